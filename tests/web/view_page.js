// The page of view_test.mjs: a module for SeaView, and the matrices of cameras.
import createPelagicView from './page/pelagic_view.js';
import {XrSession} from './page/xr_session.js';

const canvas = document.querySelector('canvas');
const started = performance.now();
const module = await createPelagicView({canvas});
const moduleMs = performance.now() - started;

const minus = (a, b) => a.map((v, i) => v - b[i]);
const dot = (a, b) => a.reduce((sum, v, i) => sum + v * b[i], 0);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = a => a.map(v => v / Math.hypot(...a));

/** Returns the matrices of an eye as in WebXR. The far plane must not affect the image. */
function eyeOf({position, target, verticalViewRad}, viewport) {
  const back = unit(minus(position, target)), right = unit(cross([0, 1, 0], back)), up = cross(back, right);
  const axes = [right, up, back];
  const view = [0, 1, 2].flatMap(i => [...axes.map(axis => axis[i]), 0]).concat(axes.map(axis => -dot(axis, position)), 1);
  const near = 0.1, far = 900, f = 1 / Math.tan(verticalViewRad / 2);
  const projection = [f * viewport[3] / viewport[2], 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, 2 * far * near / (near - far), 0];
  return {viewport, view: new Float32Array(view), projection: new Float32Array(projection)};
}

/** Returns RGBA of the bound framebuffer, the upper row first, in base 64. */
function pixels(gl, width, height) {
  const rows = new Uint8Array(4 * width * height), upright = new Uint8Array(rows.length);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, rows);
  for (let y = 0; y < height; ++y) upright.set(rows.subarray(4 * width * y, 4 * width * (y + 1)), 4 * width * (height - 1 - y));
  let text = '';
  for (let i = 0; i < upright.length; i += 8192) text += String.fromCharCode(...upright.subarray(i, i + 8192));
  return btoa(text);
}

function resize(width, height) {
  canvas.width = width;
  canvas.height = height;
}

window.tested = {module, moduleMs, canvas, eyeOf, pixels, resize, XrSession};
