/**
 * Moves of a slider, timed independently of the book's scripts, from the event to the first
 * animation frame after the one that shows the result.
 *
 * Events are dispatched at the start of an animation frame, as browsers do with pointer events; the
 * next event follows after the last result.
 */

/** Longest wait for a frame, in milliseconds. */
const PATIENCE = 20_000;
/**
 * @typedef {{latencies: number[], computes: number[]}} Moved Milliseconds from the event to the
 *   animation frame, and in Python.
 * @typedef {Moved & {levels: string[], rest: string}} Dragged The levels of the moves, and the level
 *   at rest.
 */

/** From the pointer's first move to its first event; nothing is computed in advance meanwhile. */
const APPROACH = 400;

/**
 * Drag a slider of a figure from end to end and back.
 *
 * @param {{figure: HTMLElement, name: string, moves: number, rounds: number}} hand The slider's
 *   name, the number of moves from end to end, and the number of rounds.
 * @returns {Promise<Dragged>} With an entry for each move.
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
    found.latencies.push(await latencyOf(figure, range, "input"));
    found.computes.push(Number(figure.dataset.computeMs));
    found.levels.push(level(figure));
  }
  range.value = before;
  for (const type of ["input", "change"]) range.dispatchEvent(new Event(type, { bubbles: true }));
  await untilAtRest(figure);
  return { ...found, rest: level(figure) };
}

/**
 * Choose one entry of a list again and again, with enough others in between that its frame leaves
 * the cache.
 *
 * @param {{figure: HTMLElement, name: string, value: string, others: string[], rounds: number}} hand
 * @returns {Promise<Moved>} For that entry.
 */
export async function choose({ figure, name, value, others, rounds }) {
  const list = /** @type {HTMLSelectElement} */ (figure.querySelector(`select[name="${name}"]`));
  /** @type {Moved} */
  const found = { latencies: [], computes: [] };
  for (let round = 0; round < rounds; round += 1) {
    for (const entry of [...others, value]) {
      list.value = entry;
      const latency = await latencyOf(figure, list, "change");
      if (entry !== value) continue;
      found.latencies.push(latency);
      found.computes.push(Number(figure.dataset.computeMs));
    }
  }
  await untilAtRest(figure);
  return found;
}

/**
 * Dispatch an event of a control at the start of an animation frame.
 *
 * @param {HTMLElement} figure
 * @param {HTMLElement} control
 * @param {string} type
 * @returns {Promise<number>} Milliseconds to the animation frame after the one that shows the result.
 */
async function latencyOf(figure, control, type) {
  await nextFrame();
  const begun = performance.now();
  const painted = frameAfter(figure);
  control.dispatchEvent(new Event(type, { bubbles: true }));
  await painted;
  await nextFrame();
  return performance.now() - begun;
}

/**
 * Move a slider in each animation frame, until the figure has drawn so many frames.
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
  await untilAtRest(figure);
}

/**
 * Positions up and down between 0 and 1.
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
 * The level of the present frame; empty if the scene has only one.
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
async function untilAtRest(figure) {
  const end = performance.now() + PATIENCE;
  while (!figure.rests && performance.now() < end) await nextFrame();
}
