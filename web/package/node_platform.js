// What node has otherwise than a page: files, and workers.
import { readFile } from 'node:fs/promises';
import * as os from 'node:os';
import { Worker } from 'node:worker_threads';

export const readBytes = (url) => readFile(url);
export const cores = () => os.availableParallelism?.() ?? os.cpus().length;

/** A worker thread as a page's worker: onmessage and onerror on this side, self.onmessage and postMessage() on the other. */
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

/** Calls `make` where the global Worker is one, which it only needs while it starts. */
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
