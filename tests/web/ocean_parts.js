// Dynamic waves, shores and wave inputs for the tests in node and in pages. Each function takes a
// createOcean() of index.js or worker.js and further options, such as threads.

const tickS = 1 / 60;
export const smallSea = { cascades: 2, resolution: 32, windSpeedMps: 8 };
/** The options of smallSea for the native command. */
export const smallSeaFlags = ['--cascades', '2', '--resolution', '32', '--wind-speed', '8'];

// Dynamic waves.

/** The grid of `--events-resolution 64` with the command's default depth. */
export const grid = { resolution: 64, depthM: 4000 };
export const stone = { mode: 'impulse', xM: 3, zM: -2, radiusM: 2, heightM: 0.4 };
export const boat = { shape: 'hull', xM: -10, zM: 5, radiusM: 1, lengthM: 4, heightM: -0.5, velocityXMps: 6 };
/** The events of playEvents(), as a file for `--events`: the boat moves from 0.7 s for 1.5 s. */
export const eventsFile = `time,x,z,radius,height,velocity,heading,duration,length,mode
0.5,3,-2,2,0.4,,,,,impulse
0.7,-10,5,1,-0.5,6,0,1.5,4,pressure
`;

/**
 * Computes a frame of each tick from 29 to 165, with the commands of eventsFile, and calls
 * `atTick(tick, frame)` for each.
 */
export async function playEvents(createOcean, options, atTick) {
  const ocean = await createOcean({ ...smallSea, queries: true, velocities: true, foam: true, dynamicWaves: grid, ...options });
  const waves = ocean.dynamicWaves;
  await waves.setCenter(0, 0);
  let number = null;
  for (let tick = 29; tick <= 165; ++tick) {
    if (tick === 30) await waves.addImpulse(stone);
    if (tick === 42) number = await waves.addSource(boat);
    if (tick === 132) await waves.removeSource(number);
    await atTick(tick, await ocean.frameAt(tick / 60));
  }
  ocean.dispose();
}

/** Returns "time hash dynamic_waves_hash" of every fifteenth tick of playEvents(). */
export async function eventLines(createOcean, options) {
  const lines = [];
  await playEvents(createOcean, options, async (tick, frame) => {
    if (tick % 15 === 0) lines.push(`${tick / 60} ${await frame.hash()} ${await frame.dynamicWaves.hash()}`);
  });
  return lines;
}

/** Returns the hashes of the dynamic waves at 30 ticks. */
export async function tickHashes(ocean, first) {
  const hashes = [];
  for (let tick = first; tick < first + 30; ++tick) hashes.push(await (await ocean.frameAt(tick * tickS)).dynamicWaves.hash());
  return hashes;
}

// Shores.

export const floorColumns = 48, floorRows = 40;

/** Returns the bytes of an image of an island in a bay. */
export function floorPixels() {
  return Uint8Array.from({ length: floorColumns * floorRows }, (_, at) => {
    const x = 2 * (at % floorColumns) / (floorColumns - 1) - 1, z = 2 * Math.floor(at / floorColumns) / (floorRows - 1) - 1;
    return Math.max(0, Math.min(255, 220 / (1 + 9 * (x * x + z * z) ** 2) + 30 * x));
  });
}

/** The shore of `--shore --floor` with that image: heights from -20 to 10 m, 1000 m wide. */
export function floorShore() {
  const metres = 1000 / floorColumns;
  return {
    heightsM: Float32Array.from(floorPixels(), (byte) => -20 + Math.fround(byte * Math.fround(1 / 255)) * 30),
    columns: floorColumns, rows: floorRows, metresASample: metres,
    cornerXM: -0.5 * metres * (floorColumns - 1), cornerZM: -0.5 * metres * (floorRows - 1),
  };
}

/** Points on land and on water, inside and outside of the shore. */
export const shorePoints = Array.from({ length: 400 }, (_, i) => [(i * 37.77) % 1200 - 600, (i * 12.345) % 1000 - 500]);

/** Returns "time hash" for the times of tests/golden/shore.txt (tests/shore_test.cpp, bay()). */
export async function shoreLines(createOcean, options) {
  const columns = 81, rows = 61, heightsM = [];
  for (let j = 0; j < rows; ++j)
    for (let i = 0; i < columns; ++i) {
      const x = 5 * i, fromX = x - 150, fromZ = 5 * j - 120, squared = (fromX * fromX + fromZ * fromZ) / 1600;
      heightsM.push(-12 + x * 0.035 + 16 / (1 + squared * squared));
    }
  const shore = { heightsM, columns, rows, metresASample: 5, cornerXM: -170, cornerZM: -130, resolution: 64 };
  const ocean = await createOcean({ cascades: 3, resolution: 32, windSpeedMps: 8, loopPeriodS: 40, shore, ...options });
  const lines = [];
  for (const time of [0, 7.3]) lines.push(`${time} ${await (await ocean.frameAt(time)).shore.hash()}`);
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

/** Returns the lines of tests/golden/wave_inputs.txt. */
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
    lines.push([name, ...hashes].join(' '));
    ocean.dispose();
  }
  return lines;
}
