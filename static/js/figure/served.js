/**
 * The frame that a page comes with. It was drawn when the book was built, by the Python that the
 * worker runs: while nothing has been touched, it is what a live frame would be.
 */

/** @import { Schema } from "./controls.js" */

/**
 * Whether the figure still shows the frame of its page, and that is the frame of these values.
 *
 * @param {HTMLElement} figure
 * @param {Schema} schema
 * @param {{values: string, tier: string}} asked
 */
export function isServed(figure, schema, { values, tier }) {
  const untouched = figure.dataset.frames === "0" && figure.dataset.early === undefined;
  return untouched && tier === schema.default_tier && values === servedValues(schema);
}

/**
 * The values of a page's frame, as a figure asks for them.
 *
 * @param {Schema} schema
 */
export function servedValues({ controls, values }) {
  return JSON.stringify(Object.fromEntries(controls.map(({ name }) => [name, values[name]])));
}

/**
 * Whether the page's frames were drawn by these sources, which the worker has.
 *
 * @param {string} sources
 */
export function isOfPage(sources) {
  return sources === document.body.dataset.sources;
}
