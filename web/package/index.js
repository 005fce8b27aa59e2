// Oceans in a page or in node, computed on the calling thread. pelagic/worker computes in a worker.
import { assertOptions, makeInstance, threadsFor, valueOf } from './module.js';
import { Ocean } from './ocean.js';

export { ExactWater, createExactWater } from './exact_water.js';
export { Ocean, Frame, DynamicWaves, Cascade, Plane, levelCount, levelOffset } from './ocean.js';

/**
 * Computes the spectrum of a sea; index.d.ts has the options. Rejects with an Error of one line
 * that names the option, its value and what is accepted.
 */
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

/** Returns a row for each option of a sea: name, default and accepted values. */
export async function seaOptions() {
  return (await makeInstance(1)).module.seaOptions();
}

/** Returns rows for the options of dynamic waves, disturbances, rain, shores and wave inputs. */
export async function optionTables() {
  return (await makeInstance(1)).module.optionTables();
}

/** Returns the named seas, the mildest first, then the open sea of each Beaufort force. */
export async function presets() {
  return (await makeInstance(1)).module.presets();
}
