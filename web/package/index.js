// The sea in a page or in node: createOcean() computes on the thread that calls it. pelagic/worker has the same in a worker.
import { assertOptions, makeInstance, threadsFor, valueOf } from './module.js';
import { Ocean } from './ocean.js';

export { Ocean, Frame, Cascade, Plane, levelCount, levelOffset } from './ocean.js';

/** Bakes a sea; index.d.ts has the options. Rejects with an Error of one line that names the option, the value and what is accepted. */
export async function createOcean(options = {}) {
  assertOptions(options);
  const threads = await threadsFor(options.threads);
  const instance = await makeInstance(threads);
  try {
    return new Ocean(instance, valueOf(instance.module.createOcean({ ...options, threads })));
  } catch (error) {
    instance.end();
    throw error;
  }
}

/** Every option of a sea: its name, default, and what is accepted. */
export async function seaOptions() {
  return (await makeInstance(1)).module.seaOptions();
}

/** The named seas, the mildest first, then the open sea of each force of wind. */
export async function presets() {
  return (await makeInstance(1)).module.presets();
}
