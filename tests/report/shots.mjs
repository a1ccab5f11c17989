// shots.mjs REPORT FOLDER: pictures of the report at desktop and narrow width, light and dark, for a person to look at.
import { mkdirSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { Browser } from './webdriver.mjs';

const [report, folder] = process.argv.slice(2).map((path) => resolve(path));
mkdirSync(folder, { recursive: true });
const browser = await Browser.start({ width: 1400, height: 900 });
const shot = async (name, anchor) => {
  await browser.run('if (arguments[0]) document.getElementById(arguments[0]).scrollIntoView(); else scrollTo(0, 0);', anchor ?? '');
  await new Promise((done) => { setTimeout(done, 600); });
  writeFileSync(join(folder, `${name}.png`), await browser.screenshot());
};
try {
  for (const [size, width, height] of [['desktop', 1400, 900], ['narrow', 420, 860]]) {
    // Chromium's windows are never narrower than 500 pixels: the narrow page is emulated.
    await browser.call('POST', '/goog/cdp/execute', { cmd: 'Emulation.setDeviceMetricsOverride',
      params: { width, height, deviceScaleFactor: 1, mobile: false } });
    await browser.go(pathToFileURL(report).href);
    await browser.until('the page is ready', () => browser.run('return document.documentElement.dataset.ready'));
    for (const theme of ['light', 'dark']) {
      await browser.run('document.documentElement.dataset.theme = arguments[0]', theme);
      for (const anchor of ['', 'scenes', 'images', 'problems', 'claims', 'cells', 'checks', 'environment'])
        if (theme === 'light' || anchor === '' || anchor === 'scenes' || anchor === 'images')
          await shot(`${size}-${theme}-${anchor || 'first'}`, anchor);
    }
    for (const mode of ['swipe', 'difference', 'flip']) {
      await browser.run('vm.viewer.setMode(arguments[0])', mode);
      await shot(`${size}-mode-${mode}`, 'images');
    }
  }
} finally {
  await browser.stop();
}
