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
  const moves = PLACES.flatMap((place) => sliders.map((slider) => ({ ...slider, place })));
  // The last is of the present values: its stages are cached, whatever moves first.
  const first = sliders.slice(0, 1).map((slider) => ({ ...slider, place: null }));
  let left = LONGEST_MS;
  for (const { name, min, max, place } of [...moves, ...first]) {
    while (isUntouched() && !(isNear() && isQuiet())) {
      await new Promise((done) => setTimeout(done, REST_MS));
    }
    if (!isUntouched()) return;
    if (left < 0 && place !== null) continue;
    const begun = performance.now();
    const moved = place === null ? {} : { [name]: min + place * (max - min) };
    await render(JSON.stringify({ ...values, ...moved }), levels.moving(name, begun));
    levels.settle(name);
    left -= performance.now() - begun;
  }
}
