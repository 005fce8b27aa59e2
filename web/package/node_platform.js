// Files and workers in node.
import { readFile } from 'node:fs/promises';
import * as os from 'node:os';
import { Worker } from 'node:worker_threads';

export const readBytes = (url) => readFile(url);
export const cores = () => os.availableParallelism?.() ?? os.cpus().length;

/** A worker thread with the interface of a page's worker; node_thread.js is its other side. */
export class WebWorker {
  #worker;
  onmessage = null;
  onerror = null;

  constructor(script) {
    this.#worker = new Worker(new URL('./node_thread.js', import.meta.url), { workerData: { script: String(script) } });
    this.#worker.on('message', (data) => this.onmessage?.({ data }));
    this.#worker.on('error', (error) => this.onerror?.({ message: error.message, filename: String(script), lineno: 0 }));
  }

  postMessage(message, transfer) {
    this.#worker.postMessage(message, transfer);
  }

  terminate() {
    this.#worker.terminate();
  }

  ref() {
    this.#worker.ref();
  }

  unref() {
    this.#worker.unref();
  }
}

/** Returns a worker for remote_ocean.js. */
export const oceanWorker = () => new WebWorker(new URL('./worker_thread.js', import.meta.url));

/** Calls `make` with WebWorker as the global Worker, which it needs only while it starts. */
export function withWebWorkers(make) {
  const before = Object.getOwnPropertyDescriptor(globalThis, 'Worker');
  Object.defineProperty(globalThis, 'Worker', { value: WebWorker, configurable: true });
  try {
    make();
  } finally {
    if (before) Object.defineProperty(globalThis, 'Worker', before);
    else delete globalThis.Worker;
  }
}
