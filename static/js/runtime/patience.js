/** How long the page waits for an answer: on a slow machine longer, by what that has shown so far. */

/**
 * Longest wait for an answer in milliseconds, on a machine of usual speed. `first`: of a scene's
 * first call, which imports it. Starting includes the download, which may be slow on any machine.
 *
 * @type {Record<string, number>}
 */
export const LIMITS = {
  start: 300_000,
  first: 30_000,
  prepare: 30_000,
  warm: 10_000,
  render: 10_000,
  renderEdited: 10_000,
  pull: 10_000,
  photograph: 10_000,
  error: 10_000,
  judge: 10_000,
  forget: 10_000,
  script: 10_000,
  measure: 120_000,
};

/**
 * Longest that a reader's own code may take for a frame, in milliseconds; where the book's takes long,
 * so many times as long.
 */
export const EDITED = { ms: 5000, times: 10 };
/** Milliseconds in which a machine of usual speed imports the simulations. */
const USUAL_IMPORT = 500;
/** How many times slower a machine may seem: more than this is rather one that slept meanwhile. */
const SLOWEST = 12;
/** How many times as long as its slowest frame so far a scene may take for its next. */
const TIMES = 20;

export class Patience {
  #pace = 1;
  /** @type {Map<string, number>} */
  #slowest = new Map();

  /**
   * The interpreter has started.
   *
   * @param {number} importMs What importing the simulations took.
   */
  started(importMs) {
    this.#pace = Math.min(SLOWEST, Math.max(1, importMs / USUAL_IMPORT));
  }

  /**
   * A frame has come.
   *
   * @param {string} scene
   * @param {number} computeMs What Python took for it.
   */
  learn(scene, computeMs) {
    this.#slowest.set(scene, Math.max(computeMs, this.#slowest.get(scene) ?? 0));
  }

  /**
   * @param {string} name Of the call, or `first`.
   * @param {string} [scene] What it is about.
   * @returns {number} Milliseconds.
   */
  limit(name, scene = "") {
    if (name === "start") return LIMITS.start;
    return Math.max(LIMITS[name] * this.#pace, TIMES * (this.#slowest.get(scene) ?? 0));
  }
}
