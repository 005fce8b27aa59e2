#!/usr/bin/env node
// Serves a folder on localhost: `serve.mjs FOLDER [PORT]`, any free port unless it is given. Prints the address; Ctrl-C ends it.
//
// Pages are isolated (COOP and COEP), so that they may have threads, and WebAssembly has its type, so that it compiles while it loads.
import {createReadStream} from 'node:fs';
import {realpath, stat} from 'node:fs/promises';
import {createServer} from 'node:http';
import {extname, join, resolve, sep} from 'node:path';

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
if (!/^\d+$/.test(portText) || port > 65535) fail(`PORT is ${portText}, needs 0 to 65535`);

/** The file that is asked for, or nothing: none outside the folder, through a link neither. */
async function fileOf(url) {
  const path = decodeURIComponent(new URL(url, 'http://localhost').pathname);
  const wanted = await realpath(join(folder, path.endsWith('/') ? `${path}index.html` : path));
  if (!wanted.startsWith(folder + sep)) throw new Error('outside');
  const {size} = await stat(wanted);
  return {wanted, size};
}

const server = createServer(async (request, response) => {
  if (request.method !== 'GET' && request.method !== 'HEAD') return response.writeHead(405, {...headers, Allow: 'GET, HEAD'}).end();
  try {
    const {wanted, size} = await fileOf(request.url);
    response.writeHead(200, {...headers, 'Content-Length': size, 'Content-Type': types[extname(wanted)] ?? 'application/octet-stream'});
    if (request.method === 'HEAD') return response.end();
    createReadStream(wanted).on('error', () => response.destroy()).pipe(response);
  } catch {
    response.writeHead(404, {...headers, 'Content-Type': 'text/plain'}).end('There is no such file.\n');
  }
});
server.on('error', error => fail(error.code === 'EADDRINUSE' ? `port ${port} is taken: give another one` : error.message));
server.listen(port, '127.0.0.1', () => console.log(`http://localhost:${server.address().port}/`));
for (const signal of ['SIGINT', 'SIGTERM']) process.on(signal, () => process.exit(0));
