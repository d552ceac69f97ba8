/**
 * A hand at one slider, as seen from outside the book's scripts: from an event that moves it to
 * the first animation frame after the one that shows what came of it.
 *
 * The event is given at the start of an animation frame, as browsers give those of a pointer. The
 * next one follows when the last is answered.
 */

/** Longest wait for a frame, in milliseconds. */
const PATIENCE = 5000;

const nextFrame = () => new Promise((resolve) => requestAnimationFrame(() => resolve()));

/**
 * Drag a slider from end to end and back.
 *
 * @param {{figure: string, name: string, moves: number, rounds?: number}} hand The element id of
 *   the figure, the slider's name, into how many moves its way is parted, how often it is walked.
 * @returns {Promise<{latencies: number[], computes: number[], heard: number[]}>} Milliseconds of
 *   each move: from event to animation frame, in Python, from event to the attribute of the frame.
 */
export async function drag({ figure: id, name, moves, rounds = 1 }) {
  const figure = document.querySelector(`#${CSS.escape(id)} simulation-figure`);
  const range = figure.querySelector(`input[name="${CSS.escape(name)}"]`);
  const [before, from, to] = [range.value, Number(range.min), Number(range.max)];
  const found = { latencies: [], computes: [], heard: [] };
  for (const place of way(moves, rounds)) {
    const last = range.value;
    range.value = String(from + (to - from) * place);
    if (range.value === last) continue;
    await nextFrame();
    const begun = performance.now();
    const painted = frameAfter(figure);
    range.dispatchEvent(new Event("input", { bubbles: true }));
    await painted;
    const heard = performance.now();
    await nextFrame();
    found.latencies.push(performance.now() - begun);
    found.heard.push(heard - begun);
    found.computes.push(Number(figure.dataset.computeMs));
  }
  range.value = before;
  range.dispatchEvent(new Event("input", { bubbles: true }));
  range.dispatchEvent(new Event("change", { bubbles: true }));
  await resting(figure);
  return found;
}

/** Up and down between 0 and 1, each place once on the way. */
function* way(moves, rounds) {
  for (let round = 0; round < rounds; round += 1) {
    for (let step = 1; step <= moves; step += 1) yield step / moves;
    for (let step = moves - 1; step >= 0; step -= 1) yield step / moves;
  }
}

/** The next change of `data-frames`. */
function frameAfter(figure) {
  return new Promise((resolve, reject) => {
    const watch = new MutationObserver(() => {
      watch.disconnect();
      clearTimeout(timer);
      resolve();
    });
    const timer = setTimeout(() => {
      watch.disconnect();
      reject(new Error(`no frame of ${figure.dataset.simulation} within ${PATIENCE} ms`));
    }, PATIENCE);
    watch.observe(figure, { attributeFilter: ["data-frames"] });
  });
}

/** Until the frame that was asked for last is shown. */
export async function resting(figure) {
  const end = performance.now() + PATIENCE;
  while (!figure.rests && performance.now() < end) await nextFrame();
  await nextFrame();
}
