#!/usr/bin/env node
// A server of a folder on localhost: `serve.mjs FOLDER [PORT]`. The default is a free port. Prints
// the address. Ctrl-C ends it.
//
// Pages are isolated (COOP and COEP), so that they may have threads. WebAssembly has its media
// type, so that browsers compile it while it loads.
import {constants} from 'node:fs';
import {open, realpath} from 'node:fs/promises';
import {createServer} from 'node:http';
import {extname, join, posix, resolve, sep} from 'node:path';
import {pipeline} from 'node:stream/promises';

const types = {
  '.css': 'text/css; charset=utf-8',
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript; charset=utf-8',
  '.json': 'application/json',
  '.mjs': 'text/javascript; charset=utf-8',
  '.png': 'image/png',
  '.wasm': 'application/wasm',
};
const headers = {
  'Cache-Control': 'no-cache',
  'Cross-Origin-Embedder-Policy': 'require-corp',
  'Cross-Origin-Opener-Policy': 'same-origin',
  'X-Content-Type-Options': 'nosniff',
};

function fail(line) {
  console.error(`serve: ${line}`);
  process.exit(1);
}

const [folderText, portText = '0'] = process.argv.slice(2);
if (!folderText) fail('which folder? serve.mjs FOLDER [PORT]');
const folder = await realpath(resolve(folderText)).catch(() => fail(`there is no folder ${folderText}`));
const port = Number(portText);
if (!/^\d+$/.test(portText) || port > 65535) fail(`PORT is ${portText}, expected 0 to 65535`);

/**
 * Opens the regular file or folder of a path; the caller closes it. Throws for paths outside of the
 * served folder, also through links.
 */
async function openPath(path) {
  const file = await realpath(join(folder, decodeURIComponent(path)));
  if (file !== folder && !file.startsWith(folder + sep)) throw new Error('outside');
  // Does not wait for the writer of a FIFO.
  const handle = await open(file, constants.O_RDONLY | (constants.O_NONBLOCK ?? 0));
  try {
    const status = await handle.stat();
    if (!status.isFile() && !status.isDirectory()) throw new Error('neither a file nor a folder');
    return {handle, file, size: status.size, isFolder: status.isDirectory()};
  } catch (error) {
    await handle.close();
    throw error;
  }
}

async function serve(request, response) {
  const {pathname, search} = new URL(request.url, 'http://localhost');
  const {handle, file, size, isFolder} = await openPath(pathname.endsWith('/') ? `${pathname}index.html` : pathname);
  try {
    if (isFolder) return response.writeHead(301, {...headers, Location: `./${posix.basename(pathname)}/${search}`}).end();
    response.writeHead(200, {...headers, 'Content-Length': size, 'Content-Type': types[extname(file)] ?? 'application/octet-stream'});
    if (request.method === 'HEAD' || size === 0) return response.end();
    // Closes the file also if the reader disconnects.
    await pipeline(handle.createReadStream({end: size - 1}), response);
  } finally {
    await handle.close();
  }
}

const server = createServer(async (request, response) => {
  if (request.method !== 'GET' && request.method !== 'HEAD') return response.writeHead(405, {...headers, Allow: 'GET, HEAD'}).end();
  try {
    await serve(request, response);
  } catch {
    if (response.headersSent) return response.destroy();
    response.writeHead(404, {...headers, 'Content-Type': 'text/plain'}).end('There is no such file.\n');
  }
});
server.on('error', error => fail(error.code === 'EADDRINUSE' ? `port ${port} is taken: give another one` : error.message));
server.listen(port, '127.0.0.1', () => console.log(`http://localhost:${server.address().port}/`));
for (const signal of ['SIGINT', 'SIGTERM']) process.on(signal, () => process.exit(0));
