// The npm package in a page that Vite builds, in headless Chromium:
//   usage: node bundler_test.mjs PACKAGE MODULES GOLDEN
// MODULES is a folder node_modules with puppeteer-core and vite. The settings are those of the
// package's README.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { differences } from './golden_seas.js';
import { serve } from './server.js';

const [folder, modules, golden] = process.argv.slice(2);
const puppeteer = createRequire(join(modules, 'from_here.js'))('puppeteer-core');
const readme = readFileSync(join(folder, 'README.md'), 'utf8');
const site = mkdtempSync(join(tmpdir(), 'pelagic-vite-'));

let browser, server;
before(async () => {
  cpSync(folder, join(site, 'node_modules/pelagic'), { recursive: true, dereference: true });
  const write = (name, text) => writeFileSync(join(site, name), text);
  write('package.json', '{"private": true, "type": "module"}');
  write('index.html', '<!doctype html><title>sea</title><script type="module" src="/main.js"></script>');
  write('main.js', "import * as here from 'pelagic';\nimport * as worker from 'pelagic/worker';\nglobalThis.pelagic = { here, worker };\n");
  write('vite.config.js', readme.match(/```javascript\n\/\/ vite\.config\.js\n([^]*?)```/)[1]);
  const { build } = await import(pathToFileURL(join(modules, 'vite/dist/node/index.js')));
  await build({ root: site, logLevel: 'warn' });
  rmSync(join(site, 'node_modules'), { recursive: true });
  server = await serve({ '/': join(site, 'dist') }, { isIsolated: true });
  browser = await puppeteer.launch({
    executablePath: execFileSync('sh', ['-c', 'command -v chromium']).toString().trim(),
    args: ['--no-sandbox', '--disable-dev-shm-usage'], protocolTimeout: 300000,
  });
});
after(async () => {
  await browser?.close();
  server?.close();
  rmSync(site, { recursive: true });
});

for (const [where, threads] of [['here', 1], ['worker', 1], ['worker', 3]])
  test(`a built page has the golden hashes: ${where}, threads: ${threads}`, async () => {
    const page = await browser.newPage();
    await page.goto(`${server.origin}/index.html`);
    await page.waitForFunction(() => globalThis.pelagic);
    const line = await page.evaluate(async (where, threads) => {
      const ocean = await pelagic[where].createOcean({ preset: 'moderate', threads });
      return `preset-moderate@12.34 ${await (await ocean.frameAt(12.34)).hash()}`;
    }, where, threads);
    assert.deepEqual(differences([line], readFileSync(golden, 'utf8')), []);
    await page.close();
  });
