// The npm package in headless Chromium:
//   usage: node browser_test.mjs PACKAGE MODULES GOLDEN_FOLDER SCREENSHOT
// MODULES is a folder node_modules with puppeteer-core and three.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { differences, goldenNames } from './golden_seas.js';
import { goldenOf } from './ocean_parts.js';
import { serve } from './server.js';

const [folder, modules, goldenFolder, screenshot] = process.argv.slice(2);
const puppeteer = createRequire(join(modules, 'from_here.js'))('puppeteer-core');
const goldenText = (name) => readFileSync(join(goldenFolder, name), 'utf8');
const golden = goldenText('hashes.txt');
const folders = { '/node_modules/pelagic/': folder, '/node_modules/': modules, '/tests/': dirname(fileURLToPath(import.meta.url)) };

let browser, plain, isolated;
before(async () => {
  [plain, isolated] = await Promise.all([serve(folders, { isIsolated: false }), serve(folders, { isIsolated: true })]);
  browser = await puppeteer.launch({
    executablePath: execFileSync('sh', ['-c', 'command -v chromium']).toString().trim(),
    args: ['--no-sandbox', '--disable-dev-shm-usage', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
    protocolTimeout: 300000,
  });
});
after(async () => {
  await browser?.close();
  plain?.close();
  isolated?.close();
});

/** Opens a page of the server. Collects the warnings and errors of its console. */
async function open(server, path = '/') {
  const page = await browser.newPage();
  const complaints = [];
  page.on('console', (message) => {
    if (['error', 'warn', 'warning'].includes(message.type())) complaints.push(message.text());
  });
  page.on('pageerror', (error) => complaints.push(String(error)));
  await page.goto(server.origin + path);
  return { page, complaints };
}

// An ocean has no more threads than the machine has CPUs.
for (const [where, module, threads, expected] of [['on the page', 'index.js', undefined, 1], ['in a worker', 'worker.js', 1, 1],
                                                  ['in a worker', 'worker.js', 3, 3]])
  test(`frames have the golden hashes ${where} with ${threads ?? 'the default'} threads`, async () => {
    const { page, complaints } = await open(threads > 1 ? isolated : plain);
    const [lines, count] = await page.evaluate(async (module, threads) => {
      const { createOcean } = await import(`/node_modules/pelagic/${module}`);
      const { goldenLines } = await import('/tests/golden_seas.js');
      const ocean = await createOcean({ threads });
      return [await goldenLines(createOcean, { threads }), ocean.threads];
    }, module, threads);
    assert.equal(count, Math.min(expected, await page.evaluate(() => navigator.hardwareConcurrency)));
    assert.equal(lines.length, goldenNames.length);
    assert.deepEqual(differences(lines, golden), []);
    assert.deepEqual(complaints, []);
    await page.close();
  });

for (const [where, module, options] of [['on the page', 'index.js', { threads: 1 }],
                                        ['in a worker', 'worker.js', { threads: 1 }], ['in a worker', 'worker.js', { threads: 2 }]])
  test(`dynamic waves, a shore and wave inputs have the golden values ${where}, threads: ${options.threads}`, async () => {
    const { page, complaints } = await open(options.threads > 1 ? isolated : plain);
    const seen = await page.evaluate(async (module, options) => {
      const { createOcean } = await import(`/node_modules/pelagic/${module}`);
      const parts = await import('/tests/ocean_parts.js');
      const planes = module === 'worker.js' ? { ...options, maps: ['displacement', 'velocityX', 'velocityY', 'velocityZ'] } : options;
      return [...await parts.oceanLines(createOcean, options), ...await parts.shoreLines(createOcean, options), ...await parts.waveInputLines(createOcean, planes)];
    }, module, options);
    const golden = goldenText('values.txt');
    assert.deepEqual(seen, [...goldenOf(golden, 'waves', 'linear', 'cubic', 'ray'), ...goldenOf(golden, 'shore'), ...goldenOf(golden, 'input')]);
    assert.deepEqual(complaints, []);
    await page.close();
  });

test('threads are rejected on the page itself, and in pages that are not isolated', async () => {
  const messageOf = (module) => import(`/node_modules/pelagic/${module}`).then(({ createOcean }) => createOcean({ threads: 2 }))
    .then(() => 'none', (error) => `${error instanceof Error} ${error.message}`);
  for (const [server, module, expected] of [[isolated, 'index.js', /^true threads is 2, expected 1 on a page's own thread/],
                                            [plain, 'worker.js', /^true threads is 2, expected 1 where a page is not isolated/],
                                            [isolated, 'worker.js', /^none$/]]) {
    const { page } = await open(server);
    assert.match(await page.evaluate(messageOf, module), expected);
    await page.close();
  }
});

test('a missing module is an error', async () => {
  const { page } = await open(plain);
  await page.setRequestInterception(true);
  page.on('request', (request) => (request.url().endsWith('.wasm') ? request.respond({ status: 404 }) : request.continue()));
  const message = await page.evaluate(() => import('/node_modules/pelagic/index.js').then(({ createOcean }) => createOcean())
    .then(() => 'none', (error) => error.message));
  assert.match(message, /ocean\.wasm is not there: the server says 404/);
  await page.close();
});

test('the three.js example draws a sea with a horizon', async () => {
  const { page, complaints } = await open(isolated);
  await page.setViewport({ width: 320, height: 180 });
  // Keeps the context, which the test asks for GL errors.
  await page.evaluateOnNewDocument(() => {
    const getContext = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (type, options) {
      const context = getContext.call(this, type, { ...options, preserveDrawingBuffer: true });
      globalThis.gl = context;
      return context;
    };
  });
  await page.goto(`${isolated.origin}/node_modules/pelagic/examples/three/index.html`);
  await page.waitForFunction(() => document.title.includes('threads'), { timeout: 60000 });
  await page.evaluate(() => new Promise((resolve) => {
    let frames = 0;
    const next = () => (++frames < 5 ? requestAnimationFrame(next) : resolve());
    next();
  }));
  const rows = await page.evaluate(() => {
    const { drawingBufferWidth: width, drawingBufferHeight: height } = gl;
    const pixels = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    globalThis.glError = gl.getError();
    // Mean and standard deviation of the luminance of each row, from the top.
    return Array.from({ length: height }, (_, row) => {
      const start = 4 * width * (height - 1 - row);
      const values = Array.from({ length: width }, (_, i) => (pixels[start + 4 * i] + pixels[start + 4 * i + 1] + pixels[start + 4 * i + 2]) / 3);
      const mean = values.reduce((sum, value) => sum + value) / width;
      return { mean, deviation: Math.sqrt(values.reduce((sum, value) => sum + (value - mean) ** 2, 0) / width) };
    });
  });
  await page.screenshot({ path: screenshot });
  assert.equal(await page.evaluate(() => glError), 0);
  assert.deepEqual(complaints, []);
  const share = (from, to) => rows.slice(Math.floor(from * rows.length), Math.floor(to * rows.length));
  const mean = (some, what) => some.reduce((sum, row) => sum + row[what], 0) / some.length;
  assert.ok(mean(share(0, 0.25), 'mean') > mean(share(0.6, 1), 'mean') + 20, 'the sky is brighter than the water');
  assert.ok(mean(share(0.6, 1), 'deviation') > 5, 'the water is not flat');
  await page.close();
});
