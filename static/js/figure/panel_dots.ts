/**
 * Panels that stand in a strip: a dot for each brings it into view and tells which is shown.
 * Where panels stand side by side there are no dots, and nothing to do.
 */

import { all, within } from "../page/dom.ts";

/** Listen for presses on dots, and for panels that are scrolled. */
export function installPanelDots() {
  document.addEventListener("click", (event) => {
    const dot = within(event, ".panel-dots > button", HTMLButtonElement);
    if (dot) show(dot);
  });
  document.addEventListener("scroll", pushed, { capture: true, passive: true });
}

function show(dot: HTMLButtonElement) {
  const dots = dot.parentElement;
  const strip = dots?.previousElementSibling?.querySelector(".other-panels");
  if (!dots || !strip) return;
  strip.scrollTo({ left: (way(strip) * Number(dot.dataset.place)) / (dots.children.length - 1) });
}

function pushed({ target }: Event) {
  if (!(target instanceof HTMLElement) || !target.matches(".other-panels")) return;
  const dots = target.parentElement?.nextElementSibling;
  if (!dots?.matches(".panel-dots")) return;
  const place = Math.round((target.scrollLeft / way(target)) * (dots.children.length - 1));
  for (const dot of all(dots, "button", HTMLButtonElement)) {
    dot.ariaCurrent = Number(dot.dataset.place) === place ? "true" : null;
  }
}

/** How far a strip can be pushed, in pixels. */
function way(strip: Element) {
  return Math.max(1, strip.scrollWidth - strip.clientWidth);
}
