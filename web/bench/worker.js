// The worker of a build: makes its module and calls it. Posts {row, fraction} while it measures, and
// then {frames, costs, hash} or {error}.

/** Largest number of threads, as of `pelagic bench --headset`. */
const maxThreads = 3;
/** Time of the frame whose hash shows that all builds compute one sea. */
const hashedTimeS = 12.5;

/** Waits until the workers of ended threads are free again. */
async function waitForWorkers(module) {
  while (module.PThread?.runningWorkers.length) await new Promise(resolve => setTimeout(resolve, 1));
}

/** @param frameSeconds, costSeconds  times to measure each, 0: not */
async function measure({name, hasThreads, frameSeconds, costSeconds}) {
  const threads = hasThreads ? Math.min(maxThreads, navigator.hardwareConcurrency) : 1;
  const {default: makeModule} = await import(`./${name}.js`);
  let first = 0, part = 1;
  const progress = (row, fraction) => postMessage({row, fraction: first + part * fraction});
  // Oceans on 2 and on 3 threads are measured in turns.
  const module = await makeModule({poolThreads: threads * (threads - 1) / 2, cores: navigator.hardwareConcurrency, progress});
  const hash = module.frameHash(hashedTimeS), frames = [];
  let costs = [];
  const seas = 5;
  part = frameSeconds / (frameSeconds + costSeconds) / seas;
  for (let sea = 0; sea < seas; ++sea, first += part) {
    frames.push(...module.frameRows(sea, threads, frameSeconds / seas));
    await waitForWorkers(module);
  }
  part = 1 - first;
  if (costSeconds > 0) costs = module.costRows(costSeconds);
  return {frames, costs, hash, version: module.version()};
}

self.onmessage = ({data}) => measure(data).then(
  result => postMessage({result}), error => postMessage({error: error?.message ?? String(error)}));
