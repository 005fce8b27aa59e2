// Instances of the WebAssembly modules. Each ocean has its own instance, so that disposing of it
// frees all its memory. Compiled modules are cached.

export const isNode = typeof process === 'object' && typeof process?.versions?.node === 'string';
const isPageThread = !isNode && typeof document !== 'undefined';

const maxThreads = 64;
// At the resolutions that pages draw, more threads gain little, and each is a worker.
const defaultMaxThreads = 8;

/** Imports what only node needs, from a file that browsers and bundlers do not load. */
export function nodePlatform() {
  const file = './node_platform.js';
  return import(/* webpackIgnore: true */ /* @vite-ignore */ file);
}

export function assertOptions(options) {
  if (options !== null && typeof options === 'object' && !Array.isArray(options)) return;
  const what = Array.isArray(options) ? 'an array' : String(options);
  throw new Error(`options is ${what}, expected an object such as {windSpeedMps: 9}`);
}

async function coresHere() {
  return isNode ? (await nodePlatform()).cores() : navigator.hardwareConcurrency;
}

/**
 * Returns the number of threads of an ocean: `wanted`, else one per core, at most 8. Without shared
 * memory, and on a page's own thread, which must not block, it is one.
 */
export async function threadsFor(wanted) {
  if (wanted !== undefined && !(Number.isInteger(wanted) && wanted >= 1 && wanted <= maxThreads))
    throw new Error(`threads is ${typeof wanted === 'string' ? `"${wanted}"` : String(wanted)}, expected a whole number from 1 to ${maxThreads}`);
  const isShared = typeof SharedArrayBuffer !== 'undefined' && (isNode || globalThis.crossOriginIsolated === true);
  if (wanted > 1 && isPageThread)
    throw new Error(`threads is ${wanted}, expected 1 on a page's own thread, which must not wait for others: pelagic/worker has threads`);
  if (wanted > 1 && !isShared)
    throw new Error(`threads is ${wanted}, expected 1 where a page is not isolated: its server sends neither or one of the headers COOP and COEP`);
  if (wanted !== undefined) return wanted;
  if (isPageThread || !isShared) return 1;
  return Math.min(await coresHere(), defaultMaxThreads);
}

const compiled = new Map();

async function compile(url) {
  if (isNode) return WebAssembly.compile(await (await nodePlatform()).readBytes(url));
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url} is not there: the server says ${response.status}`);
  // compileStreaming() requires this type, which some servers do not send.
  if (response.headers.get('Content-Type') === 'application/wasm') return WebAssembly.compileStreaming(response);
  return WebAssembly.compile(await response.arrayBuffer());
}

/** Returns the compiled module at `url`. After a failure the next call tries again. */
function compiledOnce(url) {
  if (!compiled.has(url.href)) {
    const promise = compile(url);
    promise.catch(() => compiled.delete(url.href));
    compiled.set(url.href, promise);
  }
  return compiled.get(url.href);
}

/**
 * Makes an instance with its own memory and, for more than one thread, its own workers.
 * @returns {Promise<{module: object, isShared: boolean, end: () => void}>}
 */
export async function makeInstance(threads) {
  const hasThreads = threads > 1;
  const [wasm, glue] = await Promise.all([
    compiledOnce(hasThreads ? new URL('./wasm/ocean-threads.wasm', import.meta.url) : new URL('./wasm/ocean.wasm', import.meta.url)),
    hasThreads ? import('./wasm/ocean-threads.js') : import('./wasm/ocean.js'),
  ]);
  const cores = await coresHere();
  const module = await new Promise((resolve, reject) => {
    const instantiateWasm = (imports, receive) => {
      WebAssembly.instantiate(wasm, imports).then((instance) => receive(instance, wasm), reject);
      return {};
    };
    const make = () => glue.default({ poolThreads: threads - 1, cores, instantiateWasm }).then(resolve, reject);
    if (hasThreads && isNode) nodePlatform().then(({ withWebWorkers }) => withWebWorkers(make)).catch(reject);
    else make();
  });
  const workers = () => (hasThreads ? [...module.PThread.unusedWorkers, ...module.PThread.runningWorkers] : []);
  // Idle workers do not keep a node process alive.
  for (const worker of workers()) worker.unref?.();
  return { module, isShared: hasThreads, end: () => workers().forEach((worker) => worker.terminate()) };
}

/** Returns the value of a binding's result, or throws its error. */
export function valueOf(answer) {
  if (answer.error !== undefined) throw new Error(answer.error);
  return answer.value;
}
