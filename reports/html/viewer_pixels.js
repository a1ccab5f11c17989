// The values of a pixel, from what is embedded, and how exact they are.
vm.viewerPixels = (() => {
  const state = vm.viewerState;

  // The FLIP maps are coloured with this polynomial (magma); a colour is turned back to the nearest of its values.
  const magma = [[-0.002136485053939582, -0.000749655052795221, -0.005386127855323933],
    [0.2516605407371642, 0.6775232436837668, 2.494026599312351],
    [8.353717279216625, -3.577719514958484, 0.3144679030132573],
    [-27.66873308576866, 14.26473078096533, -13.64921318813922],
    [52.17613981234068, -27.94360607168351, 12.94416944238394],
    [-50.76852536473588, 29.04658282127291, 4.23415299384598],
    [18.65570506591883, -11.48977351997711, -5.601961508734096]];
  const colours = Array.from({ length: 513 }, (_, i) => [0, 1, 2].map((c) =>
    255 * Math.min(1, Math.max(0, magma.reduceRight((sum, row) => sum * (i / 512) + row[c], 0)))));
  const flipValue = (data, at) => {
    let best = 0, least = Infinity;
    colours.forEach((colour, i) => {
      const distance = colour.reduce((sum, v, c) => sum + (v - data[at + c]) ** 2, 0);
      if (distance < least) { least = distance; best = i; }
    });
    return best / 512;
  };

  const linearText = (picture, { x, y }) => {
    const at = 4 * (y * picture.width + x);
    return [0, 1, 2].map((c) => vm.pictures.linear[picture.data[at + c]].toFixed(4)).join('  ');
  };

  const show = () => {
    const out = vm.byId('v-pixel'), precision = vm.byId('v-precision');
    if (!state.pixel || !state.loaded) return;
    const { a, b, flip } = state.loaded, { x, y } = state.pixel;
    const inside = (picture) => picture && x < picture.width && y < picture.height;
    const lines = [`pixel ${x}, ${y}   linear R G B`];
    if (inside(a)) lines.push(`cell       ${linearText(a, state.pixel)}`);
    if (inside(b)) lines.push(`${state.against < 0 ? 'reference' : 'other    '}  ${linearText(b, state.pixel)}`);
    const difference = vm.viewerDifference(x, y);
    if (difference) lines.push(`difference ${difference.value.map(vm.signed).join('  ')}`);
    if (inside(flip)) lines.push(`FLIP       ${flipValue(flip.data, 4 * (y * flip.width + x)).toFixed(3)}`);
    out.textContent = lines.join('\n');
    const scale = vm.model.difference_scale;
    precision.textContent = 'Cell and reference are read from 8-bit sRGB previews: exact to half a code (0.0002 in the darks, '
      + '0.005 in the lights). '
      + (difference?.from === 'map'
        ? `The difference is read from its own map: exact to ${(scale / 255).toFixed(4)}, saturated at \u00b1${scale}. `
        : 'The difference is that of the previews. ')
      + 'Full precision: the EXR files of the run.';
  };
  return { show };
})();
