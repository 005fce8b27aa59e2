// The page in headless Chromium, compared with the native command. The window is small, because
// Chromium draws in software.
//   usage: node page_test.mjs PAGE_FOLDER PELAGIC, in a folder that page_test.sh has filled
import assert from 'node:assert/strict';
import {execFileSync, spawn, spawnSync} from 'node:child_process';
import {mkdirSync, mkdtempSync, readdirSync, readFileSync, readlinkSync, rmSync, symlinkSync, writeFileSync} from 'node:fs';
import {request} from 'node:http';
import {request as secureRequest} from 'node:https';
import {createRequire} from 'node:module';
import {tmpdir} from 'node:os';
import {dirname, join} from 'node:path';
import {after, before, test} from 'node:test';
import {fileURLToPath, pathToFileURL} from 'node:url';

const [pageFolder, pelagic] = process.argv.slice(2);
const root = join(dirname(fileURLToPath(import.meta.url)), '../..');
const serve = join(root, 'web/page/serve.mjs');
const require = createRequire(join(process.cwd(), 'package.json'));
const {default: puppeteer} = await import(pathToFileURL(require.resolve('puppeteer-core')));

let server, address, browser, page, scratch;
const problems = [];
/** Options of a link with the cheapest image, paused. */
const cheap = 'quality=low&shading=headset&scale=1&paused=true';

before(async () => {
  server = spawn(process.execPath, [serve, pageFolder], {stdio: ['ignore', 'pipe', 'inherit']});
  address = await new Promise(resolve => server.stdout.once('data', line => resolve(String(line).trim())));
  scratch = mkdtempSync(join(tmpdir(), 'page_test_'));
  browser = await puppeteer.launch({
    executablePath: process.env.PELAGIC_CHROMIUM ?? '/usr/bin/chromium', headless: true, userDataDir: join(scratch, 'profile'), protocolTimeout: 300000,
    defaultViewport: {width: 320, height: 180},
    args: ['--no-sandbox', '--disable-dev-shm-usage', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
  });
  page = await browser.newPage();
  page.on('console', message => { if (['error', 'warn'].includes(message.type())) problems.push(message.text()); });
  page.on('pageerror', error => problems.push(error.message));
  await page.goto(`${address}#timeS=12.5&${cheap}`, {timeout: 300000});
  await page.waitForFunction(() => globalThis.pelagicPage?.timings.firstFrameMs || !document.getElementById('problem').hidden, {timeout: 300000});
  assert.equal(await problemLine(), '');
});
after(async () => {
  await browser?.close();
  server?.kill();
  rmSync(scratch, {recursive: true, force: true});
});

/** Waits until the sea of the settings is drawn, and returns the displayed hash. */
async function shownHash() {
  await page.waitForFunction(() => {
    const {seaChanged, hash, shownTimeS, settings} = globalThis.pelagicPage;
    return !seaChanged && hash && shownTimeS === settings.timeS && document.getElementById('hash').value === hash;
  }, {timeout: 120000});
  return page.$eval('#hash', output => output.value);
}

async function openLink(text) {
  await page.evaluate(link => { location.hash = link; }, text);
  await page.waitForFunction(link => location.hash.slice(1) === link, {}, text);
  // after the hashchange event
  await page.evaluate(() => new Promise(resolve => setTimeout(resolve, 0)));
}

/** Returns the hash of a frame, by the native command. */
function nativeHash(timeS, ...flags) {
  const out = join(scratch, `native_${Math.random()}`);
  const loop = flags.includes('--loop-period') ? [] : ['--loop-period', '3600'];  // the page's
  execFileSync(pelagic, ['export', '--out', out, '--start', String(timeS), '--maps', 'displacement', ...loop, ...flags]);
  return JSON.parse(readFileSync(join(out, 'sea.json'))).frames[0].hash;
}

/** Returns a point of the canvas that no control covers. */
const placeOnSea = () => page.evaluate(() => {
  for (let y = innerHeight / 2; y > 0; --y)
    if (document.elementFromPoint(innerWidth / 2, y)?.id === 'sea') return {x: innerWidth / 2, y};
});
const problemLine = () => page.$eval('#problem', line => (line.hidden ? '' : line.textContent));

// Serving.

test('the server sends media types, isolates pages and serves no file outside of its folder', async () => {
  const asked = async path => {
    const answer = await fetch(address + path);
    await answer.arrayBuffer();
    return answer;
  };
  for (const [path, type] of [['', 'text/html'], ['main.js', 'text/javascript'], ['style.css', 'text/css'], ['pelagic_view.wasm', 'application/wasm']]) {
    const answer = await asked(path);
    assert.equal(answer.status, 200, path);
    assert.equal(answer.headers.get('content-type').split(';')[0], type);
    assert.equal(answer.headers.get('cross-origin-opener-policy'), 'same-origin');
    assert.equal(answer.headers.get('cross-origin-embedder-policy'), 'require-corp');
  }
  assert.equal((await asked('nothing.js')).status, 404);
  assert.equal((await fetch(address, {method: 'POST'})).status, 405);
  assert.equal((await fetch(`${address}main.js`, {method: 'HEAD'})).status, 200);
  // fetch() would normalise such paths.
  for (const path of ['/../page_bindings.cpp', '/..%2f..%2f..%2fetc%2fpasswd', '/%2e%2e/%2e%2e/etc/passwd', '/%'])
    assert.equal(await new Promise((resolve, reject) => request(address, {path}, answer => resolve(answer.statusCode)).on('error', reject).end()), 404, path);
});

test('the server follows no link out of its folder, and rejects invalid arguments in one line', async () => {
  const folder = join(scratch, 'served');
  execFileSync('mkdir', [folder]);
  writeFileSync(join(folder, 'index.html'), 'here');
  writeFileSync(join(scratch, 'secret.txt'), 'secret');
  symlinkSync(join(scratch, 'secret.txt'), join(folder, 'link.txt'));
  const other = spawn(process.execPath, [serve, folder], {stdio: ['ignore', 'pipe', 'inherit']});
  const at = await new Promise(resolve => other.stdout.once('data', line => resolve(String(line).trim())));
  assert.equal(await (await fetch(at)).text(), 'here');
  assert.equal((await fetch(`${at}link.txt`)).status, 404);
  const refused = (...words) => spawnSync(process.execPath, [serve, ...words]).stderr.toString();
  assert.equal(refused(), 'serve: which folder? serve.mjs FOLDER [PORT] [--https]\n');
  assert.equal(refused('/none'), 'serve: there is no folder /none\n');
  assert.equal(refused(folder, '70000'), 'serve: PORT is 70000, expected 0 to 65535\n');
  assert.equal(refused(folder, new URL(at).port), `serve: port ${new URL(at).port} is taken: give another one\n`);
  other.kill('SIGINT');
  assert.equal(await new Promise(resolve => other.once('exit', resolve)), 0);
});

test('the server closes files of aborted downloads, does not wait for a FIFO, and redirects folders', {timeout: 120000}, async () => {
  const folder = join(scratch, 'attacked');
  mkdirSync(join(folder, 'inside'), {recursive: true});
  writeFileSync(join(folder, 'inside', 'index.html'), 'inside');
  writeFileSync(join(folder, 'empty.js'), '');
  writeFileSync(join(folder, 'large.bin'), Buffer.alloc(64 << 20));
  execFileSync('mkfifo', [join(folder, 'pipe')]);
  const other = spawn(process.execPath, [serve, folder], {stdio: ['ignore', 'pipe', 'inherit']});
  try {
    const at = await new Promise(resolve => other.stdout.once('data', line => resolve(String(line).trim())));
    const openFiles = () => readdirSync(`/proc/${other.pid}/fd`).map(number => {
      // A file may have been closed meanwhile.
      try { return readlinkSync(`/proc/${other.pid}/fd/${number}`); } catch { return ''; }
    }).filter(path => path.startsWith(folder));
    for (let download = 0; download < 20; ++download)
      await new Promise((resolve, reject) => {
        const asked = request(`${at}large.bin`, answer => answer.once('data', () => { asked.destroy(); resolve(); }));
        asked.on('error', reject).end();
      });
    for (let wait = 0; wait < 1000 && openFiles().length; ++wait) await new Promise(resolve => setTimeout(resolve, 20));
    assert.deepEqual(openFiles(), []);
    // more than node has file threads
    for (let call = 0; call < 8; ++call) assert.equal((await fetch(`${at}pipe`)).status, 404);
    const redirect = await fetch(`${at}inside?wind=3`, {redirect: 'manual'});
    assert.equal(redirect.status, 301);
    assert.equal(redirect.headers.get('location'), './inside/?wind=3');
    assert.equal(await (await fetch(`${at}inside`)).text(), 'inside');
    assert.equal(await (await fetch(`${at}empty.js`)).text(), '');
    assert.equal((await (await fetch(`${at}large.bin`)).arrayBuffer()).byteLength, 64 << 20);
    assert.deepEqual(openFiles(), []);
  } finally {
    other.kill('SIGKILL');
  }
});

test('the server serves a network over HTTPS, or names what it lacks', {timeout: 120000}, async () => {
  const secure = spawn(process.execPath, [serve, pageFolder, '--https'], {stdio: ['ignore', 'pipe', 'inherit']});
  const [at, ...others] = (await new Promise(resolve => secure.stdout.once('data', text => resolve(String(text).trim())))).split('\n');
  assert.match(at, /^https:\/\/localhost:\d+\/$/);
  for (const other of others) assert.match(other, /^https:\/\/[\d.]+:\d+\/$/);
  const {status, names, isolation} = await new Promise((resolve, reject) => secureRequest(at, {rejectUnauthorized: false}, answer => {
    const names = answer.socket.getPeerCertificate().subjectaltname;
    answer.resume().on('end', () => resolve({status: answer.statusCode, names, isolation: answer.headers['cross-origin-embedder-policy']}));
  }).on('error', reject).end());
  assert.deepEqual([status, isolation], [200, 'require-corp']);
  for (const address of ['DNS:localhost', 'IP Address:127.0.0.1', ...others.map(other => `IP Address:${new URL(other).hostname}`)])
    assert.ok(names.split(', ').includes(address), `${address} is not in ${names}`);
  secure.kill('SIGINT');
  assert.equal(await new Promise(resolve => secure.once('exit', resolve)), 0);
  const without = spawnSync(process.execPath, [serve, pageFolder, '--https'], {env: {PATH: '/nonexistent'}});
  assert.equal(without.stderr.toString(), 'serve: --https needs the program openssl, which is not installed\n');
  assert.equal(without.status, 1);
});

// Opening.

test('the first image is drawn before the first slice of the sky, which takes several', async () => {
  await page.waitForFunction(() => globalThis.pelagicPage.timings.skyMs, {timeout: 300000});
  const timings = await page.evaluate(() => globalThis.pelagicPage.timings);
  assert.ok(timings.firstSliceMs >= timings.firstFrameMs);
  assert.ok(timings.slices.length > 10, `${timings.slices.length} slices`);
  assert.ok(await page.evaluate(() => globalThis.pelagicPage.view.hasSky()));
  // The last slice uploads the sky.
  const upload = timings.slices.pop();
  console.log(`first image after ${timings.firstFrameMs.toFixed(0)} ms, sky after ${timings.skyMs.toFixed(0)} ms, ` +
              `${timings.slices.length} slices, the longest ${Math.max(...timings.slices).toFixed(1)} ms, ${upload.toFixed(1)} ms with the upload`);
});

test('the page shows a sea without errors, and every control has a name', async () => {
  const image = await page.evaluate(() => {
    const {gl, view} = globalThis.pelagicPage;
    globalThis.pelagicPage.isStale = true;
    return new Promise(resolve => {
      const look = () => {
        if (globalThis.pelagicPage.isStale) return setTimeout(look, 5);
        resolve({error: view.glError(), width: gl.drawingBufferWidth, height: gl.drawingBufferHeight});
      };
      look();
    });
  });
  assert.deepEqual(image, {error: 0, width: 320, height: 180});
  const screen = Buffer.from(await page.screenshot({encoding: 'binary'}));
  assert.ok(screen.length > 10000, 'an image without detail packs into less');
  assert.equal(await problemLine(), '');
  const nameless = await page.evaluate(() => [...document.querySelectorAll('input, select, button')]
    .filter(control => !(control.labels?.[0]?.textContent || control.textContent.trim())).map(control => control.outerHTML));
  assert.deepEqual(nameless, []);
  const ids = await page.evaluate(() => [...document.querySelectorAll('[id]')].map(one => one.id));
  assert.equal(new Set(ids).size, ids.length);
  assert.ok(await page.evaluate(() => document.getElementById('enter-vr').hidden), 'no headset here');
});

// Sea.

test('the hash of a paused frame is that of the native command', async () => {
  assert.equal(await shownHash(), nativeHash(12.5));
});

test('sliders and presets give the hashes of the native command', async () => {
  await page.evaluate(() => {
    const select = document.getElementById('option-sea-state');
    select.value = 'storm';
    select.dispatchEvent(new Event('change'));
  });
  assert.equal(await shownHash(), nativeHash(12.5, '--preset', 'storm'));
  await page.evaluate(() => {
    for (const [name, value] of [['wind', '14.5'], ['wind-towards', '30'], ['choppiness', '0.65']]) {
      const slider = document.getElementById(`option-${name}`);
      slider.value = value;
      slider.dispatchEvent(new Event('input'));
    }
  });
  assert.equal(await page.$eval('#option-wind + output', output => output.value), '14.5 m/s');
  assert.equal(await shownHash(), nativeHash(12.5, '--preset', 'storm', '--wind-speed', '14.5', '--wind-direction', '30', '--choppiness', '0.65'));
});

test('a link gives the hash of the native command', async () => {
  await openLink(`sea=swell&swellDirectionRad=120deg&seed=77&cascades=3&spreading=cosine-2s&timeS=-3.25&${cheap}`);
  assert.equal(await shownHash(), nativeHash(-3.25, '--preset', 'swell', '--swell-direction', '120', '--seed', '77', '--cascades', '3', '--spreading', 'cosine-2s'));
});

test('an invalid value shows one line and does not change the sea', async () => {
  const before = await shownHash();
  await page.evaluate(() => {
    const input = document.getElementById('option-fetch-m');
    input.value = '-5';
    input.dispatchEvent(new Event('change'));
  });
  assert.equal(await problemLine(), 'fetchM -5 is out of range (0, 2e6]');
  assert.equal(await shownHash(), before);
});

test('time advances unless it is paused, and an unchanged image is not drawn again', async () => {
  const time = () => page.evaluate(() => globalThis.pelagicPage.settings.timeS);
  const isPressed = () => page.$eval('#pause', button => button.getAttribute('aria-pressed'));
  assert.equal(await isPressed(), 'true');
  await page.click('#pause');
  assert.equal(await isPressed(), 'false');
  const from = await time();
  await page.waitForFunction(start => globalThis.pelagicPage.settings.timeS > start, {timeout: 120000}, from);
  await page.click('#pause');
  await shownHash();
  const at = await time();
  await page.waitForFunction(() => globalThis.pelagicPage.restingFrames > 2, {timeout: 120000});
  assert.equal(await time(), at);
});

// Links.

test('a link restores every option exactly', async () => {
  const failures = await page.evaluate(async () => {
    const {module, tables} = globalThis.pelagicPage;
    const {allOptions, check, defaultSettings} = await import('./options.js');
    const {readLink, writeLink} = await import('./share_link.js');
    const failures = [];
    let seed = 1;
    const random = () => (seed = Math.imul(seed, 1664525) + 1013904223 >>> 0) / 2 ** 32;
    const comesBack = (settings, what) => {
      const link = writeLink(settings, tables);
      if (!/^[\w=&.+~-]*$/.test(link)) failures.push(`${what}: ${link}`);
      const read = readLink(`#${link}`, module, tables);
      for (const name of Object.keys(settings))
        if (!Object.is(read[name], settings[name])) failures.push(`${what}: ${name} is ${settings[name]}, comes back as ${read[name]}`);
    };
    const values = option => {
      if (option.words) return option.words;
      if (typeof option.default === 'boolean') return [true, false];
      const within = Array.from({length: 20}, () => option.least + random() * (option.most - option.least));
      return [option.least, option.most, 0, -0, 1, 2, 16, 64, 0.1 + 0.2, 30 * Math.PI / 180, ...within, ...within.map(Math.round)];
    };
    const options = allOptions(tables);
    if (new Set(options.map(option => option.name)).size !== options.length) failures.push('two options have one name');
    for (const option of options) {
      let held = 0;
      for (const value of values(option)) {
        const settings = {...defaultSettings(tables), [option.name]: value};
        if (check(settings, module, tables)) continue;
        comesBack(settings, option.name);
        if (value !== option.default) ++held;
      }
      if (!held) failures.push(`${option.name}: no value but the default was tried`);
    }
    for (const preset of tables.seaPresets)
      for (const light of tables.lightPresets) comesBack({...defaultSettings(tables), ...preset.sea, ...light.light}, `${preset.name}, ${light.name}`);
    if (writeLink(defaultSettings(tables), tables) !== '') failures.push('the defaults take a link');
    return failures;
  });
  assert.deepEqual(failures, []);
});

test('the button makes a link that restores the image', async () => {
  await openLink(`sea=storm&light=storm&${cheap}`);
  const before = await shownHash();
  const {x, y} = await placeOnSea();
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 40, y - 10);
  await page.mouse.up();
  await page.click('#share');
  await page.waitForFunction(() => location.hash.startsWith('#sum='));
  const shown = await page.evaluate(() => ({link: location.hash, settings: globalThis.pelagicPage.currentSettings()}));
  assert.ok(shown.link.length < 220, `${shown.link.length} characters`);
  assert.match(shown.link, /cameraHeadingRad=/);
  await openLink('');
  assert.notEqual(await page.evaluate(() => globalThis.pelagicPage.settings.windSpeedMps), shown.settings.windSpeedMps);
  await openLink(shown.link.slice(1));
  assert.equal(await shownHash(), before);
  assert.deepEqual(await page.evaluate(() => globalThis.pelagicPage.currentSettings()), shown.settings);
});

test('a damaged link shows one line and the default sea', async () => {
  await openLink(`sea=storm&${cheap}`);
  const link = await page.evaluate(() => new URL(globalThis.pelagicPage.link()).hash.slice(1));
  assert.match(link, /^sum=/);
  const read = texts => page.evaluate(async all => {
    const {module, tables} = globalThis.pelagicPage;
    const {readLink} = await import('./share_link.js');
    return all.map(text => { try { readLink(text, module, tables); return ''; } catch (error) { return error.message; } });
  }, texts);
  // Truncated within or after the checksum, or with one changed character.
  const lines = await read([...Array(link.length - 5).keys()].map(count => link.slice(0, count + 5)));
  assert.ok(lines.every(line => line), `a piece of ${link} is taken for a link`);
  const changed = await read([...Array(link.length - 9).keys()].map(at => `${link.slice(0, at + 9)}%${link.slice(at + 10)}`));
  assert.ok(changed.every(line => line));
  const told = {
    'windSpeedMps=99': 'windSpeedMps 99 is out of range (0, 60]',
    'windSpeedMps=': 'windSpeedMps is empty, expected a number: (0, 60]',
    'windSpeedMps=1e': 'windSpeedMps is 1e, expected a number: (0, 60]',
    'wind=9': 'the page has no option wind',
    'seed=1&seed=2': 'seed stands twice in the link',
    'seed=1.5': 'seed is 1.5, expected a whole number from 0 to 4294967295',
    'paused=yes': 'paused is yes, expected true or false',
    'scale=0.1': 'scale 0.1 is out of range [0.25, 1], or 0: by the frame time',
    'cloudCover=2': 'cloudCover 2 is out of range [0, 1]',
    'light=dawn': 'light is dawn, expected one of noon, golden-hour, overcast, storm, moonlight',
    '%0A%E0%A4%A=1': 'the page has no option %0A%E0%A4%A',
  };
  assert.deepEqual(await read(Object.keys(told)), Object.values(told));
  const [unknownSea, manyCascades] = await read(['sea=gale', 'sea=pond&cascades=3']);
  assert.match(unknownSea, /^sea is gale, expected one of pond, calm, .*beaufort-12$/);
  assert.match(manyCascades, /^cascades is 3, expected 1 where waves is pond$/);
  await openLink('windSpeedMps=99');
  assert.equal(await problemLine(), 'This link is damaged: windSpeedMps 99 is out of range (0, 60]. Here is the default sea.');
  assert.equal(await page.evaluate(() => globalThis.pelagicPage.settings.windSpeedMps), 12);
  await openLink(cheap);
  assert.equal(await problemLine(), '');
});

test('the commands and the link of docs/integrations/web.md work', async () => {
  const text = readFileSync(join(root, 'docs/integrations/web.md'), 'utf8');
  const [, link] = text.match(/^ {4}http:.*#(sum=\S+)$/m);
  const [, flags] = text.match(/^ {4}pelagic export (.*) --start 12.5 --out out$/m);
  await openLink(link);
  assert.equal(await problemLine(), '');
  assert.equal(await shownHash(), nativeHash(12.5, ...flags.split(' ')));
  assert.equal(await page.evaluate(() => new URL(globalThis.pelagicPage.link()).hash.slice(1)), link);
  await openLink(cheap);

  const demo = words => spawn(join(root, 'demo.sh'), ['web', ...words], {stdio: ['ignore', 'pipe', 'inherit'], env: {...process.env, PELAGIC_SKIP_SETUP: '1'}});
  const lines = child => new Promise(resolve => {
    let said = '';
    child.stdout.on('data', data => { if (/^http:/m.test(said += data)) resolve(said); });
    child.on('exit', () => resolve(said));
  });
  const served = demo(['0']);
  const [at] = (await lines(served)).match(/^http:\S+$/m);
  assert.match(await (await fetch(at)).text(), /<title>Pelagic<\/title>/);
  served.kill('SIGINT');
  assert.equal(await new Promise(resolve => served.once('exit', resolve)), 0);
  assert.equal(await lines(demo(['--build-only'])), 'Building the page (some minutes the first time) ...\n');
  assert.equal(await lines(demo(['fast'])), 'demo.sh web: what is fast? A port, --https or --build-only is accepted\n');
});

// Boat.

/**
 * Returns the motion of a matrix from the boat to the world: heave of the point on its waterline above
 * or below the centre of mass, metres; pitch and roll in radians, if they are small.
 */
const motionOf = m => ({heave: m[13] - 0.76 * m[1], pitch: Math.asin(m[1]), roll: -Math.atan2(m[9], m[5])});

test('the boat lies on the water of a paused frame', async () => {
  await openLink(`sea=rough&timeS=44&${cheap}`);
  await shownHash();
  const pose = motionOf(await page.evaluate(() => [...globalThis.pelagicPage.view.hullMatrix()]));
  // The plane nearest to the water along the waterline, in axes of the boat.
  const [cosine, sine] = [Math.cos(2.3), Math.sin(2.3)], along = [-2.4, -1.2, 0, 1.2, 2.4], across = [-0.9, 0, 0.9];
  const places = along.flatMap(x => across.map(z => [x, z]));
  const points = join(scratch, 'points.csv');
  writeFileSync(points, places.map(([x, z]) => `${x * cosine - z * sine},${x * sine + z * cosine}`).join('\n'));
  const rows = JSON.parse(execFileSync(pelagic, ['query', '--preset', 'rough', '--time', '44', '--points', points, '--json', '--interpolation', 'linear']).toString());
  const heights = rows.map(row => row.height);
  const mean = heights.reduce((sum, height) => sum + height, 0) / heights.length;
  const [slopeX, slopeZ] = [0, 1].map(axis =>
    places.reduce((sum, place, i) => sum + place[axis] * heights[i], 0) / places.reduce((sum, place) => sum + place[axis] ** 2, 0));
  console.log(`height ${pose.heave.toFixed(3)} of ${mean.toFixed(3)} m, pitch ${pose.pitch.toFixed(3)} of ${slopeX.toFixed(3)}, roll ${pose.roll.toFixed(3)} of ${(-slopeZ).toFixed(3)}`);
  assert.ok(Math.abs(mean) > 0.5 && Math.abs(slopeX) > 0.1 && Math.abs(slopeZ) > 0.1, 'the water is flat');
  // The library weights the water by the hull's plan, and waves as short as the hull differ.
  assert.ok(Math.abs(pose.heave - mean) < 0.1, `${pose.heave} against ${mean}`);
  assert.ok(Math.abs(pose.pitch - slopeX) < 0.05, `${pose.pitch} against ${slopeX}`);
  assert.ok(Math.abs(pose.roll + slopeZ) < 0.05, `${pose.roll} against ${-slopeZ}`);
});

test('the boat heaves with the water of the native command, and its mooring holds it', {timeout: 300000}, async () => {
  const fromS = 40, seconds = 10;
  const points = join(scratch, 'anchor.csv');
  writeFileSync(points, '0,0');
  const water = JSON.parse(execFileSync(pelagic, ['query', '--preset', 'swell', '--times', `${fromS}:${fromS + seconds}:0.25`, '--points', points, '--json']).toString());
  await openLink(`sea=swell&timeS=${fromS}&${cheap}`);
  await shownHash();
  const moved = {};
  for (let second = 0; second < seconds; ++second)
    Object.assign(moved, await page.evaluate((fromS, second) => {
      const {view} = globalThis.pelagicPage, motions = {};
      for (let i = 60 * second; i < 60 * second + 60; ++i) {
        view.simulate(fromS + i / 60);
        if (i % 15 === 0) motions[fromS + i / 60] = [...view.hullMatrix()];
      }
      return motions;
    }, fromS, second));
  const rows = water.filter(row => row.time in moved), deviation = values => Math.sqrt(values.reduce((sum, value) => sum + value ** 2, 0) / values.length);
  assert.equal(rows.length, 4 * seconds);
  const differs = deviation(rows.map(row => motionOf(moved[row.time]).heave - row.height)), moves = deviation(rows.map(row => row.height));
  console.log(`heave differs by ${differs.toFixed(3)} m from water that moves by ${moves.toFixed(3)} m`);
  // The boat's heave of 1.7 s follows swell, and leaves out waves as short as the boat.
  assert.ok(moves > 0.2 && differs < 0.25 * moves, `${differs} m of ${moves} m`);
  const last = moved[fromS + seconds - 0.25];
  assert.ok(Math.hypot(last[12] + 0.76 * last[0], last[14] + 0.76 * last[2]) < 3, `the boat is at ${last.slice(12, 15)}`);
  assert.ok(last[0] * Math.cos(2.3) + last[2] * Math.sin(2.3) > Math.cos(0.5), `the bow is at ${last.slice(0, 3)}`);
});

test('1,000 frames with the boat do not grow the heap', {timeout: 600000}, async () => {
  await openLink(`sea=moderate&timeS=0&${cheap}`);
  await shownHash();
  const run = async count => {
    for (let done = 0; done < count; done += 50)
      await page.evaluate(first => {
        const {module, camera, boat} = globalThis.pelagicPage, width = 32, height = 18, pixel = new Uint8Array(4);
        const view = globalThis.testedView ??= new module.SeaView(
          {cascades: 3, resolution: 64, quality: 'low', sizeM: 256, shading: 'headset', skyFaceSize: 16, hull: globalThis.testedHull});
        const eye = {viewport: [0, 0, width, height], ...camera.matrices(width / height)}, gl = view.context;
        for (let i = first; i < first + 50; ++i) {
          view.simulate(i / 60);
          view.draw({width, height, eyes: [eye]});
          boat.draw(eye, view.hullMatrix(), view.lightInfo(), [0, 0, 0]);
        }
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);  // waits for the images
      }, frames += 50);
    return page.evaluate(() => ({allocated: testedView.seaInfo().allocatedBytes, error: testedView.glError()}));
  };
  let frames = 0;
  await page.evaluate(async () => { globalThis.testedHull = (await import('./boat.js')).boatHull(); });
  const session = await page.createCDPSession();
  const heap = async () => {
    await session.send('HeapProfiler.collectGarbage');
    return (await session.send('Runtime.getHeapUsage')).usedSize;
  };
  const first = await run(100), before = await heap();
  const last = await run(1000), after = await heap();
  await session.detach();
  await page.evaluate(() => testedView.delete());
  console.log(`module ${first.allocated} to ${last.allocated} bytes, scripts ${before} to ${after}`);
  assert.deepEqual(last, first);
  // A matrix kept for each frame would be 200,000 bytes; the browser keeps some kilobytes of each of the calls here.
  assert.ok(after - before < 100000, `scripts take ${after - before} bytes more`);
});

test('the mesh of the boat has unit normals and no vertex outside of its bounds', async () => {
  const {length, beam, boatMesh} = await import(pathToFileURL(join(pageFolder, 'boat.js')));
  const mesh = boatMesh();
  assert.equal(mesh.length % 27, 0);
  for (let i = 0; i < mesh.length; i += 9) {
    const [x, y, z, ...normal] = mesh.slice(i, i + 6);
    assert.ok(Math.abs(x) < 0.6 * length && y > -0.6 && y < 4 && Math.abs(z) < 0.52 * beam, `corner ${x}, ${y}, ${z}`);
    assert.ok(Math.abs(Math.hypot(...normal) - 1) < 1e-3, `normal ${normal}`);
    assert.ok(mesh.slice(i + 6, i + 9).every(part => part > 0 && part < 1));
  }
});

test('the hull of the boat is closed, and the mass is that of its water', async () => {
  const {boatHull} = await import(pathToFileURL(join(pageFolder, 'boat.js')));
  const {vertices, triangles, massKg} = boatHull();
  let sixfold = 0;
  for (let i = 0; i < triangles.length; i += 3) {
    // cut at y = 0, which the tetrahedra with the origin do not cross
    const corners = [0, 1, 2].map(k => vertices.slice(3 * triangles[i + k], 3 * triangles[i + k] + 3));
    const wet = corners.flatMap((a, k) => {
      const b = corners[(k + 1) % 3], cut = a[1] / (a[1] - b[1]);
      return [...(a[1] < 0 ? [a] : []), ...(a[1] < 0 !== b[1] < 0 ? [a.map((at, axis) => at + cut * (b[axis] - at))] : [])];
    });
    for (let k = 1; k + 1 < wet.length; ++k) {
      const [a, b, c] = [wet[0], wet[k], wet[k + 1]];
      sixfold += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
  }
  assert.ok(Math.abs(1025 * sixfold / 6 - massKg) < 5, `${1025 * sixfold / 6} against ${massKg} kg`);
});

// Detail.

test('slow frames lower scale, mesh and shading, and fast ones raise them', async () => {
  const {DrawDetail} = await import(pathToFileURL(join(pageFolder, 'draw_detail.js')));
  const wanted = {quality: 'high', shading: 'medium'}, least = {scale: 0.25, quality: 'low', shading: 'headset'};
  const slow = new DrawDetail();
  assert.deepEqual(slow.of(wanted), {scale: 1, ...wanted});
  slow.follow(3000);
  assert.deepEqual(slow.of(wanted), least);
  assert.deepEqual(slow.of({quality: 'paper_high', shading: 'headset'}), {scale: 0.25, quality: 'paper_high', shading: 'headset'});
  for (let frame = 0; frame < 1000; ++frame) slow.follow(8);
  assert.deepEqual(slow.of(wanted), {scale: 1, ...wanted});
  // A GPU whose time is that of the triangles and the pixels settles.
  const triangles = {low: 0.08, medium: 0.3, high: 1}, gpu = new DrawDetail(), seen = [];
  for (let frame = 0; frame < 2000; ++frame) {
    const {scale, quality, shading} = gpu.of(wanted);
    gpu.follow(60 * triangles[quality] + 40 * scale ** 2 * (shading === 'headset' ? 0.6 : 1));
    if (frame >= 1000) seen.push(quality);
  }
  assert.deepEqual([...new Set(seen)], ['medium']);
});

test("a software driver's frame takes at most 0.8 s", {timeout: 300000}, async () => {
  const visitor = await browser.newPage();
  await visitor.setViewport({width: 480, height: 300});
  await visitor.goto(address);
  await visitor.waitForFunction(() => globalThis.pelagicPage?.timings.skyMs, {timeout: 300000});
  const frames = await visitor.evaluate(() => new Promise(resolve => {
    const page = globalThis.pelagicPage, {showStatistics} = page, times = [];
    page.showStatistics = function (now, sinceLast) {
      showStatistics.call(this, now, sinceLast);
      times.push(sinceLast);
      if (times.length === 8) resolve({ms: Math.min(...times.slice(2)), width: page.gl.drawingBufferWidth, height: page.gl.drawingBufferHeight, triangles: page.view.seaInfo().triangles});
    };
  }));
  console.log(`${frames.ms.toFixed(0)} ms, ${frames.width} x ${frames.height}, ${frames.triangles} triangles`);
  assert.deepEqual([frames.width, frames.height], [120, 75]);
  assert.ok(frames.ms <= 800, `${frames.ms} ms`);
  await visitor.close();
});

// Headset.

test('the button starts a headset session with two eyes, whose end returns to the page', async () => {
  const visitor = await browser.newPage();
  visitor.on('pageerror', error => problems.push(error.message));
  // Chromium has navigator.xr without a headset; iwer replaces it by a Quest 3.
  await visitor.evaluateOnNewDocument(`${readFileSync(require.resolve('iwer/build/iwer.min.js'))}
    globalThis.headset = new IWER.XRDevice(IWER.metaQuest3, {stereoEnabled: true});
    headset.installRuntime({forceInstall: true});`);
  await visitor.goto(`${address}#timeS=12.5&${cheap.replace('&paused=true', '')}`);
  await visitor.waitForFunction(() => globalThis.pelagicPage?.timings.firstFrameMs, {timeout: 300000});
  await visitor.waitForSelector('#enter-vr:not([hidden])');
  await visitor.evaluate(() => {
    const {view} = pelagicPage, {draw} = view;
    globalThis.drawn = [];
    view.draw = request => {
      draw.call(view, request);
      drawn.push({eyes: request.eyes.length, isCanvas: !request.framebuffer, viewports: request.eyes.map(eye => eye.viewport[0]), boat: view.hullMatrix()[13]});
    };
  });
  await visitor.click('#enter-vr');
  const seen = await visitor.waitForFunction(() => {
    const inHeadset = drawn.filter(frame => frame.eyes === 2);
    return inHeadset.length >= 3 && inHeadset;
  }, {timeout: 120000});
  const inHeadset = await seen.jsonValue();
  for (const {viewports} of inHeadset) assert.ok(viewports[1] > viewports[0], 'the right eye is on the right');
  assert.notEqual(inHeadset[2].boat, inHeadset[0].boat, 'the boat does not move');
  assert.equal(await visitor.evaluate(() => pelagicPage.view.glError()), 0);
  await visitor.evaluate(async () => {
    await headset.activeSession.end();
    drawn.length = 0;
  });
  await visitor.waitForFunction(() => drawn.some(frame => frame.eyes === 1), {timeout: 120000});
  assert.equal(await visitor.$eval('#problem', line => line.textContent), '');
  await visitor.close();
});

// Window size and input.

test('the image has the size of the window, and the panel is hidden on phones at first', async () => {
  const phone = {width: 180, height: 320};
  await page.setViewport(phone);
  await page.waitForFunction(() => globalThis.pelagicPage.gl.drawingBufferHeight === 320, {timeout: 120000});
  assert.equal(await page.evaluate(() => globalThis.pelagicPage.view.glError()), 0);
  await page.keyboard.press('KeyH');
  assert.ok(await page.$eval('#panel', panel => panel.hidden) === (await page.$eval('#toggle-panel', button => button.getAttribute('aria-expanded')) === 'false'));
  const other = await browser.newPage();
  await other.setViewport(phone);
  await other.goto(`${address}#${cheap}`);
  await other.waitForFunction(() => globalThis.pelagicPage?.timings.firstFrameMs, {timeout: 300000});
  assert.ok(await other.$eval('#panel', panel => panel.hidden));
  await other.close();
});

test('keys and wheel move the camera', async () => {
  const eye = () => page.evaluate(() => globalThis.pelagicPage.currentSettings());
  const before = await eye();
  const {x, y} = await placeOnSea();
  await page.mouse.move(x, y);
  await page.mouse.wheel({deltaY: -300});
  await page.waitForFunction(distance => globalThis.pelagicPage.camera.distance < distance, {timeout: 60000}, before.cameraDistanceM);
  await page.keyboard.down('KeyR');
  await page.waitForFunction(height => globalThis.pelagicPage.camera.eye[1] > height + 0.01, {timeout: 120000}, (await eye()).cameraYM);
  await page.keyboard.up('KeyR');
  await page.evaluate(() => globalThis.pelagicPage.change({cameraFlies: true}));
  const flying = await eye();
  await page.mouse.wheel({deltaY: -100});
  await page.waitForFunction(x => Math.abs(globalThis.pelagicPage.camera.eye[0] - x) > 0.5, {timeout: 60000}, flying.cameraXM);
  assert.equal((await eye()).cameraHeadingRad, flying.cameraHeadingRad);
});

test('the console has no warnings and errors', () => assert.deepEqual(problems, []));
