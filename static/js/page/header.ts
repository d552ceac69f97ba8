/** The header that stays at the top: how far one has read, and out of the way on small screens. */

import { maybe } from "./dom.ts";

/** Where a line of text is dear: the header leaves as one reads on, and comes as one goes back. */
const SMALL = matchMedia("(max-width: 60rem), (max-height: 30rem)");
/** Scrolled, in pixels, before the header leaves or comes. */
const SLACK = 24;

/** Where the reader last began to go the other way. */
let turnedAt = 0;
let asked = false;

/** Follow how the page is scrolled. */
export function installHeader() {
  addEventListener("scroll", ask, { passive: true });
  addEventListener("resize", ask);
  ask();
}

/** Show how far the page that is shown has been read. */
export function ask() {
  if (asked) return;
  asked = true;
  requestAnimationFrame(follow);
}

function follow() {
  asked = false;
  const header = maybe(document, ".site-header", HTMLElement);
  if (!header) return;
  header.style.setProperty("--read", read().toFixed(4));
  const stays = !SMALL.matches || scrollY < 200 || header.matches(":focus-within") || isOpen();
  header.classList.toggle("away", !stays && isAway(header.classList.contains("away")));
}

/**
 * Whether the header should be away, where it may.
 *
 * @param away Whether it is.
 */
function isAway(away: boolean) {
  turnedAt = away ? Math.max(turnedAt, scrollY) : Math.min(turnedAt, scrollY);
  if (Math.abs(scrollY - turnedAt) <= SLACK) return away;
  turnedAt = scrollY;
  return !away;
}

/** The part of the chapter that has passed the lower edge of the window, once it was scrolled. */
function read() {
  const article = maybe(document, "article.chapter", HTMLElement);
  if (!article) return 0;
  const { top, height } = article.getBoundingClientRect();
  const way = height + top + scrollY - innerHeight;
  return way > 0 ? Math.min(Math.max(scrollY / way, 0), 1) : 1;
}

function isOpen() {
  return document.querySelector("#contents:popover-open") !== null;
}
