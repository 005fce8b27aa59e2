// The npm package in node: usage: node package_test.mjs PACKAGE GOLDEN
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { differences, goldenLines, goldenNames } from './golden_seas.js';

const [folder, goldenFile] = process.argv.slice(2);
const { createOcean, presets, seaOptions, levelCount, levelOffset } = await import(pathToFileURL(join(folder, 'index.js')));
const remote = await import(pathToFileURL(join(folder, 'worker.js')));
const golden = readFileSync(goldenFile, 'utf8');
const small = { resolution: 64, patchSizeM: 250, threads: 1 };

for (const [where, create, threads] of [['here', createOcean, 1], ['here', createOcean, 3], ['in a worker', remote.createOcean, 1],
                                        ['in a worker', remote.createOcean, 2]])
  test(`frames have the golden hashes ${where}, threads: ${threads}`, async () => {
    const lines = await goldenLines(create, { threads });
    assert.equal(lines.length, goldenNames.length);
    assert.deepEqual(differences(lines, golden), []);
  });

test('every golden frame is compared, except those of C++ tests', () => {
  const known = golden.trim().split('\n').map((line) => line.split(' ')[0]);
  assert.deepEqual(known.filter((name) => !goldenNames.includes(name)),
                   ['foam-folded', 'queries-analytic', 'queries-pond', 'queries-folded', 'queries-smooth', 'queries-cascades']);
});

// Converts a half float.
function valueOfHalf(half) {
  const exponent = (half >> 10) & 31, fraction = half & 1023, sign = half >> 15 ? -1 : 1;
  return sign * (exponent === 0 ? fraction * 2 ** -24 : (1 + fraction / 1024) * 2 ** (exponent - 15));
}

test('maps and planes have the same waves at the documented positions', async () => {
  const ocean = await createOcean({ ...small, queries: true, velocities: true, slopes: true, foam: true });
  const frame = ocean.frameAt(3);
  const [cascade] = frame.cascades;
  const texels = 64 * 64;
  assert.equal(cascade.displacement.length, 4 * texels);
  const rows = cascade.height.toRows(), dx = cascade.dx.toRows(), dz = cascade.dz.toRows();
  for (const [i, j] of [[0, 0], [5, 0], [0, 5], [63, 63], [17, 40]]) {
    assert.equal(rows[64 * j + i], cascade.height.at(i, j));
    const texel = 4 * (64 * j + i);
    for (const [channel, plane] of [[0, dx], [1, rows], [2, dz]]) {
      const exact = plane[64 * j + i];
      // A half float has eleven significant bits.
      assert.ok(Math.abs(valueOfHalf(cascade.displacement[texel + channel]) - exact) <= Math.max(Math.abs(exact) * 2 ** -11, 2 ** -25));
    }
    const [x, z] = [i * cascade.texelM + dx[64 * j + i], j * cascade.texelM + dz[64 * j + i]];
    // the tolerance of a millimetre, on slopes below 1
    assert.ok(Math.abs(frame.query([x, z]).heightM[0] - rows[64 * j + i]) < 2e-3);
  }
  assert.equal(Math.max(...rows), cascade.bounds.heightMaxM);
  assert.equal(Math.min(...rows), cascade.bounds.heightMinM);
  assert.equal(levelCount(64), 7);
  const chain = 4 * levelOffset(64, levelCount(64));
  for (const name of ['gradients', 'slopes', 'moments']) assert.equal(cascade[name].length, chain, name);
  assert.equal(cascade.compression.length, texels);
  assert.deepEqual(cascade.snapshots.map((image) => image.length), [chain, chain, chain, chain]);
  assert.deepEqual([cascade.snapshotsVersion.length, frame.snapshotAges.length], [4, 16]);
  assert.ok(cascade.velocityY.toRows().some((speed) => speed !== 0));
  ocean.dispose();
});

test('views share one memory, and hold the frame until the second schedule() after its own', async () => {
  const ocean = await createOcean({ ...small, threads: 2 });
  const first = ocean.frameAt(1);
  const { displacement } = first.cascades[0];
  assert.equal(displacement.buffer, first.cascades[0].height.data.buffer);
  assert.ok(displacement.buffer instanceof SharedArrayBuffer);
  const copy = displacement.slice(), hash = first.hash();
  ocean.frameAt(2);
  assert.deepEqual(first.cascades[0].displacement, copy);  // also while the next frame is computed
  assert.equal(first.hash(), hash);
  ocean.schedule(3);
  assert.equal(first.isValid, false);
  assert.throws(() => first.cascades, /the frame is over/);
  assert.throws(() => first.hash(), /the frame is over/);
  ocean.complete();
  assert.notDeepEqual(displacement, copy);
  ocean.dispose();
});

test('views are valid again after memory growth', async () => {
  const ocean = await createOcean({ ...small, queries: true });
  const frame = ocean.frameAt(1);
  const kept = frame.cascades[0].displacement, copy = kept.slice(), hash = frame.hash();
  ocean.query(new Float64Array(2e6));  // a million samples exceed the memory
  assert.equal(kept.length, 0, 'the memory has not grown');
  assert.deepEqual(frame.cascades[0].displacement, copy);
  assert.equal(frame.hash(), hash);
  ocean.dispose();
});

test('points are pairs, numbers or objects', async () => {
  const points = [[1, 2], [-30.5, 4], [1e7 + 0.5, -3e6]];
  for (const create of [createOcean, remote.createOcean]) {
    const ocean = await create({ ...small, queries: true });
    const frame = await ocean.frameAt(12.34), expected = await frame.query(points);
    for (const given of [points.flat(), Float64Array.from(points.flat()), points.map(([x, z]) => ({ x, z }))])
      assert.deepEqual(await frame.query(given), expected);
    assert.equal(await frame.firstHit({ originM: [0, 30, 0], direction: [0, 1, 0], reachM: 100 }), null);
    ocean.dispose();
  }
});

test('an invalid value is rejected by one line that says what is accepted', async () => {
  const cases = [
    [{ windSpeedMps: -3 }, 'windSpeedMps -3 is out of range (0, 60]'],
    [{ windSpeedMps: NaN }, 'windSpeedMps NaN is out of range (0, 60]'],
    [{ windSpeedMps: Infinity }, 'windSpeedMps Infinity is out of range (0, 60]'],
    [{ windSpeedMps: '9' }, 'windSpeedMps is "9", expected a number: (0, 60]'],
    [{ windSpeedMps: null }, 'windSpeedMps is null, expected a number: (0, 60]'],
    [{ windSpeedMps: [9] }, 'windSpeedMps is an array, expected a number: (0, 60]'],
    [{ resolution: 100 }, 'resolution is 100, expected a power of two from 16 to 2048, or 0: chosen'],
    [{ cascades: 2.5 }, 'cascades is 2.5, expected 1, 2, 3 or 4, or 0: chosen'],
    [{ cascades: 3, patchSizeM: 100 }, 'cascades is 3, expected 1 where the side of the cascade is given'],
    [{ spectrum: 'phillips-paper', swellHeightM: 1 }, 'swellHeightM is 1, expected 0 where the spectrum is phillips-paper'],
    [{ systems: 3 }, 'systems is 3, expected an array'],
    [{ systems: [3] }, 'systems[0] is 3, expected an object'],
    [{ systems: [{}, { heightM: -1 }] }, 'systems[1].heightM -1 is out of range (0, 30], or 0: by the wind'],
    [{ systems: [{ spectrum: 'jonswop' }] },
      'systems[0].spectrum is "jonswop", expected phillips-paper, phillips, pierson-moskowitz, jonswap or none (the nearest is jonswap)'],
    [{ systems: [{ height: 1 }] }, 'there is no option systems[0].height, expected systems[0].heightM'],
    [{ systems: Array(9).fill({}) }, 'systems has 9 elements, expected 0 to 8'],
    [{ wind_speed_mps: 9 }, 'there is no option wind_speed_mps, expected windSpeedMps'],
    [{ windspeed: 9 }, 'there is no option windspeed, expected windSpeedMps'],
    [{ waves: 'ponds' }, 'waves is "ponds", expected spectrum, analytic, pond or regular (the nearest is pond)'],
    [{ queries: 1 }, 'queries is 1, expected true or false'],
    [{ threads: 0 }, 'threads is 0, expected a whole number from 1 to 64'],
    [{ threads: '2' }, 'threads is "2", expected a whole number from 1 to 64'],
    [null, 'options is null, expected an object such as {windSpeedMps: 9}'],
    [[], 'options is an array, expected an object such as {windSpeedMps: 9}'],
  ];
  for (const create of [createOcean, remote.createOcean])
    for (const [options, message] of cases) await assert.rejects(create(options), { name: 'Error', message });
  await assert.rejects(createOcean({ preset: 'ruogh' }), /^Error: preset is "ruogh", expected pond, calm.*the nearest is rough/);
  await assert.rejects(remote.createOcean({ maps: ['depth'] }), /maps has depth, expected only displacement/);

  const ocean = await createOcean(small);
  for (const [call, message] of [
    [() => ocean.complete(), 'no frame is scheduled; call schedule() first'],
    [() => ocean.query([0, 0]), 'there is no frame yet; call complete() first'],
    [() => ocean.schedule(NaN), 'timeS is NaN, expected a finite number'],
    [() => ocean.schedule('1'), 'timeS is "1", expected a finite number'],
    [() => ocean.schedule(), 'timeS is undefined, expected a finite number'],
    [() => { ocean.schedule(1); ocean.schedule(2); }, 'a frame is scheduled already; call complete() first'],
    [() => ocean.changeSea({ windSpeedMps: 5 }), 'a frame is scheduled; call complete() first'],
    [() => ocean.complete().query([1]), 'points has 1 numbers, expected pairs of numbers: [x, z, x, z, ...], [[x, z], ...] or [{x, z}, ...], metres'],
    [() => ocean.changeSea({ resolution: 32 }), /resolution/],
    [() => ocean.completeSea(), 'no sea is scheduled; call scheduleSea() first'],
    [() => ocean.turnInto({ windSpeedMps: 5 }, { fromS: 1, overS: 0 }), 'overS is 0, expected seconds in (0, 1e9]'],
  ])
    assert.throws(call, typeof message === 'string' ? { name: 'Error', message } : message);
  assert.throws(() => ocean.query([0, 0]), /queries/);
  ocean.dispose();
  assert.throws(() => ocean.frameAt(1), { name: 'Error', message: 'the ocean is disposed' });

  const askable = await createOcean({ ...small, queries: true });
  askable.frameAt(0);
  for (const [ray, pattern] of [[undefined, /^Error: originM is undefined, expected three numbers/], [{ originM: [0, 1, 0], direction: [0, 0, 0], reachM: 1 }, /direction's length 0 is out of range/],
                                [{ originM: [0, 1, 0], direction: [0, -1, 0], reachM: -1 }, /reachM is -1, expected 0 to a million/]])
    assert.throws(() => askable.firstHit(ray), pattern);
  assert.throws(() => askable.query([0, 0], { toleranceM: 0 }), /toleranceM is 0, expected metres above 0/);
  assert.throws(() => askable.query([0, 0], { interpolation: 'quintic' }), /interpolation is "quintic", expected linear or cubic/);
  askable.dispose();
});

test('an ocean is unchanged after an error', async () => {
  const ocean = await createOcean(small);
  const expected = ocean.frameAt(5).hash();
  assert.throws(() => ocean.schedule(NaN));
  assert.throws(() => ocean.changeSea({ windSpeedMps: 99 }));
  assert.equal(ocean.frameAt(5).hash(), expected);
  ocean.dispose();
});

test('a sea changes at once or over time', async () => {
  const rough = { ...small, windSpeedMps: 17, seed: 3 };
  const ocean = await createOcean(small), other = await createOcean(rough);
  ocean.scheduleSea({ windSpeedMps: 17, seed: 3 });
  const before = ocean.frameAt(2).hash();
  ocean.completeSea();
  assert.equal(ocean.sea.windSpeedMps, 17);
  assert.equal(ocean.sea.resolution, 64);
  const after = other.frameAt(2).hash();
  assert.notEqual(before, after);
  assert.equal(ocean.frameAt(2).hash(), after);
  ocean.turnInto({ windSpeedMps: 5 }, { fromS: 10, overS: 5 });
  assert.equal(ocean.frameAt(9).hash(), other.frameAt(9).hash());
  assert.equal(ocean.frameAt(20).sea.windSpeedMps, 5);
  assert.notEqual(ocean.frameAt(20).hash(), other.frameAt(20).hash());

  const there = await remote.createOcean(small);
  await there.changeSea({ windSpeedMps: 17, seed: 3 });
  assert.equal(await (await there.frameAt(2)).hash(), after);
  for (const one of [ocean, other, there]) one.dispose();
});

test("a worker's frames are views of shared memory, else copies", async () => {
  const local = await createOcean({ ...small, slopes: true });
  for (const threads of [1, 2]) {
    const ocean = await remote.createOcean({ ...small, threads, slopes: true, maps: ['displacement', 'slopes', 'height'] });
    assert.equal(ocean.isShared, threads > 1);
    ocean.schedule(4);
    const [cascade] = (await ocean.complete()).cascades;
    assert.equal(cascade.displacement.buffer instanceof SharedArrayBuffer, threads > 1);
    const here = local.frameAt(4).cascades[0];
    assert.deepEqual(Array.from(cascade.displacement), Array.from(here.displacement));
    assert.deepEqual(Array.from(cascade.slopes), Array.from(here.slopes));
    assert.deepEqual(Array.from(cascade.height.toRows()), Array.from(here.height.toRows()));
    assert.equal(cascade.moments, null);
    const pending = ocean.frameAt(1);
    ocean.dispose();
    await assert.rejects(pending, /disposed/);
    await assert.rejects(ocean.frameAt(1), /disposed/);
  }
  local.dispose();
});

test('types have the options, defaults and accepted values of the library', async () => {
  const types = readFileSync(join(folder, 'index.d.ts'), 'utf8');
  const options = types.slice(types.indexOf('interface SeaOptions'), types.indexOf('interface OceanOptions'));
  const table = await seaOptions();
  const typed = [...options.matchAll(/\/\*\*((?:(?!\*\/)[^])*)\*\/\n  (\w+)\?: (.*);/g)]
    .map(([, doc, name, type]) => ({ doc: doc.replace(/\s*\n\s*\* ?/g, ' '), name, type }));
  assert.deepEqual(typed.map(({ name }) => name), ['preset', ...table.map(({ name }) => name), 'systems']);
  for (const { name, default: value, accepted, words } of table) {
    const { doc, type } = typed.find((one) => one.name === name);
    assert.ok(doc.includes(`Default ${typeof value === 'string' ? `"${value}"` : value}`), `${name}: ${doc}`);
    if (words) assert.equal(type, words.map((word) => `'${word}'`).join(' | '));
    else assert.ok(doc.includes(`: ${accepted}.`), `${name}: ${doc} lacks ${accepted}`);
  }
  for (const { name, sea } of await presets()) {
    const ocean = await createOcean({ preset: name, threads: 1 });
    assert.deepEqual(ocean.sea, sea);
  }
});

// The memory of an ocean is allocated with its first frames; the rest is garbage.
test('ten thousand frames take no more memory than a hundred', async () => {
  const ocean = await createOcean({ ...small, resolution: 32, queries: true });
  const points = new Float64Array(64);
  const run = (frames) => {
    for (let i = 0; i < frames; ++i) {
      const frame = ocean.frameAt(i / 60);
      frame.query(points);
      assert.ok(frame.cascades[0].displacement.length);
    }
  };
  run(100);
  const bytes = ocean.frameAt(0).cascades[0].displacement.buffer.byteLength, held = ocean.memoryBytes;
  globalThis.gc();
  const heap = process.memoryUsage().heapUsed;
  run(10000);
  globalThis.gc();
  assert.equal(ocean.frameAt(0).cascades[0].displacement.buffer.byteLength, bytes);
  assert.equal(ocean.memoryBytes, held);
  // A leak of one number per frame would be 80 KB, of a view a megabyte; compiled code varies.
  assert.ok(process.memoryUsage().heapUsed - heap < 1e6, `${process.memoryUsage().heapUsed - heap} bytes more`);
  ocean.dispose();
});

test('the memory of disposed oceans is freed', async () => {
  const live = [];
  for (let i = 0; i < 30; ++i) {
    const ocean = await createOcean({ ...small, threads: 1 + i % 2 });
    live.push(new WeakRef(ocean.frameAt(i).cascades[0].displacement.buffer));
    ocean.dispose();
  }
  for (let i = 0; i < 20; ++i) {
    await new Promise((resolve) => setTimeout(resolve, 20));
    globalThis.gc();
  }
  const left = live.filter((buffer) => buffer.deref()).length;
  assert.ok(left <= 3, `${left} of 30 memories are still there`);  // references may be in registers
});
