/**
 * Turning to another chapter without leaving the page, so that the interpreter stays alive.
 * The next page is fetched and its body takes the place of this one. On any doubt the browser
 * loads the page itself; where the host does not answer, this one stays.
 */

import { all, isPlain, within } from "./dom.ts";
import { notice } from "./notice.ts";
import { HostError, fetchPage, linkedPage } from "./prefetch.ts";
import { isOfRelease } from "./release.ts";
import { useWordsOf, words } from "./words.ts";

/** What a head says of its own page, or with addresses relative to it. */
const OF_A_PAGE = [
  'meta[name="description"]',
  'meta[property^="og:"]',
  ...["icon", "apple-touch-icon", "canonical", "alternate", "manifest"].map(
    (rel) => `link[rel="${rel}"]`,
  ),
].join();

/**
 * The book's style sheet in a page's head, which is in this one too; addresses in it differ, so
 * that this page's policy does not know it.
 */
const STYLES = /<style>[\s\S]*?<\/style>/;

let turning: AbortController | null = null;
let shownPath = location.pathname;
let scrollTimer = 0;

/**
 * Listen for links to other pages of the book.
 *
 * @param turned Called when a new page has been put in place.
 * @param returned Called when another state of this page is to be shown.
 * @param leave Called with the path of the page that is about to go.
 */
export function installNavigation(
  turned: () => void,
  returned: () => void,
  leave: (page: string) => void,
) {
  history.scrollRestoration = "manual";
  if (history.state?.scroll !== undefined) restoreScroll();
  const leaveShown = () => leave(shownPath);
  addEventListener("pagehide", leaveShown);
  document.addEventListener("click", (event) => {
    const link = within(event, "a[href]", HTMLAnchorElement);
    const url = link && !event.defaultPrevented && isPlain(event) ? linkedPage(link) : null;
    if (!url) return;
    event.preventDefault();
    // In another language, the figures are as they were left.
    if (link?.matches(".other-language")) url.search = location.search;
    saveScroll();
    turnTo(url, turned, () => {
      leaveShown();
      history.pushState({}, "", url);
    });
  });
  addEventListener("popstate", () => {
    if (isArrived()) {
      restoreScroll();
      returned();
    } else turnTo(new URL(location.href), turned, leaveShown);
  });
  addEventListener("scroll", () => {
    clearTimeout(scrollTimer);
    scrollTimer = setTimeout(saveScroll, 100);
  });
}

/** Whether the address is of the page that is shown, and not of one that is still fetched. */
export function isArrived() {
  return location.pathname === shownPath;
}

async function turnTo(url: URL, turned: () => void, commit: () => void) {
  turning?.abort();
  turning = new AbortController();
  const { signal } = turning;
  try {
    const page = parsed(url, await fetchPage(url, signal));
    if (signal.aborted) return;
    // Until it has others, the browser finds the icons from the next page's address, too.
    for (const link of all(document.head, "link[rel=icon]", HTMLLinkElement)) {
      link.setAttribute("href", link.href);
    }
    commit();
    putInPlace(page);
    shownPath = location.pathname;
    turned();
    document.getElementById("main")?.focus({ preventScroll: true });
    restoreScroll();
  } catch (error) {
    if (signal.aborted) return;
    if (!(error instanceof HostError)) location.assign(url);
    else {
      const again = () => turnTo(url, turned, commit);
      notice(words("page.away"), { label: words("page.again"), act: again });
    }
  }
}

/** The page, if it belongs to the same build of the book. */
function parsed(url: URL, { text, type, redirected }: import("./prefetch.ts").Page): Document {
  if (!type.startsWith("text/html") || redirected) throw new Error("not a page of the book");
  const page = new DOMParser().parseFromString(text.replace(STYLES, ""), "text/html");
  if (!page.querySelector("main#main")) throw new Error("no text in the page");
  if (!isOfRelease(page, url.href)) throw new Error("the book has been built anew");
  return page;
}

/** Called when the address is already the new page's, so that relative links resolve. */
function putInPlace(page: Document) {
  document.title = page.title;
  document.documentElement.lang = page.documentElement.lang;
  useWordsOf(page);
  const old = document.head.querySelectorAll(OF_A_PAGE);
  document.head.append(...page.head.querySelectorAll(OF_A_PAGE));
  for (const part of old) part.remove();
  for (const name of Object.keys(document.body.dataset)) delete document.body.dataset[name];
  Object.assign(document.body.dataset, page.body.dataset);
  document.body.className = page.body.className;
  document.body.replaceChildren(...page.body.childNodes);
}

/** Begin reading: at the link's target, where one left off, or at the top. */
function restoreScroll() {
  const target = hashTarget();
  const stored = history.state?.scroll;
  if (stored === undefined && target) target.scrollIntoView();
  else jumpTo(stored ?? 0);
}

/** A smooth scroll that was under way may take one more step after the jump. */
function jumpTo(top: number) {
  scrollTo({ top, behavior: "instant" });
  requestAnimationFrame(() => scrollTo({ top, behavior: "instant" }));
}

/** The element that the address points to; none where its end is mangled. */
export function hashTarget() {
  try {
    return document.getElementById(decodeURIComponent(location.hash.slice(1)));
  } catch {
    return null;
  }
}

function saveScroll() {
  clearTimeout(scrollTimer);
  if (!isArrived()) return;
  history.replaceState({ ...history.state, scroll: Math.round(scrollY) }, "");
}
