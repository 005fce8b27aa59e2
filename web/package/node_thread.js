// The other side of node_platform.js's WebWorker: a thread of node that looks like a page's worker to the script that it runs.
import { parentPort, workerData } from 'node:worker_threads';

globalThis.self = globalThis;
globalThis.location = { href: workerData.script };
globalThis.importScripts = () => {};
globalThis.postMessage = (message, transfer) => parentPort.postMessage(message, transfer);
await import(workerData.script);
parentPort.on('message', (data) => globalThis.onmessage({ data }));
