// What the viewer shows: which two pictures, in which mode, from where. The pictures of a state are loaded together.
vm.viewerState = {
  entry: 0,       // of model.entries
  against: -1,    // the reference, or another entry
  mode: 'side',
  gain: 1,
  swipe: 0.5,
  blinkB: false,  // in blink: which of the two is shown
  scale: 0,       // screen pixels (CSS) a picture's pixel; 0: fitted
  centre: null,   // of the picture, in its pixels; null: its middle
  pixel: null,    // whose values are shown
  loaded: null,   // {a, b, difference, flip} of the entry and against
  problem: '',
};

vm.viewerLoad = async () => {
  const state = vm.viewerState;
  const entry = vm.model.entries[state.entry];
  const other = state.against >= 0 ? vm.model.entries[state.against] : null;
  const wanted = [entry.rendered, other ? other.rendered : entry.reference, other ? -1 : entry.difference,
    other ? -1 : entry.flip];
  const [a, b, difference, flip] = await Promise.all(wanted.map((index) => vm.pictures.get(index).catch(() => null)));
  return { a, b, difference, flip };
};

// Test minus reference of a pixel and how it is known: {value: [r, g, b], from: 'map' or 'previews'}; null: unknown.
vm.viewerDifference = (x, y) => {
  const { a, b, difference } = vm.viewerState.loaded;
  if (difference) {
    const at = 4 * (y * difference.width + x);
    const scale = vm.model.difference_scale;
    return { value: [0, 1, 2].map((c) => (difference.data[at + c] / 255 - 0.5) * 2 * scale), from: 'map' };
  }
  if (!a || !b || a.width !== b.width || a.height !== b.height) return null;
  const at = 4 * (y * a.width + x);
  const linear = vm.pictures.linear;
  return { value: [0, 1, 2].map((c) => linear[a.data[at + c]] - linear[b.data[at + c]]), from: 'previews' };
};
