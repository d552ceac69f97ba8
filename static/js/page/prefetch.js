/** Pages are fetched when a link to them is pointed at, unless the reader pays for what is fetched. */

import { isMetered } from "./data_saver.js";
import { within } from "./dom.js";
import { linkedPage } from "./links.js";

const HINTS = ["pointerover", "focusin", "touchstart"];
/** Milliseconds after which a page is fetched again, as the book may have been built anew. */
const VALID = 60_000;

/** @typedef {{text: string, type: string, redirected: boolean}} Page */
/** @type {Map<string, {time: number, page: Promise<Page | null>}>} */
const prefetched = new Map();

/** The host does not answer. */
export class HostError extends Error {}

/** Called once. */
export function installPrefetch() {
  for (const kind of HINTS) document.addEventListener(kind, hint, { passive: true });
}

/** @param {Event} event */
function hint(event) {
  const link = within(event, "a[href]", HTMLAnchorElement);
  const url = link && linkedPage(link);
  if (url && navigator.onLine && !isMetered()) prefetch(url);
}

/**
 * @param {URL} url
 * @returns {Promise<Page | null>} Null where the page does not arrive.
 */
export function prefetch({ origin, pathname }) {
  const found = prefetched.get(pathname);
  if (found && performance.now() - found.time < VALID) return found.page;
  const page = load(origin + pathname).catch(() => null);
  prefetched.set(pathname, { time: performance.now(), page });
  return page;
}

/**
 * A page of the book, prefetched or fetched now.
 *
 * @param {URL} url
 * @param {AbortSignal} signal
 * @returns {Promise<Page>}
 * @throws {HostError} Where the host does not answer.
 * @throws {Error} Where it has no such page.
 */
export async function fetchPage(url, signal) {
  const early = prefetched.has(url.pathname) ? await prefetch(url) : null;
  return early ?? load(url.href, signal);
}

/**
 * @param {string} address
 * @param {AbortSignal} [signal]
 * @returns {Promise<Page>}
 */
async function load(address, signal) {
  const reply = await fetch(address, { signal }).catch((error) => {
    throw new HostError(error);
  });
  if (!reply.ok) throw new Error("not a page of the book");
  const { redirected, headers } = reply;
  return { text: await reply.text(), type: headers.get("content-type") ?? "", redirected };
}
