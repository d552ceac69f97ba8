/**
 * Pages before they are asked for: fetched when a link to them is pointed at, unless the reader pays
 * for what is fetched.
 */

import { within } from "./dom.js";
import { linkedPage } from "./links.js";
import { isMetered } from "./sparing.js";

const HINTS = ["pointerover", "focusin", "touchstart"];
/** Milliseconds after which a page is fetched again, as the book may have been built anew. */
const GOOD = 60_000;

/** @typedef {{text: string, type: string, redirected: boolean}} Page */
/** @type {Map<string, {time: number, page: Promise<Page | null>}>} */
const expected = new Map();

/** The host does not answer. */
export class Away extends Error {}

/** Listen for pointers that come to links. */
export function installAhead() {
  for (const kind of HINTS) document.addEventListener(kind, hint, { passive: true });
}

/**
 * A page of the book, as it was fetched before or comes now.
 *
 * @param {URL} url
 * @param {AbortSignal} [signal]
 * @returns {Promise<Page>}
 * @throws {Away} Where the host does not answer.
 * @throws {Error} Where it has no such page.
 */
export async function fetchText(url, signal) {
  const early = expected.get(url.pathname);
  const isGood = early && performance.now() - early.time < GOOD;
  return (isGood && (await early.page)) || (await load(url.href, signal));
}

/** @param {Event} event */
function hint(event) {
  const link = within(event, "a[href]", HTMLAnchorElement);
  const url = link && linkedPage(link);
  if (url && navigator.onLine && !isMetered()) expect(url);
}

/**
 * Have a page at hand.
 *
 * @param {URL} url
 * @returns {Promise<Page | null>} Nothing where it cannot be had.
 */
export function expect({ origin, pathname }) {
  const early = expected.get(pathname);
  if (early && performance.now() - early.time < GOOD) return early.page;
  const page = load(origin + pathname).catch(() => null);
  expected.set(pathname, { time: performance.now(), page });
  return page;
}

/**
 * @param {string} address
 * @param {AbortSignal} [signal]
 * @returns {Promise<Page>}
 */
async function load(address, signal) {
  const reply = await fetch(address, { signal }).catch((error) => {
    throw new Away(error);
  });
  if (!reply.ok) throw new Error("not a page of the book");
  const { redirected, headers } = reply;
  return { text: await reply.text(), type: headers.get("content-type") ?? "", redirected };
}
