// Pictures with a marked pixel: the whole with rings around what is worst, and the neighbourhood of the worst enlarged.
// Drawn when they come into sight, and all of them before printing.
vm.startSpots = () => {
  const side = 220, around = 7;  // of a drawing in CSS pixels; of the pixels shown on each side of the worst
  const ring = (context, x, y, r) => {
    for (const [colour, width] of [['#000', 4], ['#fff', 1.6]]) {
      context.strokeStyle = colour;
      context.lineWidth = width;
      context.beginPath();
      context.arc(x, y, r, 0, 2 * Math.PI);
      context.stroke();
    }
  };
  const drawing = (label, picture, from, size, marks) => {
    const ratio = Math.min(side / size.width, side / size.height);
    const canvas = vm.make('canvas', { width: Math.max(1, Math.round(size.width * ratio)), height: Math.max(1, Math.round(size.height * ratio)) });
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', label);
    const context = canvas.getContext('2d');
    context.imageSmoothingEnabled = false;
    context.drawImage(picture.canvas, from.x, from.y, size.width, size.height, 0, 0, canvas.width, canvas.height);
    for (const [x, y] of marks) ring(context, (x + 0.5 - from.x) * ratio, (y + 0.5 - from.y) * ratio, Math.max(6, 0.8 * ratio));
    return vm.make('div', {}, canvas, vm.make('div', { textContent: label }));
  };
  const whole = (label, picture, marks) => drawing(label, picture, { x: 0, y: 0 }, picture, marks);
  const enlarged = (label, picture, x, y) => {
    const width = Math.min(picture.width, 2 * around + 1), height = Math.min(picture.height, 2 * around + 1);
    const from = { x: Math.min(Math.max(0, x - around), picture.width - width), y: Math.min(Math.max(0, y - around), picture.height - height) };
    return drawing(label, picture, from, { width, height }, [[x, y]]);
  };
  const fill = async (figure) => {
    if (figure.dataset.done) return;
    figure.dataset.done = 'true';
    const x = Number(figure.dataset.x), y = Number(figure.dataset.y);
    const marks = figure.dataset.marks ? figure.dataset.marks.split(' ').map((pair) => pair.split(',').map(Number)) : x >= 0 ? [[x, y]] : [];
    for (const [name, index] of [['picture', figure.dataset.picture], ['difference', figure.dataset.difference]]) {
      const loaded = await vm.pictures.get(Number(index)).catch(() => null);
      if (!loaded) continue;
      figure.append(whole(name, loaded, marks));
      if (x >= 0) figure.append(enlarged(`${name} around ${x}, ${y}`, loaded, x, y));
    }
    figure.dataset.drawn = 'true';
  };
  const all = [...document.querySelectorAll('.spots')];
  const observer = new IntersectionObserver((seen) => {
    for (const { isIntersecting, target } of seen)
      if (isIntersecting) {
        fill(target);
        observer.unobserve(target);
      }
  }, { rootMargin: '300px' });
  for (const figure of all) observer.observe(figure);

  // What is folded is printed too; afterwards it is as it was. A failing case is open anyway; cases and checks that hold
  // stay folded, or they would be most of the paper.
  let opened = [];
  addEventListener('beforeprint', () => {
    all.forEach(fill);
    opened = [...document.querySelectorAll('details.fold:not([open])')].filter((fold) => !fold.closest('.case'));
    for (const fold of opened) fold.open = true;
  });
  addEventListener('afterprint', () => {
    for (const fold of opened) fold.open = false;
  });

  // A link to something inside a closed fold opens it.
  addEventListener('hashchange', () => document.getElementById(location.hash.slice(1))?.closest('details')?.setAttribute('open', ''));
};
