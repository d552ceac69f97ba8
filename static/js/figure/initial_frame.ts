/** The frame that a page comes with: drawn when the book was built, by the Python that the worker runs. */

import type { Schema } from "./controls.ts";

/** Whether an untouched figure shows the frame of its page, and that is the frame asked for. */
export function isInitial(
  { dataset }: HTMLElement,
  { controls, values, default_tier: tier }: Schema,
  asked: { values: string; tier: string },
) {
  const initial = Object.fromEntries(controls.map(({ name }) => [name, values[name]]));
  const untouched = dataset.frames === "0" && dataset.early === undefined;
  return untouched && tier === asked.tier && JSON.stringify(initial) === asked.values;
}
