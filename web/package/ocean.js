// An ocean and its frames. index.d.ts documents them; this file checks their validity.
import { valueOf } from './module.js';
import { flatPoints, flatWaterPoints } from './points.js';

/** Returns the number of mip levels: resolution, resolution / 2, ..., 1 texels along a side. */
export const levelCount = (resolution) => 32 - Math.clz32(resolution);

/** Returns the first texel of a mip level. */
export function levelOffset(resolution, level) {
  let texels = 0;
  for (let above = 0; above < level; ++above) texels += (resolution >> above) ** 2;
  return texels;
}

/** A square of floats, stored in blocks of a few columns as the kernels compute them. */
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

export const textureNames = ['displacement', 'gradients', 'slopes', 'moments'];
export const mapNames = [...textureNames, 'compression', 'snapshots'];
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

  /** Growing memory that is not shared empties its views, so they are made again. */
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

/** The dynamic waves or the shore of a frame. Arrays are views of the module's memory. */
export class FrameGrid {
  #hash;

  constructor(frame, read, hash) {
    let views = read();
    const array = (name) => {
      frame.assertValid();
      if (views.heightM.length === 0) views = read();  // after memory growth
      return views[name];
    };
    for (const [name, value] of Object.entries(views))
      Object.defineProperty(this, name, ArrayBuffer.isView(value) ? { enumerable: true, get: () => array(name) } : { enumerable: true, value });
    this.#hash = () => {
      frame.assertValid();
      return hash();
    };
  }

  hash() {
    return this.#hash();
  }
}

/** Returns arrays of the bytes of droplets: three doubles and six floats each. */
function dropletsOf(view) {
  const { buffer } = view.slice();  // aligned, and not shared
  const doubles = new Float64Array(buffer), floats = new Float32Array(buffer), count = doubles.length / 6;
  const arrays = { positionsM: new Float64Array(3 * count), velocitiesMps: new Float32Array(3 * count) };
  for (const name of ['radiusM', 'opacity', 'ageS']) arrays[name] = new Float32Array(count);
  for (let i = 0; i < count; ++i) {
    for (let axis = 0; axis < 3; ++axis) {
      arrays.positionsM[3 * i + axis] = doubles[6 * i + axis];
      arrays.velocitiesMps[3 * i + axis] = floats[12 * i + 6 + axis];
    }
    arrays.radiusM[i] = floats[12 * i + 9];
    arrays.opacity[i] = floats[12 * i + 10];
    arrays.ageS[i] = floats[12 * i + 11];
  }
  return { count, ...arrays };
}

/** A frame, valid until the second schedule() after its own. */
export class Frame {
  #ocean;
  #native;
  #slot;
  #number;
  #about;
  #cascades;
  #dynamicWaves;
  #shore;

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
  get snapshotAges() { return this.#describe().snapshotAges; }

  get cascades() {
    this.#cascades ??= this.#describe().cascades.map((about, number) => new Cascade(this, number, about));
    this.assertValid();
    return this.#cascades;
  }

  get dynamicWaves() {
    this.assertValid();
    this.#dynamicWaves ??= this.#grid('dynamicWaves', 'dynamicWavesHash');
    return this.#dynamicWaves;
  }

  get shore() {
    this.assertValid();
    this.#shore ??= this.#grid('shore', 'shoreHash');
    return this.#shore;
  }

  #grid(name, hash) {
    const native = this.#native, slot = this.#slot;
    return native[name](slot) && new FrameGrid(this, () => native[name](slot), () => native[hash](slot));
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

  droplets() {
    this.assertValid();
    return dropletsOf(valueOf(this.#native.droplets(this.#slot)));
  }

  sprayHash() {
    this.assertValid();
    return valueOf(this.#native.sprayHash(this.#slot));
  }

  query(points, { toleranceM, interpolation, footprintM } = {}) {
    this.assertValid();
    const views = valueOf(this.#native.query(this.#slot, flatPoints(points), toleranceM, interpolation, footprintM));
    // Copies, because the next query overwrites the views.
    return Object.fromEntries(Object.entries(views).map(([name, view]) => [name, view.slice()]));
  }

  sampleWater(points, options = {}) {
    this.assertValid();
    return valueOf(this.#native.sampleWater(this.#slot, flatWaterPoints(points), options));
  }

  firstHit(ray) {
    this.assertValid();
    return valueOf(this.#native.firstHit(this.#slot, ray ?? {}));
  }
}

/** The dynamic waves of an ocean. */
export class DynamicWaves {
  #native;
  #idle;

  /**
   * @param native  returns the binding; throws if the ocean is disposed
   * @param idle    returns the binding; throws then, and if a frame is in flight
   */
  constructor(native, idle) {
    this.#native = native;
    this.#idle = idle;
    this.options = valueOf(native().dynamicWavesOptions());
  }

  addImpulse(disturbance) { valueOf(this.#native().addImpulse(disturbance)); }
  addSource(source) { return valueOf(this.#native().addSource(source)); }
  setSource(number, source) { valueOf(this.#native().setSource(number, source)); }
  removeSource(number) { valueOf(this.#native().removeSource(number)); }
  setCenter(xM, zM) { valueOf(this.#native().setCenter(xM, zM)); }
  setRain(rain) { valueOf(this.#native().setRain(rain)); }
  saveState() { return valueOf(this.#idle().saveState()); }
  restoreState(saved) { valueOf(this.#idle().restoreState(saved)); }
}

export class Ocean {
  #instance;
  #native;
  #scheduled = 0;
  #isInFlight = false;
  #isBaking = false;
  #newest = null;
  #dynamicWaves = null;

  constructor(instance, native) {
    this.#instance = instance;
    this.#native = native;
  }

  #open() {
    if (!this.#native) throw new Error('the ocean is disposed');
    return this.#native;
  }

  #idle() {
    const native = this.#open();
    if (this.#isInFlight) throw new Error('a frame is scheduled; call complete() first');
    return native;
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

  /** Returns whether the frame of schedule() number `number` is still in memory. */
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

  sampleWater(points, options) {
    return this.#newestFrame().sampleWater(points, options);
  }

  firstHit(ray) {
    return this.#newestFrame().firstHit(ray);
  }

  setWaterFrame(water) {
    valueOf(this.#open().setWaterFrame(water));
  }

  setOrigin(xM, zM) {
    valueOf(this.#open().setOrigin(xM, zM));
  }

  setSprayCenter(xM, zM) {
    valueOf(this.#open().setSprayCenter(xM, zM));
  }

  emit(emitters) {
    valueOf(this.#open().emit(emitters));
  }

  saveSpray() {
    return valueOf(this.#idle().saveSpray());
  }

  restoreSpray(saved) {
    valueOf(this.#idle().restoreSpray(saved));
  }

  scheduleSea(options) {
    const native = this.#open();
    if (this.#isBaking) throw new Error('a sea is scheduled already; call completeSea() first');
    valueOf(native.scheduleSea(options));
    this.#isBaking = true;
  }

  seaIsReady() {
    return this.#open().seaIsReady();
  }

  completeSea() {
    const native = this.#open();
    if (!this.#isBaking) throw new Error('no sea is scheduled; call scheduleSea() first');
    if (this.#isInFlight) throw new Error('a frame is scheduled; call complete() first');
    this.#isBaking = false;
    valueOf(native.completeSea());
  }

  changeSea(options) {
    this.#idle();
    this.scheduleSea(options);
    this.completeSea();
  }

  turnInto(options, when) {
    const native = this.#open();
    if (this.#isBaking) throw new Error('a sea is scheduled; call completeSea() first');
    valueOf(native.turnInto(options, when ?? {}));
  }

  get dynamicWaves() {
    this.#dynamicWaves ??= new DynamicWaves(() => this.#open(), () => this.#idle());
    return this.#dynamicWaves;
  }

  setInput(index, input) {
    valueOf(this.#open().setInput(index, input));
  }

  get sea() { return this.#open().sea(); }
  get isShared() { return this.#instance?.isShared ?? false; }
  get threads() { return this.#open().threads(); }
  get memoryBytes() { return this.#open().memoryBytes(); }

  dispose() {
    // The threads end before their workers are terminated.
    this.#native?.delete();
    this.#native = null;
    this.#newest = null;
    this.#instance?.end();
    this.#instance = null;
  }
}
if (Symbol.dispose) Ocean.prototype[Symbol.dispose] = Ocean.prototype.dispose;
