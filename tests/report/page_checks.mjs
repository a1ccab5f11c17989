// Checks of the page itself: what the tables and plots say, sorting, filter, themes, widths, printing.
import { strict as assert } from 'node:assert';
import { columns, ms, number, points, scientific, settingOf, timeToError } from './expected.mjs';

const openReport = async ({ open, quiet, browser, shot }) => {
  await open('report.html');
  await browser.until('the first picture', () => browser.run('return document.getElementById("viewer").dataset.ready'));
  await shot('screenshot.png');
  await quiet();
};

const namesAreText = async ({ browser, results }) => {
  const found = await browser.run(`return {
    titles: [...document.querySelectorAll('section.scene h3')].map((h) => h.textContent),
    broken: document.querySelectorAll('.tte caption b, td img, h3 b').length,
    command: document.querySelector('#environment .command code').textContent }`);
  // Scenes of real data come first; a scene of several experiments says which.
  assert.deepEqual(found.titles, [results.scenes[1].title, `${results.scenes[0].title} (quick)`]);
  assert.equal(found.broken, 0, 'no element came out of a name');
  assert.equal(found.command, results.run.argv.join(' '));
};

const headerNames = async ({ browser, results }) => {
  const text = await browser.run('return document.querySelector("#summary").textContent + document.querySelector("#environment").textContent');
  for (const word of [results.run.id, results.git.sha, results.machine.cpu, ...results.backends.map(({ renderer }) => renderer)])
    assert.ok(text.includes(word), `${word} is named`);
};

const timeToErrorTable = async ({ browser, results }) => {
  const rows = await browser.run(`return [...document.querySelectorAll('table.tte')].flatMap((table) => [...table.tBodies[0].rows].map((row) => ({
    experiment: table.dataset.experiment, scene: table.dataset.scene, method: row.dataset.method, backend: row.dataset.backend,
    setting: row.dataset.setting,
    software: row.textContent.includes('software'),
    // A field over several columns speaks for each of them.
    texts: [...row.querySelectorAll('td')].flatMap((td) => Array(td.colSpan).fill([...td.childNodes].filter((n) => !n.classList?.contains('between')).map((n) => n.textContent).join('').trim())),
    between: [...row.querySelectorAll('.between')].map((e) => e.textContent),
    bold: [...row.querySelectorAll('td')].map((td) => td.classList.contains('least')) })))`);
  const swept = results.results.filter(({ key }) => key.experiment === 'quick' && key.variant === '');
  const series = new Set(swept.map((cell) => JSON.stringify([cell.key.scene, cell.key.method, cell.key.backend, settingOf(results, cell)])));
  assert.equal(rows.length, series.size, 'a row for each scene, method, backend and setting');
  assert.deepEqual(new Set(rows.map(({ setting }) => setting).filter(Boolean)), new Set(['target_format rgba32f', 'target_format rgba8',
    'target_format rgba16f', 'ignores ground_fog']));
  assert.ok(rows.some(({ between }) => between.includes('step 2 and 1')), 'between which two it was interpolated');
  let compared = 0;
  for (const row of rows) {
    const described = results.backends.find(({ id }) => id === row.backend);
    assert.equal(row.software, described?.software ?? false, `software tag of ${row.backend}`);
    if (points(results, row, 'rmse').length === 0) {
      assert.match(row.texts[0], /no time with an error/);
      continue;
    }
    columns.forEach(([metric, target], c) => {
      const expected = timeToError(points(results, row, metric), target);
      assert.equal(row.texts[c], expected, `${row.scene} ${row.method} ${row.backend} ${metric} ${target}`);
      ++compared;
    });
  }
  assert.ok(compared > 100, `${compared} fields were compared`);
  assert.ok(rows.some(({ texts }) => texts.some((text) => text.startsWith('not reached'))), 'some target is not reached');
  // The hardware row is faster than all: were it ranked against software, no software field would be bold.
  assert.ok(rows.some(({ software, bold }) => software && bold.includes(true)), 'software is ranked among software');
  assert.ok(rows.some(({ software, bold }) => !software && bold.includes(true)), 'hardware is ranked among hardware');
};

const outcomeCounts = async ({ browser, results }) => {
  const ok = results.results.filter(({ outcome }) => outcome === 'ok').length;
  const tiles = await browser.run('return [...document.querySelectorAll(".tile")].map((t) => t.textContent)');
  assert.ok(tiles[0].includes(`${ok} of ${results.results.length} ok`), tiles[0]);
  const bound = Math.max(...results.results.flatMap(({ views }) => views.map(({ reference }) => reference?.bound ?? 0)));
  assert.ok(tiles[1].includes(scientific(bound)), tiles[1]);
  const rows = await browser.run('return [...document.querySelectorAll("table.problems tbody tr")].map((r) => r.textContent)');
  const bad = results.results.filter(({ outcome }) => outcome !== 'ok');
  assert.equal(rows.length, bad.length);
  for (const { outcome, reason, command } of bad)
    assert.ok(rows.some((row) => row.includes(outcome) && row.includes(reason) && row.includes(command)), `${outcome}: ${reason}`);
};

const cellTable = async ({ browser, results }) => {
  const rows = await browser.run('return [...document.querySelectorAll("#cell-table tbody tr")].map((r) => [...r.cells].map((c) => c.textContent.trim()))');
  assert.equal(rows.length, results.results.length);
  results.results.forEach((cell, i) => {
    assert.equal(rows[i][5], cell.outcome);
    if (!cell.metrics) return;
    const { worst } = cell.error;
    assert.deepEqual([rows[i][6], rows[i][8], rows[i][11], rows[i][12], rows[i][14]], [ms(cell.metrics.frame_wall.stats.median),
      ms(cell.metrics.frame_cpu.stats.median), scientific(worst.rmse), scientific(worst.max), number(worst.flip_p99)]);
  });
};

const convergence = async ({ browser, results }) => {
  const rows = await browser.run('return [...document.querySelectorAll("table.convergence tbody tr")].map((r) => r.textContent)');
  assert.equal(rows.length, results.convergence.length);
  const ordered = [...results.scenes].reverse().flatMap(({ name }) => results.convergence.filter(({ key }) => key.scene === name));
  ordered.forEach((row, i) => {
    for (const text of [row.fitted.toFixed(2), row.verdict, row.reason, row.floor_reason]) assert.ok(rows[i].includes(text), `${text} in ${rows[i]}`);
  });
  assert.ok(ordered.some(({ floor_reason }) => floor_reason !== ''));
  // On the log-log plot of a series, every point is where its value and error put it, and the slope is the order.
  const plots = await browser.run(`return [...document.querySelectorAll('svg[data-plot=convergence]')].map((svg) => ({
    points: [...svg.querySelectorAll('.point')].map((p) => p.getAttribute('aria-label')), slopes: svg.querySelectorAll('.slope').length }))`);
  assert.equal(plots.length, 2);
  for (const plot of plots) {
    assert.equal(plot.points.length, 40);
    assert.equal(plot.slopes, 2, 'the slope that each method states');
  }
};

const parity = async ({ browser, results }) => {
  const rows = await browser.run('return [...document.querySelectorAll("#parity + .scroll tbody tr")].map((r) => [...r.cells].map((c) => c.textContent.trim()))');
  assert.equal(rows.length, results.parity.length);
  const bad = results.parity.filter(({ ok }) => !ok);
  assert.ok(bad.length > 0);
  assert.deepEqual(rows.slice(0, bad.length).map((row) => [row[5], row.at(-1)]), bad.map((row) => [scientific(row.interior_max), 'differs']),
    'what differs comes first');
  assert.ok(rows.slice(bad.length).every((row) => row.at(-1) === 'ok'));
};

// Every point lies where the logarithms of its time and error put it.
const plotPositions = async ({ browser, results }) => {
  const plots = await browser.run(`return [...document.querySelectorAll('svg.plot[data-metric]')].map((svg) => ({ metric: svg.dataset.metric,
    points: [...svg.querySelectorAll('.point')].map((p) => ({ time: Number(p.dataset.time), error: Number(p.dataset.error), cell: Number(p.dataset.cell),
      place: p.querySelector('g').getAttribute('transform').match(/[\\d.]+/g).map(Number) })) }))`);
  assert.equal(plots.length, 2 * results.scenes.length);
  const residual = (pairs) => {  // of the least-squares line through (log value, pixel)
    const n = pairs.length, mean = (k) => pairs.reduce((sum, pair) => sum + pair[k], 0) / n, [mx, my] = [mean(0), mean(1)];
    const slope = pairs.reduce((s, [x, y]) => s + (x - mx) * (y - my), 0) / pairs.reduce((s, [x]) => s + (x - mx) ** 2, 0);
    return [slope, Math.max(...pairs.map(([x, y]) => Math.abs(y - my - slope * (x - mx))))];
  };
  for (const plot of plots) {
    assert.ok(plot.points.length >= 40);
    for (const { time, cell } of plot.points) assert.equal(time, results.results[cell].metrics.frame_wall.stats.median);
    const [right, offTime] = residual(plot.points.map(({ time, place }) => [Math.log10(time), place[0]]));
    const [up, offError] = residual(plot.points.filter(({ error }) => error > 0).map(({ error, place }) => [Math.log10(error), place[1]]));
    assert.ok(right > 0 && offTime < 0.1, `time axis of ${plot.metric}: off by ${offTime}`);
    assert.ok(up < 0 && offError < 0.1, `error axis of ${plot.metric}: off by ${offError}`);
  }
};

const plotKeys = async ({ browser }) => {
  const focused = () => browser.run('return document.activeElement.getAttribute("aria-label")');
  const tip = () => browser.run('const t = document.getElementById("tip"); return t.hidden ? null : t.textContent');
  await browser.run('document.querySelector("svg.plot").scrollIntoView({block: "center"}); document.querySelector("svg.plot .point").focus()');
  const first = await focused();
  assert.match(first, /ms/);
  assert.equal(await tip(), first, 'the tooltip says what the focus says');
  await browser.press('\uE014');
  const second = await focused();
  assert.notEqual(second, first);
  assert.equal(await tip(), second);
  await browser.press('\uE00C');
  assert.equal(await tip(), null, 'Escape hides the tooltip');
};

const sorting = async ({ browser, results }) => {
  const column = () => browser.run('return [...document.querySelectorAll("#cell-table tbody tr")].map((r) => r.cells[11].textContent)');
  const press = () => browser.run('document.querySelectorAll("#cell-table .sort")[11].click()');
  const errors = results.results.filter(({ error }) => error).map(({ error }) => error.worst.rmse).sort((a, b) => a - b).map(scientific);
  const none = results.results.filter(({ error }) => !error).map(() => '-');
  await press();
  assert.deepEqual(await column(), [...errors, ...none]);
  await press();
  assert.deepEqual(await column(), [...errors.reverse(), ...none], 'what is missing stays last');
  assert.equal(await browser.run('return document.querySelectorAll("#cell-table th")[11].getAttribute("aria-sort")'), 'descending');
};

const filterAndDetails = async ({ browser, results }) => {
  await browser.run('const f = document.getElementById("cell-filter"); f.value = "raycast cpu"; f.dispatchEvent(new Event("input"))');
  const shown = await browser.run('return [...document.querySelectorAll("#cell-table tbody tr")].filter((r) => !r.hidden).length');
  assert.equal(shown, results.results.filter(({ key }) => key.method === 'raycast' && key.backend === 'cpu').length);
  await browser.run('const f = document.getElementById("cell-filter"); f.value = ""; f.dispatchEvent(new Event("input"))');
  const [cell, text] = await browser.run(`const b = [...document.querySelectorAll('#cell-table .more')].find((m) => m.closest('tr').textContent.includes('raycast'));
    b.click(); return [Number(b.closest('tr').dataset.cell), document.querySelector('tr.details').textContent]`);
  const { command, metrics, key } = results.results[cell];
  for (const word of [command, ...Object.keys(metrics.counters), ...Object.keys(key.params), ms(metrics.prepare.wall)])
    assert.ok(text.includes(word), `${word} in the details`);
  await browser.run('document.querySelector("#cell-table .more[aria-expanded=true]").click()');
  assert.equal(await browser.run('return document.querySelectorAll("tr.details").length'), 0);
};

const themes = async ({ browser, shot }) => {
  const colours = () => browser.run(`const s = getComputedStyle(document.body); return [s.backgroundColor, s.color]
    .map((c) => c.match(/\\d+/g).slice(0, 3).reduce((a, v) => a + Number(v), 0) / 3)`);
  const emulate = (value) => browser.call('POST', '/goog/cdp/execute', { cmd: 'Emulation.setEmulatedMedia',
    params: { features: [{ name: 'prefers-color-scheme', value }] } });
  await browser.run('scrollTo(0, 0); document.activeElement.blur()');
  await emulate('dark');
  const [darkGround, darkText] = await colours();
  assert.ok(darkGround < 60 && darkText > 180, 'the system asks for dark');
  await shot('screenshot-dark.png');
  await emulate('light');
  const [ground, text] = await colours();
  assert.ok(ground > 200 && text < 80, 'the system asks for light');
  await browser.press('d');
  assert.ok((await colours())[0] < 60, 'the key makes it dark');
  await browser.run('document.getElementById("theme").click()');
  assert.ok((await colours())[0] > 200, 'the button makes it light again');
};

const help = async ({ browser }) => {
  const isOpen = () => browser.run('return document.getElementById("help").open');
  await browser.press('?');
  assert.equal(await isOpen(), true);
  await browser.press('\uE00C');
  assert.equal(await isOpen(), false);
};

const copying = async ({ browser, results }) => {
  await browser.run('document.querySelector("#cells").scrollIntoView()');
  const point = await browser.run('const b = document.querySelector("table.problems .copy"); b.scrollIntoView({block: "center"}); const r = b.getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]');
  await browser.click(point);
  await browser.until('the button says so', () => browser.run('return document.querySelector("table.problems .copy").textContent === "copied"'));
  // What was copied, pasted into the filter.
  await browser.run('document.getElementById("cell-filter").focus()');
  await browser.press(['\uE009', 'v']);
  const pasted = await browser.run('const f = document.getElementById("cell-filter"); const v = f.value; f.value = ""; f.dispatchEvent(new Event("input")); f.blur(); return v');
  assert.equal(pasted, results.results.find(({ outcome }) => outcome !== 'ok').command);
};

const narrow = async ({ browser, shot }) => {
  const metrics = (params) => browser.call('POST', '/goog/cdp/execute', { cmd: 'Emulation.setDeviceMetricsOverride', params });
  await metrics({ width: 420, height: 860, deviceScaleFactor: 1, mobile: false });
  await browser.run('scrollTo(0, 0)');
  const [inner, scroll] = await browser.run('return [innerWidth, document.documentElement.scrollWidth]');
  await shot('screenshot-narrow.png');
  await browser.call('POST', '/goog/cdp/execute', { cmd: 'Emulation.clearDeviceMetricsOverride', params: {} });
  assert.equal(inner, 420);
  assert.ok(scroll <= inner, `the page is ${scroll} wide in a window of ${inner}`);
};

const printing = async ({ browser }) => {
  const { data } = await browser.call('POST', '/goog/cdp/execute', { cmd: 'Page.printToPDF', params: { landscape: true, printBackground: true } });
  const pdf = Buffer.from(data, 'base64');
  assert.equal(pdf.subarray(0, 5).toString(), '%PDF-');
  const pages = (pdf.toString('latin1').match(/\/Type \/Page\b/g) ?? []).length;
  assert.ok(pages >= 2 && pages < 30, `${pages} pages`);
};

const withoutPictures = async ({ browser, open, quiet }) => {
  await open('bare.html');
  const [hidden, note, rows] = await browser.run('return [document.getElementById("viewer").hidden, document.getElementById("images").textContent, document.querySelectorAll("table.tte tbody tr").length]');
  assert.equal(hidden, true);
  assert.match(note, /No picture is in this report/);
  assert.ok(rows > 0);
  await quiet();
  await open('report.html');
};

// results.json writes null for them, and what they were beside it.
const notFinite = async ({ browser, results }) => {
  const cell = results.results.findIndex(({ nulls }) => nulls?.['/error/worst/psnr'] === 'infinity');
  const [ssim, details] = await browser.run(`const row = document.querySelector('#cell-table tr[data-cell="' + arguments[0] + '"]');
    row.querySelector('.more').click(); const text = row.nextElementSibling.textContent; row.querySelector('.more').click();
    return [row.cells[15].textContent, text]`, cell);
  assert.equal(ssim, 'n/a');
  assert.match(details, /psnrinfinite/);
};

export const pageChecks = [
  ['opens from file:// without a console message or a request', openReport],
  ['names from the file are text, never markup', namesAreText],
  ['run, commit, machine and backends are named', headerNames],
  ['time to error: every field is what results.json says', timeToErrorTable],
  ['outcomes: counts, reasons, commands', outcomeCounts],
  ['cells: times and errors', cellTable],
  ['convergence: order and verdict', convergence],
  ['parity: what differs comes first', parity],
  ['plots: every point in its place', plotPositions],
  ['plots: focus, arrow keys and tooltip', plotKeys],
  ['cells sort both ways', sorting],
  ['cells filter, details open and close', filterAndDetails],
  ['numbers that are not finite are named', notFinite],
  ['dark and light: system, key, button', themes],
  ['help opens with ?', help],
  ['a command is copied', copying],
  ['420 pixels wide: nothing sticks out', narrow],
  ['prints', printing],
  ['a report without pictures says so', withoutPictures],
];
