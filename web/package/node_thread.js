// The thread of a WebWorker (node_platform.js). It gives the script the globals of a page's worker.
import { parentPort, workerData } from 'node:worker_threads';

globalThis.self = globalThis;
globalThis.location = { href: workerData.script };
globalThis.importScripts = () => {};
globalThis.postMessage = (message, transfer) => parentPort.postMessage(message, transfer);
await import(workerData.script);
parentPort.on('message', (data) => globalThis.onmessage({ data }));
