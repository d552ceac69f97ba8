/**
 * The definition of a term, shown beside its mark while the mark is looked at: under the mouse, at
 * the focus, or after a tap. Escape puts it away. Without scripts the mark is a link to the
 * glossary, as it stays for a click.
 */

import { within } from "./dom.js";

/** Before a definition opens under a mouse that may only be passing, and before it closes. */
const PAUSE = 180;
const GAP = 6;
const MARGIN = 8;

/** @type {HTMLElement | null} */
let shown = null;
let timer = 0;

/** Listeners on the document, so that they outlive a change of chapter. */
export function install() {
  document.addEventListener("pointerover", (event) => {
    if (event.pointerType !== "mouse") return;
    const mark = markOf(event);
    clearTimeout(timer);
    if (mark) timer = setTimeout(() => show(mark), PAUSE);
    else if (shown && !within(event, ".definition", HTMLElement)) timer = setTimeout(hide, PAUSE);
  });
  document.addEventListener("focusin", (event) => {
    const mark = markOf(event);
    if (mark?.matches(":focus-visible")) show(mark);
    else if (!within(event, ".definition", HTMLElement)) hide();
  });
  document.addEventListener("focusout", (event) => {
    if (markOf(event)) hide();
  });
  document.addEventListener("keydown", (event) => {
    if (event.key === "Escape") hide();
  });
  document.addEventListener("click", (event) => {
    const mark = markOf(event);
    const touched = event instanceof PointerEvent && event.pointerType === "touch";
    if (!mark || !touched) {
      if (!within(event, ".definition", HTMLElement)) hide();
      return;
    }
    if (shown === definitionOf(mark)) return; // a second tap follows the link
    event.preventDefault();
    show(mark);
  });
}

/** @param {Event} event */
function markOf(event) {
  return within(event, "a.term", HTMLAnchorElement);
}

/** @param {HTMLAnchorElement} mark */
function definitionOf(mark) {
  return document.getElementById(mark.getAttribute("aria-describedby") ?? "");
}

/** @param {HTMLAnchorElement} mark */
function show(mark) {
  clearTimeout(timer);
  const definition = definitionOf(mark);
  if (definition === shown || !definition || !mark.isConnected) return;
  hide();
  definition.showPopover();
  shown = definition;
  place(definition, mark.getClientRects()[0] ?? mark.getBoundingClientRect());
}

function hide() {
  clearTimeout(timer);
  if (shown?.isConnected) shown.hidePopover();
  shown = null;
}

/**
 * Below the mark, or above where there is no room; within the window.
 *
 * @param {HTMLElement} definition
 * @param {DOMRect} mark
 */
function place(definition, mark) {
  const { width, height } = definition.getBoundingClientRect();
  const right = document.documentElement.clientWidth - width - MARGIN;
  const fits = mark.bottom + GAP + height < innerHeight;
  const top = fits ? mark.bottom + GAP : mark.top - GAP - height;
  definition.style.left = `${scrollX + Math.max(MARGIN, Math.min(mark.left, right))}px`;
  definition.style.top = `${scrollY + top}px`;
}
