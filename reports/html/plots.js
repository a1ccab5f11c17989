// Points of the plots: a tooltip under the pointer or the focus, arrow keys from point to point, Enter to the picture.
vm.startPlots = () => {
  const tip = vm.byId('tip');
  const show = (point) => {
    tip.textContent = point.getAttribute('aria-label');
    tip.hidden = false;
    const box = point.querySelector('.hit').getBoundingClientRect();
    const size = tip.getBoundingClientRect();
    const left = Math.min(Math.max(8, box.left + box.width / 2 - size.width / 2), innerWidth - size.width - 8);
    const top = box.top - size.height - 6;
    tip.style.left = `${left}px`;
    tip.style.top = `${top < 52 ? box.bottom + 6 : top}px`;
  };
  const hide = () => { tip.hidden = true; };
  const open = (point) => {
    const entry = vm.model.entries.findIndex((e) => e.cell === Number(point.dataset.cell));
    if (entry >= 0) vm.viewer.show(entry, true);
    else vm.say('There is no picture of this cell in the report');
  };
  for (const plot of document.querySelectorAll('svg.plot')) {
    const points = [...plot.querySelectorAll('.point')];
    points[0].setAttribute('tabindex', '0');
    points.forEach((point, at) => {
      point.addEventListener('pointerenter', () => show(point));
      point.addEventListener('pointerleave', hide);
      point.addEventListener('focus', () => show(point));
      point.addEventListener('blur', hide);
      point.addEventListener('click', () => open(point));
      point.addEventListener('keydown', (event) => {
        const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
        if (event.key === 'Enter') open(point);
        else if (event.key === 'Escape') hide();
        else if (step) {
          const next = points[(at + step + points.length) % points.length];
          point.setAttribute('tabindex', '-1');
          next.setAttribute('tabindex', '0');
          next.focus();
        } else return;
        event.preventDefault();
        event.stopPropagation();
      });
    });
  }
  addEventListener('scroll', () => {
    const point = document.activeElement;
    if (point?.matches('.point') && !tip.hidden) show(point);
    else hide();
  }, { passive: true });
};
