// Checks of the picture viewer: modes, keys, swipe, zoom, values of a pixel against the PNG files.
import { strict as assert } from 'node:assert';
import { join } from 'node:path';
import { linear, readPng } from './png_reader.mjs';
import { keys } from './webdriver.mjs';

const state = (browser) => browser.run(`const s = vm.viewerState; return { ...s, loaded: null, cell: vm.model.entries[s.entry].cell,
  view: vm.model.entries[s.entry].view, zoom: vm.viewerDraw.scale() }`);
const settle = async (browser) => {
  await browser.until('the pictures are there', () => browser.run('return vm.viewerState.loaded !== null'));
  await new Promise((done) => { setTimeout(done, 150); });
};
// A colour of the canvas, at a share of its width and height.
const colour = (browser, u, v) => browser.run(`const c = document.getElementById('v-canvas');
  const one = new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true });
  one.drawImage(c, -Math.floor(arguments[0] * c.width), -Math.floor(arguments[1] * c.height));
  return [...one.getImageData(0, 0, 1, 1).data].slice(0, 3)`, u, v);
const box = (browser) => browser.run('const r = document.getElementById("v-canvas").getBoundingClientRect(); return [r.x, r.y, r.width, r.height]');

// The coarsest slices on cpu: their picture differs visibly from the reference.
const chosen = (results) => results.results.findIndex(({ key, quality }) => key.scene === 'ball' && key.method === 'texture3d_slices' && key.backend === 'cpu' && quality.value === 4);
const showChosen = async ({ browser, results }) => {
  const cell = chosen(results);
  await browser.run('vm.viewer.show(vm.model.entries.findIndex((e) => e.cell === arguments[0] && e.view === 0), true); vm.viewer.setMode("side"); vm.viewer.fit()', cell);
  await settle(browser);
  return results.results[cell].views[0];
};

const modesByKey = async (context) => {
  const { browser } = context;
  await showChosen(context);
  const seen = [];
  for (const [key, mode] of [['1', 'side'], ['2', 'swipe'], ['3', 'blink'], ['4', 'difference'], ['5', 'flip']]) {
    await browser.press(key);
    assert.equal((await state(browser)).mode, mode);
    assert.equal(await browser.run('return document.querySelector("[data-mode][aria-checked=true]").dataset.mode'), mode);
    seen.push((await browser.run('return document.getElementById("v-canvas").toDataURL()')));
  }
  assert.equal(new Set(seen.filter((_, i) => i !== 2)).size, 4, 'the modes look different');
};

const sideBySide = async (context) => {
  const { browser, folder } = context;
  const view = await showChosen(context);
  const middle = (file) => { const png = readPng(join(folder, file)); return png.code(png.width / 2, png.height / 2); };
  const near = (a, b) => a.every((v, i) => Math.abs(v - b[i]) <= 2);
  const [left, right] = [await colour(browser, 0.25, 0.5), await colour(browser, 0.75, 0.5)];
  const [test, reference] = [middle(view.rendered.preview), middle(view.reference_image.preview)];
  assert.ok(near(left, test), `left ${left}, the cell's PNG ${test}`);
  assert.ok(near(right, reference), `right ${right}, the reference's PNG ${reference}`);
  assert.ok(!near(left, right), 'the two differ');
};

const swipe = async (context) => {
  const { browser } = context;
  await showChosen(context);
  await browser.press('2');
  const [x, y, width, height] = await box(browser);
  await browser.pointer([[x + width / 2, y + height / 2], [x + width * 0.6, y + height / 2], [x + width * 0.8, y + height / 2]], { drag: true });
  assert.ok(Math.abs((await state(browser)).swipe - 0.8) < 0.02, 'the edge follows the pointer');
  const middle = await colour(browser, 0.5, 0.4);  // away from the frame round the pixel under the pointer
  await browser.run('const r = document.getElementById("v-swipe"); r.focus()');
  for (let i = 0; i < 50; ++i) await browser.press(keys.left);
  const moved = (await state(browser)).swipe;
  assert.ok(Math.abs(moved - 0.3) < 0.03, `the slider moves by keys: ${moved}`);
  assert.notDeepEqual(await colour(browser, 0.5, 0.4), middle, 'the other picture is under the same place');
};

const blink = async (context) => {
  const { browser } = context;
  await showChosen(context);
  await browser.press('3');
  const which = async () => (await state(browser)).blinkB;
  const first = await which();
  await browser.until('it blinks by itself', async () => (await which()) !== first, 4000);
  await browser.press(' ');
  const stopped = await which(), shown = await colour(browser, 0.5, 0.4);
  await new Promise((done) => { setTimeout(done, 1500); });
  assert.equal(await which(), stopped, 'Space stops it');
  await browser.press(' ');
  assert.equal(await which(), !stopped, 'Space swaps by hand');
  assert.notDeepEqual(await colour(browser, 0.5, 0.4), shown);
};

const arrows = async (context) => {
  const { browser, results } = context;
  await showChosen(context);
  const before = await state(browser);
  await browser.press(keys.right);
  await settle(browser);
  const after = await state(browser);
  assert.notEqual(after.cell, before.cell);
  assert.equal(after.view, before.view, 'another cell, the same view');
  await browser.press(keys.left);
  await settle(browser);
  assert.equal((await state(browser)).cell, before.cell);
  await browser.press(keys.down);
  await settle(browser);
  assert.equal((await state(browser)).view, 1);
  await browser.press('[');
  await settle(browser);
  assert.equal(results.results[(await state(browser)).cell].key.scene, results.scenes[1].name);
  assert.ok((await browser.run('return document.getElementById("live").textContent')).length > 0, 'it is announced');
};

const pixelValues = async (context) => {
  const { browser, folder } = context;
  const view = await showChosen(context);
  const test = readPng(join(folder, view.rendered.preview)), reference = readPng(join(folder, view.reference_image.preview));
  const map = readPng(join(folder, view.difference.preview));
  const [x, y, width, height] = await box(browser);
  await browser.pointer([[x + width * 0.25 + 21, y + height / 2 - 13]]);
  const { pixel } = await state(browser);
  assert.ok(pixel, 'there is a pixel under the pointer');
  const lines = () => browser.run('return document.getElementById("v-pixel").textContent.split("\\n")');
  const numbers = (line) => line.replaceAll('\u2212', '-').match(/[-+]?\d+\.\d+/g).map(Number);
  const compare = async (at) => {
    const text = await lines();
    assert.ok(text[0].includes(`${at.x}, ${at.y}`), text[0]);
    const close = (found, wanted, what) => wanted.forEach((v, c) => assert.ok(Math.abs(found[c] - v) < 6e-5, `${what}: ${found} for ${wanted}`));
    close(numbers(text[1]), test.code(at.x, at.y).map(linear), 'cell');
    close(numbers(text[2]), reference.code(at.x, at.y).map(linear), 'reference');
    close(numbers(text[3]), map.code(at.x, at.y).map((code) => (code / 255 - 0.5) * 0.1), 'difference');
    // The map's own coding apart, the difference is that of the two pictures.
    const direct = test.code(at.x, at.y).map((code, c) => linear(code) - linear(reference.code(at.x, at.y)[c]));
    numbers(text[3]).forEach((v, c) => assert.ok(Math.abs(v - Math.max(-0.05, Math.min(0.05, direct[c]))) < 0.012, 'the sign and size are right'));
  };
  await compare(pixel);
  await browser.run('document.getElementById("v-canvas").focus()');
  await browser.press([keys.shift, keys.right]);
  const moved = (await state(browser)).pixel;
  assert.deepEqual(moved, { x: pixel.x + 1, y: pixel.y }, 'Shift and arrow move the pixel');
  await compare(moved);
  assert.match(await browser.run('return document.getElementById("v-precision").textContent'), /8-bit sRGB/);
};

const zoomAndPan = async (context) => {
  const { browser, results } = context;
  await showChosen(context);
  const fitted = (await state(browser)).zoom;
  await browser.press('+');
  assert.ok(Math.abs((await state(browser)).zoom / fitted - 1.5) < 0.01);
  const [x, y, width, height] = await box(browser);
  await browser.pointer([[x + width / 4, y + height / 2], [x + width / 4 + 40, y + height / 2], [x + width / 4 + 60, y + height / 2]], { drag: true });
  const { centre, zoom } = await state(browser);
  assert.ok(Math.abs((48 - centre.x) * zoom - 60) < 2, `both panes moved with the pointer: ${JSON.stringify(centre)}`);
  await browser.press('w');
  const { error } = results.results[chosen(results)].views[0];
  assert.deepEqual((await state(browser)).pixel, { x: error.max_x, y: error.max_y }, 'w shows the worst pixel');
  await browser.press('0');
  assert.equal((await state(browser)).zoom, fitted);
};

const fillsWindow = async (context) => {
  const { browser, shot } = context;
  await showChosen(context);
  await browser.press('f');
  await settle(browser);
  const [, , width] = await box(browser);
  assert.ok(width > 1300, `the pictures are ${width} wide`);
  await shot('screenshot-viewer.png');
  await browser.press(keys.escape);
  assert.equal(await browser.run('return document.getElementById("viewer").classList.contains("full")'), false);
};

const otherCell = async (context) => {
  const { browser } = context;
  await showChosen(context);
  await browser.run('const s = document.getElementById("v-against"); s.selectedIndex = 3; s.dispatchEvent(new Event("change"))');
  await settle(browser);
  await browser.press('5');
  assert.match(await browser.run('return document.getElementById("v-message").textContent'), /against the reference only/);
  await browser.press('4');
  assert.match(await browser.run('return document.getElementById("v-message").textContent'), /8-bit previews/);
};

const lostPictures = async ({ browser, results }) => {
  const cell = results.results.findIndex(({ views }) => views[0]?.rendered?.preview === 'images/gone.png');
  await browser.run('vm.viewer.show(vm.model.entries.findIndex((e) => e.cell === arguments[0] && e.view === 0), true); vm.viewer.setMode("side")', cell);
  await settle(browser);
  const message = await browser.run('return document.getElementById("v-message").textContent');
  for (const words of ['images/gone.png cannot be read', 'not below the results', 'no PNG preview']) assert.ok(message.includes(words), message);
};

const typingIsLeftAlone = async ({ browser }) => {
  const before = await state(browser);
  await browser.run('document.getElementById("cell-filter").focus({preventScroll: true})');
  await browser.press('5');
  await browser.press('d');
  assert.equal((await state(browser)).mode, before.mode);
  assert.equal(await browser.run('const f = document.getElementById("cell-filter"); const v = f.value; f.value = ""; return v'), '5d');
};

const thumbnails = async ({ browser }) => {
  await browser.run('document.activeElement.blur(); document.querySelector(".thumbs").scrollIntoView({block: "center"})');
  await browser.until('the small pictures are loaded', () => browser.run('const i = document.querySelector(".thumb img"); return i && i.complete && i.naturalWidth > 0'));
  const count = await browser.run('return document.querySelectorAll("section.scene:first-of-type .thumb, #scene-0 .thumb").length');
  assert.ok(count >= 9, `${count} small pictures: the reference and each method on each backend`);
  const wanted = await browser.run('const t = document.querySelectorAll("#scene-0 .thumb")[3]; t.click(); return Number(t.dataset.entry)');
  await settle(browser);
  assert.equal((await state(browser)).entry, wanted);
};

export const viewerChecks = [
  ['keys 1 to 5 choose the mode', modesByKey],
  ['side by side shows the cell and the reference', sideBySide],
  ['swipe: edge by pointer, slider by keys', swipe],
  ['blink: by itself, and by hand with Space', blink],
  ['arrows choose cell and view, brackets the scene', arrows],
  ['values of a pixel are those of the PNG files', pixelValues],
  ['zoom, pan, worst pixel', zoomAndPan],
  ['fills the window and comes back', fillsWindow],
  ['another cell instead of the reference', otherCell],
  ['pictures that are lost say why', lostPictures],
  ['keys typed into a field stay there', typingIsLeftAlone],
  ['small pictures load and open the viewer', thumbnails],
  ['nothing was said on the console', async ({ quiet }) => quiet()],
];
