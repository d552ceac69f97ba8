/**
 * Highlights everything with the colour of the element under the pointer. Words, symbols and readouts
 * dim the rest of the nearest figure, and mark the same colour in the text and the controls that move
 * it. Controls and handles only mark the text: whoever moves them needs the whole picture.
 */

import { findAll, findOptional } from "../page/dom.ts";
import { named } from "./controls.ts";

/** Milliseconds that a pointer must rest: one that passes highlights nothing. */
const REST = 150;

let timer = 0;
let pointed: Element | null = null;
let leaving = new AbortController();

/** The reader points at, or has focused, something that may have a colour. */
export function highlightFrom(element: Element) {
  const figure = nearestFigure(element);
  const role = figure && roleOf(element, figure);
  if (element === pointed || !role) return;
  clear();
  pointed = element;
  leaving = new AbortController();
  for (const type of ["pointerleave", "focusout"]) {
    element.addEventListener(type, clear, { signal: leaving.signal });
  }
  timer = setTimeout(() => {
    const text = figure.closest("article");
    if (text) text.dataset.lit = role;
    if (element.matches(".control, .handle")) return;
    for (const control of controlsOf(figure, role)) control.classList.add("driven");
    // A figure that draws nothing in that colour has nothing to dim.
    if (figure.querySelector(`.overlay .${role}`)) figure.dataset.lit = role;
  }, REST);
}

function clear() {
  clearTimeout(timer);
  leaving.abort();
  if (pointed && !pointed.matches(".control, .handle")) {
    for (const { classList } of document.querySelectorAll(".control.driven")) {
      classList.remove("driven");
    }
  }
  pointed = null;
  for (const lit of findAll(document, "[data-lit]", HTMLElement)) delete lit.dataset.lit;
}

/** The colour of an element; of a control, the colour of the handle that drives it. */
function roleOf(element: Element, figure: HTMLElement): string | undefined {
  const name = element.matches(".control") && element.querySelector("[name]")?.getAttribute("name");
  const driving = `[data-handle][data-drives~="${CSS.escape(name || "")}"]`;
  const coloured = name ? findOptional(figure, driving, HTMLElement) : element;
  return /(?:^|\s)role-(\w+)/.exec(coloured?.getAttribute("class") ?? "")?.[1];
}

/** The controls that a handle of this colour drives. */
function controlsOf(figure: HTMLElement, role: string) {
  const handles = findAll(figure, `.handle.role-${role}`, HTMLElement);
  const names = new Set(handles.flatMap(({ dataset }) => (dataset.drives ?? "").split(" ")));
  return [...names].flatMap((name) => figure.querySelector(named(name))?.closest(".control") ?? []);
}

/** The figure that an element stands in, or the one that lies least far above or below it. */
function nearestFigure(element: Element): HTMLElement | null {
  const inside = element.closest("figure.simulation");
  if (inside) return findOptional(inside, "simulation-figure", HTMLElement);
  const here = element.getBoundingClientRect();
  const distance = (figure: HTMLElement) => {
    const { top, bottom } = figure.getBoundingClientRect();
    return Math.max(top - here.bottom, here.top - bottom);
  };
  const figures = findAll(document, "simulation-figure", HTMLElement);
  return figures.sort((one, other) => distance(one) - distance(other))[0] ?? null;
}
