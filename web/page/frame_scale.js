// The scale of the drawn image, which decreases if the frame rate is below 30 per second.

const goalMs = 33, smallest = 0.25;
/** Number of frames of which the median is used. */
const framesAStep = 12;

export class FrameScale {
  value = 1;
  #times = [];

  /** Takes the duration of a frame. */
  follow(frameMs) {
    // Pages in the background receive no frames.
    if (frameMs <= 0 || frameMs > 5000) return;
    this.#times.push(frameMs);
    const sum = this.#times.reduce((total, ms) => total + ms, 0);
    if (this.#times.length < framesAStep && sum < 1000) return;
    const middle = this.#times.sort((a, b) => a - b)[this.#times.length >> 1];
    this.#times = [];
    // Half of the time is taken as proportional to the pixels, so that the scale does not
    // oscillate.
    if (middle > 1.25 * goalMs) this.value = Math.max(smallest, this.value * Math.max(0.6, Math.sqrt(goalMs / middle)));
    else if (middle < 0.6 * goalMs) this.value = Math.min(1, this.value * 1.1);
  }
}
