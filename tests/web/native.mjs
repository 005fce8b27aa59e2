// Results of the native command, for the tests of the package.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { deflateSync } from 'node:zlib';
import { eventsFile, floorColumns, floorPixels, floorRows, shorePoints, smallSeaFlags } from './ocean_parts.js';

function inFolder(work) {
  const folder = mkdtempSync(join(tmpdir(), 'package_test_'));
  try {
    return work(folder);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

const columnNames = ['height', 'nx', 'ny', 'nz', 'vx', 'vy', 'vz', 'jacobian', 'error_m', 'foam', 'converged'];

/** Returns a row of samples for each point, in single precision, by `pelagic query`. */
export function nativeRows(pelagic, points, flags) {
  const input = points.map(([x, z]) => `${x},${z}\n`).join('');
  const csv = execFileSync(pelagic, ['query', '--points', '-', '--foam', ...flags], { input, stdio: ['pipe', 'pipe', 'ignore'] }).toString();
  const [header, ...lines] = csv.trim().split('\n');
  const columns = columnNames.map((name) => header.split(',').indexOf(name));
  return lines.map((line) => {
    const texts = line.split(',');
    return columns.map((column) => Math.fround(Number(texts[column])));
  });
}

/** Returns the same rows for the result of query(). */
export function rowsOf(answers) {
  const three = (array, i) => [...array.slice(3 * i, 3 * i + 3)];
  return Array.from(answers.heightM, (height, i) => [height, ...three(answers.normal, i), ...three(answers.velocityMps, i),
                                                     answers.jacobian[i], answers.errorM[i], answers.foam[i], answers.converged[i]]);
}

const eventFlags = (folder) => {
  const file = join(folder, 'events.csv');
  writeFileSync(file, eventsFile);
  return [...smallSeaFlags, '--events', file, '--events-resolution', '64', '--events-at', '0,0'];
};

/** Returns the lines of eventLines() (ocean_parts.js), by `pelagic export`. */
export function nativeEventLines(pelagic) {
  return inFolder((folder) => {
    const out = join(folder, 'out');
    execFileSync(pelagic, ['export', '--out', out, ...eventFlags(folder), '--fps', '4', '--frames', '2-11', '--maps', 'displacement', '--no-sync'],
                 { stdio: 'ignore' });
    const { frames } = JSON.parse(readFileSync(join(out, 'sea.json')));
    return frames.map((frame) => `${frame.time_s} ${frame.hash} ${frame.dynamic_waves_hash}`);
  });
}

/** Returns samples of playEvents() (ocean_parts.js) at 2 s, by `pelagic query`. */
export function nativeEventRows(pelagic, points) {
  return inFolder((folder) => nativeRows(pelagic, points, ['--time', '2', '--interpolation', 'linear', ...eventFlags(folder)]));
}

function crc32(bytes) {
  let crc = ~0;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; ++bit) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}

/** Returns a grey PNG of 8 bits. */
function pngOf(pixels, columns, rows) {
  const word = (number) => {
    const bytes = Buffer.alloc(4);
    bytes.writeUInt32BE(number);
    return bytes;
  };
  const chunk = (name, data) => {
    const body = Buffer.concat([Buffer.from(name), data]);
    return Buffer.concat([word(data.length), body, word(crc32(body))]);
  };
  const lines = Buffer.concat(Array.from({ length: rows }, (_, j) => Buffer.from([0, ...pixels.subarray(columns * j, columns * (j + 1))])));
  return Buffer.concat([Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'), chunk('IHDR', Buffer.concat([word(columns), word(rows), Buffer.from([8, 0, 0, 0, 0])])),
                        chunk('IDAT', deflateSync(lines)), chunk('IEND', Buffer.alloc(0))]);
}

/** Returns samples of the sea over floorShore() (ocean_parts.js) at 12.34 s, by `pelagic query`. */
export function nativeShoreRows(pelagic) {
  return inFolder((folder) => {
    const floor = join(folder, 'floor.png');
    writeFileSync(floor, pngOf(floorPixels(), floorColumns, floorRows));
    return nativeRows(pelagic, shorePoints, ['--time', '12.34', '--interpolation', 'linear', ...smallSeaFlags, '--shore', '--floor', floor]);
  });
}
