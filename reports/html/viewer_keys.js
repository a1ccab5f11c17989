// Keys of the viewer. They act while the viewer is in sight, and never in a field or list that uses them itself.
vm.startViewerKeys = () => {
  const { viewer, viewerState: state } = vm;
  const modes = ['side', 'swipe', 'blink', 'difference', 'flip'];

  const inSight = () => {
    const box = vm.byId('v-stage').getBoundingClientRect();
    return !viewer.root.hidden && Math.min(box.bottom, innerHeight) - Math.max(box.top, 0) > box.height / 3;
  };
  const movePixel = (key) => {
    const size = vm.viewerDraw.size();
    if (!size) return;
    const at = state.pixel ?? { x: Math.floor(size.width / 2), y: Math.floor(size.height / 2) };
    const [dx, dy] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[key];
    viewer.setPixel({ x: Math.min(size.width - 1, Math.max(0, at.x + dx)), y: Math.min(size.height - 1, Math.max(0, at.y + dy)) });
    vm.say(vm.byId('v-pixel').textContent);
  };
  // Keys that would otherwise scroll or press a button: only with the picture in focus, or filling the window.
  const focused = () => document.activeElement === viewer.canvas || viewer.root.classList.contains('full');

  const actions = {
    ArrowLeft: () => viewer.step(viewer.select.cell, -1),
    ArrowRight: () => viewer.step(viewer.select.cell, 1),
    ArrowUp: () => focused() && (viewer.step(viewer.select.view, -1), true),
    ArrowDown: () => focused() && (viewer.step(viewer.select.view, 1), true),
    '[': () => viewer.step(viewer.select.scene, -1),
    ']': () => viewer.step(viewer.select.scene, 1),
    ',': () => viewer.setSwipe(state.swipe - 0.05),
    '.': () => viewer.setSwipe(state.swipe + 0.05),
    '+': () => viewer.zoom(1.5),
    '=': () => viewer.zoom(1.5),
    '-': () => viewer.zoom(1 / 1.5),
    0: () => viewer.fit(),
    w: () => viewer.worst(),
    f: () => viewer.full(),
    Escape: () => viewer.root.classList.contains('full') && (viewer.full(false), true),
    ' ': () => state.mode === 'blink' && document.activeElement === viewer.canvas && (viewer.stopBlink(), viewer.swap(), true),
  };
  modes.forEach((mode, i) => { actions[i + 1] = () => viewer.setMode(mode); });

  addEventListener('keydown', (event) => {
    if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey || vm.byId('help').open || !inSight()) return;
    const target = event.target;
    const typing = target.matches?.('input[type=search], textarea, select, input[type=range]');
    const arrow = event.key.startsWith('Arrow');
    if (typing && !(target.matches('input[type=range]') && !arrow)) return;
    if (target.matches?.('[role=radio]') && arrow) {  // arrows go round the modes, as in any group of radio buttons
      const by = event.key === 'ArrowRight' || event.key === 'ArrowDown' ? 1 : modes.length - 1;
      viewer.setMode(modes[(modes.indexOf(state.mode) + by) % modes.length]);
      viewer.root.querySelector('[aria-checked=true]').focus();
      event.preventDefault();
      return;
    }
    if (arrow && event.shiftKey) {
      if (!focused()) return;
      movePixel(event.key);
      event.preventDefault();
      return;
    }
    const action = actions[event.key];
    if (action && action() !== false) event.preventDefault();
  });
};
