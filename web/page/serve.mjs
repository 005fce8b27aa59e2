#!/usr/bin/env node
// A server of a folder on localhost: `serve.mjs FOLDER [PORT] [--https]`. The default is a free port.
// Prints the address. Ctrl-C ends it.
//
// --https serves every machine of the network, because WebXR needs HTTPS there, and prints an address
// for each of its interfaces. openssl makes a certificate, which browsers ask to accept.
//
// Pages are isolated (COOP and COEP), so that they may have threads. WebAssembly has its media
// type, so that browsers compile it while it loads.
import {spawnSync} from 'node:child_process';
import {constants, mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {open, realpath} from 'node:fs/promises';
import {createServer} from 'node:http';
import {createServer as createHttpsServer} from 'node:https';
import {networkInterfaces, tmpdir} from 'node:os';
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

const words = process.argv.slice(2);
const isSecure = words.includes('--https');
const [folderText, portText = '0'] = words.filter(word => word !== '--https');
if (!folderText) fail('which folder? serve.mjs FOLDER [PORT] [--https]');
const folder = await realpath(resolve(folderText)).catch(() => fail(`there is no folder ${folderText}`));
const port = Number(portText);
if (!/^\d+$/.test(portText) || port > 65535) fail(`PORT is ${portText}, expected 0 to 65535`);

/** Returns the IPv4 addresses of this machine by which others reach it. */
function addressesHere() {
  return Object.values(networkInterfaces()).flat().filter(one => one.family === 'IPv4' && !one.internal).map(one => one.address);
}

/** Returns {key, cert} of a certificate for this machine's names, valid for a month, or {reason}. */
function certificate() {
  const folder = mkdtempSync(join(tmpdir(), 'serve_'));
  const key = join(folder, 'key.pem'), cert = join(folder, 'cert.pem');
  const names = ['DNS:localhost', ...['127.0.0.1', ...addressesHere()].map(address => `IP:${address}`)];
  try {
    const made = spawnSync('openssl', ['req', '-x509', '-newkey', 'ec', '-pkeyopt', 'ec_paramgen_curve:prime256v1', '-nodes', '-days', '30',
      '-subj', '/CN=pelagic', '-addext', `subjectAltName=${names}`, '-keyout', key, '-out', cert], {encoding: 'utf8'});
    if (made.error) return {reason: '--https needs the program openssl, which is not installed'};
    if (made.status !== 0) return {reason: `--https: openssl made no certificate: ${made.stderr.trim().split('\n').pop()}`};
    return {key: readFileSync(key), cert: readFileSync(cert)};
  } finally {
    rmSync(folder, {recursive: true, force: true});
  }
}

function makeServer() {
  if (!isSecure) return createServer(answer);
  const {reason, ...keys} = certificate();
  if (reason) fail(reason);
  return createHttpsServer(keys, answer);
}

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

async function answer(request, response) {
  if (request.method !== 'GET' && request.method !== 'HEAD') return response.writeHead(405, {...headers, Allow: 'GET, HEAD'}).end();
  try {
    await serve(request, response);
  } catch {
    if (response.headersSent) return response.destroy();
    response.writeHead(404, {...headers, 'Content-Type': 'text/plain'}).end('There is no such file.\n');
  }
}

function showAddresses() {
  const {port: used} = server.address();
  const names = isSecure ? ['localhost', ...addressesHere()] : ['localhost'];
  console.log(names.map(name => `${isSecure ? 'https' : 'http'}://${name}:${used}/`).join('\n'));
}

const server = makeServer();
server.on('error', error => fail(error.code === 'EADDRINUSE' ? `port ${port} is taken: give another one` : error.message));
server.listen(port, isSecure ? '0.0.0.0' : '127.0.0.1', showAddresses);
for (const signal of ['SIGINT', 'SIGTERM']) process.on(signal, () => process.exit(0));
