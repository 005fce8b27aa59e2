// An ocean in a worker, seen from outside: each method posts a message and promises what comes back.
import { mapNames, planeNames, Plane } from './ocean.js';
import { flatPoints } from './points.js';

/** Messages to a worker and their answers, by number. */
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
      if (!call) return;  // closed meanwhile
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
      this.#worker.postMessage({ id, method, args });  // throws of what can't be cloned
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

/** A cascade as it came: its maps are copies of the worker's, or its very memory where that is shared. */
class RemoteCascade {
  constructor({ maps, ...about }) {
    Object.assign(this, about, { rotationRad: Math.atan2(about.sine, about.cosine), texelM: about.sideM / about.resolution });
    for (const name of mapNames) this[name] = maps[name] ?? null;
    for (const name of planeNames) this[name] = maps[name] ? new Plane(maps[name]) : null;
  }
}

export class RemoteFrame {
  #line;
  #number;

  constructor(line, { number, cascades, ...about }) {
    this.#line = line;
    this.#number = number;
    Object.assign(this, about, { cascades: cascades.map((cascade) => new RemoteCascade(cascade)) });
  }

  hash() {
    return this.#line.call('hash', this.#number);
  }

  foamHash() {
    return this.#line.call('foamHash', this.#number);
  }

  async query(points, options) {
    return this.#line.call('query', this.#number, flatPoints(points), options);
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
    this.threads = threads;
    this.isShared = isShared;
  }

  schedule(timeS) {
    if (this.#frame) throw new Error('a frame is scheduled already; call complete() first');
    this.#frame = this.#line.call('frameAt', timeS);
    this.#frame.catch(() => {});  // complete() tells
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

  async firstHit(ray) {
    return this.#newestFrame().firstHit(ray);
  }

  changeSea(options) {
    return this.#line.call('changeSea', options);
  }

  turnInto(options, when) {
    return this.#line.call('turnInto', options, when);
  }

  sea() {
    return this.#line.call('sea');
  }

  memoryBytes() {
    return this.#line.call('memoryBytes');
  }

  /** Ends the worker and its threads; what it still owes is refused. */
  dispose() {
    this.#line.close('the ocean is disposed');
  }
}
if (Symbol.dispose) RemoteOcean.prototype[Symbol.dispose] = RemoteOcean.prototype.dispose;
