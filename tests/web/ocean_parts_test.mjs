// Dynamic waves, shores and wave inputs of the npm package in node, compared with golden values:
// usage: node ocean_parts_test.mjs PACKAGE GOLDEN_FOLDER
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { bay, boat, exactWaterLines, goldenOf, grid, oceanLines, seaLines, shoreLines, smallSea, sprayLines, stone, tickHashes, waveInputLines } from './ocean_parts.js';

const [folder, goldenFolder] = process.argv.slice(2);
const { createExactWater, createOcean, optionTables } = await import(pathToFileURL(join(folder, 'index.js')));
const remote = await import(pathToFileURL(join(folder, 'worker.js')));
const golden = (...kinds) => goldenOf(readFileSync(join(goldenFolder, 'values.txt'), 'utf8'), ...kinds);

const local = { threads: 1 };
const maps = ['displacement', 'velocityX', 'velocityY', 'velocityZ'];
const everywhere = [['here, one thread', createOcean, local], ['here, three threads', createOcean, { threads: 3 }],
                    ['in a worker, one thread', remote.createOcean, { threads: 1, maps }],
                    ['in a worker, two threads', remote.createOcean, { threads: 2, maps }]];

for (const [where, create, options] of everywhere)
  test(`dynamic waves, a shore, spray, wave inputs, a current and a transition have the golden values ${where}`, async () => {
    assert.deepEqual(await oceanLines(create, options), golden('waves', 'linear', 'cubic', 'ray'));
    assert.deepEqual(await seaLines(create, options), golden('lifted', 'transition'));
    assert.deepEqual(await shoreLines(create, options), golden('shore'));
    assert.deepEqual(await sprayLines(create, options), golden('spray', 'droplet'));
    assert.deepEqual(await waveInputLines(create, options), golden('input'));
  });

test('exact water has the golden values on any number of threads, and errors of one line', async () => {
  for (const threads of [1, 3])
    assert.deepEqual(await exactWaterLines(createExactWater, { threads }), golden('exact', 'exact-surface'));
  const water = await createExactWater({ ...smallSea, threads: 1, waterFrame: { seaLevelM: 2 }, waterDensityKgpm3: 1000 });
  assert.throws(() => water.sample([0, -3999, 0]), { message: 'y[0] is -3999, expected at least -3998, the sea floor' });
  assert.throws(() => water.sample([0, 0]), { message: /^points has 2 numbers, expected triples of numbers: \[x, y, z, x, y, z, ...\]/ });
  assert.throws(() => water.setTime('now'), { message: 'timeS is "now", expected a finite number' });
  water.dispose();
  assert.throws(() => water.setTime(1), { message: 'the water is disposed of' });
  await assert.rejects(createExactWater({ preset: 'pond' }), { message: 'waves is pond, expected spectrum, analytic or regular' });
  await assert.rejects(createExactWater({ waterDensityKgpm3: 0 }), { message: 'waterDensityKgpm3 0 is out of range [500, 2000]' });
  await assert.rejects(createExactWater({ queries: true }), /queries/);
});

test('water of a frame lies below its surface, on any number of threads', async () => {
  const points = [[1.5, -1.5, 0.25], [-7.25, -20, 4], [12, 9, -9.75], [3, -3990, -2]];
  const found = [];
  for (const threads of [1, 3]) {
    const ocean = await createOcean({ ...smallSea, queries: true, depth: true, threads });
    assert.throws(() => ocean.sampleWater(points), /there is no frame yet/);
    const frame = ocean.frameAt(12.5);
    const water = frame.sampleWater(points), { heightM } = frame.query(points.map(([x, , z]) => [x, z]));
    points.forEach(([, y], i) => {
      assert.ok(Math.abs(heightM[i] - y - water.depthM[i]) < 1e-3);
      assert.equal(water.pressurePa[i] > 0, water.depthM[i] > 0);
    });
    assert.ok(Math.abs(water.pressurePa[3] / (1025 * 9.80665 * 3990) - 1) < 1e-3);
    assert.ok(Math.abs(ocean.sampleWater(points, { waterDensityKgpm3: 1000 }).pressurePa[3] * 1.025 / water.pressurePa[3] - 1) < 1e-6);
    assert.equal(water.velocityMps.length, 12);
    found.push([...water.pressurePa, ...water.velocityMps, ...water.accelerationMps2]);
    assert.throws(() => frame.sampleWater([0, -4001, 0]), { message: 'y[0] is -4001, expected at least -4000, the sea floor' });
    assert.throws(() => frame.sampleWater(points, { footprintM: -1 }), { message: 'footprintM is -1, expected 0 or more' });
    assert.ok(frame.query([3, 4], { footprintM: 20 }).heightM[0] !== frame.query([3, 4]).heightM[0]);
    assert.throws(() => frame.query([3, 4], { footprintM: -1 }), { message: 'footprintM is -1, expected 0 or more' });
    assert.throws(() => frame.sampleWater(points, { interpolation: 'sinc' }), { message: 'interpolation is "sinc", expected linear or cubic' });
    ocean.dispose();
  }
  assert.deepEqual(found[0], found[1]);
  const shallow = await createOcean({ ...smallSea, queries: true, threads: 1 });
  assert.throws(() => shallow.frameAt(0).sampleWater(points), /depth/);
  shallow.dispose();
});

test('sources, rain and saved states continue bit-identically on any number of threads', async () => {
  const rain = { dropsPerM2S: 0.5, radiusM: 1, heightM: 0.1, seed: 3 };
  let expected = null;
  for (const [, create, options] of everywhere) {
    const ocean = await create({ ...smallSea, dynamicWaves: grid, ...options });
    const other = await create({ ...smallSea, dynamicWaves: grid, threads: 1 });
    const waves = ocean.dynamicWaves;
    await waves.addSource(boat);
    await waves.setRain(rain);
    await tickHashes(ocean, 0);
    const saved = await waves.saveState();
    assert.ok(saved instanceof Uint8Array && saved.buffer instanceof ArrayBuffer && saved.length > 17 * 64 * 64);
    const after = await tickHashes(ocean, 30);
    assert.equal(new Set(after).size, 30);
    expected ??= after;
    assert.deepEqual(after, expected);
    await other.dynamicWaves.restoreState(saved);
    assert.deepEqual(await tickHashes(other, 30), after);
    await waves.restoreState(saved);
    assert.deepEqual(await tickHashes(ocean, 30), after);
    for (const damaged of [new Uint8Array(0), saved.slice(0, -1), new Uint8Array(saved.length).fill(255)])
      await assert.rejects(async () => waves.restoreState(damaged), /^Error: [^\n]+$/);
    ocean.dispose();
    other.dispose();
  }
});

test('a sea level out of range is rejected', async () => {
  const ocean = await createOcean({ ...smallSea, ...local });
  assert.throws(() => ocean.setWaterFrame({ seaLevelM: 1001 }), /^Error: seaLevelM 1001 is out of range \[-1000, 1000\]/);
  ocean.dispose();
});

test('queries agree before and after a shift of the origin', async () => {
  const places = [[1.5, 0.25], [-7.25, 4], [60, 40.5], [-230.125, 77]], [toX, toZ] = [1e7, -2e6];
  const moved = places.map(([x, z]) => [x - toX, z - toZ]);
  const near = (found, expected) => found.forEach((value, i) => assert.ok(Math.abs(value - expected[i]) <= 1e-5, `${value}, expected ${expected[i]}`));
  for (const create of [createOcean, remote.createOcean]) {
    const ocean = await create({ ...smallSea, ...local, queries: true });
    const before = await ocean.frameAt(2), hash = await before.hash(), heights = Array.from((await before.query(places)).heightM);
    await ocean.setOrigin(toX, toZ);
    const after = await ocean.frameAt(2);
    assert.equal(await after.hash(), hash);
    near(Array.from((await after.query(moved)).heightM), heights);
    const rejected = { message: 'xM is 200000000, expected a number in [-1e8, 1e8]' };
    await assert.rejects(async () => await ocean.setOrigin(2e8, 0), rejected);
    await assert.rejects(async () => await ocean.setOrigin('here', 0), { message: 'xM is "here", expected a number in [-1e8, 1e8]' });
    await ocean.dispose();
  }
  const water = await createExactWater({ ...smallSea, threads: 1 });
  const depths = Array.from(water.sample(places.map(([x, z]) => [x, -1, z])).depthM);
  water.setOrigin(toX, toZ);
  near(Array.from(water.sample(moved.map(([x, z]) => [x, -1, z])).depthM), depths);
  water.dispose();
});

test('saved states need equal options and no frame in flight', async () => {
  const ocean = await createOcean({ ...smallSea, dynamicWaves: grid, ...local });
  const unlike = await createOcean({ ...smallSea, dynamicWaves: { ...grid, sideM: 48 }, ...local });
  ocean.frameAt(0);
  const saved = ocean.dynamicWaves.saveState();
  assert.throws(() => unlike.dynamicWaves.restoreState(saved), /^Error: [^\n]+$/);
  ocean.schedule(1);
  for (const call of [() => ocean.dynamicWaves.saveState(), () => ocean.dynamicWaves.restoreState(saved)])
    assert.throws(call, /^Error: a frame is scheduled.* complete\(\)/);
  ocean.dynamicWaves.addImpulse(stone);  // for the next frame
  const before = ocean.complete().dynamicWaves.hash();
  assert.notEqual(ocean.frameAt(1 + 2 / 60).dynamicWaves.hash(), before);
  ocean.dispose();
  unlike.dispose();
  assert.throws(() => ocean.dynamicWaves.addImpulse(stone), { name: 'Error', message: 'the ocean is disposed' });
});

for (const [where, create, options] of [everywhere[0], everywhere[2], everywhere[3]])
  test(`the view of dynamic waves has the waves at their position ${where}`, async () => {
    const ocean = await create({ ...smallSea, dynamicWaves: { ...grid, borderM: 8 }, ...options });
    await ocean.dynamicWaves.setCenter(30.2, -7);
    await ocean.frameAt(0);
    await ocean.dynamicWaves.addImpulse({ ...stone, xM: 33, zM: -9 });
    const view = (await ocean.frameAt(2 / 60)).dynamicWaves;
    assert.deepEqual([view.resolution, view.texelM, view.firstX + 32, view.firstZ + 32], [64, 1, 30, -7]);
    for (const array of [view.heightM, view.verticalVelocityMps]) assert.ok(array instanceof Float32Array && array.length === 64 * 64);
    assert.ok(view.foam instanceof Uint8Array && view.foam.length === 64 * 64 && Math.max(...view.foam) > 0);
    const highest = Math.max(...view.heightM);
    assert.equal(view.heightM.indexOf(highest), 64 * (64 - 9) + 33);
    assert.ok(highest > 0.3 && highest <= view.heightMaxM && view.heightMinM <= Math.min(...view.heightM));
    assert.ok(view.verticalVelocityMps.some((speed) => speed !== 0));
    ocean.dispose();
  });

for (const [where, create, options] of [everywhere[0], everywhere[2], everywhere[3]])
  test(`the view of a shore has the floor and the waves over it ${where}`, async () => {
    const ocean = await create({ ...smallSea, shore: bay(), ...options }), open = await create({ ...smallSea, ...options });
    const frame = await ocean.frameAt(12.34), { shore } = frame;
    assert.equal(await frame.hash(), await (await open.frameAt(12.34)).hash());
    assert.deepEqual([shore.columns, shore.xM, shore.zM], [64, -170, -130]);
    const texels = shore.columns * shore.rows;
    for (const name of ['depthM', 'heightM', 'verticalVelocityMps', 'potentialM2ps', 'reachM', 'foam']) {
      assert.equal(shore[name].length, texels, name);
      assert.ok(shore[name].some((value) => value !== 0), name);
    }
    assert.equal(shore.weightsRgba8.length, 4 * texels);
    assert.ok(shore.weightsChangePerM > 0);
    assert.ok(shore.heightMinM <= shore.heightM.reduce((least, height) => Math.min(least, height)));
    const hash = await shore.hash();
    assert.equal(await (await ocean.frameAt(52.34)).shore.hash(), hash);  // a loop period later
    assert.notEqual(await (await ocean.frameAt(13)).shore.hash(), hash);
    await assert.rejects(async () => shore.hash(), /^Error: the frame is over/);
    await assert.rejects(async () => ocean.changeSea({ windSpeedMps: 9 }), /^Error: [^\n]*shore/);
    ocean.dispose();
    open.dispose();
  });

test('without the options frames have neither dynamic waves nor a shore', async () => {
  for (const create of [createOcean, remote.createOcean]) {
    const ocean = await create({ ...smallSea, ...local });
    const frame = await ocean.frameAt(0);
    assert.deepEqual([frame.dynamicWaves, frame.shore], [null, null]);
    await assert.rejects(async () => ocean.dynamicWaves.addImpulse(stone),
                         { name: 'Error', message: 'the ocean has no dynamic waves: give it the option dynamicWaves' });
    await assert.rejects(async () => ocean.setInput(0, { ripple: {} }),
                         { name: 'Error', message: 'the ocean has no wave inputs: give it the option inputs' });
    ocean.dispose();
  }
});

test('views of grids survive memory growth, and throw after the validity of their frame', async () => {
  const ocean = await createOcean({ ...smallSea, queries: true, dynamicWaves: grid, shore: bay(), ...local });
  ocean.frameAt(0);
  ocean.dynamicWaves.addImpulse(stone);
  const frame = ocean.frameAt(2 / 60);
  for (const part of [frame.dynamicWaves, frame.shore]) {
    const kept = part.heightM, copy = kept.slice(), hash = part.hash();
    assert.ok(copy.some((height) => height !== 0));
    ocean.query(new Float64Array(part === frame.shore ? 8e6 : 2e6));
    assert.equal(kept.length, 0, 'the memory has not grown');
    assert.deepEqual(part.heightM, copy);
    assert.equal(part.hash(), hash);
  }
  const { dynamicWaves } = frame;
  ocean.frameAt(1);
  ocean.frameAt(2);
  assert.throws(() => dynamicWaves.heightM, /^Error: the frame is over/);
  assert.throws(() => dynamicWaves.hash(), /^Error: the frame is over/);
  assert.equal(dynamicWaves.resolution, 64);
  ocean.dispose();
});

test('a wave input that is set to nothing leaves the waves of the wind', async () => {
  for (const create of [createOcean, remote.createOcean]) {
    const sea = { resolution: 64, patchSizeM: 250, ...local }, wave = { amplitudeM: 0.25, wavelengthM: 250 / 8 };
    const ocean = await create({ ...sea, inputs: [{ waves: [wave] }, { ripple: wave }] }), alone = await create(sea);
    const hashes = [await (await alone.frameAt(3)).hash(), await (await ocean.frameAt(3)).hash()];
    await ocean.setInput(0, { waves: [] });
    hashes.push(await (await ocean.frameAt(3)).hash());
    assert.equal(new Set(hashes).size, 3);
    await ocean.setInput(1, { ripple: {} });
    assert.equal(await (await ocean.frameAt(3)).hash(), hashes[0]);
    ocean.dispose();
    alone.dispose();
  }
});

test('an invalid option is rejected by one line that names it, its value and what is accepted', async () => {
  const heightsM = new Float32Array(16);
  const square = { heightsM, columns: 4, rows: 4 };
  const creations = [
    [{ dynamicWaves: true }, 'dynamicWaves is true, expected an object'],
    [{ dynamicWaves: { resolution: 100 } }, 'dynamicWaves.resolution is 100, expected 64, 128, 256, 512 or 1024'],
    [{ dynamicWaves: { sideM: '64' } }, 'dynamicWaves.sideM is "64", expected a number: [1, 10000]'],
    [{ dynamicWaves: { borderM: 20 } }, 'dynamicWaves.borderM is 20, expected at most a quarter of sideM, 16'],
    [{ dynamicWaves: { step: 'euler' } }, 'dynamicWaves.step is "euler", expected spectral or verlet'],
    [{ dynamicWaves: { side: 64 } }, 'there is no option dynamicWaves.side, expected dynamicWaves.sideM'],
    [{ shore: 3 }, 'shore is 3, expected an object'],
    [{ shore: {} }, 'shore.heightsM is undefined, expected an array of numbers'],
    [{ shore: { heightsM: 'flat', columns: 4, rows: 4 } }, 'shore.heightsM is "flat", expected an array of numbers'],
    [{ shore: { heightsM } }, 'shore.columns is 0, expected 2 to 4096'],
    [{ shore: { ...square, rows: 2.5 } }, 'shore.rows is 2.5, expected 2 to 4096'],
    [{ shore: { ...square, rows: 3 } }, "shore.heightsM' size is 16, expected 12, columns times rows"],
    [{ shore: { ...square, heightsM: [...heightsM.slice(1), NaN] } }, 'shore.heightsM nan is out of range [-11000, 9000]'],
    [{ shore: { ...square, metresPerSample: 0 } }, 'shore.metresPerSample 0 is out of range [0.001, 10000]'],
    [{ shore: square, cascades: 1 }, /^Error: cascades is 1, expected 2 to 4 where there is a shore/],
    [{ inputs: 3 }, 'inputs is 3, expected an array'],
    [{ inputs: [3] }, 'inputs[0] is 3, expected {waves, choppiness} or {ripple}'],
    [{ inputs: [{ choppiness: 1 }] }, 'inputs[0] is an object, expected {waves, choppiness} or {ripple}'],
    [{ inputs: [{ waves: 3 }] }, 'inputs[0].waves is 3, expected an array'],
    [{ inputs: [{ waves: [{}, 3] }] }, 'inputs[0].waves[1] is 3, expected an object'],
    [{ inputs: [{ waves: [{ wavelengthM: -1 }] }] }, 'inputs[0].waves[0].wavelengthM -1 is out of range [0.01, 1000]'],
    [{ inputs: [{ waves: [{ amplitudeM: 5 }] }] }, /^Error: inputs\[0\]\.steepness is /],
    [{ inputs: [{ waves: [], choppiness: 2 }] }, 'inputs[0].choppiness 2 is out of range [0, 1]'],
    [{ inputs: [{ ripple: { amplitudeM: 1 } }] }, /^Error: inputs\[0\]\.ripple\.amplitudeM is 1, expected at most wavelengthM \/ \(2 pi\)/],
    [{ inputs: [{ ripple: { radius: 1 } }] }, /^Error: there is no option inputs\[0\]\.ripple\.radius/],
  ];
  for (const create of [createOcean, remote.createOcean])
    for (const [options, message] of creations)
      await assert.rejects(create({ ...smallSea, ...local, ...options }), typeof message === 'string' ? { name: 'Error', message } : message);

  const options = { ...smallSea, ...local, dynamicWaves: grid, inputs: [{ waves: [] }] };
  for (const ocean of [await createOcean(options), await remote.createOcean(options)]) {
    const hash = await (await ocean.frameAt(0)).dynamicWaves.hash();
    const waves = ocean.dynamicWaves;
    for (const [call, message] of [
      [() => waves.addImpulse(3), 'disturbance is 3, expected an object'],
      [() => waves.addImpulse({ radiusM: 0 }), 'radiusM 0 is out of range [0.001, 1000]'],
      [() => waves.addImpulse({ radiusM: 'wide' }), 'radiusM is "wide", expected a number: [0.001, 1000]'],
      [() => waves.addImpulse({ radius: 3 }), 'there is no option radius, expected radiusM'],
      [() => waves.addSource({ mode: 'pull' }), 'mode is "pull", expected pressure, relaxation, impulse or foam'],
      [() => waves.addSource(), 'disturbance is undefined, expected an object'],
      [() => waves.setSource(-1, boat), 'number is -1, expected a number that addSource() returned'],
      [() => waves.removeSource('boat'), 'number is "boat", expected a number that addSource() returned'],
      [() => waves.setCenter(1e9, 0), 'the centre 1000000000 is out of range [-1e8, 1e8]'],
      [() => waves.setCenter(0, NaN), 'zM is NaN, expected a finite number'],
      [() => waves.setRain({ dropsPerM2S: 1, radiusM: 9 }), 'radiusM 9 is out of range [0.001, 4], to a 16th of sideM'],
      [() => waves.setRain({ seed: -1 }), 'seed is -1, expected a whole number from 0 to 4294967295'],
      [() => waves.restoreState([1]), 'saved is an array, expected a Uint8Array that saveState() returned'],
      [() => ocean.setInput(1, { waves: [] }), 'index is 1, expected a whole number from 0 to 0'],
      [() => ocean.setInput(0, { ripple: {} }), 'there is no option input.ripple, expected one of input.waves or input.choppiness'],
    ])
      await assert.rejects(async () => call(), { name: 'Error', message });
    assert.equal(await (await ocean.frameAt(0)).dynamicWaves.hash(), hash);
    ocean.dispose();
  }
});

test('types have the options, defaults and accepted values of the library', async () => {
  const types = readFileSync(join(folder, 'index.d.ts'), 'utf8');
  const interfaces = { dynamicWaves: 'DynamicWavesOptions', disturbance: 'Disturbance', rain: 'Rain', shore: 'ShoreOptions', spray: 'SprayOptions', sprayEmitter: 'SprayEmitter',
                       analyticWave: 'AnalyticWave', ripple: 'Ripple', waterFrame: 'WaterFrame' };
  const tables = await optionTables();
  assert.deepEqual(Object.keys(tables).sort(), Object.keys(interfaces).sort());
  for (const [part, name] of Object.entries(interfaces)) {
    const text = types.slice(types.indexOf(`export interface ${name} {`)).split('\n}\n')[0];
    const typed = [...text.matchAll(/\/\*\*((?:(?!\*\/)[^])*)\*\/\n  (\w+)(\??): (.*);/g)]
      .map(([, doc, name, optional, type]) => ({ doc: doc.replace(/\s*\n\s*\* ?/g, ' '), name, optional, type }));
    assert.deepEqual(typed.map(({ name }) => name).filter((name) => name !== 'heightsM').sort(), tables[part].map(({ name }) => name).sort());
    for (const { name, default: value, accepted, words } of tables[part]) {
      const { doc, optional, type } = typed.find((one) => one.name === name);
      if (optional) assert.ok(doc.includes(`Default ${typeof value === 'string' ? `"${value}"` : value}`), `${name}: ${doc}`);
      if (words) assert.equal(type, words.map((word) => `'${word}'`).join(' | '));
      else assert.ok(doc.includes(`: ${accepted}`), `${name}: ${doc} lacks ${accepted}`);
    }
  }
  const ocean = await createOcean({ ...smallSea, ...local, dynamicWaves: { sideM: 32, borderM: 8 } });
  const defaults = Object.fromEntries(tables.dynamicWaves.map((row) => [row.name, row.default]));
  assert.deepEqual(ocean.dynamicWaves.options, { ...defaults, sideM: 32, borderM: 8 });
  ocean.dispose();
});
