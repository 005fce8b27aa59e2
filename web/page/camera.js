// The camera, which orbits a point or flies, as that of the native viewer (viewer/view_camera.cpp).
// y is up, and a heading of 0 looks along +x.

const steepestRad = 1.5, nearestM = 1, furthestM = 3000, lowestM = -50, highestM = 5000;
const radiansAPixel = 0.004, slowestMps = 8, nearPlaneM = 0.1;

const clamp = (value, least, most) => Math.min(Math.max(value, least), most);
/** Rounds for links, to centimetres and tenths of a milliradian. */
const rounded = (value, digits) => Number(value.toFixed(digits));

/** The camera of the settings that begin with `camera`. */
export class Camera {
  constructor(settings) {
    this.take(settings);
  }

  take(settings) {
    this.eye = [settings.cameraXM, settings.cameraYM, settings.cameraZM];
    this.heading = settings.cameraHeadingRad;
    this.pitch = settings.cameraPitchRad;
    this.distance = settings.cameraDistanceM;
    this.fov = settings.cameraFovRad;
    this.flies = settings.cameraFlies;
  }

  settings() {
    return {
      cameraXM: rounded(this.eye[0], 2),
      cameraYM: rounded(this.eye[1], 2),
      cameraZM: rounded(this.eye[2], 2),
      cameraHeadingRad: rounded(this.heading, 4),
      cameraPitchRad: rounded(this.pitch, 4),
      cameraDistanceM: rounded(this.distance, 2),
      cameraFovRad: rounded(this.fov, 4),
      cameraFlies: this.flies,
    };
  }

  ahead() {
    const across = Math.cos(this.pitch);
    return [across * Math.cos(this.heading), Math.sin(this.pitch), across * Math.sin(this.heading)];
  }

  /** Turns by a drag in pixels, around the target or around the eye. */
  turn(right, down) {
    const target = this.target();
    this.heading += right * radiansAPixel;
    this.heading -= 2 * Math.PI * Math.round(this.heading / (2 * Math.PI));
    this.pitch = clamp(this.pitch - down * radiansAPixel, -steepestRad, steepestRad);
    if (!this.flies) this.stand(target);
  }

  /** Scales the distance to the target; a flying camera moves ahead or back. */
  zoom(factor) {
    if (this.flies) return this.move([0, 0, (1 - factor) * 20]);
    const target = this.target();
    this.distance = clamp(this.distance * factor, nearestM, furthestM);
    this.stand(target);
  }

  /** Moves to the right, up and ahead, metres. */
  move([right, up, ahead]) {
    const direction = this.ahead();
    const horizontal = [-Math.sin(this.heading), 0, Math.cos(this.heading)];
    for (let axis = 0; axis < 3; ++axis) this.eye[axis] += right * horizontal[axis] + ahead * direction[axis];
    this.eye[1] = clamp(this.eye[1] + up, lowestM, highestM);
  }

  /** Moves by the pressed keys; the speed increases with the height. */
  fly(keys, seconds) {
    const held = name => (keys.has(name) ? 1 : 0);
    const metres = seconds * Math.max(slowestMps, Math.abs(this.eye[1]));
    const way = [held('KeyD') - held('KeyA'), held('KeyR') - held('KeyF'), held('KeyW') - held('KeyS')];
    if (way.some(part => part)) this.move(way.map(part => part * metres));
    const turns = [held('ArrowRight') - held('ArrowLeft'), held('ArrowDown') - held('ArrowUp')];
    if (turns.some(part => part)) this.turn(turns[0] * seconds * 250, turns[1] * seconds * 250);
  }

  target() {
    const direction = this.ahead();
    return this.eye.map((at, axis) => at + this.distance * direction[axis]);
  }

  stand(target) {
    const direction = this.ahead();
    this.eye = target.map((at, axis) => at - this.distance * direction[axis]);
    this.eye[1] = clamp(this.eye[1], lowestM, highestM);
  }

  /** Returns column-major matrices, as in WebGL and WebXR, with the far plane at infinity. */
  matrices(aspect) {
    const f = this.ahead();
    const right = [-Math.sin(this.heading), 0, Math.cos(this.heading)];
    const up = [right[1] * f[2] - right[2] * f[1], right[2] * f[0] - right[0] * f[2], right[0] * f[1] - right[1] * f[0]];
    const dot = axis => -(axis[0] * this.eye[0] + axis[1] * this.eye[1] + axis[2] * this.eye[2]);
    const back = f.map(part => -part);
    const view = new Float64Array([
      right[0], up[0], back[0], 0,
      right[1], up[1], back[1], 0,
      right[2], up[2], back[2], 0,
      dot(right), dot(up), dot(back), 1]);
    // In portrait images the field of view is that of the width, which would be narrow on phones.
    const scale = 1 / Math.tan(this.fov / 2) * Math.min(1, Math.sqrt(aspect));
    const projection = new Float64Array([
      scale / aspect, 0, 0, 0,
      0, scale, 0, 0,
      0, 0, -1, -1,
      0, 0, -2 * nearPlaneM, 0]);
    return {view, projection};
  }
}

/** Connects mouse, touch and keys of the canvas. Returns the set of pressed keys. */
export function followInput(canvas, camera) {
  const pointers = new Map(), keys = new Set();
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  canvas.addEventListener('pointerdown', event => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
  });
  canvas.addEventListener('pointermove', event => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const now = {x: event.clientX, y: event.clientY};
    if (pointers.size === 2) {
      const earlier = spread();
      pointers.set(event.pointerId, now);
      camera.zoom(earlier / Math.max(spread(), 1));
    } else {
      pointers.set(event.pointerId, now);
      camera.turn(now.x - before.x, now.y - before.y);
    }
  });
  for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, event => pointers.delete(event.pointerId));
  canvas.addEventListener('wheel', event => {
    event.preventDefault();
    camera.zoom(0.9 ** clamp(-event.deltaY / 100, -3, 3));
  }, {passive: false});
  const isTyping = event => event.target.matches('input, select') || event.ctrlKey || event.metaKey || event.altKey;
  addEventListener('keydown', event => {
    if (isTyping(event)) return;
    keys.add(event.code);
    if (event.code.startsWith('Arrow')) event.preventDefault();
  });
  addEventListener('keyup', event => keys.delete(event.code));
  addEventListener('blur', () => keys.clear());
  return keys;
}
