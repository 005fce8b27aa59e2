// Oceans in a worker: the interface of index.js with promises. The calling thread never blocks.
import { assertOptions, isNode, nodePlatform } from './module.js';
import { RemoteOcean } from './remote_ocean.js';

export { seaOptions, optionTables, presets, levelCount, levelOffset, Plane } from './index.js';
export { RemoteOcean, RemoteFrame, RemoteDynamicWaves } from './remote_ocean.js';

/** Computes the spectrum of a sea in a worker; index.d.ts and worker.d.ts have the options. */
export async function createOcean(options = {}) {
  assertOptions(options);
  // Bundlers find the worker's script by this literal expression only.
  const worker = isNode ? (await nodePlatform()).oceanWorker()
                        : new Worker(new URL('./worker_thread.js', import.meta.url), { type: 'module' });
  return RemoteOcean.in(worker, options);
}
