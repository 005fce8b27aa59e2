// The commands and examples of docs/integrations/web.md and of the package's README:
//   usage: node docs_test.mjs SOURCE MODULES
// MODULES is a folder node_modules with typescript.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

const [source, modules] = process.argv.slice(2);
const project = join(source, 'build', 'my-sea');

/** Returns the code blocks of a page, or of its section, in order: {language, text}. */
function blocksOf(page, heading) {
  let text = readFileSync(join(source, page), 'utf8');
  if (heading) text = text.slice(text.indexOf(`\n## ${heading}\n`) + 1).split(/\n## /)[0];
  return [...text.matchAll(/^```(\w+)\n([^]*?)^```$/gm)].map(([, language, text]) => ({ language, text }));
}

const run = (command, args, options) => execFileSync(command, args, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'], ...options });

/** Compares the output of each JavaScript block with the block after it. Returns their number. */
function runExamples(name, blocks) {
  let compared = 0;
  blocks.forEach(({ language, text }, i) => {
    if (language !== 'js') return;
    const file = join(project, `${name}_${i}.mjs`);
    writeFileSync(file, text);
    assert.equal(run('node', [file], { cwd: project }), blocks[i + 1].text);
    ++compared;
  });
  return compared;
}

test("the commands of docs/integrations/web.md make the package, install it and compute a frame", () => {
  const blocks = blocksOf('docs/integrations/web.md', 'The npm package');
  const lines = blocks.filter(({ language }) => language === 'bash').map(({ text }) => text).join('');
  const printed = run('bash', ['-e', '-c', lines], { cwd: source, env: { ...process.env, npm_config_audit: 'false', npm_config_fund: 'false' } });
  assert.equal(printed.trim().split('\n').at(-1) + '\n', blocks.find(({ language }) => language === 'text').text);
});

test('the examples of the README print what follows them', () => {
  assert.equal(runExamples('readme', blocksOf('web/package/README.md')), 6);
});

test("TypeScript accepts the README's example and all declarations strictly, and rejects unknown options", () => {
  const { text } = blocksOf('web/package/README.md').find(({ language }) => language === 'ts');
  const compilerOptions = { strict: true, noEmit: true, module: 'nodenext', target: 'es2022', lib: ['es2022', 'dom'], types: [] };
  writeFileSync(join(project, 'tsconfig.json'), JSON.stringify({ compilerOptions, files: ['typed.mts'] }));
  const tsc = (lines) => {
    writeFileSync(join(project, 'typed.mts'), lines);
    return run('node', [join(modules, 'typescript', 'bin', 'tsc'), '-p', '.'], { cwd: project });
  };
  tsc(text);
  tsc(`import { createOcean, type RemoteFrame } from 'pelagic/worker';
const frame: RemoteFrame = await (await createOcean({ maps: ['height'] })).frameAt(1);
export const height: Float32Array | undefined = frame.cascades[0].height?.toRows();`);
  tsc(`import { createOcean, type Disturbance, type WaveInput } from 'pelagic';
import { createOcean as createRemote } from 'pelagic/worker';
const boat: Disturbance = { shape: 'hull', lengthM: 4 };
const inputs: WaveInput[] = [{ waves: [{ amplitudeM: 0.1 }] }, { ripple: { amplitudeM: 0.1 } }];
const options = { dynamicWaves: { step: 'verlet' as const }, shore: { heightsM: [0, 1, 2, 3], columns: 2, rows: 2 }, inputs };
const ocean = await createOcean(options), remote = await createRemote(options);
ocean.dynamicWaves.removeSource(ocean.dynamicWaves.addSource(boat));
const number: number = await remote.dynamicWaves.addSource(boat);
ocean.dynamicWaves.restoreState(await remote.dynamicWaves.saveState());
ocean.setInput(0, { waves: [] });
export const depths: Float32Array | undefined = ocean.frameAt(0).shore?.depthM;
export const hashes: (string | undefined)[] = [ocean.frameAt(0).dynamicWaves?.hash(), await (await remote.frameAt(number)).dynamicWaves?.hash()];`);
  for (const wrong of ['{ windSpeed: 9 }', "{ windSpeedMps: '9' }", "{ waves: 'ponds' }", '{ dynamicWaves: { side: 3 } }', "{ inputs: [{ ripple: { xM: '3' } }] }",
                       '{ inputs: [() => 0] }', '{ shore: { heightsM: [0, 1, 2, 3] } }'])
    assert.throws(() => tsc(`import { createOcean } from 'pelagic';\nawait createOcean(${wrong});`), (error) => /error TS2/.test(error.stdout));
});

test('the tarball has the files of the package only', () => {
  const files = run('tar', ['tzf', join(source, 'build', 'pelagic-1.0.0.tgz')]).trim().split('\n').sort();
  assert.deepEqual(files.filter((file) => !/^package\/(\w+\.(js|d\.ts)|examples\/three\/.*|wasm\/ocean(-threads)?(\.worker)?\.(js|wasm))$/.test(file)),
                   ['package/LICENSE', 'package/NOTICE', 'package/README.md', 'package/package.json']);
  for (const name of ['ocean.js', 'ocean.wasm', 'ocean-threads.js', 'ocean-threads.wasm', 'ocean-threads.worker.js'])
    assert.ok(files.includes(`package/wasm/${name}`), name);
});
