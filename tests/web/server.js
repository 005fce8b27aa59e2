// A server of folders, whose pages are isolated or not.
import { createReadStream, existsSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';

const types = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm', '.txt': 'text/plain' };

/**
 * @param folders  {"/pelagic/": "/path"}; @returns {Promise<{origin: string, close: () => void}>}
 */
export async function serve(folders, { isIsolated }) {
  const server = createServer((request, response) => {
    const path = normalize(new URL(request.url, 'http://localhost').pathname);
    const mount = Object.keys(folders).find((name) => path.startsWith(name));
    const file = mount && join(folders[mount], path.slice(mount.length));
    if (isIsolated) {
      response.setHeader('Cross-Origin-Opener-Policy', 'same-origin');
      response.setHeader('Cross-Origin-Embedder-Policy', 'require-corp');
    }
    // Pages do not run text as code.
    response.setHeader('Content-Security-Policy', "script-src 'self' 'unsafe-inline' 'wasm-unsafe-eval'");
    if (path === '/') return response.setHeader('Content-Type', 'text/html').end('<!doctype html><title>empty</title>');
    if (path === '/favicon.ico') return response.writeHead(204).end();
    if (!file || !existsSync(file) || !statSync(file).isFile()) return response.writeHead(404).end();
    response.setHeader('Content-Type', types[extname(file)] ?? 'application/octet-stream');
    createReadStream(file).pipe(response);
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return { origin: `http://127.0.0.1:${server.address().port}`, close: () => server.close() };
}
