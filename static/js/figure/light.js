/**
 * Words, symbols and readouts light up what else has the colour of their idea: in the figure
 * nearest to them the rest steps back, and in the text the same colour is marked.
 */

import { all } from "../page/dom.js";

/** Milliseconds that a pointer must rest on a word: one that passes lights nothing. */
const REST = 150;

let timer = 0;
/** @type {Element | null} */
let pointed = null;
/** @type {AbortController | null} */
let leaving = null;

/**
 * The reader points at, or has focused, something that has a colour.
 *
 * @param {Element} element
 */
export function point(element) {
  const role = /(?:^|\s)role-(\w+)/.exec(element.getAttribute("class") ?? "")?.[1];
  const figure = nearestFigure(element);
  if (element === pointed || !role || !figure) return;
  put(null);
  pointed = element;
  leaving = new AbortController();
  const { signal } = leaving;
  for (const type of ["pointerleave", "blur"]) {
    element.addEventListener(type, () => put(null), { signal });
  }
  timer = setTimeout(() => put(figure, role), REST);
}

/**
 * Light a role in a figure and in the text, or nothing.
 *
 * @param {HTMLElement | null} figure
 * @param {string} [role]
 */
function put(figure, role = "") {
  clearTimeout(timer);
  if (!figure) {
    leaving?.abort();
    pointed = null;
  }
  for (const lit of all(document, "[data-lit]", HTMLElement)) delete lit.dataset.lit;
  if (!figure) return;
  // A figure that draws nothing in that colour has nothing to step back from.
  if (figure.querySelector(`.overlay .${role}`)) figure.dataset.lit = role;
  const text = figure.closest("article");
  if (text) text.dataset.lit = role;
}

/**
 * The figure that an element stands in, or the one that lies least far above or below it.
 *
 * @param {Element} element
 * @returns {HTMLElement | null}
 */
function nearestFigure(element) {
  const inside = element.closest("figure.simulation")?.querySelector("simulation-figure");
  if (inside instanceof HTMLElement) return inside;
  const here = element.getBoundingClientRect();
  const far = (/** @type {HTMLElement} */ figure) => {
    const { top, bottom } = figure.getBoundingClientRect();
    return Math.max(top - here.bottom, here.top - bottom);
  };
  const figures = all(document, "simulation-figure", HTMLElement);
  return figures.sort((one, other) => far(one) - far(other))[0] ?? null;
}
