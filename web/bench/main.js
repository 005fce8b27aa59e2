// Measures four builds in workers, one after another, and shows tables and a JSON.
//
// `window.pelagicBench` is {isDone, results} for tests. ?seconds=N sets the duration.

/** Weights of the time to measure. Costs of options are those of one thread. */
const builds = [
  {name: 'bench', simd: true, hasThreads: false, frames: 1, costs: 2.5},
  {name: 'bench-threads', simd: true, hasThreads: true, frames: 1.75, costs: 0},
  {name: 'bench-scalar', simd: false, hasThreads: false, frames: 1, costs: 2},
  {name: 'bench-scalar-threads', simd: false, hasThreads: true, frames: 1.75, costs: 0},
];
/** The frame of a display of 72 Hz. */
const periodMs = 1000 / 72;

const byId = id => document.getElementById(id);
const seconds = Number(new URLSearchParams(location.search).get('seconds') ?? 60);
const shared = window.pelagicBench = {isDone: false, results: null};

/** Runs a build in a worker of its own, so that its memory and threads end with it. */
function run(build, progress) {
  const weights = builds.reduce((sum, {frames, costs}) => sum + frames + costs, 0);
  const worker = new Worker('worker.js', {type: 'module'});
  return new Promise((resolve, reject) => {
    worker.onmessage = ({data}) => {
      if (data.result) resolve(data.result);
      else if (data.error) reject(new Error(data.error));
      else progress(data.row, data.fraction);
    };
    worker.onerror = event => reject(new Error(event.message ?? 'the worker did not start'));
    worker.postMessage({...build, frameSeconds: seconds * build.frames / weights, costSeconds: seconds * build.costs / weights});
  }).finally(() => worker.terminate());
}

/** Returns the step of the clock in milliseconds. */
function clockStep() {
  let least = Infinity;
  for (let i = 0; i < 20; ++i) {
    const from = performance.now();
    let to = from;
    while (to === from) to = performance.now();
    least = Math.min(least, to - from);
  }
  return least;
}

function gpuName() {
  const gl = document.createElement('canvas').getContext('webgl2');
  const info = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = gl ? gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER) : 'no WebGL 2';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return name;
}

function table(caption, head, rows) {
  const made = document.createElement('table');
  made.createCaption().textContent = caption;
  const cells = (row, kind, texts) => texts.forEach(text => row.append(Object.assign(document.createElement(kind), {textContent: text})));
  cells(made.createTHead().insertRow(), 'th', head);
  const body = made.createTBody();
  for (const row of rows) cells(body.insertRow(), 'td', row);
  return made;
}

const digits = ms => (ms === undefined ? '' : ms.toPrecision(3));
const distinct = values => [...new Set(values)];
const nameOf = ({simd, threads, module_threads: hasThreads}) =>
  `${simd ? 'SIMD' : 'no SIMD'}, ${hasThreads ? `${threads} thread${threads > 1 ? 's' : ''}` : 'without threads'}`;

function show({rows, costs}) {
  const columns = distinct(rows.map(nameOf)), seas = distinct(rows.map(row => row.sea));
  const of = (sea, column) => rows.find(row => row.sea === sea && nameOf(row) === column)?.ours_ms;
  const percent = ms => (ms === undefined ? '' : ` (${(100 * ms / periodMs).toFixed(0)} %)`);
  const costColumns = [true, false].filter(simd => costs.some(row => row.simd === simd));
  const cost = (option, simd) => costs.find(row => row.option === option && row.simd === simd);
  byId('tables').replaceChildren(
    table('Milliseconds a frame (of 13.9 ms)', ['sea', ...columns], seas.map(sea => [sea, ...columns.map(column => digits(of(sea, column)) + percent(of(sea, column)))])),
    table('Milliseconds by option, 4x128 on one thread', ['option', ...costColumns.flatMap(simd => {
      const name = simd ? 'SIMD' : 'no SIMD';
      return [`${name}, warm`, 'ratio', `${name}, 72 Hz`, 'ratio'];
    }), 'MB'], distinct(costs.map(row => row.option)).map(option => [option, ...costColumns.flatMap(simd => {
      const row = cost(option, simd);
      return [digits(row.warm_ms), row.warm_ratio.toFixed(2), digits(row.rhythm_ms), row.rhythm_ratio.toFixed(2)];
    }), (cost(option, costColumns[0]).memory_bytes / 1e6).toFixed(1)])));
}

async function measure() {
  byId('run').disabled = true;
  byId('progress').hidden = false;
  const results = {version: '', user_agent: navigator.userAgent, gpu: gpuName(), cores: navigator.hardwareConcurrency,
                   is_isolated: globalThis.crossOriginIsolated === true, clock_step_ms: clockStep(), seconds, period_ms: periodMs,
                   hashes: {}, errors: {}, rows: [], costs: []};
  for (const [i, build] of builds.entries()) {
    const {name, simd, hasThreads} = build;
    const progress = (row, fraction) => {
      byId('state').textContent = `${simd ? 'SIMD' : 'no SIMD'}${hasThreads ? ', threads' : ''}: ${row}`;
      byId('progress').value = (i + fraction) / builds.length;
    };
    try {
      if (hasThreads && !results.is_isolated) throw new Error('the page is not isolated, so there are no threads');
      const {frames, costs, hash, version} = await run(build, progress);
      results.version = version;
      results.hashes[name] = hash;
      results.rows.push(...frames.map(row => ({sea: `${row.cascades}x${row.n}`, simd, module_threads: hasThreads, ...row})));
      results.costs.push(...costs.map(row => ({simd, ...row})));
    } catch (error) {
      results.errors[name] = error.message;
    }
    if (results.rows.length) show(results);
  }
  byId('json').value = JSON.stringify(results, null, 1);
  byId('results').hidden = byId('progress').hidden = false;
  byId('progress').value = 1;
  const failed = Object.entries(results.errors).map(([name, line]) => `${name}: ${line}`);
  byId('state').textContent = failed.length ? failed.join('; ') : 'Done.';
  byId('run').disabled = false;
  Object.assign(shared, {isDone: true, results});
}

byId('run').addEventListener('click', measure);
byId('copy').addEventListener('click', async () => {
  byId('json').select();
  byId('copy').textContent = await navigator.clipboard?.writeText(byId('json').value).then(() => 'Copied', () => undefined) ?? 'Press Ctrl-C';
});
