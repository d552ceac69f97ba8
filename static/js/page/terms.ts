/**
 * The definition of a term, shown beside its mark: under the mouse, at
 * the focus, or after a tap. Escape puts it away. Without scripts the mark is a link to the
 * glossary, as it stays for a click.
 */

import { closestTo } from "./dom.ts";

/** Before a definition opens under a mouse that may only be passing, and before it closes. */
const PAUSE = 180;

let shown: HTMLElement | null = null;
let timer = 0;

/** Listeners on the document, so that they outlive a change of chapter. */
export function install() {
  document.addEventListener("pointerover", (event) => {
    if (event.pointerType !== "mouse") return;
    const mark = markOf(event);
    clearTimeout(timer);
    if (mark) timer = setTimeout(() => show(mark), PAUSE);
    else if (shown && !isInside(event)) timer = setTimeout(hide, PAUSE);
  });
  document.addEventListener("focusin", (event) => {
    const mark = markOf(event);
    if (mark?.matches(":focus-visible")) show(mark);
    else if (!isInside(event)) hide();
  });
  document.addEventListener("focusout", (event) => markOf(event) && hide());
  document.addEventListener("keydown", ({ key }) => key === "Escape" && hide());
  document.addEventListener("click", (event) => {
    const mark = markOf(event);
    const touched = event instanceof PointerEvent && event.pointerType === "touch";
    if (!mark || !touched) {
      if (!isInside(event)) hide();
      return;
    }
    if (shown === definitionOf(mark)) return; // a second tap follows the link
    event.preventDefault();
    show(mark);
  });
}

function markOf(event: Event) {
  return closestTo(event, "a.term", HTMLAnchorElement);
}

function isInside(event: Event) {
  return closestTo(event, ".definition", HTMLElement) !== null;
}

function definitionOf(mark: HTMLAnchorElement) {
  return document.getElementById(mark.getAttribute("aria-describedby") ?? "");
}

function show(mark: HTMLAnchorElement) {
  clearTimeout(timer);
  const definition = definitionOf(mark);
  if (definition === shown || !definition || !mark.isConnected) return;
  hide();
  // The mark becomes its anchor: `references.css` places it there.
  (definition as any).showPopover({ source: mark });
  shown = definition;
}

function hide() {
  clearTimeout(timer);
  if (shown?.isConnected) shown.hidePopover();
  shown = null;
}
