/**
 * The next chapter's figures before they are asked for: once all of this one live and the hand rests,
 * the scenes of that are imported, so that its figures live as soon as the page is turned, and then
 * their stages computed, so that they answer the first touch.
 */

import { expect } from "../page/ahead.js";
import { all, maybe } from "../page/dom.js";
import { linkedPage } from "../page/links.js";
import { isMetered } from "../page/sparing.js";
import { sharedRuntime } from "../runtime/runtime.js";
import { aheadOf, LEAST_URGENT } from "./warming.js";

/** Milliseconds between two looks, and of rest after the hand has moved. */
const REST = 500;
const LONG_REST = 3000;

let lastInput = 0;

/** Called once. */
export function watchHand() {
  for (const kind of ["pointerdown", "pointermove", "keydown", "input"]) {
    addEventListener(kind, () => (lastInput = performance.now()), { passive: true });
  }
}

/** Called for each page. */
export async function readyNext() {
  const main = document.getElementById("main");
  const rested = async (/** @type {() => boolean} */ isAtRest) => {
    do await new Promise((resolve) => setTimeout(resolve, REST));
    while (main?.isConnected && !isAtRest());
    return main?.isConnected;
  };
  if (isMetered() || !(await rested(allLive)) || !navigator.onLine) return;
  const next = maybe(document, ".pager a[rel=next]", HTMLAnchorElement);
  const url = next && linkedPage(next);
  const page = url && (await expect(url));
  const frames = page ? aheadOf(page.text) : [];
  const imports = [...new Set(frames.map(({ scene }) => scene))].map((scene) => ({ scene }));
  for (const asked of [...imports, ...frames]) {
    if (!handRests() && !(await rested(handRests))) return;
    if (!main?.isConnected) return;
    const name = "tier" in asked ? "warm" : "prepare";
    await sharedRuntime()
      ?.call(name, asked, LEAST_URGENT)
      .catch(() => {}); // told when the figure asks
  }
}

/** Whether there are figures, and all of them live. */
function allLive() {
  const figures = all(document, "simulation-figure", HTMLElement);
  return figures.length > 0 && figures.every(({ dataset }) => dataset.state === "live");
}

/** @param {number} [ms] For how long at least. */
function handRests(ms = REST) {
  return performance.now() - lastInput > ms;
}

/** Whether nothing goes on in the page, and for a while has not. */
export function isAtRest() {
  return allLive() && handRests(LONG_REST);
}
