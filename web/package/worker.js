// The sea in a worker of its own: the same as index.js, as promises. The thread that calls never waits.
import { assertOptions, workerClass } from './module.js';
import { RemoteOcean } from './remote_ocean.js';

export { seaOptions, presets, levelCount, levelOffset, Plane } from './index.js';
export { RemoteOcean, RemoteFrame } from './remote_ocean.js';

/** Bakes a sea in a worker; index.d.ts and worker.d.ts have the options. */
export async function createOcean(options = {}) {
  assertOptions(options);
  const WorkerHere = await workerClass();
  const worker = new WorkerHere(new URL('./worker_thread.js', import.meta.url), { type: 'module' });
  return RemoteOcean.in(worker, options);
}
