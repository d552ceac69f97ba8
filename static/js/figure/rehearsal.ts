/**
 * Frames that nobody sees: while the reader rests, the sliders of a figure in view move a few times,
 * at the level with which a drag would begin. Browsers compile machine code better once it has run
 * often; so the first frames of a drag are in time as well.
 */

import { isSlider } from "../../../simulations/engine/controls/slider/kind.ts";
import type { Schema } from "./controls.ts";
import type { FigureLevels } from "./levels.ts";

/** Milliseconds of rest after the last input. */
const REST_MS = 500;
/** Where sliders move to, as shares of their ranges. */
const PLACES = [0.3, 0.7, 0.4, 0.6];
/** Longest that a figure is rehearsed, in milliseconds, however slow the device. */
const LONGEST_MS = 1500;

let lastInput = 0;

export function watchInput() {
  for (const kind of ["pointerdown", "pointermove", "keydown", "input"]) {
    addEventListener(kind, () => (lastInput = performance.now()), { passive: true });
  }
}

/** Whether the reader has done nothing for a while. */
export function isQuiet() {
  return performance.now() - lastInput > REST_MS;
}

/**
 * @param render Requests a frame.
 * @param isUntouched Whether it is still of use.
 * @param isNear Whether the figure is near the window.
 */
export async function rehearse(
  { controls, values }: Schema,
  levels: FigureLevels,
  render: (values: string, tier: string) => Promise<unknown>,
  isUntouched: () => boolean,
  isNear: () => boolean,
) {
  const sliders = controls.filter(isSlider);
  const end = sliders.slice(0, 1).map(({ name }) => [name, values[name]] as const);
  const moves = PLACES.flatMap((place) =>
    sliders.map(({ name, min, max }) => [name, min + place * (max - min)] as const),
  );
  let left = LONGEST_MS;
  // At the end, the present frame: its stages are cached, whatever moves first.
  for (const [number, [name, value]] of [...moves, ...end].entries()) {
    while (isUntouched() && !(isNear() && isQuiet())) {
      await new Promise((done) => setTimeout(done, REST_MS));
    }
    if (!isUntouched()) return;
    if (left < 0 && number < moves.length) continue;
    const begun = performance.now();
    const tier = levels.moving(name, begun);
    await render(JSON.stringify({ ...values, [name]: value }), tier);
    levels.settle(name);
    left -= performance.now() - begun;
  }
}
