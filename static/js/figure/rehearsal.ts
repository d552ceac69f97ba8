/**
 * Frames that nobody sees: while the reader rests, the sliders of a figure in view move a few times at
 * the level with which a drag would begin. Browsers compile machine code better once it has run
 * often, and the times say which level this device draws in time; so the first frames of a drag are
 * in time as well.
 */

import { isSlider } from "../../../simulations/engine/controls/slider/kind.ts";
import type { FrameReply } from "../runtime/messages.ts";
import type { Schema } from "./controls.ts";
import type { FigureLevels } from "./levels.ts";

/** Milliseconds of rest after the last input. */
const REST_MS = 500;
/** Where sliders move to, as shares of their ranges. The times of the first are of cold code. */
const PLACES = [0.3, 0.7, 0.4, 0.6];
const COLD = 1;
/** Longest that a figure is rehearsed, in milliseconds, however slow the device. */
const LONGEST_MS = 1500;
/** Milliseconds from the frame of the worker to the pixels. */
const PAINT_MS = 4;

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
  render: (values: string, tier: string) => Promise<FrameReply>,
  isUntouched: () => boolean,
  isNear: () => boolean,
) {
  const sliders = controls.filter(isSlider);
  let left = LONGEST_MS;
  for (const [round, place] of PLACES.entries()) {
    for (const { name, min, max } of sliders) {
      while (isUntouched() && !(isNear() && isQuiet())) {
        await new Promise((done) => setTimeout(done, REST_MS));
      }
      if (left < 0 || !isUntouched()) return;
      const begun = performance.now();
      const tier = levels.moving(name, begun);
      await render(JSON.stringify({ ...values, [name]: min + place * (max - min) }), tier);
      const now = performance.now();
      left -= now - begun;
      if (round >= COLD) levels.shown(name, tier, false, now - begun + PAINT_MS, now);
      levels.settle(name);
    }
  }
  if (!sliders.length) return;
  const [{ name }] = sliders; // the stages of the present frame, for whatever moves first
  await render(JSON.stringify(values), levels.moving(name, performance.now()));
  levels.settle(name);
}
