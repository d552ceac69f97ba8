/**
 * Turning to another chapter without leaving the page, so that the interpreter stays alive.
 * The next page is fetched and its body takes the place of this one. On any doubt the browser
 * loads the page itself; where the host does not answer, this one stays. A page is fetched early when
 * a link to it is pointed at, unless the reader pays for what is fetched.
 */

import { isMetered } from "./data_saver.ts";
import { openFolds } from "./deeper.ts";
import { findAll, hashTarget, isPlainClick, unfold, closestTo } from "./dom.ts";
import { showNotice } from "./notice.ts";
import { isOfRelease } from "./release.ts";
import { words } from "./words.ts";

/** Parts of a head that describe its page, or have addresses relative to it. */
const PAGE_METADATA = [
  'meta[name="description"]',
  'meta[property^="og:"]',
  ...["canonical", "alternate", "manifest"].map((rel) => `link[rel="${rel}"]`),
].join();

/**
 * The book's style sheet in a page's head, which is in this one too; addresses in it differ, so
 * that this page's policy does not know it.
 */
const STYLES = /<style>[\s\S]*?<\/style>/;

let turning: AbortController | null = null;
let currentPath = location.pathname;
let scrollTimer = 0;

/** What a part of pages does. */
export interface Part {
  /** Listen; called once. */
  install(): void;
  /** A page has come into place. */
  setUpPage?(): void;
  /** The address has become another one of the same page. */
  followAddress?(): void;
  /** The page is about to make way for another; its address may be that one's already. */
  leavePage?(page: string): void;
}

/** Install all parts of pages, and call them as pages come and go. */
export function installParts(pageParts: Part[]) {
  const setUpAll = () => {
    for (const part of pageParts) part.setUpPage?.();
  };
  const leaveAll = () => {
    for (const part of pageParts) part.leavePage?.(currentPath);
  };
  for (const part of pageParts) part.install();
  // All pages have the same ones, but from other addresses they are found by whole addresses only.
  for (const link of findAll(document.head, 'link[rel$="icon"]', HTMLLinkElement)) {
    link.setAttribute("href", link.href);
  }
  setUpAll();
  for (const kind of POINTING_EVENTS)
    document.addEventListener(kind, prefetchPointed, { passive: true });
  history.scrollRestoration = "manual";
  if (history.state?.scroll !== undefined) restoreScroll();
  addEventListener("pagehide", leaveAll);
  document.addEventListener("click", (event) => {
    const link = closestTo(event, "a[href]", HTMLAnchorElement);
    const url = link && !event.defaultPrevented && isPlainClick(event) ? linkedPage(link) : null;
    if (!url || document.querySelector("[data-unsaved]")) return; // the browser asks for a confirmation
    event.preventDefault();
    saveScroll();
    turnTo(url, setUpAll, () => {
      leaveAll();
      history.pushState({}, "", url);
    });
  });
  addEventListener("popstate", () => {
    if (isAddressCurrent()) {
      restoreScroll();
      for (const part of pageParts) part.followAddress?.();
    } else turnTo(new URL(location.href), setUpAll, leaveAll);
  });
  addEventListener("scroll", () => {
    clearTimeout(scrollTimer);
    scrollTimer = setTimeout(saveScroll, 100);
  });
  addEventListener("toggle", saveScroll, true);
}

/** Whether the address is that of the present page, and not of one that is still fetched. */
export function isAddressCurrent() {
  return location.pathname === currentPath;
}

async function turnTo(url: URL, setUpAll: () => void, commit: () => void) {
  turning?.abort();
  turning = new AbortController();
  const { signal } = turning;
  try {
    const page = parseBookPage(url, await fetchPage(url, signal));
    if (signal.aborted) return;
    commit();
    const rest = hashTarget() || history.state?.scroll ? null : detachLowerBlocks(page);
    putInPlace(page);
    currentPath = location.pathname;
    if (rest) await firstFrame();
    if (signal.aborted) return;
    rest?.();
    setUpAll();
    document.getElementById("main")?.focus({ preventScroll: true });
    restoreScroll();
  } catch (error) {
    if (signal.aborted) return;
    if (!(error instanceof HostUnreachable)) location.assign(url);
    else {
      const again = () => turnTo(url, setUpAll, commit);
      showNotice(words("page.away"), { label: words("page.again"), act: again });
    }
  }
}

/** The page, if it belongs to the same build of the book. */
function parseBookPage(url: URL, loaded: Page): Document {
  const { type, redirected } = loaded;
  if (!type.startsWith("text/html") || redirected) throw new Error("not a page of the book");
  const page = loaded.early ?? parse(loaded);
  delete loaded.early; // its parts go into this page
  if (!page.querySelector("main#main")) throw new Error("no text in the page");
  if (!isOfRelease(page, url.href)) throw new Error("the book has been built anew");
  return page;
}

function parse({ text }: Page) {
  return new DOMParser().parseFromString(text.replace(STYLES, ""), "text/html");
}

/** Called when the address is already the new page's, so that relative links resolve. */
function putInPlace(page: Document) {
  document.title = page.title;
  const old = document.head.querySelectorAll(PAGE_METADATA);
  document.head.append(...page.head.querySelectorAll(PAGE_METADATA));
  for (const part of old) part.remove();
  for (const name of Object.keys(document.body.dataset)) delete document.body.dataset[name];
  Object.assign(document.body.dataset, page.body.dataset);
  document.body.className = page.body.className;
  document.body.replaceChildren(...page.body.childNodes);
}

/** Blocks of a chapter that fill the window, and some more. */
const FIRST_BLOCKS = 16;

/**
 * Take what is far below the beginning out of a page: it would keep the first figure waiting.
 *
 * @returns Puts it back; null where there is none.
 */
function detachLowerBlocks(page: Document) {
  const all = [...(page.querySelector("article.chapter")?.children ?? [])];
  const blocks = all.slice(firstBlocks(all));
  const place = page.createComment("");
  if (blocks.length === 0) return null;
  blocks[0].before(place);
  for (const block of blocks) block.remove();
  return () => place.replaceWith(...blocks);
}

/** How many blocks come first: a figure finds its parts only where they come with it. */
function firstBlocks(blocks: Element[]) {
  let count = FIRST_BLOCKS;
  for (const [index, block] of blocks.entries()) {
    const leads = ({ dataset }: HTMLElement) => {
      const leader = `#${CSS.escape(dataset.with ?? "")}`;
      return blocks.slice(0, count).some((one) => one.matches(leader) || one.querySelector(leader));
    };
    const parts = findAll(block, "simulation-figure[data-with]", HTMLElement);
    if (parts.some(leads)) count = Math.max(count, index + 1);
  }
  return count;
}

/** Longest wait for a first frame, in milliseconds. */
const FIRST_FRAME_MS = 300;

/** Until the first figure is live, the reader goes on, or `FIRST_FRAME_MS` has passed. */
function firstFrame(): Promise<void> {
  return new Promise((resolve) => {
    const seen = new MutationObserver(() => isLive() && done());
    const isLive = () => document.querySelector("simulation-figure[data-state=live]") !== null;
    const kinds = ["wheel", "keydown", "pointerdown", "touchstart", "scroll"];
    const done = () => {
      seen.disconnect();
      for (const kind of kinds) removeEventListener(kind, done);
      requestAnimationFrame(() => setTimeout(resolve));
    };
    seen.observe(document, { subtree: true, attributeFilter: ["data-state"] });
    for (const kind of kinds) addEventListener(kind, done, { once: true, passive: true });
    setTimeout(done, FIRST_FRAME_MS);
    if (!document.querySelector("simulation-figure")) done();
  });
}

/** Begin reading: at the link's target, where one left off, or at the top. */
function restoreScroll() {
  const target = hashTarget();
  const stored = history.state?.scroll;
  unfold(target);
  if (stored === undefined && target) target.scrollIntoView({ behavior: "instant" });
  else jumpTo(stored ?? 0);
}

/** A smooth scroll that was under way may take one more step after the jump. */
function jumpTo(top: number) {
  scrollTo({ top, behavior: "instant" });
  requestAnimationFrame(() => scrollTo({ top, behavior: "instant" }));
}

function saveScroll() {
  clearTimeout(scrollTimer);
  if (!isAddressCurrent()) return;
  const here = { scroll: Math.round(scrollY), opened: openFolds() };
  changeHistory("replaceState", { ...history.state, ...here });
}

/** Browsers refuse more than some hundred changes within seconds: the history stays as it is then. */
export function changeHistory(change: "replaceState" | "pushState", state: unknown, url?: URL) {
  try {
    history[change](state, "", url);
  } catch {
    // The next change may be taken.
  }
}

const POINTING_EVENTS = ["pointerover", "focusin", "touchstart"];
/** Milliseconds after which a page is fetched again, as the book may have been built anew. */
const VALID_MS = 60_000;

type Page = { text: string; type: string; redirected: boolean; early?: Document };

const prefetched: Map<string, { time: number; page: Promise<Page | null> }> = new Map();

/** The host does not answer. */
class HostUnreachable extends Error {}

function prefetchPointed(event: Event) {
  const link = closestTo(event, "a[href]", HTMLAnchorElement);
  const url = link && linkedPage(link);
  if (url && navigator.onLine && !isMetered()) {
    prefetch(url).then((page) => {
      if (page) page.early ??= parse(page);
    });
  }
}

/** @returns Null where the page does not arrive. */
export function prefetch({ origin, pathname }: URL): Promise<Page | null> {
  const found = prefetched.get(pathname);
  if (found && performance.now() - found.time < VALID_MS) return found.page;
  const page = load(origin + pathname).catch(() => null);
  prefetched.set(pathname, { time: performance.now(), page });
  return page;
}

/** A page of the book, prefetched or fetched now; `HostUnreachable` where the host does not answer. */
async function fetchPage(url: URL, signal: AbortSignal): Promise<Page> {
  const early = prefetched.has(url.pathname) ? await prefetch(url) : null;
  return early ?? load(url.href, signal);
}

async function load(address: string, signal?: AbortSignal): Promise<Page> {
  const reply = await fetch(address, { signal }).catch((error) => {
    throw new HostUnreachable(error);
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
