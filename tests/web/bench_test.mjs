// The page bench/ in headless Chromium, over HTTPS as for a headset.
//   usage: node bench_test.mjs PAGE_FOLDER PELAGIC, in a folder that page_test.sh has filled
import assert from 'node:assert/strict';
import {execFileSync, spawn} from 'node:child_process';
import {existsSync, mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {createRequire} from 'node:module';
import {tmpdir} from 'node:os';
import {dirname, join} from 'node:path';
import {after, before, test} from 'node:test';
import {fileURLToPath, pathToFileURL} from 'node:url';

const [pageFolder, pelagic] = process.argv.slice(2);
const serve = join(dirname(fileURLToPath(import.meta.url)), '../../web/page/serve.mjs');
const require = createRequire(join(process.cwd(), 'package.json'));
const {default: puppeteer} = await import(pathToFileURL(require.resolve('puppeteer-core')));
const modules = ['bench', 'bench-threads', 'bench-scalar', 'bench-scalar-threads'];

let server, address, browser, scratch;
before(async () => {
  for (const name of modules) assert.ok(existsSync(join(pageFolder, 'bench', `${name}.wasm`)), `there is no ${name}.wasm; ./test.sh wasm builds it`);
  server = spawn(process.execPath, [serve, pageFolder, '--https'], {stdio: ['ignore', 'pipe', 'inherit']});
  [address] = (await new Promise(resolve => server.stdout.once('data', lines => resolve(String(lines))))).split('\n');
  scratch = mkdtempSync(join(tmpdir(), 'bench_test_'));
  browser = await puppeteer.launch({
    executablePath: process.env.PELAGIC_CHROMIUM ?? '/usr/bin/chromium', headless: true, acceptInsecureCerts: true, userDataDir: join(scratch, 'profile'),
    protocolTimeout: 300000, args: ['--no-sandbox', '--disable-dev-shm-usage', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
  });
});
after(async () => {
  await browser?.close();
  server?.kill();
  if (scratch) rmSync(scratch, {recursive: true, force: true});
});

/** Returns the JSON of `pelagic bench`. */
const nativeRows = option => JSON.parse(execFileSync(pelagic, ['bench', option, '--seconds', '0.1', '--json', '-'], {stdio: ['ignore', 'pipe', 'ignore']})).rows;

test('the page times the rows of the command with and without threads and SIMD', {timeout: 600000}, async () => {
  const page = await browser.newPage();
  const problems = [];
  page.on('pageerror', error => problems.push(error.message));
  page.on('console', message => { if (['error', 'warn'].includes(message.type())) problems.push(message.text()); });
  await page.goto(`${address}bench/?seconds=4`);
  assert.ok(await page.evaluate(() => isSecureContext && crossOriginIsolated && 'xr' in navigator));
  await page.click('#run');
  await page.waitForFunction(() => globalThis.pelagicBench.isDone, {timeout: 600000});
  const {results, shown, texts} = await page.evaluate(() => ({
    results: globalThis.pelagicBench.results, shown: document.getElementById('json').value, texts: [...document.querySelectorAll('table')].map(one => one.innerText)}));
  console.log(texts.join('\n'));
  assert.deepEqual(results.errors, {});
  assert.deepEqual(problems, []);
  assert.deepEqual(JSON.parse(shown), results);

  // Each build computes the sea of the native command.
  const out = join(scratch, 'native');
  execFileSync(pelagic, ['export', '--out', out, '--start', '12.5', '--maps', 'displacement', '--loop-period', '3600']);
  const {hash} = JSON.parse(readFileSync(join(out, 'sea.json'))).frames[0];
  assert.deepEqual(results.hashes, Object.fromEntries(modules.map(name => [name, hash])));

  const threads = Math.min(3, results.cores);
  const seas = [...new Set(nativeRows('--headset').map(row => `${row.cascades}x${row.n}`))];
  for (const simd of [true, false])
    for (const [hasThreads, counts] of [[false, [1]], [true, [1, 2, 3].slice(0, threads)]]) {
      const rows = results.rows.filter(row => row.simd === simd && row.module_threads === hasThreads);
      assert.deepEqual(rows.map(row => `${row.sea} ${row.threads}`), seas.flatMap(sea => counts.map(count => `${sea} ${count}`)));
      for (const row of rows) assert.ok(row.ours_ms > 0.01 && row.ours_ms < 1000 && row.ours_ms_quartiles[0] <= row.ours_ms, JSON.stringify(row));
    }
  const options = nativeRows('--cost').map(row => row.option);
  for (const simd of [true, false]) assert.deepEqual(results.costs.filter(row => row.simd === simd).map(row => row.option), options);
  // Four lanes; on a busy machine less of it remains.
  const ms = simd => results.rows.find(row => row.sea === '4x128' && row.simd === simd && !row.module_threads).ours_ms;
  assert.ok(ms(false) > 1.3 * ms(true), `${ms(false)} ms without SIMD, ${ms(true)} ms with it`);
  await page.close();
});
