// Water by the exact sum over the waves of a sea. index.d.ts documents it.
import { assertOptions, makeInstance, threadsFor, valueOf } from './module.js';
import { flatPoints, flatWaterPoints } from './points.js';

export class ExactWater {
  #instance;
  #native;

  constructor(instance, native) {
    this.#instance = instance;
    this.#native = native;
  }

  #open() {
    if (!this.#native) throw new Error('the water is disposed of');
    return this.#native;
  }

  setTime(timeS) {
    valueOf(this.#open().setTime(timeS));
  }

  setOrigin(xM, zM) {
    valueOf(this.#open().setOrigin(xM, zM));
  }

  sample(points, { footprintM } = {}) {
    return valueOf(this.#open().sample(flatWaterPoints(points), footprintM));
  }

  sampleSurface(points, { footprintM } = {}) {
    return valueOf(this.#open().sampleSurface(flatPoints(points), footprintM));
  }

  dispose() {
    this.#native?.delete();
    this.#native = null;
    this.#instance?.end();
    this.#instance = null;
  }
}
if (Symbol.dispose) ExactWater.prototype[Symbol.dispose] = ExactWater.prototype.dispose;

export async function createExactWater(options = {}) {
  assertOptions(options);
  const threads = await threadsFor(options.threads);
  const instance = await makeInstance(threads);
  try {
    return new ExactWater(instance, valueOf(instance.module.createExactWater({ ...options, threads })));
  } catch (error) {
    instance.end();
    throw error;
  }
}
