// The npm package in a page that a bundler builds, in headless Chromium:
//   usage: node bundler_test.mjs BUNDLER PACKAGE MODULES GOLDEN
// BUNDLER is Vite, Esbuild or Webpack. MODULES is a folder node_modules with it and puppeteer-core.
// The settings are those of the package's README.
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

const [bundler, folder, modules, golden] = process.argv.slice(2);
const require = createRequire(join(modules, 'from_here.js'));
const puppeteer = require('puppeteer-core');
const readme = readFileSync(join(folder, 'README.md'), 'utf8');
const site = mkdtempSync(join(tmpdir(), 'pelagic-bundler-'));
const write = (name, text) => writeFileSync(join(site, name), text);
const writePage = (name, script) => write(name, `<!doctype html><title>sea</title><script type="module" src="${script}"></script>`);

/** Each builds main.js into the folder dist, with index.html. */
const builds = {
  async Vite() {
    writePage('index.html', '/main.js');
    write('vite.config.js', readme.match(/```javascript\n\/\/ vite\.config\.js\n([^]*?)```/)[1]);
    const { build } = await import(pathToFileURL(join(modules, 'vite/dist/node/index.js')));
    await build({ root: site, logLevel: 'warn' });
  },
  async Esbuild() {
    const env = { ...process.env, PATH: `${join(modules, '.bin')}:${process.env.PATH}` };
    execFileSync('sh', ['-ec', readme.match(/```bash\n(esbuild [^]*?)```/)[1]], { cwd: site, env, stdio: 'inherit' });
    writePage('dist/index.html', './main.js');
  },
  async Webpack() {
    await new Promise((resolve, reject) => {
      const output = { path: join(site, 'dist') };
      require('webpack')({ context: site, mode: 'production', entry: './main.js', output }, (error, stats) => {
        if (error || stats.hasErrors()) reject(error ?? new Error(stats.toString()));
        else resolve();
      });
    });
    writePage('dist/index.html', './main.js');
  },
};

let browser, server;
before(async () => {
  cpSync(folder, join(site, 'node_modules/pelagic'), { recursive: true, dereference: true });
  write('package.json', '{"private": true, "type": "module"}');
  write('main.js', "import * as here from 'pelagic';\nimport * as worker from 'pelagic/worker';\nglobalThis.pelagic = { here, worker };\n");
  await builds[bundler]();
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
  test(`a page that ${bundler} builds has the golden hashes: ${where}, threads: ${threads}`, async () => {
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
