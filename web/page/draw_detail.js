// The detail of the drawn image by the duration of frames: its scale, mesh and shading, which decrease
// if the frame rate is below 30 per second.

const goalMs = 33;
/** Number of frames of which the median is used. */
const framesAStep = 12;
/** A frame this many times too long takes the last step at once. */
const tooLong = 8;

/** Steps from full detail on: scale, and by how many tiers mesh and shading are below the wanted ones. */
const steps = [
  {scale: 1, mesh: 0, shading: 0},
  {scale: 0.8, mesh: 0, shading: 0},
  {scale: 0.7, mesh: 1, shading: 0},
  {scale: 0.6, mesh: 1, shading: 1},
  {scale: 0.5, mesh: 2, shading: 1},
  {scale: 0.35, mesh: 3, shading: 2},
  {scale: 0.25, mesh: 3, shading: 2},
];

/** Tiers, the cheapest first. */
const meshes = ['low', 'medium', 'high', 'ultra'], shadings = ['headset', 'medium', 'high'];
const below = (tiers, wanted, count) => (tiers.includes(wanted) ? tiers[Math.max(0, tiers.indexOf(wanted) - count)] : wanted);

/** In a headset two eyes are drawn at least 72 times a second. */
export const headsetDetail = ({quality}) => ({quality: quality === 'low' ? quality : 'medium', shading: 'headset'});

/** Returns whether a WebGL context draws on the CPU. */
export function drawsInSoftware(gl) {
  const info = gl.getExtension('WEBGL_debug_renderer_info');
  return Boolean(info) && /swiftshader|llvmpipe|software|basic render/i.test(gl.getParameter(info.UNMASKED_RENDERER_WEBGL));
}

export class DrawDetail {
  #step = 0;
  #times = [];
  #fast = 0;

  /** @param isSlow  begins with the last step */
  constructor(isSlow = false) {
    if (isSlow) this.#step = steps.length - 1;
  }

  /** Returns {scale, quality, shading} for what the user wants. */
  of({quality, shading}) {
    const {scale, mesh, shading: lower} = steps[this.#step];
    return {scale, quality: below(meshes, quality, mesh), shading: below(shadings, shading, lower)};
  }

  /** Takes the duration of a frame. */
  follow(frameMs) {
    if (frameMs <= 0) return;
    this.#times.push(frameMs);
    const sum = this.#times.reduce((total, ms) => total + ms, 0);
    if (this.#times.length < framesAStep && sum < 1000) return;
    const middle = this.#times.sort((a, b) => a - b)[this.#times.length >> 1];
    this.#times = [];
    const last = steps.length - 1;
    if (middle > tooLong * goalMs) this.#step = last;
    else if (middle > 1.25 * goalMs) this.#step = Math.min(last, this.#step + 1);
    // A step back may double the time, so it needs half of the goal, three times.
    this.#fast = middle < 0.5 * goalMs ? this.#fast + 1 : 0;
    if (this.#fast === 3) {
      this.#step = Math.max(0, this.#step - 1);
      this.#fast = 0;
    }
  }
}
