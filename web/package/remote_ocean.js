// The proxy of an ocean in a worker. Each method posts a message and returns a promise of the
// result.
import { mapNames, planeNames, Plane } from './ocean.js';
import { flatPoints, flatWaterPoints } from './points.js';

/** Calls of a worker's methods, by message. */
class Line {
  #worker;
  #calls = new Map();
  #next = 0;
  #end = null;

  constructor(worker) {
    this.#worker = worker;
    worker.unref?.();
    worker.onmessage = ({ data: { id, value, error } }) => {
      const call = this.#take(id);
      if (!call) return;  // closed
      if (error !== undefined) call.reject(new Error(error));
      else call.resolve(value);
    };
    worker.onerror = (event) => {
      event.preventDefault?.();
      this.close(`the worker failed: ${event.message ?? 'its script could not be loaded'}`);
    };
  }

  #take(id) {
    const call = this.#calls.get(id);
    this.#calls.delete(id);
    if (this.#calls.size === 0) this.#worker.unref?.();
    return call;
  }

  call(method, ...args) {
    if (this.#end) return Promise.reject(new Error(this.#end));
    return new Promise((resolve, reject) => {
      const id = this.#next++;
      this.#worker.postMessage({ id, method, args });  // throws if an argument cannot be cloned
      this.#worker.ref?.();
      this.#calls.set(id, { resolve, reject });
    });
  }

  close(why) {
    if (this.#end) return;
    this.#end = why;
    this.#worker.terminate();
    for (const call of this.#calls.values()) call.reject(new Error(why));
    this.#calls.clear();
  }
}

/** A cascade of a frame. Maps are copies, or views of the worker's memory if it is shared. */
class RemoteCascade {
  constructor({ maps, ...about }) {
    Object.assign(this, about, { rotationRad: Math.atan2(about.sine, about.cosine), texelM: about.sideM / about.resolution });
    for (const name of mapNames) this[name] = maps[name] ?? null;
    for (const name of planeNames) this[name] = maps[name] ? new Plane(maps[name]) : null;
  }
}

/** The dynamic waves or the shore of a frame. Arrays are copies, or views of shared memory. */
class RemoteGrid {
  #hash;

  constructor(about, hash) {
    Object.assign(this, about);
    this.#hash = hash;
  }

  hash() {
    return this.#hash();
  }
}

/**
 * The dynamic waves of an ocean. The worker executes commands and frames in the order of the calls.
 */
export class RemoteDynamicWaves {
  #line;

  constructor(line) {
    this.#line = line;
  }

  options() { return this.#line.call('dynamicWavesOptions'); }
  addImpulse(disturbance) { return this.#line.call('dynamicWaves', 'addImpulse', disturbance); }
  addSource(source) { return this.#line.call('dynamicWaves', 'addSource', source); }
  setSource(number, source) { return this.#line.call('dynamicWaves', 'setSource', number, source); }
  removeSource(number) { return this.#line.call('dynamicWaves', 'removeSource', number); }
  setCenter(xM, zM) { return this.#line.call('dynamicWaves', 'setCenter', xM, zM); }
  setRain(rain) { return this.#line.call('dynamicWaves', 'setRain', rain); }
  saveState() { return this.#line.call('dynamicWaves', 'saveState'); }
  restoreState(saved) { return this.#line.call('dynamicWaves', 'restoreState', saved); }
}

export class RemoteFrame {
  #line;
  #number;

  constructor(line, { number, cascades, dynamicWaves, shore, ...about }) {
    this.#line = line;
    this.#number = number;
    Object.assign(this, about, { cascades: cascades.map((cascade) => new RemoteCascade(cascade)) });
    this.dynamicWaves = dynamicWaves && new RemoteGrid(dynamicWaves, () => line.call('dynamicWavesHash', number));
    this.shore = shore && new RemoteGrid(shore, () => line.call('shoreHash', number));
  }

  hash() {
    return this.#line.call('hash', this.#number);
  }

  foamHash() {
    return this.#line.call('foamHash', this.#number);
  }

  droplets() {
    return this.#line.call('droplets', this.#number);
  }

  sprayHash() {
    return this.#line.call('sprayHash', this.#number);
  }

  async query(points, options) {
    return this.#line.call('query', this.#number, flatPoints(points), options);
  }

  async sampleWater(points, options) {
    return this.#line.call('sampleWater', this.#number, flatWaterPoints(points), options);
  }

  firstHit(ray) {
    return this.#line.call('firstHit', this.#number, ray);
  }
}

export class RemoteOcean {
  #line;
  #frame = null;
  #newest = null;

  static async in(worker, options) {
    const line = new Line(worker);
    try {
      return new RemoteOcean(line, await line.call('create', options));
    } catch (error) {
      line.close('the ocean could not be made');
      throw error;
    }
  }

  constructor(line, { threads, isShared }) {
    this.#line = line;
    this.dynamicWaves = new RemoteDynamicWaves(line);
    this.threads = threads;
    this.isShared = isShared;
  }

  schedule(timeS) {
    if (this.#frame) throw new Error('a frame is scheduled already; call complete() first');
    this.#frame = this.#line.call('frameAt', timeS);
    this.#frame.catch(() => {});  // complete() rejects with the error
  }

  async complete() {
    if (!this.#frame) throw new Error('no frame is scheduled; call schedule() first');
    const promise = this.#frame;
    try {
      this.#newest = new RemoteFrame(this.#line, await promise);
    } finally {
      this.#frame = null;
    }
    return this.#newest;
  }

  async frameAt(timeS) {
    this.schedule(timeS);
    return this.complete();
  }

  #newestFrame() {
    if (!this.#newest) throw new Error('there is no frame yet; call complete() first');
    return this.#newest;
  }

  async query(points, options) {
    return this.#newestFrame().query(points, options);
  }

  async sampleWater(points, options) {
    return this.#newestFrame().sampleWater(points, options);
  }

  async firstHit(ray) {
    return this.#newestFrame().firstHit(ray);
  }

  setWaterFrame(water) {
    return this.#line.call('setWaterFrame', water);
  }

  setOrigin(xM, zM) {
    return this.#line.call('setOrigin', xM, zM);
  }

  setSprayCenter(xM, zM) {
    return this.#line.call('setSprayCenter', xM, zM);
  }

  emit(emitters) {
    return this.#line.call('emit', emitters);
  }

  saveSpray() {
    return this.#line.call('saveSpray');
  }

  restoreSpray(saved) {
    return this.#line.call('restoreSpray', saved);
  }

  changeSea(options) {
    return this.#line.call('changeSea', options);
  }

  turnInto(options, when) {
    return this.#line.call('turnInto', options, when);
  }

  setInput(index, input) {
    return this.#line.call('setInput', index, input);
  }

  sea() {
    return this.#line.call('sea');
  }

  memoryBytes() {
    return this.#line.call('memoryBytes');
  }

  /** Ends the worker and its threads. Pending promises are rejected. */
  dispose() {
    this.#line.close('the ocean is disposed');
  }
}
if (Symbol.dispose) RemoteOcean.prototype[Symbol.dispose] = RemoteOcean.prototype.dispose;
