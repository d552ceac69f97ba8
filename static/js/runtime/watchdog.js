/**
 * Tells a worker that has stopped from one that is at work: by time in which both could run. An
 * hour in which the computer slept, or the tab was hidden and its timers held back, counts nothing.
 */

/** Milliseconds between two looks at the clock; a gap of more than twice as many was no waiting. */
const STEP = 1000;

export class Watchdog {
  /** @type {ReturnType<typeof setInterval> | undefined} */
  #timer;

  /**
   * Wait from now on.
   *
   * @param {number} limit Milliseconds of waiting after which it bites, once.
   * @param {() => void} bite
   */
  watch(limit, bite) {
    this.rest();
    const step = Math.min(limit, STEP);
    let [left, last] = [limit, performance.now()];
    this.#timer = setInterval(() => {
      const now = performance.now();
      if (now - last <= 2 * STEP) left -= now - last;
      last = now;
      if (left > 0) return;
      this.rest();
      bite();
    }, step);
  }

  /** Wait no more. */
  rest() {
    clearInterval(this.#timer);
  }
}
