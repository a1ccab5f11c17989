// browser_test.mjs FOLDER: opens FOLDER/report.html in a real Chromium, from file://, and compares what it shows with
// FOLDER/results.json and the pictures beside it. Ends with 1 where a check fails; screenshots lie in FOLDER.
import { strict as assert } from 'node:assert';
import { readFileSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { pageChecks } from './page_checks.mjs';
import { sectionChecks } from './section_checks.mjs';
import { viewerChecks } from './viewer_checks.mjs';
import { Browser } from './webdriver.mjs';

const folder = resolve(process.argv[2] ?? '.');
const url = (name) => pathToFileURL(join(folder, name)).href;

const main = async () => {
  const results = JSON.parse(readFileSync(join(folder, 'results.json'), 'utf8'));
  const browser = await Browser.start({ width: 1400, height: 900 });
  const open = async (name) => {
    await browser.go(url(name));
    await browser.until(`${name} is ready`, () => browser.run('return document.documentElement.dataset.ready === "true"'), 30000);
  };
  const shot = async (name) => writeFileSync(join(folder, name), await browser.screenshot());
  const quiet = async () => {
    const errors = (await browser.log('browser')).filter(({ level }) => level === 'SEVERE' || level === 'WARNING');
    assert.deepEqual(errors, [], 'the console is silent');
    const asked = (await browser.log('performance')).map(({ message }) => JSON.parse(message).message)
      .filter(({ method, params }) => method === 'Network.requestWillBeSent' && params.documentURL.startsWith('file:'))
      .map(({ params }) => params.request.url)
      .filter((address) => !/^(data|blob):/.test(address) && !/^file:.*\/(report|bare|old|verify)\.html$/.test(address));
    assert.deepEqual(asked, [], 'no request leaves the page');
  };
  const context = { browser, results, folder, open, shot, quiet };

  let failed = 0;
  try {
    for (const [name, check] of [...pageChecks, ...sectionChecks, ...viewerChecks]) {
      try {
        await check(context);
        console.log(`ok      ${name}`);
      } catch (error) {
        ++failed;
        console.log(`FAILED  ${name}\n        ${String(error.message).replaceAll('\n', '\n        ')}`);
      }
    }
  } finally {
    await browser.stop();
  }
  console.log(failed === 0 ? `all ${pageChecks.length + sectionChecks.length + viewerChecks.length} checks passed` : `${failed} checks failed`);
  return failed === 0 ? 0 : 1;
};

main().then((code) => { process.exitCode = code; }, (error) => {
  console.log(`FAILED  ${error.stack}`);
  process.exitCode = 1;
});
