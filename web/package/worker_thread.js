// The worker's side of remote_ocean.js.
import { createOcean } from './index.js';
import { mapNames, planeNames, textureNames } from './ocean.js';

let ocean = null;
let isShared = false;
let sent = [];  // names of the maps and planes that are posted with a frame
const frames = new Map();  // the valid frames, by number
let count = 0;

const isPlane = (map) => !ArrayBuffer.isView(map);

/** Returns a view of shared memory as it is, else a copy to be transferred. */
function posted(view, transfer) {
  if (isShared) return view;
  const copy = view.slice();
  transfer.push(copy.buffer);
  return copy;
}

function postedCascade(cascade, transfer) {
  const maps = {};
  for (const name of sent) {
    const data = cascade.map(name);
    if (Array.isArray(data)) maps[name] = data.map((view) => posted(view, transfer));
    else if (data) maps[name] = isPlane(data) ? { ...data, data: posted(data.data, transfer) } : posted(data, transfer);
  }
  return { ...cascade, maps };
}

/** Returns null for null. */
function postedGrid(grid, transfer) {
  return grid && Object.fromEntries(Object.entries(grid).map(
    ([name, value]) => [name, ArrayBuffer.isView(value) ? posted(value, transfer) : value]));
}

function frameOf(number) {
  const frame = frames.get(number);
  if (!frame) throw new Error('the frame is over: it lasts until the second schedule() after its own, or dispose()');
  return frame;
}

const methods = {
  async create({ maps = textureNames, ...options }) {
    const known = [...mapNames, ...planeNames];
    if (!Array.isArray(maps)) throw new Error(`maps is ${String(maps)}, expected an array of ${known.join(', ')}`);
    for (const name of maps)
      if (!known.includes(name)) throw new Error(`maps has ${String(name)}, expected only ${known.join(', ')}`);
    ocean = await createOcean(options);
    isShared = ocean.isShared;
    sent = maps;
    return { threads: ocean.threads, isShared };
  },
  frameAt(timeS, transfer) {
    const frame = ocean.frameAt(timeS);
    const number = count++;
    frames.set(number, frame);
    frames.delete(number - 2);
    const { sea, statistics, isa, bounds, snapshotAges } = frame;
    return {
      number, timeS, sea, statistics, isa, bounds, snapshotAges,
      cascades: frame.cascades.map((cascade) => postedCascade(cascade, transfer)),
      dynamicWaves: postedGrid(frame.dynamicWaves, transfer),
      shore: postedGrid(frame.shore, transfer),
    };
  },
  hash: (number) => frameOf(number).hash(),
  foamHash: (number) => frameOf(number).foamHash(),
  droplets: (number) => frameOf(number).droplets(),
  sprayHash: (number) => frameOf(number).sprayHash(),
  setSprayCenter: (xM, zM) => ocean.setSprayCenter(xM, zM),
  emit: (emitters) => ocean.emit(emitters),
  saveSpray: () => ocean.saveSpray(),
  restoreSpray: (saved) => ocean.restoreSpray(saved),
  dynamicWavesHash: (number) => frameOf(number).dynamicWaves.hash(),
  shoreHash: (number) => frameOf(number).shore.hash(),
  dynamicWaves: (method, ...args) => ocean.dynamicWaves[method](...args),
  dynamicWavesOptions: () => ocean.dynamicWaves.options,
  setInput: (index, input) => ocean.setInput(index, input),
  query: (number, points, options) => frameOf(number).query(points, options),
  sampleWater: (number, points, options) => frameOf(number).sampleWater(points, options),
  firstHit: (number, ray) => frameOf(number).firstHit(ray),
  setWaterFrame: (water) => ocean.setWaterFrame(water),
  setOrigin: (xM, zM) => ocean.setOrigin(xM, zM),
  changeSea: (options) => ocean.changeSea(options),
  turnInto: (options, when) => ocean.turnInto(options, when),
  sea: () => ocean.sea,
  memoryBytes: () => ocean.memoryBytes,
};

self.onmessage = async ({ data: { id, method, args } }) => {
  const transfer = [];
  try {
    const value = await (method === 'frameAt' ? methods.frameAt(args[0], transfer) : methods[method](...args));
    postMessage({ id, value }, transfer);
  } catch (error) {
    postMessage({ id, error: error.message });
  }
};
