// How large the drawn image is beside its canvas: smaller where frames take longer than 30 a second.

const goalMs = 33, smallest = 0.25;
/** A frame says little; so many, together, are believed. */
const framesAStep = 12;

export class FrameScale {
  value = 1;
  #times = [];

  /** Goes on with how long a frame took. */
  follow(frameMs) {
    // A page in the background gets no frames.
    if (frameMs <= 0 || frameMs > 5000) return;
    this.#times.push(frameMs);
    const sum = this.#times.reduce((total, ms) => total + ms, 0);
    if (this.#times.length < framesAStep && sum < 1000) return;
    const middle = this.#times.sort((a, b) => a - b)[this.#times.length >> 1];
    this.#times = [];
    // Half of a frame's time is taken as the pixels', so the step falls short rather than swinging.
    if (middle > 1.25 * goalMs) this.value = Math.max(smallest, this.value * Math.max(0.6, Math.sqrt(goalMs / middle)));
    else if (middle < 0.6 * goalMs) this.value = Math.min(1, this.value * 1.1);
  }
}
