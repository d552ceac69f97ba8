/**
 * A chapter that has just been opened is laid out as far as the window shows it, and painted: who
 * touches a figure there need not wait for what is far below. That stands in by estimate
 * (`unfolding.css`) until the hand rests, a moment later; then it is laid out step by step, and
 * nothing is left of this. Places, searches and scrolling are those of any page.
 */

import { all, within } from "./dom.js";
import { idle, painted } from "./pauses.js";

/** On the root where the page's head, which comes before the blocks, has found that they may wait. */
const UNFOLDING = "unfolding";
/** On a block that waits. */
const FOLDED = "data-folded";
/** Blocks that a window shows, and more. */
const SHOWN = 8;
/** Those that never wait, and those that do not on a page that is loaded: as in `unfolding.css`. */
const CHEAP = ".heading";
const LOADED = ".heading, form, .simulation";
/** What waits of a block that does not. */
const DEAR = ".panel-view";
/** Milliseconds after which a step ends. */
const STEP = 8;
/** Milliseconds for a first touch. */
const REST = 100;

const { classList } = document.documentElement;

/** Who goes to another place of the page needs to know where that is. */
export function installUnfolding() {
  const away = (/** @type {Event} */ event) => within(event, 'a[href*="#"]', Element);
  document.addEventListener("click", (event) => away(event) && layOut(), { capture: true });
}

/**
 * Have what is far below the top of a page stand in.
 *
 * @param {Document} page
 * @param {string} [apart] Blocks that do not.
 */
export function fold(page, apart = CHEAP) {
  for (const block of all(page, ".chapter > *", Element).slice(SHOWN)) {
    const parts = block.matches(apart) ? all(block, DEAR, Element) : [block];
    for (const part of parts) part.setAttribute(FOLDED, "");
  }
}

/**
 * Lay out what stands in, when nobody waits.
 *
 * @returns {Promise<boolean>} Whether the page is still there.
 */
export async function unfold() {
  const main = document.getElementById("main");
  if (classList.contains(UNFOLDING)) fold(document, LOADED);
  classList.remove(UNFOLDING);
  if (folded().length) {
    await painted();
    await new Promise((resolve) => setTimeout(resolve, REST));
  }
  for (const waiting = folded(); main?.isConnected && waiting.length;) {
    await idle();
    const begun = performance.now();
    do layOutInside(waiting.shift());
    while (waiting.length && performance.now() - begun < STEP);
  }
  if (main?.isConnected) layOut();
  return main?.isConnected ?? false;
}

/** Lay out what stands in, now. */
export function layOut() {
  for (const block of folded()) block.removeAttribute(FOLDED);
}

/**
 * Lay out what is in a block that still stands in: nothing else moves, and nothing is painted. What
 * is closed in it stays as it is, so it is asked for one part of it only.
 *
 * @param {Element | undefined} block
 */
function layOutInside(block) {
  if (!block) return;
  const inside = block.firstElementChild ?? document.createRange();
  if (inside instanceof Range) inside.selectNodeContents(block);
  inside.getBoundingClientRect();
}

function folded() {
  return all(document, `[${FOLDED}]`, Element);
}
