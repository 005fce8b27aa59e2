// An ocean, its frames and what is in them. index.d.ts says what each means; here is how long it holds.
import { valueOf } from './module.js';
import { flatPoints } from './points.js';

/** Levels in a chain of mipmaps: resolution, resolution / 2, ..., 1. */
export const levelCount = (resolution) => 32 - Math.clz32(resolution);

/** First texel of a level in its chain. */
export function levelOffset(resolution, level) {
  let texels = 0;
  for (let above = 0; above < level; ++above) texels += (resolution >> above) ** 2;
  return texels;
}

/** A square of floats in blocks of a few columns, which is how they are computed. */
export class Plane {
  constructor({ data, resolution, blockColumns, rowStride, blockStride }) {
    Object.assign(this, { data, resolution, blockColumns, rowStride, blockStride });
  }

  at(i, j) {
    const block = Math.floor(i / this.blockColumns);
    return this.data[block * this.blockStride + j * this.rowStride + (i - block * this.blockColumns)];
  }

  toRows(out = new Float32Array(this.resolution ** 2)) {
    const { data, resolution, blockColumns, rowStride, blockStride } = this;
    for (let j = 0; j < resolution; ++j)
      for (let i = 0, from = j * rowStride; i < resolution; i += blockColumns, from += blockStride)
        for (let column = 0; column < blockColumns; ++column) out[j * resolution + i + column] = data[from + column];
    return out;
  }
}

export const mapNames = ['displacement', 'gradients', 'slopes', 'moments', 'foam'];
export const planeNames = ['dx', 'height', 'dz', 'velocityX', 'velocityY', 'velocityZ'];

/** A cascade of a frame. Its maps are views of the module's memory. */
export class Cascade {
  #frame;
  #number;
  #maps;

  constructor(frame, number, about) {
    this.#frame = frame;
    this.#number = number;
    Object.assign(this, about, { rotationRad: Math.atan2(about.sine, about.cosine), texelM: about.sideM / about.resolution });
  }

  /** A memory that grows leaves its old views without a byte, unless it is shared. So they are made anew then. */
  map(name) {
    this.#frame.assertValid();
    if (!this.#maps || this.#maps.displacement.length === 0) this.#maps = this.#frame.mapsOf(this.#number);
    return this.#maps[name];
  }
}
for (const name of mapNames)
  Object.defineProperty(Cascade.prototype, name, { get() { return this.map(name); } });
for (const name of planeNames)
  Object.defineProperty(Cascade.prototype, name, {
    get() {
      const plane = this.map(name);
      return plane && new Plane(plane);
    },
  });

/** A frame: valid until the second schedule() after the one that asked for it. */
export class Frame {
  #ocean;
  #native;
  #slot;
  #number;
  #about;
  #cascades;

  constructor(ocean, native, slot, number) {
    this.#ocean = ocean;
    this.#native = native;
    this.#slot = slot;
    this.#number = number;
  }

  get isValid() {
    return this.#ocean.isHeld(this.#number);
  }

  assertValid() {
    if (!this.isValid) throw new Error('the frame is over: it lasts until the second schedule() after its own, or dispose()');
  }

  #describe() {
    this.assertValid();
    this.#about ??= this.#native.describe(this.#slot);
    return this.#about;
  }

  get timeS() { return this.#describe().timeS; }
  get sea() { return this.#describe().sea; }
  get statistics() { return this.#describe().statistics; }
  get isa() { return this.#describe().isa; }
  get bounds() { return this.#describe().bounds; }

  get cascades() {
    this.#cascades ??= this.#describe().cascades.map((about, number) => new Cascade(this, number, about));
    this.assertValid();
    return this.#cascades;
  }

  mapsOf(cascade) {
    return this.#native.maps(this.#slot, cascade);
  }

  hash() {
    this.assertValid();
    return this.#native.hash(this.#slot);
  }

  foamHash() {
    this.assertValid();
    return this.#native.foamHash(this.#slot);
  }

  query(points, { toleranceM, interpolation } = {}) {
    this.assertValid();
    const views = valueOf(this.#native.query(this.#slot, flatPoints(points), toleranceM, interpolation));
    // The next query writes over them.
    return Object.fromEntries(Object.entries(views).map(([name, view]) => [name, view.slice()]));
  }

  firstHit(ray) {
    this.assertValid();
    return valueOf(this.#native.firstHit(this.#slot, ray ?? {}));
  }
}

export class Ocean {
  #instance;
  #native;
  #scheduled = 0;
  #isInFlight = false;
  #isBaking = false;
  #newest = null;

  constructor(instance, native) {
    this.#instance = instance;
    this.#native = native;
  }

  #open() {
    if (!this.#native) throw new Error('the ocean is disposed');
    return this.#native;
  }

  schedule(timeS) {
    const native = this.#open();
    if (this.#isInFlight) throw new Error('a frame is scheduled already; call complete() first');
    valueOf(native.schedule(timeS));
    this.#isInFlight = true;
    ++this.#scheduled;
  }

  isReady() {
    return this.#open().isReady();
  }

  complete() {
    const native = this.#open();
    if (!this.#isInFlight) throw new Error('no frame is scheduled; call schedule() first');
    this.#isInFlight = false;
    this.#newest = new Frame(this, native, valueOf(native.complete()), this.#scheduled);
    return this.#newest;
  }

  frameAt(timeS) {
    this.schedule(timeS);
    return this.complete();
  }

  /** The frame that schedule() number `number` asked for is in memory still. */
  isHeld(number) {
    return this.#native !== null && this.#scheduled - number < 2;
  }

  #newestFrame() {
    this.#open();
    if (!this.#newest) throw new Error('there is no frame yet; call complete() first');
    return this.#newest;
  }

  query(points, options) {
    return this.#newestFrame().query(points, options);
  }

  firstHit(ray) {
    return this.#newestFrame().firstHit(ray);
  }

  scheduleSea(options) {
    const native = this.#open();
    if (this.#isBaking) throw new Error('a sea is scheduled already, expected completeSea() first');
    valueOf(native.scheduleSea(options));
    this.#isBaking = true;
  }

  seaIsReady() {
    return this.#open().seaIsReady();
  }

  completeSea() {
    const native = this.#open();
    if (!this.#isBaking) throw new Error('no sea is scheduled, expected scheduleSea() first');
    if (this.#isInFlight) throw new Error('a frame is scheduled; call complete() first');
    this.#isBaking = false;
    valueOf(native.completeSea());
  }

  changeSea(options) {
    this.#open();
    if (this.#isInFlight) throw new Error('a frame is scheduled; call complete() first');
    this.scheduleSea(options);
    this.completeSea();
  }

  turnInto(options, when) {
    const native = this.#open();
    if (this.#isBaking) throw new Error('a sea is scheduled, expected completeSea() first');
    valueOf(native.turnInto(options, when ?? {}));
  }

  get sea() { return this.#open().sea(); }
  get isShared() { return this.#instance?.isShared ?? false; }
  get threads() { return this.#open().threads(); }
  get memoryBytes() { return this.#open().memoryBytes(); }

  dispose() {
    // First its threads come to their ends, where they wait for nothing; then their workers may be ended.
    this.#native?.delete();
    this.#native = null;
    this.#newest = null;
    this.#instance?.end();
    this.#instance = null;
  }
}
if (Symbol.dispose) Ocean.prototype[Symbol.dispose] = Ocean.prototype.dispose;
