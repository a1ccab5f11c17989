// The viewer's controls: choosing cells, modes, zoom; what is around the picture.
vm.viewer = (() => {
  const state = vm.viewerState;
  const { entries, blocks } = vm.model;
  const root = vm.byId('viewer'), canvas = vm.byId('v-canvas');
  const select = { scene: vm.byId('v-scene'), cell: vm.byId('v-cell'), view: vm.byId('v-view'), against: vm.byId('v-against') };
  const modeNames = { side: 'Side by side', swipe: 'Swipe', blink: 'Blink', difference: 'Signed difference', flip: 'FLIP map' };
  let blinkTimer = 0, generation = 0;

  const current = () => entries[state.entry];
  const blockOf = (entry) => blocks.findIndex((block) => block.cells.includes(entry.cell));
  const entriesOf = (block) => entries.map((entry, index) => ({ entry, index })).filter(({ entry }) => blocks[block].cells.includes(entry.cell));
  const viewName = (entry) => {
    const view = vm.results.results[entry.cell].views[entry.view];
    return view.name || `view ${view.index}`;
  };
  const fill = (list, options, chosen) => {
    list.replaceChildren(...options.map(([value, text]) => vm.make('option', { value, textContent: text })));
    list.value = String(chosen);
  };

  const fillSelects = () => {
    const block = blockOf(current());
    const shown = blocks.map((b, i) => [i, b.title]).filter(([i]) => entriesOf(i).length > 0);
    fill(select.scene, shown, block);
    const cells = [...new Map(entriesOf(block).map(({ entry }) => [entry.cell, vm.cellName(entry.cell)]))];
    fill(select.cell, cells, current().cell);
    const same = entriesOf(block).filter(({ entry }) => entry.cell === current().cell);
    fill(select.view, same.map(({ entry, index }) => [index, viewName(entry)]), state.entry);
    const others = entriesOf(block).filter(({ entry, index }) => index !== state.entry && viewName(entry) === viewName(current()));
    if (!others.some(({ index }) => index === state.against)) state.against = -1;
    fill(select.against, [[-1, 'the reference'], ...others.map(({ entry, index }) => [index, vm.cellName(entry.cell)])], state.against);
  };

  const message = () => {
    const loaded = state.loaded, note = current().note;
    const missing = [];
    if (!loaded) return '';
    if (['side', 'swipe', 'blink'].includes(state.mode)) {
      if (!loaded.a) missing.push('the picture of this cell is not in the report');
      if (!loaded.b) missing.push('there is no picture to compare with');
    }
    if (state.mode === 'difference' && !loaded.difference) missing.push(vm.viewerDifference(0, 0) ? 'computed from the 8-bit previews: differences below 1/255 are not seen' : 'there is no difference picture');
    if (state.mode === 'flip' && !loaded.flip) missing.push(state.against >= 0 ? 'FLIP maps are made against the reference only' : 'there is no FLIP map');
    return missing.length > 0 ? missing.join('; ') + (note ? ` (${note})` : '') : '';
  };

  const facts = () => {
    const result = vm.results.results[current().cell], view = result.views[current().view];
    const box = vm.byId('v-facts');
    const item = (name, text) => vm.make('span', {}, vm.make('span', { className: 'dim', textContent: `${name} ` }), text);
    box.replaceChildren();
    if (view.frame_wall) box.append(item('this view', `${vm.ms(view.frame_wall.median)} ms`));
    if (view.error)
      for (const [name, key] of [['RMSE', 'rmse'], ['max', 'max'], ['FLIP p99', 'flip_p99'], ['SSIM', 'ssim']])
        box.append(item(name, key === 'ssim' ? (view.error.ssim ?? NaN).toFixed(4) : key === 'flip_p99' ? vm.number(view.error[key]) : vm.scientific(view.error[key])));
    if (view.reference) box.append(item('reference bound', vm.scientific(view.reference.bound) + (view.reference.estimate ? ' (estimate)' : '')));
    if (result.ignored_effects?.length > 0) box.append(vm.make('span', { className: 'badge bad', textContent: `${result.ignored_effects.join(', ')} ignored: the picture lacks it` }));
    if (view.shows_nothing) box.append(vm.make('span', { className: 'badge neutral', textContent: 'shows nothing but the background: its errors say nothing' }));
    if (result.outcome !== 'ok') box.append(item('outcome', `${result.outcome}: ${result.reason}`));
    box.append(vm.commandBox(result.command));
  };

  const labels = () => {
    const a = vm.cellName(current().cell);
    const b = state.against >= 0 ? vm.cellName(entries[state.against].cell) : 'reference';
    const text = { side: [a, b], swipe: [a, b], blink: [state.blinkB ? '' : a, state.blinkB ? b : ''],
      difference: [`${a} minus ${b}`, `grey: equal; full scale \u00b1${Number((vm.model.difference_scale / state.gain).toPrecision(3))}`],
      flip: [`FLIP, ${a}`, 'black: equal; bright: visible'] }[state.mode];
    vm.byId('v-label-a').textContent = text[0];
    vm.byId('v-label-b').textContent = text[1];
    canvas.setAttribute('aria-label', `${modeNames[state.mode]}: ${a} against ${b}, ${viewName(current())}`);
  };

  // Everything that follows from the state, without loading.
  const refresh = () => {
    for (const button of root.querySelectorAll('[data-mode]')) {
      const on = button.dataset.mode === state.mode;
      button.setAttribute('aria-checked', String(on));
      button.tabIndex = on ? 0 : -1;
    }
    vm.byId('v-swipe-box').hidden = state.mode !== 'swipe';
    vm.byId('v-gain-box').hidden = state.mode !== 'difference';
    vm.byId('v-swipe').value = String(Math.round(state.swipe * 100));
    vm.byId('v-message').textContent = message();
    labels();
    vm.viewerDraw.draw();
    if (state.loaded && vm.viewerDraw.size()) vm.byId('v-zoom').textContent = `${Math.round(vm.viewerDraw.scale() * 100)} %`;
    vm.viewerPixels.show();
  };

  const reload = async () => {
    const mine = ++generation;
    fillSelects();
    facts();
    const loaded = await vm.viewerLoad();
    if (mine !== generation) return;  // a later choice overtook this one
    state.loaded = loaded;
    refresh();
    root.dataset.ready = String(mine);
    const against = state.against >= 0 ? vm.cellName(entries[state.against].cell) : 'the reference';
    vm.say(`${vm.cellName(current().cell)}, ${viewName(current())}, against ${against}`);
  };

  const stopBlink = () => { clearInterval(blinkTimer); blinkTimer = 0; };
  const startBlink = () => {
    stopBlink();
    if (!matchMedia('(prefers-reduced-motion: reduce)').matches) blinkTimer = setInterval(swap, 600);
  };
  const swap = () => { state.blinkB = !state.blinkB; labels(); vm.viewerDraw.draw(); };

  const setMode = (mode) => {
    state.mode = mode;
    stopBlink();
    if (mode === 'blink') startBlink();
    refresh();
    vm.say(modeNames[mode] + (message() ? `: ${message()}` : ''));
  };

  // `against`: another entry to compare with; without it the choice stays.
  const show = (entry, scroll = false, against = null) => {
    const next = entries[entry], block = blockOf(next);
    if (blockOf(current()) !== block) { state.centre = null; state.scale = 0; state.pixel = null; }
    state.entry = entry;
    if (against !== null) state.against = against;
    reload();
    if (scroll) {
      vm.byId('images').scrollIntoView();
      canvas.focus({ preventScroll: true });
    }
  };
  // The same view of another cell, where it has one.
  const showCell = (cell) => {
    const candidates = entries.map((entry, index) => ({ entry, index })).filter(({ entry }) => entry.cell === cell);
    show((candidates.find(({ entry }) => viewName(entry) === viewName(current())) ?? candidates[0]).index);
  };
  const step = (list, by) => {
    const next = list.selectedIndex + by;
    if (next < 0 || next >= list.options.length) return vm.say(by < 0 ? 'This is the first' : 'This is the last');
    list.selectedIndex = next;
    list.dispatchEvent(new Event('change'));
  };

  const zoom = (factor, at = null) => {
    if (!vm.viewerDraw.size()) return;
    const before = vm.viewerDraw.scale(), after = Math.min(64, Math.max(vm.viewerDraw.fitted() / 4, before * factor));
    if (at) {  // the point under the pointer stays where it is
      const pane = vm.viewerDraw.panes().find((p) => at.x >= p.x && at.x < p.x + p.width) ?? vm.viewerDraw.panes()[0];
      const c = vm.viewerDraw.centre(), dx = at.x - pane.x - pane.width / 2, dy = at.y - pane.height / 2;
      state.centre = { x: c.x + dx / before - dx / after, y: c.y + dy / before - dy / after };
    }
    state.scale = after;
    refresh();
  };
  const fit = () => { state.scale = 0; state.centre = null; refresh(); };
  const setPixel = (pixel) => {
    state.pixel = pixel;
    vm.viewerDraw.draw();
    vm.viewerPixels.show();
  };
  const worst = () => {
    const error = vm.results.results[current().cell].views[current().view].error;
    if (!error || error.max_x < 0) return vm.say('The worst pixel is not known');
    state.centre = { x: error.max_x + 0.5, y: error.max_y + 0.5 };
    state.scale = Math.max(12, vm.viewerDraw.fitted());
    setPixel({ x: error.max_x, y: error.max_y });
    refresh();
    vm.say(`Worst pixel ${error.max_x}, ${error.max_y}: ${vm.scientific(error.max)}`);
  };
  const full = (on = !root.classList.contains('full')) => {
    root.classList.toggle('full', on);
    vm.byId('v-full').setAttribute('aria-pressed', String(on));
    refresh();
  };
  const setSwipe = (value) => { state.swipe = Math.min(1, Math.max(0, value)); refresh(); };

  const startPointer = () => {
    let drag = null;
    const point = (event) => {
      const box = canvas.getBoundingClientRect();
      return { x: event.clientX - box.left, y: event.clientY - box.top };
    };
    canvas.addEventListener('pointerdown', (event) => {
      if (!vm.viewerDraw.size()) return;
      const p = point(event);
      const edge = state.mode === 'swipe' && Math.abs(p.x - state.swipe * canvas.clientWidth) < 16;
      drag = { edge, from: p, centre: vm.viewerDraw.centre() };
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener('pointermove', (event) => {
      const p = point(event);
      if (!drag) {
        const pixel = vm.viewerDraw.pixelAt(p.x, p.y);
        if (pixel) setPixel(pixel);
      } else if (drag.edge) {
        setSwipe(p.x / canvas.clientWidth);
      } else {
        const s = vm.viewerDraw.scale();
        state.scale = s;
        state.centre = { x: drag.centre.x - (p.x - drag.from.x) / s, y: drag.centre.y - (p.y - drag.from.y) / s };
        vm.viewerDraw.draw();
      }
    });
    for (const name of ['pointerup', 'pointercancel']) canvas.addEventListener(name, () => { drag = null; });
    canvas.addEventListener('wheel', (event) => {
      // The page scrolls over a picture that nobody has chosen.
      if (document.activeElement !== canvas && !event.ctrlKey && !root.classList.contains('full')) return;
      event.preventDefault();
      zoom(2 ** (-event.deltaY / 300), point(event));
    }, { passive: false });
    canvas.addEventListener('pointerdown', () => canvas.focus({ preventScroll: true }));
  };

  const start = () => {
    if (entries.length === 0) return;
    root.hidden = false;
    if (innerWidth < 640) state.mode = 'swipe';  // two pictures side by side would be too small
    select.scene.addEventListener('change', () => show(entriesOf(Number(select.scene.value))[0].index));
    select.cell.addEventListener('change', () => showCell(Number(select.cell.value)));
    select.view.addEventListener('change', () => show(Number(select.view.value)));
    select.against.addEventListener('change', () => { state.against = Number(select.against.value); reload(); });
    for (const button of root.querySelectorAll('[data-mode]')) button.addEventListener('click', () => setMode(button.dataset.mode));
    vm.byId('v-in').addEventListener('click', () => zoom(1.5));
    vm.byId('v-out').addEventListener('click', () => zoom(1 / 1.5));
    vm.byId('v-fit').addEventListener('click', fit);
    vm.byId('v-worst').addEventListener('click', worst);
    vm.byId('v-full').addEventListener('click', () => full());
    vm.byId('v-gain').addEventListener('change', (event) => { state.gain = Number(event.target.value); refresh(); });
    vm.byId('v-swipe').addEventListener('input', (event) => setSwipe(Number(event.target.value) / 100));
    new ResizeObserver(() => { if (state.loaded) refresh(); }).observe(canvas);
    startPointer();
    reload();
  };
  return { start, show, step, select, setMode, zoom, fit, worst, full, setPixel, setSwipe, swap, stopBlink, root, canvas };
})();
