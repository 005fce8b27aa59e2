// What the pages tell people to type, typed: usage: node docs_test.mjs SOURCE MODULES
// MODULES is a folder node_modules with typescript.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';

const [source, modules] = process.argv.slice(2);
const project = join(source, 'build', 'my-sea');

/** Blocks of a page in order: {language, text}. */
function blocksOf(page, heading) {
  let text = readFileSync(join(source, page), 'utf8');
  if (heading) text = text.slice(text.indexOf(`\n## ${heading}\n`) + 1).split(/\n## /)[0];
  return [...text.matchAll(/^```(\w+)\n([^]*?)^```$/gm)].map(([, language, text]) => ({ language, text }));
}

const run = (command, args, options) => execFileSync(command, args, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'], ...options });

test("docs/users/web.md's lines make the package, install it and compute a frame", () => {
  const blocks = blocksOf('docs/users/web.md', 'The npm package');
  const lines = blocks.filter(({ language }) => language === 'bash').map(({ text }) => text).join('');
  const printed = run('bash', ['-e', '-c', lines], { cwd: source, env: { ...process.env, npm_config_audit: 'false', npm_config_fund: 'false' } });
  assert.equal(printed.trim().split('\n').at(-1) + '\n', blocks.find(({ language }) => language === 'text').text);
});

test("the package's README says what its lines print", () => {
  const blocks = blocksOf('web/package/README.md');
  let compared = 0;
  blocks.forEach(({ language, text }, i) => {
    if (language !== 'js') return;
    const file = join(project, `readme_${i}.mjs`);
    writeFileSync(file, text);
    assert.equal(run('node', [file], { cwd: project }), blocks[i + 1].text);
    ++compared;
  });
  assert.equal(compared, 3);
});

test("TypeScript takes the README's lines and the types' every file, strictly, and refuses what is not an option", () => {
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
  for (const wrong of ['{ windSpeed: 9 }', "{ windSpeedMps: '9' }", "{ waves: 'pond' }"])
    assert.throws(() => tsc(`import { createOcean } from 'pelagic';\nawait createOcean(${wrong});`), (error) => /error TS2/.test(error.stdout));
});

test('the tarball holds what its parts ask for, and no more', () => {
  const files = run('tar', ['tzf', join(source, 'build', 'pelagic-0.1.0.tgz')]).trim().split('\n').sort();
  assert.deepEqual(files.filter((file) => !/^package\/(\w+\.(js|d\.ts)|examples\/three\/.*|wasm\/ocean(-threads)?(\.worker)?\.(js|wasm))$/.test(file)),
                   ['package/LICENSE', 'package/NOTICE', 'package/README.md', 'package/package.json']);
  for (const name of ['ocean.js', 'ocean.wasm', 'ocean-threads.js', 'ocean-threads.wasm', 'ocean-threads.worker.js'])
    assert.ok(files.includes(`package/wasm/${name}`), name);
});
