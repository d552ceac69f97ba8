/**
 * Notices that a worker does not answer. Only time in which it could run counts: not an hour in which
 * the computer slept, or the tab was hidden and its timers were delayed.
 */

/** Milliseconds between two looks at the clock; a gap of more than twice as many was sleep. */
const STEP = 1000;

export class Watchdog {
  #timer: ReturnType<typeof setInterval> | undefined;

  /**
   * @param limit In milliseconds.
   * @param act Called once it has passed.
   */
  start(limit: number, act: () => void) {
    this.stop();
    let [left, last] = [limit, performance.now()];
    this.#timer = setInterval(
      () => {
        const now = performance.now();
        if (now - last <= 2 * STEP) left -= now - last;
        last = now;
        if (left > 0) return;
        this.stop();
        act();
      },
      Math.min(limit, STEP),
    );
  }

  stop() {
    clearInterval(this.#timer);
  }
}
