/**
 * Links from one page of the book to another. Pages are fetched when a link to them is pointed at,
 * unless the reader pays for what is fetched.
 */

import { isMetered } from "./data_saver.ts";
import { within } from "./dom.ts";

const HINTS = ["pointerover", "focusin", "touchstart"];
/** Milliseconds after which a page is fetched again, as the book may have been built anew. */
const VALID = 60_000;

export type Page = { text: string; type: string; redirected: boolean };

const prefetched: Map<string, { time: number; page: Promise<Page | null> }> = new Map();

/** The host does not answer. */
export class HostError extends Error {}

/** Called once. */
export function installPrefetch() {
  for (const kind of HINTS) document.addEventListener(kind, hint, { passive: true });
}

function hint(event: Event) {
  const link = within(event, "a[href]", HTMLAnchorElement);
  const url = link && linkedPage(link);
  if (url && navigator.onLine && !isMetered()) prefetch(url);
}

/** @returns Null where the page does not arrive. */
export function prefetch({ origin, pathname }: URL): Promise<Page | null> {
  const found = prefetched.get(pathname);
  if (found && performance.now() - found.time < VALID) return found.page;
  const page = load(origin + pathname).catch(() => null);
  prefetched.set(pathname, { time: performance.now(), page });
  return page;
}

/** A page of the book, prefetched or fetched now; `HostError` where the host does not answer. */
export async function fetchPage(url: URL, signal: AbortSignal): Promise<Page> {
  const early = prefetched.has(url.pathname) ? await prefetch(url) : null;
  return early ?? load(url.href, signal);
}

async function load(address: string, signal?: AbortSignal): Promise<Page> {
  const reply = await fetch(address, { signal }).catch((error) => {
    throw new HostError(error);
  });
  if (!reply.ok) throw new Error("not a page of the book");
  const { redirected, headers } = reply;
  return { text: await reply.text(), type: headers.get("content-type") ?? "", redirected };
}

/** Where a link leads, if that is another page of the book, or another state of its figures. */
export function linkedPage(link: HTMLAnchorElement): URL | null {
  const { root } = document.body.dataset;
  if (root === undefined || link.target || link.hasAttribute("download")) return null;
  const url = new URL(link.href);
  const book = new URL(root || "./", location.href).href;
  const inBook = url.href.startsWith(book) && /(\/|\.html)$/.test(url.pathname);
  const isOther = url.pathname + url.search !== location.pathname + location.search;
  return inBook && isOther ? url : null;
}
