// A small WebDriver client over node's own fetch: starts chromedriver on a free port and a fresh headless Chromium.
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const pause = (ms) => new Promise((resolve) => { setTimeout(resolve, ms); });

const freePort = () => new Promise((resolve, reject) => {
  const server = createServer();
  server.on('error', reject);
  server.listen(0, '127.0.0.1', () => {
    const { port } = server.address();
    server.close(() => resolve(port));
  });
});

const flags = ['--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run',
  '--disable-background-networking', '--disable-component-update', '--disable-sync', '--disable-dev-shm-usage',
  '--hide-scrollbars', '--force-device-scale-factor=1'];

export const keys = { left: '\uE012', up: '\uE013', right: '\uE014', down: '\uE015', shift: '\uE008', enter: '\uE007', escape: '\uE00C' };

export class Browser {
  // Throws with chromedriver's own words where it cannot be started.
  static async start({ width, height }) {
    const browser = new Browser();
    const port = await freePort();
    browser.profile = mkdtempSync(join(tmpdir(), 'volumark-chromium-'));
    browser.driver = spawn('chromedriver', [`--port=${port}`], { stdio: ['ignore', 'pipe', 'pipe'] });
    let words = '', died = null;
    for (const stream of [browser.driver.stdout, browser.driver.stderr]) stream.on('data', (data) => { words += data; });
    browser.driver.on('error', (error) => { died = `${error.message}: install the packages chromium and chromium-driver`; });
    browser.driver.on('exit', (code) => { died ??= `ended with ${code}`; });
    browser.base = `http://127.0.0.1:${port}`;
    try {
      await browser.until('chromedriver answers', async () => {
        if (died) throw new Error(`chromedriver ${died}\n${words}`);
        try {
          return (await (await fetch(`${browser.base}/status`)).json()).value.ready;
        } catch {
          return false;
        }
      }, 30000);
      const args = [...flags, `--window-size=${width},${height}`, `--user-data-dir=${browser.profile}`];
      const session = await browser.call('POST', '/session', { capabilities: { alwaysMatch: {
        browserName: 'chrome', 'goog:chromeOptions': { args }, 'goog:loggingPrefs': { browser: 'ALL', performance: 'ALL' },
      } } });
      browser.base += `/session/${session.sessionId}`;
      browser.open = true;
      await browser.call('POST', '/timeouts', { script: 20000, pageLoad: 60000 });
    } catch (error) {
      await browser.stop();
      throw error;
    }
    return browser;
  }

  async call(method, path, body) {
    const response = await fetch(this.base + path, { method, signal: AbortSignal.timeout(90000),
      ...(method === 'POST' ? { body: JSON.stringify(body ?? {}) } : {}) });
    const { value } = await response.json();
    if (value && value.error) throw new Error(`WebDriver ${path}: ${value.message}`);
    return value;
  }

  async stop() {
    if (this.open) await this.call('DELETE', '').catch(() => {});
    this.driver?.kill();
    await pause(200);
    rmSync(this.profile, { recursive: true, force: true, maxRetries: 5 });
  }

  // Runs until `probe` gives something true.
  async until(what, probe, limit = 15000) {
    const end = Date.now() + limit;
    for (;;) {
      const value = await probe();
      if (value) return value;
      if (Date.now() > end) throw new Error(`waited ${limit} ms in vain: ${what}`);
      await pause(50);
    }
  }

  go(url) { return this.call('POST', '/url', { url }); }
  // The body of a function in the page; what it returns.
  run(script, ...args) { return this.call('POST', '/execute/sync', { script, args }); }
  resize(width, height) { return this.call('POST', '/window/rect', { width, height }); }
  async screenshot() { return Buffer.from(await this.call('GET', '/screenshot'), 'base64'); }
  log(type) { return this.call('POST', '/se/log', { type }); }

  // Real key events on what has the focus; a list is a chord: all but the last are held.
  press(key) {
    const chord = Array.isArray(key) ? key : [key];
    const actions = [...chord.map((value) => ({ type: 'keyDown', value })),
      ...[...chord].reverse().map((value) => ({ type: 'keyUp', value }))];
    return this.call('POST', '/actions', { actions: [{ type: 'key', id: 'keyboard', actions }] });
  }

  // Real pointer events at points of the window: move there, or drag from the first to the last.
  pointer(points, { drag = false } = {}) {
    const moves = points.map(([x, y]) => ({ type: 'pointerMove', duration: 30, x: Math.round(x), y: Math.round(y), origin: 'viewport' }));
    const actions = drag
      ? [moves[0], { type: 'pointerDown', button: 0 }, ...moves.slice(1), { type: 'pointerUp', button: 0 }]
      : moves;
    return this.call('POST', '/actions', { actions: [{ type: 'pointer', id: 'mouse', parameters: { pointerType: 'mouse' }, actions }] });
  }
  click(point) { return this.pointer([point, point], { drag: true }); }
}
