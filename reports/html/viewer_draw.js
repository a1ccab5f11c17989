// Draws the state on the canvas: one pane, or two side by side, under one linked zoom and pan.
vm.viewerDraw = (() => {
  const state = vm.viewerState;
  const canvas = vm.byId('v-canvas');
  let cache = { of: null, gain: 0, canvas: null };

  const panes = () => {
    const width = canvas.clientWidth, height = canvas.clientHeight;
    if (state.mode !== 'side') return [{ x: 0, width, height }];
    const half = Math.floor(width / 2);
    return [{ x: 0, width: half - 1, height }, { x: half + 1, width: width - half - 1, height }];
  };
  const size = () => state.loaded?.a ?? state.loaded?.b ?? state.loaded?.difference ?? state.loaded?.flip;
  const fitted = () => {
    const picture = size(), pane = panes()[0];
    return Math.min(pane.width / picture.width, pane.height / picture.height);
  };
  const scale = () => state.scale || fitted();
  const centre = () => state.centre ?? { x: size().width / 2, y: size().height / 2 };

  // The picture's pixel under a point of the canvas (CSS pixels); null outside.
  const pixelAt = (x, y) => {
    if (!size()) return null;
    const pane = panes().find((p) => x >= p.x && x < p.x + p.width);
    if (!pane) return null;
    const px = Math.floor((x - pane.x - pane.width / 2) / scale() + centre().x);
    const py = Math.floor((y - pane.height / 2) / scale() + centre().y);
    return px >= 0 && py >= 0 && px < size().width && py < size().height ? { x: px, y: py } : null;
  };

  // The signed difference as a picture: 50 % grey is equal. The embedded map as it is, or redrawn with the gain.
  const differencePicture = () => {
    const { difference, a } = state.loaded;
    if (difference && state.gain === 1) return difference.canvas;
    if (cache.of === state.loaded && cache.gain === state.gain) return cache.canvas;
    const { width, height } = difference ?? a;
    const out = vm.make('canvas', { width, height });
    const image = new ImageData(width, height);
    const factor = 127.5 * state.gain / vm.model.difference_scale;
    for (let y = 0, at = 0; y < height; ++y)
      for (let x = 0; x < width; ++x, at += 4) {
        const { value } = vm.viewerDifference(x, y);
        for (let c = 0; c < 3; ++c) image.data[at + c] = 127.5 + factor * value[c];
        image.data[at + 3] = 255;
      }
    out.getContext('2d').putImageData(image, 0, 0);
    cache = { of: state.loaded, gain: state.gain, canvas: out };
    return out;
  };

  const paint = (context, picture, pane, from = 0, to = 1) => {
    if (!picture) return;
    const s = scale(), c = centre();
    context.save();
    context.beginPath();
    context.rect(pane.x + from * pane.width, 0, (to - from) * pane.width, pane.height);
    context.clip();
    context.imageSmoothingEnabled = s < 1;
    context.drawImage(picture, pane.x + pane.width / 2 - c.x * s, pane.height / 2 - c.y * s, picture.width * s,
      picture.height * s);
    context.restore();
  };

  const mark = (context, pane) => {
    if (!state.pixel) return;
    const s = scale(), c = centre(), r = Math.max(s, 7);
    const x = pane.x + pane.width / 2 + (state.pixel.x + 0.5 - c.x) * s, y = pane.height / 2 + (state.pixel.y + 0.5 - c.y) * s;
    context.save();
    context.beginPath();
    context.rect(pane.x, 0, pane.width, pane.height);
    context.clip();
    for (const [colour, width] of [['#000', 3], ['#fff', 1]]) {
      context.strokeStyle = colour;
      context.lineWidth = width;
      context.strokeRect(x - r / 2, y - r / 2, r, r);
    }
    context.restore();
  };

  const edge = (context, pane) => {
    const x = state.swipe * pane.width;
    context.fillStyle = '#fff';
    context.fillRect(x - 1, 0, 2, pane.height);
    context.beginPath();
    context.arc(x, pane.height / 2, 9, 0, 2 * Math.PI);
    context.fill();
  };

  const draw = () => {
    const ratio = devicePixelRatio || 1;
    canvas.width = Math.round(canvas.clientWidth * ratio);
    canvas.height = Math.round(canvas.clientHeight * ratio);
    if (!state.loaded || !size() || canvas.width === 0) return;
    const context = canvas.getContext('2d');
    context.scale(ratio, ratio);
    const { a, b, flip } = state.loaded;
    const all = panes(), pane = all[0];
    if (state.mode === 'side') {
      paint(context, a?.canvas, all[0]);
      paint(context, b?.canvas, all[1]);
    } else if (state.mode === 'swipe') {
      paint(context, a?.canvas, pane, 0, state.swipe);
      paint(context, b?.canvas, pane, state.swipe, 1);
      edge(context, pane);
    } else if (state.mode === 'blink') {
      paint(context, (state.blinkB ? b : a)?.canvas, pane);
    } else if (state.mode === 'difference') {
      if (vm.viewerDifference(0, 0)) paint(context, differencePicture(), pane);
    } else {
      paint(context, flip?.canvas, pane);
    }
    for (const p of all) mark(context, p);
  };
  return { draw, panes, size, scale, fitted, centre, pixelAt };
})();
