/** The first handle of a page moves once as it comes into view, to show that it can be dragged. */

import { maybe, within } from "../page/dom.ts";
import { isCalm } from "./animate.ts";

/** Milliseconds for which the handle shows what it is for. */
const SHOWN = 3200;

/** Whether the reader has used a figure, here or on an earlier page. */
let used = false;

export function watchHands() {
  for (const kind of ["pointerdown", "keydown"]) {
    document.addEventListener(kind, (event) => {
      if (!within(event, "simulation-figure", HTMLElement)) return;
      used = true;
      maybe(document, ".nudged", HTMLElement)?.classList.remove("nudged");
    });
  }
}

/** Called for each page. Before its figure is live, a handle is not displayed and not in view. */
export function nudgeFirstHandle() {
  const handle = maybe(document, ".handle:not(.drag, .aim, [hidden])", HTMLElement);
  if (!handle || isCalm()) return;
  const watcher = new IntersectionObserver(
    ([{ isIntersecting }]) => {
      if (!isIntersecting) return;
      watcher.disconnect();
      if (used) return;
      handle.classList.add("nudged");
      setTimeout(() => handle.classList.remove("nudged"), SHOWN);
    },
    { threshold: 1, rootMargin: "-15% 0px" },
  );
  watcher.observe(handle);
}
