// Checks of the first screen and of what leads from it: attribution, pairs, regions, hard cases, motion, effects.
import { strict as assert } from 'node:assert';
import { ms, number, points, scientific, timeToError } from './expected.mjs';

const text = (browser, selector) => browser.run('return document.querySelector(arguments[0])?.textContent ?? ""', selector);
const texts = (browser, selector) => browser.run('return [...document.querySelectorAll(arguments[0])].map((e) => e.textContent)', selector);
const resize = (browser, width, height) => browser.call('POST', '/goog/cdp/execute', { cmd: 'Emulation.setDeviceMetricsOverride',
  params: { width, height, deviceScaleFactor: 1, mobile: false } });
const ordinarySize = (browser) => browser.call('POST', '/goog/cdp/execute', { cmd: 'Emulation.clearDeviceMetricsOverride', params: {} });

const firstScreen = async ({ browser, shot }) => {
  await resize(browser, 1280, 800);
  await browser.run('scrollTo(0, 0); document.activeElement.blur()');
  const boxes = await browser.run(`return ['answer-accuracy', 'answer-stability', 'answer-effects'].map((id) => {
    const r = document.getElementById(id).getBoundingClientRect(); return [r.left, r.top, r.right, r.bottom]; })`);
  await shot('first-screen.png');
  for (const [left, top, right, bottom] of boxes)
    assert.ok(left >= 0 && top >= 46 && right <= 1280 && bottom <= 800, `an answer is not on the first screen: ${left} ${top} ${right} ${bottom}`);
  for (const id of ['scenes', 'stability', 'effects'])
    assert.ok(await browser.run('return document.querySelector(".answers a[href=\\"#" + arguments[0] + "\\"]") !== null && document.getElementById(arguments[0]) !== null', id), `a link to ${id}`);
  await ordinarySize(browser);
};

// The least over the backends of the same kind, as worked out here.
const leastTimes = async ({ browser, results }) => {
  const rows = await browser.run(`return [...document.querySelectorAll('#least-times tbody tr')].map((row) => ({
    heads: [...row.querySelectorAll('th')].map((e) => e.textContent.trim()),
    cells: [...row.querySelectorAll('td')].flatMap((td) => Array(td.colSpan).fill(td.textContent.trim())) }))`);
  assert.equal(rows[0].heads[0], results.scenes[1].name, 'real data come first');
  let compared = 0;
  for (const { heads: [scene, who], cells } of rows) {
    const method = who.split(' ')[0], hardware = who.includes('hardware');
    const wanted = [['rmse', 1e-2], ['rmse', 3e-3], ['rmse', 1e-3], ['rmse', 3e-4], ['flip_p99', 0.1], ['flip_p99', 0.05], ['flip_p99', 0.02]];
    const groups = [...new Set(results.results.filter(({ key }) => key.experiment === 'quick' && key.method === method).map(({ key }) => key.backend))]
      .filter((backend) => (results.backends.find(({ id }) => id === backend)?.software ?? true) !== hardware)
      .flatMap((backend) => [undefined, 'target_format rgba32f', 'target_format rgba8', 'target_format rgba16f']
        .map((setting) => ({ experiment: 'quick', scene, method, backend, setting })));
    wanted.forEach(([metric, target], c) => {
      const found = groups.filter(({ setting }) => (setting !== undefined) === (method === 'raycast' && scene === 'ball'))
        .map((row) => [timeToError(points(results, row, metric), target), row.backend]).filter(([t]) => !/[a-z]/.test(t.replace(/e[-+]/, '')));
      if (found.length === 0) return assert.match(cells[c], /best|no figure/);
      const value = ([t]) => Number(t.replace('\u2264\u2009', ''));
      const least = found.reduce((a, b) => (value(b) < value(a) ? b : a));
      assert.ok(cells[c].startsWith(least[0]) && cells[c].includes(least[1]), `${scene} ${who} ${metric} ${target}: ${cells[c]}, expected ${least}`);
      ++compared;
    });
  }
  assert.ok(compared > 30, `${compared} compared`);
};

const metricSwitch = async ({ browser }) => {
  const shown = () => browser.run(`const seen = (s) => document.querySelector('#least-times ' + s).offsetParent !== null; return [seen('.of-rmse'), seen('.of-flip')]`);
  assert.deepEqual(await shown(), [true, false]);
  await browser.run('document.getElementById("metric-rmse").focus()');
  await browser.press('\uE014');
  assert.deepEqual(await shown(), [false, true], 'the arrow key goes to FLIP');
  await browser.press('\uE012');
  assert.deepEqual(await shown(), [true, false]);
};

// Published cells and claims, by paper; the ratio as worked out here.
const papers = async ({ browser, results }) => {
  const rows = await browser.run(`return [...document.querySelectorAll('#claims tbody tr')].map((row) =>
    [...row.querySelectorAll('th, td')].map((e) => e.textContent.trim()))`);
  const cell = results.results.find(({ paper }) => paper);
  const ours = 1 / cell.metrics.frame_wall.stats.median;
  const published = rows.find((row) => row[0] === 'Table <1>');
  assert.deepEqual(published.slice(4), ['frames/s', number(8), number(ours), number(ours / 8)]);
  const judged = rows.find((row) => row[0] === 'P1');
  assert.deepEqual([judged[1], judged[5], judged[6], judged[7]], ['Twice <as fast>', '1.25 [1.20, 1.30]', '1.80 to 2.20', 'not reproduced']);
  assert.equal(rows.find((row) => row[0] === 'P2')[7], 'not judged');
  assert.equal(rows.find((row) => row[0] === 'c1')[7], 'reproduced', 'of a file that names no paper');
  assert.match(await text(browser, '#claims h3'), /someone2000/);
};

const stabilityLine = async ({ browser, results }) => {
  const line = await text(browser, '#answer-stability .line');
  const rows = results.hard_cases.filter(({ outcome }) => outcome !== 'not_applicable');
  assert.match(line, /FAILS/, 'in words');
  assert.match(line, /\u2717/, 'and as a symbol');
  assert.ok(line.includes(`${new Set(rows.map(({ id }) => id)).size} cases`), line);
  assert.ok(line.includes('not_a_number (raycast, gl)'), line);
  const pass = rows.filter(({ outcome }) => outcome === 'pass').length;
  assert.ok(line.includes(`${pass} of ${rows.length} checks hold`), line);
  const failures = await texts(browser, '#answer-stability .failures li');
  assert.ok(failures[0].includes('no number') && failures[1].includes('error: the method threw'), 'the worst first');
  assert.ok(failures.some((f) => f.includes('sensitivity (raycast, gl)') && f.includes('26.0 of its bound')), failures.join('; '));
  assert.match(await text(browser, '#answer-stability'), /SPIKES[^]*41 spikes[^]*26\.0 of its limit, in ball \(raycast, gl\)/);
};

const effectCosts = async ({ browser, results }) => {
  const rows = () => browser.run('return [...document.querySelectorAll("#effect-costs tbody tr")].filter((r) => r.offsetParent !== null).map((r) => [...r.cells].map((c) => c.textContent))');
  const expected = (backend) => results.effects.filter(({ key, mode }) => key.backend === backend && mode === 'leave_one_out')
    .map((row) => [row.key.scene, row.key.method, row.effect, ms(row.with.median), ms(row.without.median),
      row.time_differs ? `+${Math.round(100 * (row.with.median / row.without.median - 1))} %` : 'within noise', '412 / 340']);
  assert.deepEqual(await rows(), expected('gl'));
  await browser.run('document.getElementById("effect-backend-1").click()');
  assert.deepEqual(await rows(), expected('cpu'));
  await browser.run('document.getElementById("effect-backend-0").click()');
};

const attribution = async ({ browser, results }) => {
  const bars = await browser.run(`return [...document.querySelectorAll('.attribution li')].map((li) => ({ text: li.textContent,
    fills: [...li.querySelectorAll('.stack .fill')].map((f) => ({ left: parseFloat(f.style.left), width: parseFloat(f.style.width), pattern: getComputedStyle(f).backgroundImage })),
    zero: parseFloat(li.querySelector('.at-zero')?.style.left ?? '0'), one: parseFloat(li.querySelector('.at-one')?.style.left ?? 'NaN') }))`);
  // The same method has the same shares on gl and cpu: one bar. Of the other, one has no parts.
  assert.deepEqual(bars.map(({ text: t }) => t.match(/^(\S+) on ([a-z, ]+?) step/)?.slice(1)), [['texture3d_slices', 'gl, cpu'], ['raycast', 'gl'], ['raycast', 'cpu']]);
  assert.match(bars[1].text, /no part of it can be made ideal/);
  const parts = results.attribution[0].parts.filter(({ worth }) => worth !== null);
  const unit = bars[0].one - bars[0].zero;
  assert.equal(bars[0].fills.length, parts.length, 'a part that could not be drawn has no bar');
  parts.forEach(({ worth, aspect }, i) => {
    assert.ok(Math.abs(bars[0].fills[i].width / unit - Math.abs(worth)) < 1e-3, `the width of ${aspect}`);
    assert.ok(worth >= 0 ? bars[0].fills[i].left >= bars[0].zero - 0.01 : bars[0].fills[i].left < bars[0].zero, `the side of ${aspect}`);
  });
  assert.equal(new Set(bars[0].fills.map(({ pattern }) => pattern)).size, parts.length, 'patterns tell the parts apart without colour');
  assert.match(bars[0].text, /step 62\.0 %[^]*table size \u221221\.0 %[^]*4\.0 % of the squared error/);
  const rows = await texts(browser, 'details.fold table tbody tr');
  const noted = rows.find((row) => row.includes('gl filters R8 textures with 8 bits'));
  assert.ok(noted?.includes('31.0 %'), 'the note stands beside its part');
  assert.ok(rows.some((row) => row.includes('out of memory') && row.includes('n/a')), 'what could not be drawn says why');
  assert.ok(rows.some((row) => row.includes('two errors had cancelled')));
};

const matrix = async ({ browser, results }) => {
  const tables = await browser.run('return [...document.querySelectorAll("#scene-0 table.matrix")].map((t) => [...t.tBodies[0].rows].map((r) => [...r.cells].map((c) => c.textContent)))');
  assert.equal(tables.length, 1);
  const [first, second] = tables[0];
  assert.deepEqual([first[0], second[0]], ['texture3d_slices', 'raycast']);
  assert.match(first[2], /gl raycast[^]*cpu indistinguishable/, 'above the diagonal: who is closer');
  assert.match(second[1], /gl texture3d_slices[^]*cpu raycast/, 'below it: who is faster');
  assert.ok(first[2].includes(scientific(results.pairs[0].rmse)));
};

const regions = async ({ browser, results }) => {
  const rows = await texts(browser, '#scene-0 table.regions tbody tr');
  assert.ok(rows.length >= 8);
  const finest = results.results.filter(({ key, error }) => key.experiment === 'quick' && key.scene === 'ball' && key.method === 'texture3d_slices' && key.backend === 'gl' && error)
    .reduce((a, b) => (b.error.worst.rmse < a.error.worst.rmse ? b : a));
  assert.ok(rows[0].includes(scientific(finest.error.worst.regions.interior.rmse)), rows[0]);
};

const hardCases = async ({ browser, results }) => {
  const groups = await browser.run(`return [...document.querySelectorAll('details.case')].map((d) => ({ id: d.dataset.case, open: d.open,
    line: d.querySelector('summary').textContent, rows: [...d.querySelectorAll('tbody tr')].map((r) => r.textContent) }))`);
  assert.deepEqual(new Set(groups.map(({ id }) => id)), new Set(results.hard_cases.map(({ id }) => id)));
  for (const { id, open, line, rows } of groups) {
    const mine = results.hard_cases.filter((row) => row.id === id);
    const bad = mine.some(({ outcome }) => outcome === 'fail' || outcome === 'error');
    assert.equal(open, bad, `${id} is open where it fails`);
    assert.equal(line.includes('\u2717'), bad, `${id} has its symbol`);
    assert.equal(rows.length, mine.length);
    for (const { reason, source } of mine) assert.ok(rows.some((row) => row.includes(reason) && row.includes(source)), `${id}: ${reason}`);
  }
  assert.ok(groups.findIndex(({ open }) => !open) >= groups.filter(({ open }) => open).length, 'what fails comes first');
  const share = await browser.run(`const row = document.querySelector('[data-case=slab] tbody tr'); return [row.querySelector('.share').textContent.trim(), parseFloat(row.querySelector('.fill').style.width)]`);
  assert.deepEqual(share, [number(0.25), 75 * 0.25], 'the bar is as long as the share');
  await browser.run('document.querySelector("[data-case=slab] summary").focus()');
  await browser.press('\uE007');
  assert.equal(await browser.run('return document.querySelector("[data-case=slab]").open'), true, 'Enter opens a case');
};

// The ring lies on the pixel that the file names.
const worstPixels = async ({ browser, results, shot }) => {
  const row = results.hard_cases.find(({ picture }) => picture);
  await browser.run('document.querySelector("#stability .spots").scrollIntoView({block: "center"})');
  await browser.until('the pictures are drawn', () => browser.run('return document.querySelector("#stability .spots").dataset.drawn'));
  await shot('worst-pixels.png');
  const [caption, count, ringed] = await browser.run(`const f = document.querySelector('#stability .spots'), c = f.querySelectorAll('canvas')[0], p = new OffscreenCanvas(c.width, c.height).getContext('2d', { willReadFrequently: true });
    p.drawImage(c, 0, 0);
    const size = Number(arguments[2]), x = (Number(arguments[0]) + 0.5) * c.width / size, y = (Number(arguments[1]) + 0.5) * c.height / size;
    const white = (dx, dy) => [...p.getImageData(Math.round(x + dx), Math.round(y + dy), 1, 1).data].slice(0, 3).every((v) => v > 180);
    return [f.querySelector('figcaption').textContent, f.querySelectorAll('canvas').length, [white(6, 0), white(-6, 0), white(0, 6), white(0, -6)].filter(Boolean).length]`, row.x, row.y, row.picture.width);
  assert.ok(caption.includes(`worst pixel ${row.x}, ${row.y}`), caption);
  assert.equal(count, 4, 'picture and difference, whole and enlarged');
  assert.ok(ringed >= 3, `the ring is around the pixel: ${ringed} of 4 places are white`);
};

const motion = async ({ browser, results }) => {
  const rows = await texts(browser, '#sensitivity ~ .scroll tbody tr');
  assert.equal(rows.length, results.sensitivity.length);
  const bad = results.sensitivity.find(({ ok }) => !ok);
  assert.ok(rows[0].includes('fail') && rows[0].includes('26.0') && rows[1].includes('0.400') && rows[0].includes(`${bad.spikes[0].x}, ${bad.spikes[0].y}`) && rows[0].includes('and 38 more'), rows[0]);
  const marks = await browser.run('return [...document.querySelectorAll(".spots[data-marks]")].map((f) => f.dataset.marks)');
  assert.deepEqual(marks, ['40,30 44,60'], 'the spikes of the first view are marked in its picture');
};

const effectPictures = async ({ browser, results }) => {
  const thumbs = await browser.run('return [...document.querySelectorAll("#effects .thumb")].map((t) => [Number(t.dataset.entry), Number(t.dataset.against)])');
  assert.equal(thumbs.length, 4, 'two methods, with and without');
  const entries = await browser.run('return vm.model.entries.map(({ cell }) => cell)');
  const variants = thumbs.map(([entry]) => results.results[entries[entry]].key.variant);
  assert.deepEqual(variants, ['', 'none', '', 'none']);
  await browser.run('document.querySelectorAll("#effects .thumb")[1].click()');
  await browser.until('both pictures', () => browser.run('return vm.viewerState.loaded !== null && vm.viewerState.against >= 0'));
  const [a, b] = await browser.run('return [document.getElementById("v-label-a").textContent, document.getElementById("v-label-b").textContent]');
  assert.match(a, /no effect/);
  assert.doesNotMatch(b, /no effect|reference/);
};

// Neither the variants of effects, nor a cell without an effect, nor an empty one may be on the fronts.
const notRanked = async ({ browser, results }) => {
  const plotted = await browser.run('return [...document.querySelectorAll("svg.plot[data-metric] .point")].map((p) => Number(p.dataset.cell))');
  const kept = (cell) => cell.key.variant === '' && cell.ignored_effects.length === 0 && !cell.views.some(({ shows_nothing }) => shows_nothing);
  assert.ok(plotted.every((cell) => kept(results.results[cell])));
  const scene = results.results.find(({ views }) => views.some(({ shows_nothing }) => shows_nothing)).key.scene;
  const sections = await browser.run('return [...document.querySelectorAll("section.scene")].map((s) => [s.querySelector("table.tte").dataset.scene, s.querySelector(".warning")?.textContent ?? ""])');
  for (const [name, warning] of sections) assert.equal(/Shows nothing/.test(warning), name === scene, name);
};

const frontChoice = async ({ browser }) => {
  const shown = () => browser.run('return ["each", "by-method", "by-backend"].map((c) => getComputedStyle(document.querySelector("#scene-0 .fronts." + c)).display !== "none")');
  assert.deepEqual(await shown(), [true, false, false]);
  await browser.run('document.getElementById("fronts-method").click()');
  assert.deepEqual(await shown(), [false, true, false]);
  assert.deepEqual(new Set(await texts(browser, '#scene-0 svg[data-metric=rmse] .by-method .letter')), new Set(['texture3d_slices', 'raycast']));
  await browser.run('document.getElementById("fronts-each").click()');
};

const filterLevels = async ({ browser }) => {
  const notes = await texts(browser, '#environment .filter');
  assert.equal(notes.length, 4);
  assert.match(notes[0], /r8 257[^]*only 8 bits[^]*1\/255/);
  assert.match(notes[1], /finer than 8 bits/);
};

const commands = async ({ browser }) => {
  for (const selector of ['section.scene', '#stability', '#effects .card']) {
    const missing = await browser.run('return [...document.querySelectorAll(arguments[0])].filter((s) => !s.querySelector(".copy[data-copy^=volumark]")).length', selector);
    assert.equal(missing, 0, `each ${selector} says how to run it again`);
  }
};

// Everything that can be used can be reached by Tab, and has a name.
const reachable = async ({ browser }) => {
  const faults = await browser.run(`const seen = [...document.querySelectorAll('a[href], button, input, select, summary, [tabindex="0"]')];
    const name = (e) => e.getAttribute('aria-label') || e.textContent.trim() || e.labels?.[0]?.textContent.trim() || e.title;
    return [...seen.filter((e) => !name(e)).map((e) => 'no name: ' + e.outerHTML.slice(0, 80)),
      ...seen.filter((e) => e.tabIndex < 0 && !e.matches('[role=radio]')).map((e) => 'not by Tab: ' + e.outerHTML.slice(0, 80)),
      ...[...document.querySelectorAll('.scroll')].filter((e) => e.tabIndex !== 0 || !e.getAttribute('aria-label')).map((e) => 'scrolls without keys: ' + e.className)]`);
  assert.deepEqual(faults, []);
};

// Text against its ground, at least 4.5 to 1 (3 to 1 for what is large), in both themes.
const contrast = async ({ browser }) => {
  for (const theme of ['light', 'dark']) {
    const faults = await browser.run(`document.documentElement.dataset.theme = arguments[0];
      const parse = (c) => c.match(/[\\d.]+/g).map(Number);
      const light = ([r, g, b]) => [r, g, b].map((v) => (v /= 255, v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)).reduce((s, v, i) => s + v * [0.2126, 0.7152, 0.0722][i], 0);
      const ground = (e) => { for (; e; e = e.parentElement) { const c = parse(getComputedStyle(e).backgroundColor); if (c.length < 4 || c[3] > 0.9) return c; } return [255, 255, 255]; };
      const out = new Set();
      for (const e of document.querySelectorAll('main *')) {
        if (![...e.childNodes].some((n) => n.nodeType === 3 && n.textContent.trim()) || e.offsetParent === null || e.closest('#v-stage, svg')) continue;
        const style = getComputedStyle(e), a = light(parse(style.color)), b = light(ground(e));
        const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05), large = parseFloat(style.fontSize) >= 18.6;
        if (ratio < (large ? 3 : 4.5)) out.add(e.tagName + '.' + e.className + ' ' + ratio.toFixed(2) + ' ' + style.color);
      }
      return [...out].slice(0, 10)`, theme);
    assert.deepEqual(faults, [], `${theme}: text that is too faint`);
  }
  await browser.run('delete document.documentElement.dataset.theme');
};

const narrowSections = async ({ browser, shot }) => {
  await resize(browser, 420, 860);
  const wide = await browser.run('return [...document.querySelectorAll("main *")].filter((e) => e.getBoundingClientRect().right > innerWidth + 1 && !e.closest(".scroll, svg, .sr, .top")).map((e) => e.tagName + "." + e.className).slice(0, 8)');
  for (const id of ['stability', 'effects', 'scene-0']) {
    await browser.run('document.getElementById(arguments[0]).scrollIntoView()', id);
    await shot(`narrow-${id}.png`);
  }
  await ordinarySize(browser);
  assert.deepEqual(wide, [], 'nothing but what scrolls is wider than the window');
};

const oldFile = async ({ browser, open, quiet }) => {
  await open('old.html');
  const answers = await text(browser, '.answers');
  assert.match(answers, /No hard case was checked[^]*volumark verify[^]*No effect was switched[^]*volumark run effects/);
  assert.equal(await browser.run('return document.querySelectorAll("#answer-stability .copy, #answer-effects .copy").length'), 2);
  assert.ok(await browser.run('return document.querySelectorAll("#least-times tbody tr").length > 0'));
  assert.equal(await browser.run('return document.querySelectorAll(".attribution, table.matrix, details.case").length'), 0);
  await quiet();
};

const verifyAlone = async ({ browser, open, quiet }) => {
  await open('verify.html');
  assert.match(await text(browser, '#answer-accuracy'), /No method was swept[^]*volumark run accuracy/);
  assert.match(await text(browser, '#answer-stability'), /6 cases/);
  assert.ok(await browser.run('return document.querySelectorAll("details.case").length > 3'));
  assert.match(await text(browser, '#scenes'), /holds no cells/);
  await quiet();
  await open('report.html');
};

export const sectionChecks = [
  ['first screen: the three answers are in a window of 1280 x 800', firstScreen],
  ['first screen: least times over the backends', leastTimes],
  ['first screen: RMSE or FLIP, by keys', metricSwitch],
  ['first screen: the stability line, in words and symbols', stabilityLine],
  ['papers: published cells and claims', papers],
  ['first screen: what effects cost, by backend', effectCosts],
  ['attribution: bars as wide as the shares, patterns, notes', attribution],
  ['methods against methods: verdicts on both sides', matrix],
  ['errors by region', regions],
  ['hard cases: grouped, failures open and first, bars', hardCases],
  ['hard cases: worst pixels are ringed', worstPixels],
  ['motion of the camera: spikes listed and marked', motion],
  ['effects: pictures with and without, compared', effectPictures],
  ['fronts: what is another picture, or empty, is not ranked', notRanked],
  ['fronts: of each series, method or backend', frontChoice],
  ['filter levels and what they mean', filterLevels],
  ['every part says how to run it again', commands],
  ['all controls have a name and are reached by Tab', reachable],
  ['contrast in both themes', contrast],
  ['420 pixels wide: the sections too', narrowSections],
  ['a file of version 1.0 says what to run', oldFile],
  ['a file of hard cases alone', verifyAlone],
];
