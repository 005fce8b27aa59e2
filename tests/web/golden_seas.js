// The seas of tests/golden/hashes.txt, for tests in node and in pages. Its hashes of queries are
// for points of the C++ tests; ocean_parts.js has those of tests/golden/values.txt.

const oneCascade = { resolution: 64, patchSizeM: 250 };
const seas = { default: {} };
for (const spectrum of ['phillips-paper', 'phillips', 'pierson-moskowitz', 'jonswap']) seas[`${spectrum}-64`] = { ...oneCascade, spectrum };
for (const spreading of ['paper', 'cosine-2s', 'hasselmann']) seas[`spreading-${spreading}-64`] = { ...oneCascade, spreading };
seas['shallow-64'] = { ...oneCascade, depthM: 8 };
seas['breaking-swell-64'] = { ...oneCascade, depthM: 2, swellHeightM: 1, swellDirectionRad: 2 };
seas['analytic-64'] = { waves: 'analytic', resolution: 64, choppiness: 1 };
seas['pond-64'] = { waves: 'pond', resolution: 64 };
seas['none-64'] = { ...oneCascade, spectrum: 'none', swellHeightM: 2 };
seas['wind-sea-by-height'] = { waveHeightM: 2, peakPeriodS: 7 };
const systems = [
  { heightM: 1.2, peakPeriodS: 12, directionRad: 2, spreadRad: 0.26 },
  { spreading: 'hasselmann', windSpeedMps: 8, fetchM: 30e3, directionRad: -1 },
  { spectrum: 'pierson-moskowitz', heightM: 0.5 },
];
seas.systems = { systems };
seas['systems-64'] = { spectrum: 'none', resolution: 64, patchSizeM: 900, depthM: 20, systems };
seas['short-wave-cutoff-64'] = { ...oneCascade, shortWaveCutoff: 0.8 };
for (const preset of ['calm', 'moderate', 'rough', 'storm']) seas[`preset-${preset}`] = { preset };

export const goldenNames = [...Object.keys(seas).flatMap((name) => [`${name}@0`, `${name}@12.34`]), 'foam-cascades'];

/** Returns "name hash" lines of the seas, by createOcean() of index.js or worker.js. */
export async function goldenLines(createOcean, options) {
  const lines = [];
  for (const [name, sea] of Object.entries(seas)) {
    const ocean = await createOcean({ ...sea, ...options });
    for (const time of [0, 12.34]) lines.push(`${name}@${time} ${await (await ocean.frameAt(time)).hash()}`);
    ocean.dispose();
  }
  const foamy = await createOcean({ cascades: 4, resolution: 64, choppiness: 1, foam: true, ...options });
  lines.push(`foam-cascades ${await (await foamy.frameAt(12.34)).foamHash()}`);
  foamy.dispose();
  return lines;
}

/** Returns the lines that differ from the file's, whose hashes may lack leading zeros. */
export function differences(lines, goldenText) {
  const golden = new Map(goldenText.trim().split('\n').map((line) => line.split(' ')));
  return lines.filter((line) => {
    const [name, hash] = line.split(' ');
    return golden.get(name)?.padStart(16, '0') !== hash;
  });
}
