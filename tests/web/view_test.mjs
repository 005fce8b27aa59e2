// SeaView in headless Chromium, compared with native images.
//   usage: node view_test.mjs VIEW_IMAGE SERVE, in a folder that view_test.sh has filled
// Images remain in that folder as .rgba files.
import assert from 'node:assert/strict';
import {execFileSync, spawn} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, before, test} from 'node:test';
import {createRequire} from 'node:module';
import {pathToFileURL} from 'node:url';

const [viewImage, serve] = process.argv.slice(2);
const require = createRequire(join(process.cwd(), 'package.json'));
const {default: puppeteer} = await import(pathToFileURL(require.resolve('puppeteer-core')));

const scene = {
  preset: 'moderate', resolution: 64, timeS: 12.5, light: 'noon', skyFaceSize: 64, quality: 'medium', shading: 'medium', width: 320, height: 180, eyesApartM: 0,
  camera: {position: [3, 5, -2], target: [60, 1, 35], verticalViewRad: 0.8}, points: [[0, 0], [3.5, -7.25], [1234.5, 99]],
};
/** A cheaper scene for many frames, because Chromium draws in software. */
const quickScene = {...scene, quality: 'low', shading: 'headset'};
const viewOptions = ({preset, resolution, skyFaceSize, quality, shading}) => ({preset, resolution, skyFaceSize, quality, shading});

/** Returns the native results of a scene: {pixels, hash, heights}. */
function nativeImage(name, wanted) {
  writeFileSync(`${name}.json`, JSON.stringify(wanted));
  const [hash, ...heights] = execFileSync(viewImage, [`${name}.json`, `${name}_native.rgba`]).toString().trim().split('\n');
  return {hash, heights: heights.map(Number), pixels: readFileSync(`${name}_native.rgba`)};
}

function saved(name, base64) {
  const bytes = Buffer.from(base64, 'base64');
  writeFileSync(`${name}_page.rgba`, bytes);
  return bytes;
}

/** Returns the peak signal-to-noise ratio of the colours of two RGBA images, in decibels. */
function psnr(a, b) {
  assert.equal(a.length, b.length);
  let squares = 0;
  for (let i = 0; i < a.length; ++i) if (i % 4 !== 3) squares += (a[i] - b[i]) ** 2;
  return 10 * Math.log10(255 ** 2 / (squares / (0.75 * a.length)));
}

/** Compares two images, and prints the ratio. */
function assertAlike(name, a, b, minDb) {
  const db = psnr(a, b);
  console.log(`${name}: ${db.toFixed(1)} dB`);
  assert.ok(db >= minDb, `${name}: ${db} dB`);
}

let server, browser, page, profile, site;
const problems = [];

before(async () => {
  server = spawn(process.execPath, [serve, '.'], {stdio: ['ignore', 'pipe', 'inherit']});
  const address = await new Promise(resolve => server.stdout.once('data', line => resolve(String(line).trim())));
  profile = mkdtempSync(join(tmpdir(), 'view_test_'));
  browser = await puppeteer.launch({
    executablePath: process.env.PELAGIC_CHROMIUM ?? '/usr/bin/chromium', headless: true, userDataDir: profile, protocolTimeout: 300000,
    defaultViewport: {width: 240, height: 120},
    args: ['--no-sandbox', '--disable-dev-shm-usage', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
  });
  console.log(await browser.version());
  page = await browser.newPage();
  page.on('pageerror', error => problems.push(String(error)));
  page.on('console', message => { if (message.type() === 'error' && !message.text().includes('404')) problems.push(message.text()); });
  site = address;
  await page.goto(new URL('view_page.html', site));
  await page.waitForFunction('window.tested', {timeout: 60000});
});

after(async () => {
  await browser?.close();
  server?.kill();
  if (profile) rmSync(profile, {recursive: true, force: true});
});

test('the first image has a plain sky; the baked one agrees with EGL, hash and heights exactly', {timeout: 120000}, async () => {
  const native = nativeImage('mono', scene);
  const drawn = await page.evaluate(async (scene, options) => {
    const {module, canvas, eyeOf, pixels, resize} = tested;
    const {width, height} = scene;
    resize(width, height);
    const view = tested.view = new module.SeaView(options);
    view.setLight({preset: scene.light});
    const eyes = [eyeOf(scene.camera, [0, 0, width, height])];
    const image = () => {
      view.draw({width, height, eyes});
      return pixels(view.context, width, height);
    };
    view.simulate(scene.timeS);
    const first = {image: image(), hasSky: view.hasSky()};
    let slices = 1;
    while (!view.continueBaking(50)) ++slices;
    const baked = image();
    const hash = view.hash(), heights = [...view.heights(new Float64Array(scene.points.flat())).heights];

    // Framebuffers of the page: one with as many samples as the canvas, and one to resolve them.
    const gl = view.context;
    const framebufferOf = samples => {
      const framebuffer = gl.createFramebuffer();
      gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
      for (const [format, attachment] of [[gl.RGBA8, gl.COLOR_ATTACHMENT0], [gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT]]) {
        gl.bindRenderbuffer(gl.RENDERBUFFER, gl.createRenderbuffer());
        gl.renderbufferStorageMultisample(gl.RENDERBUFFER, samples, format, width, height);
        gl.framebufferRenderbuffer(gl.FRAMEBUFFER, attachment, gl.RENDERBUFFER, gl.getParameter(gl.RENDERBUFFER_BINDING));
      }
      return framebuffer;
    };
    const framebuffer = framebufferOf(gl.getParameter(gl.SAMPLES)), means = framebufferOf(0);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.clear(gl.COLOR_BUFFER_BIT);
    view.draw({framebuffer, width, height, eyes});
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, framebuffer);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, means);
    gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, means);
    const own = pixels(gl, width, height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    return {first, baked, own, slices, hash, heights, hasSky: view.hasSky(), error: view.glError(), simulateMs: view.simulateMs(), drawMs: view.drawMs(),
            moduleMs: tested.moduleMs};
  }, scene, viewOptions(scene));
  console.log(`module ${drawn.moduleMs.toFixed(0)} ms, sky in ${drawn.slices} slices, simulate ${drawn.simulateMs.toFixed(2)} ms, draw ${drawn.drawMs.toFixed(2)} ms of script`);
  assert.equal(drawn.hash, native.hash);
  assert.deepEqual(drawn.heights.map(Math.fround), native.heights.map(Math.fround));
  assert.equal(drawn.error, 0);
  assert.equal(drawn.first.hasSky, false);
  assert.equal(drawn.hasSky, true);
  const first = saved('first', drawn.first.image);
  // The upper half is bright sky without clouds, which would differ from column to column.
  const {width} = scene;
  const row = Array.from({length: width}, (_, x) => first[4 * (20 * width + x) + 2]);
  assert.ok(Math.min(...row) > 40, `the first sky's blue is ${Math.min(...row)}`);
  assert.ok(Math.max(...row.slice(1).map((blue, x) => Math.abs(blue - row[x]))) <= 6, 'the first sky has edges');
  const baked = saved('mono', drawn.baked);
  assertAlike('page and EGL', baked, native.pixels, 40);
  assertAlike("canvas and a framebuffer of the page's", baked, saved('own', drawn.own), 50);
});

test('200 frames with resizes cause no GL error', {timeout: 400000}, async () => {
  const {errors, simulateMs, drawMs, triangles} = await page.evaluate((camera, options) => {
    const {module, eyeOf, resize} = tested;
    tested.view.delete();
    const view = tested.view = new module.SeaView(options);
    view.setLight({preset: 'noon'});
    while (!view.continueBaking(50));
    const pixel = new Uint8Array(4);
    const errors = [];
    let simulateMs = 0, drawMs = 0;
    for (let i = 0; i < 200; ++i) {
      const [width, height] = i % 40 < 10 ? [160 - i % 10, 90 + i % 10] : [160, 90];
      resize(width, height);
      view.simulate(0.05 * i);
      view.draw({width, height, eyes: [eyeOf(camera, [0, 0, width, height])]});
      // waits for the image
      view.context.readPixels(0, 0, 1, 1, view.context.RGBA, view.context.UNSIGNED_BYTE, pixel);
      simulateMs += view.simulateMs();
      drawMs += view.drawMs();
      const error = view.glError();
      if (error !== 0) errors.push([i, error]);
    }
    return {errors, simulateMs, drawMs, triangles: view.seaInfo().triangles};
  }, scene.camera, viewOptions(quickScene));
  console.log(`script a frame: simulate ${(simulateMs / 200).toFixed(2)} ms, draw ${(drawMs / 200).toFixed(2)} ms, ${triangles} triangles`);
  assert.deepEqual(errors, []);
  assert.ok(triangles > 1000);
});

/**
 * Returns the disparity of some rows: by how many columns the right half is shifted to the left.
 */
function disparity(image, width, rows) {
  const half = width / 2, largest = 12;
  const at = (x, y) => image[4 * (y * width + x) + 1];
  let best = [Infinity, 0];
  for (let shift = -largest; shift <= largest; ++shift) {
    let squares = 0;
    for (const y of rows) for (let x = largest; x < half - largest; ++x) squares += (at(x + shift, y) - at(half + x, y)) ** 2;
    if (squares < best[0]) best = [squares, shift];
  }
  return best[1];
}

test('a headset session draws two eyes, follows the head and ends', {timeout: 150000}, async () => {
  await page.evaluate(async preset => {
    const {XRDevice, metaQuest3} = await import('/node_modules/iwer/build/iwer.module.js');
    const device = tested.device = new XRDevice(metaQuest3, {stereoEnabled: true, fovy: 1.2, ipd: 0.2});
    device.installRuntime({forceInstall: true});
    tested.resize(160, 90);
    if (!await tested.XrSession.isSupported()) throw new Error('there is no headset');
    device.position.set(0.3, 1.7, -0.2);
    tested.seen = undefined;
    tested.framesOfPose = 0;
    tested.xr = await tested.XrSession.enter(tested.view, {
      timeS: 20, origin: [5, 1, 7],
      drawMore(framebuffer, eyes) {
        const gl = tested.view.context;
        const {drawingBufferWidth: width, drawingBufferHeight: height} = gl;
        tested.framesOfPose = tested.seen?.pose === device.position.x ? tested.framesOfPose + 1 : 1;
        tested.seen = {timeS: tested.xr.timeS, width, height, viewports: eyes.map(eye => eye.viewport), pixels: tested.pixels(gl, width, height), pose: device.position.x};
      },
    });
  });
  // The head looks along -z. The room has its floor at `origin`.
  const seenFrom = async (name, [x, y, z], [tx, ty, tz]) => {
    // Caustics and foam are baked beside the frames, so the first of a pose may show older ones.
    await page.waitForFunction(x => Math.abs(tested.seen?.pose - x) < 1e-6 && tested.framesOfPose > 2, {timeout: 90000, polling: 200}, x);
    const seen = await page.evaluate('tested.seen');
    const {width, height} = seen;
    assert.deepEqual(seen.viewports, [[0, 0, width / 2, height], [width / 2, 0, width / 2, height]]);
    const position = [x + 5, y + 1, z + 7];
    const native = nativeImage(name, {...quickScene, timeS: seen.timeS, width, height, eyesApartM: 0.2,
      camera: {position, target: [position[0] + tx, position[1] + ty, position[2] + tz], verticalViewRad: 1.2}});
    const image = saved(name, seen.pixels);
    assertAlike(`${name}, ${width} x ${height}`, image, native.pixels, 40);
    return {...seen, image};
  };
  const first = await seenFrom('stereo', [0.3, 1.7, -0.2], [0, 0, -1]);
  // Near water is further to the left in the right eye; the horizon is not.
  const rows = (from, to) => Array.from({length: to - from}, (_, i) => from + i);
  const near = disparity(first.image, first.width, rows(first.height - 16, first.height));
  const far = disparity(first.image, first.width, rows(6, first.height / 2 - 4));
  console.log(`disparity ${near} pixels near, ${far} far`);
  // Eyes 0.2 m apart, 2.7 m above the sea, 30 degrees down: 0.2 / 5 of the focal length, which is
  // half the height / tan(0.6).
  assert.ok(near >= 2 && near <= 6, `near water is ${near} pixels further to the left`);
  assert.equal(far, 0);

  await page.evaluate(() => {
    tested.device.position.set(-1.5, 2.5, 0.4);
    const half = 0.3;  // about x: down by 0.6 rad
    tested.device.quaternion.set(-Math.sin(half), 0, 0, Math.cos(half));
  });
  const second = await seenFrom('moved', [-1.5, 2.5, 0.4], [0, -Math.sin(0.6), -Math.cos(0.6)]);
  assert.ok(second.timeS > first.timeS && second.timeS < first.timeS + 120, 'the sea runs with the display');
  assert.ok(psnr(first.image, second.image) < 30, 'the head moved, and the image did not');

  const after = await page.evaluate(async () => {
    await tested.xr.end();
    await tested.xr.ended;
    const {frames} = tested.xr;
    await new Promise(resolve => setTimeout(resolve, 300));
    return {more: tested.xr.frames - frames, frames, error: tested.view.glError(), session: String(tested.xr.error), width: tested.canvas.width};
  });
  console.log(`${after.frames} frames of both eyes`);
  assert.deepEqual([after.more, after.error, after.session], [0, 0, 'undefined']);
  assert.equal(after.width, 160, 'the canvas is the page\'s again');
});

test('an invalid value is rejected by one line and does not change the sea', async () => {
  const rejected = await page.evaluate(() => {
    const {module, view} = tested;
    const lines = [];
    view.simulate(1);
    const before = view.hash();
    for (const wrong of [() => view.setSea({windSpeedMps: -3}), () => view.setSea({windSpeed: 3}), () => view.setLight({cloudCover: 3}),
                         () => view.setLight({preset: 'dusk'}), () => new module.SeaView({shading: 'best'}), () => view.draw({eyes: []}),
                         () => view.draw({eyes: [{viewport: [0, 0, 1, 1], view: [1], projection: []}]}), () => view.simulate(NaN)])
      try {
        wrong();
        lines.push('accepted');
      } catch (error) {
        lines.push(`${error.name}: ${error.message}`);
      }
    view.simulate(1);
    return {lines, same: before === view.hash()};
  });
  assert.deepEqual(rejected.lines, [
    'Error: windSpeedMps -3 is out of range (0, 60]',
    rejected.lines[1],
    'Error: cloudCover 3 is out of range [0, 1]',
    'Error: preset is "dusk", expected noon, golden-hour, overcast, storm or moonlight',
    'Error: shading is "best", expected headset, medium or high',
    'Error: eyes is 0, expected one or two',
    "Error: an eye's view needs 16 numbers",
    'Error: timeS is nan, expected a finite number',
  ]);
  assert.match(rejected.lines[1], /^Error: there is no option windSpeed, expected windSpeedMps/);
  assert.equal(rejected.same, true);
});

test('a lost context is reported, and a new view draws in the restored one', {timeout: 60000}, async () => {
  const {line, error} = await page.evaluate(async scene => {
    const {module, canvas, eyeOf} = tested;
    const {context} = tested.view;
    const loser = context.getExtension('WEBGL_lose_context');
    const draw = view => view.draw({width: 160, height: 90, eyes: [eyeOf(scene.camera, [0, 0, 160, 90])]});
    const happens = name => new Promise(resolve => canvas.addEventListener(name, event => { event.preventDefault(); resolve(); }, {once: true}));
    const lost = happens('webglcontextlost');
    loser.loseContext();
    await lost;
    let line = 'drawn';
    try {
      draw(tested.view);
    } catch (error) {
      line = error.message;
    }
    tested.view.delete();
    const restored = happens('webglcontextrestored');
    await new Promise(resolve => setTimeout(resolve, 0));
    loser.restoreContext();
    await restored;
    const view = new module.SeaView({resolution: 64, skyFaceSize: 64});
    view.simulate(1);
    draw(view);
    const error = view.glError();
    view.delete();
    return {line, error};
  }, scene);
  assert.equal(line, "the browser took the canvas's WebGL context away; delete this SeaView and make another one");
  assert.equal(error, 0);
  assert.deepEqual(problems, []);
});

test("the example of docs/integrations/web.md shows the sea in a headset", {timeout: 120000}, async () => {
  const documented = await browser.newPage();
  const errors = [];
  documented.on('pageerror', error => errors.push(String(error)));
  await documented.goto(new URL('documented.html', site));
  await documented.waitForFunction('window.isReady', {timeout: 60000});
  await documented.click('button');
  await documented.waitForFunction('window.framesDrawn >= 3', {timeout: 60000});
  await documented.evaluate('device.activeSession.end()');
  const frames = await documented.evaluate('framesDrawn');
  await new Promise(resolve => setTimeout(resolve, 300));
  assert.deepEqual([await documented.evaluate('framesDrawn'), await documented.evaluate('glError'), errors], [frames, 0, []]);
});
