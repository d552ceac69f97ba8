/**
 * A figure that plays when it comes into view, once, until a hand is on it; not where the reader
 * asked for less motion. Whatever plays stops where nobody sees it.
 */

import { isAction } from "../../../simulations/engine/controls/action/kind.ts";
import { one } from "../page/dom.ts";
import { isCalm } from "./animate.ts";
import type { Schema } from "./controls.ts";
import type { Motion } from "./motion.ts";

/** Share of the panels that must be in view. */
const IN_VIEW = 0.6;

/** @param signal Ends all watching. */
export function playInView(
  figure: HTMLElement,
  schema: Schema,
  motion: Motion,
  signal: AbortSignal,
) {
  const action = schema.controls.filter(isAction).find(({ arrival }) => arrival);
  let waits = !!action;
  let inView = false;
  const begin = () => {
    if (!waits || !action || !inView || figure.dataset.state !== "live" || isCalm()) return;
    waits = false;
    motion.press(action, performance.now());
  };
  const touched = () => {
    waits = false;
  };
  const observer = new IntersectionObserver(
    (entries) => {
      const last = entries[entries.length - 1];
      inView = last.intersectionRatio >= IN_VIEW;
      if (last.isIntersecting) begin();
      else motion.stop();
    },
    { threshold: [0, IN_VIEW] },
  );
  observer.observe(one(figure, ".panels", HTMLElement));
  signal.addEventListener("abort", () => observer.disconnect());
  figure.addEventListener("painted", begin, { signal });
  for (const type of ["pointerdown", "keydown", "input", "change"]) {
    figure.addEventListener(type, touched, { signal, capture: true });
  }
}
