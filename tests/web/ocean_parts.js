// Dynamic waves, shores and wave inputs for the tests in node and in pages. Each function takes a
// createOcean() of index.js or worker.js and further options, such as threads.

const tickS = 1 / 60;

// The scene of tests/golden_values_test.cpp. Lines are those of tests/golden/values.txt.

export const smallSea = { cascades: 3, resolution: 32, windSpeedMps: 8, loopPeriodS: 40 };
export const grid = { resolution: 64, borderM: 8 };
export const stone = { mode: 'impulse', xM: 3, zM: -2, radiusM: 2, heightM: 0.4 };
export const boat = { shape: 'hull', xM: -10, zM: 5, radiusM: 1, lengthM: 4, heightM: -0.5, velocityXMps: 6 };
export const points = [[1.5, 0.25], [-7.25, 4], [12, -9.75], [3, -2], [60, 40.5], [150.5, 10], [-60, 100], [400, -1000]];

/** Returns the lines of a kind, or of several. */
export const goldenOf = (text, ...kinds) => text.trim().split('\n').filter((line) => kinds.includes(line.split(' ')[0]));

/** Returns a beach with an island in front of it. */
export function bay() {
  const columns = 81, rows = 61, heightsM = [];
  for (let j = 0; j < rows; ++j)
    for (let i = 0; i < columns; ++i) {
      const x = 5 * i, fromX = x - 150, fromZ = 5 * j - 120, squared = (fromX * fromX + fromZ * fromZ) / 1600;
      heightsM.push(-12 + x * 0.035 + 16 / (1 + squared * squared));
    }
  return { heightsM, columns, rows, metresPerSample: 5, cornerXM: -170, cornerZM: -130, resolution: 64 };
}

const bitsOf = (array) => Array.from(array, (word) => word.toString(16).padStart(8, '0'));
const floatBits = (numbers) => bitsOf(new Uint32Array(Float32Array.from(numbers).buffer)).join(' ');
const doubleBits = (numbers) => numbers.map((number) => bitsOf(new Uint32Array(new Float64Array([number]).buffer)).reverse().join('')).join(' ');

function sampleLines(kind, answers) {
  const three = (array, i) => [...array.slice(3 * i, 3 * i + 3)];
  return points.map((_, i) => `${kind} ${i} ` + floatBits([answers.heightM[i], ...three(answers.normal, i), ...three(answers.velocityMps, i),
                                                          answers.jacobian[i], answers.errorM[i], answers.foam[i], answers.converged[i]]));
}

/** Returns the lines of an ocean with dynamic waves and a shore. */
export async function oceanLines(createOcean, options) {
  const ocean = await createOcean({ ...smallSea, queries: true, velocities: true, foam: true, dynamicWaves: grid, shore: bay(), ...options });
  const waves = ocean.dynamicWaves, lines = [];
  let number = null, frame = null;
  await waves.setCenter(0.75, -1);
  for (let tick = 0; tick <= 60; ++tick) {
    if (tick === 3) await waves.addImpulse(stone);
    if (tick === 5) number = await waves.addSource(boat);
    if (tick === 20) await waves.setSource(number, { ...boat, heightM: -1 });
    if (tick === 25) await waves.setRain({ dropsPerM2S: 0.5, radiusM: 1, heightM: 0.1, seed: 3 });
    if (tick === 30) await waves.addImpulse({ mode: 'foam', xM: 12, zM: -10, heightM: 0.3 });
    if (tick === 40) {
      await waves.removeSource(number);
      await waves.setRain({});
    }
    frame = await ocean.frameAt(tick / 60);
    if (tick % 10 === 0)
      lines.push(`waves ${tick} ${await frame.hash()} ${await frame.foamHash()} ${await frame.dynamicWaves.hash()} ${await frame.shore.hash()}`);
  }
  for (const interpolation of ['linear', 'cubic']) lines.push(...sampleLines(interpolation, await frame.query(points, { interpolation })));
  for (const [i, x] of [1.5, 150.5].entries()) {
    const { distanceM, positionM } = await frame.firstHit({ originM: [x, 12, -7], direction: [1, -0.5, 0.25], reachM: 500 });
    lines.push(`ray ${i} ${doubleBits([distanceM, ...positionM])}`);
  }
  ocean.dispose();
  return lines;
}

/** Returns the lines of a sea level with a current, and of a transition. */
export async function seaLines(createOcean, options) {
  const moving = await createOcean({ ...smallSea, queries: true, ...options }), changing = await createOcean({ ...smallSea, ...options });
  await moving.setWaterFrame({ seaLevelM: 3, currentXMps: 1.5, currentZMps: -0.5 });
  const { heightM } = await (await moving.frameAt(10)).query(points);
  const lines = Array.from(heightM, (height, i) => `lifted ${i} ${floatBits([height])}`);
  await changing.turnInto({ windSpeedMps: 6 }, { fromS: 10, overS: 20 });
  for (const time of [5, 17.5, 40]) lines.push(`transition ${time} ${await (await changing.frameAt(time)).hash()}`);
  moving.dispose();
  changing.dispose();
  return lines;
}

/** Returns the lines of exact water. */
export async function exactWaterLines(createExactWater, options) {
  const water = await createExactWater({ ...smallSea, ...options });
  water.setTime(12.5);
  const y = [-1.5, -0.25, -20, 0, 1, -3, -100, -4000];
  const below = water.sample(points.map(([x, z], i) => [x, y[i], z])), surface = water.sampleSurface(points);
  const three = (array, i) => [...array.slice(3 * i, 3 * i + 3)];
  water.dispose();
  return [...y.map((_, i) => `exact ${i} ` + floatBits([below.depthM[i], below.pressurePa[i], ...three(below.velocityMps, i),
                                                       ...three(below.accelerationMps2, i)])),
          ...y.map((_, i) => `exact-surface ${i} ` + floatBits([surface.heightM[i], ...three(surface.velocityMps, i)]))];
}

/** Returns the lines of spray. */
export async function sprayLines(createOcean, options) {
  const ocean = await createOcean({ ...smallSea, windSpeedMps: 18, spray: {}, ...options }), lines = [];
  await ocean.setSprayCenter(5, -3);
  await ocean.emit([{ timeS: 2, xM: 1, yM: 2, zM: -4, extentM: 0.5, velocityXMps: 3, velocityYMps: 4, spreadMps: 1, radiusM: 0.0625, count: 10 }]);
  const saved = await ocean.saveSpray();
  await ocean.restoreSpray(saved);
  for (const time of [2.0625, 7.25]) {
    const frame = await ocean.frameAt(time), droplets = await frame.droplets();
    lines.push(`spray ${time} ${await frame.sprayHash()} ${droplets.count.toString(16).padStart(16, '0')}`);
    for (const [name, i] of [['first', 0], ['last', droplets.count - 1]])
      lines.push(`droplet ${time}-${name} ${doubleBits([...droplets.positionsM.slice(3 * i, 3 * i + 3)])} ` +
                 floatBits([...droplets.velocitiesMps.slice(3 * i, 3 * i + 3), droplets.radiusM[i], droplets.opacity[i], droplets.ageS[i]]));
  }
  ocean.dispose();
  return lines;
}

/** Returns the hashes of the dynamic waves at 30 ticks. */
export async function tickHashes(ocean, first) {
  const hashes = [];
  for (let tick = first; tick < first + 30; ++tick) hashes.push(await (await ocean.frameAt(tick * tickS)).dynamicWaves.hash());
  return hashes;
}

/** Returns the lines of a shore. */
export async function shoreLines(createOcean, options) {
  const ocean = await createOcean({ ...smallSea, shore: bay(), ...options });
  const lines = [];
  for (const time of [0, 7.3]) lines.push(`shore ${time} ${await (await ocean.frameAt(time)).shore.hash()}`);
  ocean.dispose();
  return lines;
}

// Wave inputs.

const inputSeas = {
  stack: { cascades: 3, resolution: 64, windSpeedMps: 12 },
  smallest: { resolution: 16, patchSizeM: 40, windSpeedMps: 6 },
  'one-cascade': { resolution: 128, patchSizeM: 150, windSpeedMps: 12 },
  pond: { waves: 'pond', resolution: 64 },
};

/** The waves of tests/wave_input_bits_test.cpp. */
function gerstnerInput() {
  const waves = [];
  for (let i = 0, wavelengthM = 180; i < 20; ++i, wavelengthM *= 0.77)
    waves.push({ amplitudeM: 0.003 * wavelengthM, wavelengthM, directionRad: 0.61 * (i % 7) - 1.9, phaseRad: 0.43 * (i % 11) - 2 });
  return { waves, choppiness: 0.9 };
}

/** FNV-1a of the velocities, modulo 2^64, in two halves that fit into doubles. */
function velocityHash(frame) {
  let high = 0xcbf29ce4, low = 0x84222325;
  const word = new Float32Array(1), bits = new Uint32Array(word.buffer);
  for (const cascade of frame.cascades)
    for (const plane of [cascade.velocityX, cascade.velocityY, cascade.velocityZ])
      for (const velocity of plane.toRows()) {
        word[0] = velocity;
        low = (low ^ bits[0]) >>> 0;
        // The prime is 2^40 + 0x1b3.
        const product = low * 0x1b3;
        high = (Math.imul(high, 0x1b3) + Math.floor(product / 2 ** 32) + (low << 8)) >>> 0;
        low = product >>> 0;
      }
  return [high, low].map((half) => half.toString(16).padStart(8, '0')).join('');
}

/** Returns the lines of wave inputs. */
export async function waveInputLines(createOcean, options) {
  const lines = [];
  for (const [name, sea] of Object.entries(inputSeas)) {
    const ripple = { xM: 7.3, zM: -2.9, wavelengthM: 9, amplitudeM: 0.5, reachM: 40 };
    const ocean = await createOcean({
      ...sea, loopPeriodS: 30, velocities: true, slopes: true, foam: true, inputs: [gerstnerInput(), { ripple }], ...options,
    });
    const hashes = [];
    const note = async (frame) => hashes.push(await frame.hash(), await frame.foamHash(), velocityHash(frame));
    await note(await ocean.frameAt(4.321));
    await ocean.setInput(1, { ripple: { xM: -3, zM: 1e6, wavelengthM: 13, amplitudeM: 0.25, phaseRad: 1 } });
    await note(await ocean.frameAt(4.444));
    lines.push(['input', name, ...hashes].join(' '));
    ocean.dispose();
  }
  return lines;
}
