// Benchmark of a frame in node and of the native command, one thread each, with SSE4.2, which has
// registers of equal width. They take turns, and the minimum over the turns counts, so that other
// load on the machine affects both equally.
//
//   node bench/web.mjs [PACKAGE [PELAGIC [TURNS]]]
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { gzipSync } from 'node:zlib';

const [folder = 'build/pelagic-npm', pelagic = 'build/release/bin/pelagic', turns = 4] = process.argv.slice(2);
const { createOcean } = await import(pathToFileURL(join(resolve(folder), 'index.js')));

const sizes = [64, 128, 256, 512];
const seas = new Map(sizes.map((n) => [`one cascade of ${n}`, { resolution: n, patchSizeM: 250 }]));
seas.set('default sea', {});
const least = new Map([...seas.keys()].map((name) => [name, { native: Infinity, node: Infinity }]));

function takeNative() {
  const args = ['bench', '--isa', 'sse4.2', '--threads', '1', '--seconds', '8', '--json', '-'];
  const { rows } = JSON.parse(execFileSync(pelagic, args, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] }));
  for (const { cascades, n, ours_ms } of rows) {
    const best = least.get(cascades > 1 ? 'default sea' : `one cascade of ${n}`);
    if (best) best.native = Math.min(best.native, ours_ms);
  }
}

/** The median of frames in a second, as the native command has it. */
async function takeNode() {
  for (const [name, sea] of seas) {
    const ocean = await createOcean({ ...sea, threads: 1 });
    for (let i = 0; i < 200; ++i) ocean.frameAt(i);  // until the engine has optimised it
    const times = [];
    for (let time = 0, begin = performance.now(); performance.now() - begin < 1000; time += 1 / 60) {
      const before = performance.now();
      ocean.frameAt(time);
      times.push(performance.now() - before);
    }
    ocean.dispose();
    const best = least.get(name);
    best.node = Math.min(best.node, times.sort((a, b) => a - b)[times.length >> 1]);
  }
}

for (let turn = 0; turn < Number(turns); ++turn) {
  takeNative();
  await takeNode();
}
console.log(`node ${process.version}\n\n| sea | native SSE4.2, ms | node, ms | ratio |\n|---|---|---|---|`);
for (const [name, { native, node }] of least) console.log(`| ${name} | ${native.toFixed(3)} | ${node.toFixed(3)} | ${(node / native).toFixed(2)} |`);
console.log('\n| file | KB | packed by gzip |\n|---|---|---|');
for (const file of ['ocean.wasm', 'ocean.js', 'ocean-threads.wasm', 'ocean-threads.js']) {
  const bytes = readFileSync(join(folder, 'wasm', file));
  console.log(`| ${file} | ${Math.round(bytes.length / 1000)} | ${Math.round(gzipSync(bytes, { level: 9 }).length / 1000)} |`);
}
