// The worker's side of remote_ocean.js.
import { createOcean } from './index.js';
import { mapNames, planeNames } from './ocean.js';

let ocean = null;
let isShared = false;
let sent = [];  // names of the maps and planes that go out with a frame
const frames = new Map();  // by number: those that may be asked still
let count = 0;

const isPlane = (map) => !ArrayBuffer.isView(map);

/** A view of shared memory goes as it is, any other as a copy that is handed over. */
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
    if (data) maps[name] = isPlane(data) ? { ...data, data: posted(data.data, transfer) } : posted(data, transfer);
  }
  return { ...cascade, maps };
}

function frameOf(number) {
  const frame = frames.get(number);
  if (!frame) throw new Error('the frame is over: it lasts until the second schedule() after its own, or dispose()');
  return frame;
}

const methods = {
  async create({ maps = mapNames, ...options }) {
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
    const { sea, statistics, isa, bounds } = frame;
    return { number, timeS, sea, statistics, isa, bounds, cascades: frame.cascades.map((cascade) => postedCascade(cascade, transfer)) };
  },
  hash: (number) => frameOf(number).hash(),
  foamHash: (number) => frameOf(number).foamHash(),
  query: (number, points, options) => frameOf(number).query(points, options),
  firstHit: (number, ray) => frameOf(number).firstHit(ray),
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
