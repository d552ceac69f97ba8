/**
 * A hand at one slider, as seen from outside the book's scripts: from an event that moves it to
 * the first animation frame after the one that shows what came of it.
 *
 * The event is given at the start of an animation frame, as browsers give those of a pointer. The
 * next one follows when the last is answered.
 */

/** Longest wait for a frame, in milliseconds. */
const PATIENCE = 20_000;
/**
 * @typedef {{latencies: number[], computes: number[]}} Moved Milliseconds from the event to the
 *   animation frame, and in Python.
 * @typedef {Moved & {levels: string[], rest: string}} Dragged The levels that were shown, and the one
 *   at rest.
 */

/** From a hand's first move to its hold on a slider: nothing new is computed ahead meanwhile. */
const APPROACH = 400;

/**
 * Drag a slider of a figure from end to end and back.
 *
 * @param {{figure: HTMLElement, name: string, moves: number, rounds: number}} hand The slider's
 *   name, into how many moves its way is parted, how often it is walked.
 * @returns {Promise<Dragged>} Of each move.
 */
export async function drag({ figure, name, moves, rounds }) {
  const range = /** @type {HTMLInputElement} */ (figure.querySelector(`input[name="${name}"]`));
  const [before, from, to] = [range.value, Number(range.min), Number(range.max)];
  /** @type {Dragged} */
  const found = { latencies: [], computes: [], levels: [], rest: "" };
  figure.dispatchEvent(new PointerEvent("pointermove", { bubbles: true }));
  await new Promise((resolve) => setTimeout(resolve, APPROACH));
  for (const place of way(moves, rounds)) {
    const last = range.value;
    range.value = String(from + (to - from) * place);
    if (range.value === last) continue;
    found.latencies.push(await answered(figure, range, "input"));
    found.computes.push(Number(figure.dataset.computeMs));
    found.levels.push(level(figure));
  }
  range.value = before;
  for (const type of ["input", "change"]) range.dispatchEvent(new Event(type, { bubbles: true }));
  await resting(figure);
  return { ...found, rest: level(figure) };
}

/**
 * Choose one entry of a list again and again, others in between: as many as a figure may have at
 * hand, so that it draws the one anew.
 *
 * @param {{figure: HTMLElement, name: string, value: string, others: string[], rounds: number}} hand
 * @returns {Promise<Moved>} Of that one.
 */
export async function choose({ figure, name, value, others, rounds }) {
  const list = /** @type {HTMLSelectElement} */ (figure.querySelector(`select[name="${name}"]`));
  /** @type {Moved} */
  const found = { latencies: [], computes: [] };
  for (let round = 0; round < rounds; round += 1) {
    for (const entry of [...others, value]) {
      list.value = entry;
      const latency = await answered(figure, list, "change");
      if (entry !== value) continue;
      found.latencies.push(latency);
      found.computes.push(Number(figure.dataset.computeMs));
    }
  }
  await resting(figure);
  return found;
}

/**
 * Give the event of a control, at the start of an animation frame.
 *
 * @param {HTMLElement} figure
 * @param {HTMLElement} control
 * @param {string} type
 * @returns {Promise<number>} Milliseconds to the animation frame after the one that shows the answer.
 */
async function answered(figure, control, type) {
  await nextFrame();
  const begun = performance.now();
  const painted = frameAfter(figure);
  control.dispatchEvent(new Event(type, { bubbles: true }));
  await painted;
  await nextFrame();
  return performance.now() - begun;
}

/**
 * Turn a slider as fast as events come, for so many frames.
 *
 * @param {{figure: HTMLElement, name: string, frames: number}} hand
 */
export async function exercise({ figure, name, frames }) {
  const range = /** @type {HTMLInputElement} */ (figure.querySelector(`input[name="${name}"]`));
  const [from, to, end] = [Number(range.min), Number(range.max), painted(figure) + frames];
  for (let move = 0; painted(figure) < end; move += 1) {
    range.value = String(from + (to - from) * ((move % 64) / 63));
    range.dispatchEvent(new Event("input", { bubbles: true }));
    await nextFrame();
  }
  await resting(figure);
}

/**
 * Up and down between 0 and 1.
 *
 * @param {number} moves
 * @param {number} rounds
 */
function* way(moves, rounds) {
  for (let round = 0; round < rounds; round += 1) {
    for (let step = 1; step <= moves; step += 1) yield step / moves;
    for (let step = moves - 1; step >= 0; step -= 1) yield step / moves;
  }
}

function nextFrame() {
  return new Promise((resolve) => requestAnimationFrame(resolve));
}

/**
 * The level of the frame that is shown; empty where the scene has only one.
 *
 * @param {HTMLElement} figure
 */
function level({ dataset }) {
  return dataset.level ?? dataset.tier ?? "";
}

/** @param {HTMLElement} figure */
function painted(figure) {
  return Number(figure.dataset.frames ?? 0);
}

/**
 * The next change of `data-frames`.
 *
 * @param {HTMLElement} figure
 * @returns {Promise<void>}
 */
function frameAfter(figure) {
  return new Promise((resolve, reject) => {
    const watch = new MutationObserver(() => over(resolve));
    const late = new Error(`no frame of ${figure.dataset.simulation} within ${PATIENCE} ms`);
    const timer = setTimeout(() => over(() => reject(late)), PATIENCE);
    watch.observe(figure, { attributeFilter: ["data-frames"] });

    /** @param {() => void} settle */
    function over(settle) {
      watch.disconnect();
      clearTimeout(timer);
      settle();
    }
  });
}

/** @param {HTMLElement & {rests?: boolean}} figure */
async function resting(figure) {
  const end = performance.now() + PATIENCE;
  while (!figure.rests && performance.now() < end) await nextFrame();
}
