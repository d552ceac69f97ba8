/**
 * What follows from how a page is scrolled: the header, which shows how far one has read and is out
 * of the way on small screens; the section that is read, marked in the contents; and what can be
 * pushed sideways, which can be focused so that arrow keys push it.
 */

import { findAll, findOptional } from "./dom.ts";

/** Small windows, in which the header leaves as one reads on and comes as one goes back. */
const SMALL_SCREEN = matchMedia("(max-width: 60rem), (max-height: 30rem)");
/** Scrolled, in pixels, before the header leaves or comes. */
const SLACK = 24;

/** Where the reader last began to go the other way. */
let turnedAt = 0;
let isScheduled = false;

/** Called once. */
export function install() {
  addEventListener("scroll", schedule, { passive: true });
  addEventListener("resize", schedule);
  addEventListener("hashchange", () => openContents()?.hidePopover());
}

function schedule() {
  if (isScheduled) return;
  isScheduled = true;
  requestAnimationFrame(updateHeader);
}

function updateHeader() {
  isScheduled = false;
  const header = findOptional(document, ".site-header", HTMLElement);
  if (!header) return;
  header.style.setProperty("--read", readShare().toFixed(4));
  const stays =
    !SMALL_SCREEN.matches ||
    scrollY < 200 ||
    header.matches(":focus-within") ||
    openContents() !== null;
  header.classList.toggle("away", !stays && isHeaderAway(header.classList.contains("away")));
}

/**
 * Whether the header should be away, where it may.
 *
 * @param away Whether it is.
 */
function isHeaderAway(away: boolean) {
  turnedAt = away ? Math.max(turnedAt, scrollY) : Math.min(turnedAt, scrollY);
  if (Math.abs(scrollY - turnedAt) <= SLACK) return away;
  turnedAt = scrollY;
  return !away;
}

/** The part of the chapter that has passed the lower edge of the window, once it was scrolled. */
function readShare() {
  const article = findOptional(document, "article.chapter", HTMLElement);
  if (!article) return 0;
  const { top, height } = article.getBoundingClientRect();
  const range = height + top + scrollY - innerHeight;
  return range > 0 ? Math.min(Math.max(scrollY / range, 0), 1) : 1;
}

function openContents() {
  return findOptional(document, "#contents:popover-open", HTMLElement);
}

/** Called for each page. */
export function setUpPage() {
  schedule();
  watchSections();
  watchScrollers();
}

/** A section is read once its heading is above this part of the window. */
const LINE = 0.35;

/** All that lies above counts as in sight: a jump over a heading is noticed, too. */
const headings = new IntersectionObserver(markCurrentSection, {
  rootMargin: `9999999px 0px -${100 * (1 - LINE)}% 0px`,
});

function watchSections() {
  headings.disconnect();
  for (const heading of listedHeadings()) headings.observe(heading);
}

/** The headings that the contents list and that are not folded up, in the order of the page. */
function listedHeadings() {
  const links = findAll(document, "#contents .sections a", HTMLAnchorElement);
  return links.flatMap((link) => document.getElementById(idOf(link)) ?? []).filter(isVisible);
}

function markCurrentSection() {
  const current = listedHeadings().findLast(
    (heading) => heading.getBoundingClientRect().top < LINE * innerHeight,
  );
  for (const link of findAll(document, ".sections a", HTMLAnchorElement)) {
    const isCurrent = current !== undefined && idOf(link) === current.id;
    link.ariaCurrent = isCurrent ? "location" : null;
    if (isCurrent) scrollListTo(link);
  }
}

/** Scroll the list, and nothing else, so that the link is in sight. */
function scrollListTo(link: HTMLElement) {
  const list = link.closest(".contents > ol");
  if (!list || list.scrollHeight <= list.clientHeight) return;
  const [inner, outer] = [link.getBoundingClientRect(), list.getBoundingClientRect()];
  if (inner.top < outer.top || inner.bottom > outer.bottom) {
    list.scrollTop += inner.top - outer.top - list.clientHeight / 3;
  }
}

function idOf(link: HTMLAnchorElement) {
  return decodeURIComponent(link.hash.slice(1));
}

const SCROLLERS =
  ".other-panels, .formula, .table-wrapper, .nowrap, :is(p, li, .explanation) > math, pre";

const sizes = new ResizeObserver((entries) => toggleFocusable(entries.map(({ target }) => target)));

function watchScrollers() {
  sizes.disconnect();
  for (const box of document.querySelectorAll(SCROLLERS)) sizes.observe(box);
  // A font that comes late makes the contents wider, and not the box. What is not shown, as it is
  // folded up, is not laid out for this: the observer reports it once it is.
  document.fonts.ready.then(() =>
    toggleFocusable([...document.querySelectorAll(SCROLLERS)].filter(isVisible)),
  );
}

function isVisible(box: Element) {
  return box.checkVisibility?.({ contentVisibilityAuto: true }) ?? true;
}

/** Sizes of all boxes are read before one is changed, or the page would be laid out for each. */
function toggleFocusable(boxes: Element[]) {
  const wrong = boxes.filter((box) => isScrollable(box) !== box.hasAttribute("tabindex"));
  for (const box of wrong) {
    if (box.hasAttribute("tabindex")) box.removeAttribute("tabindex");
    else box.setAttribute("tabindex", "0");
  }
}

function isScrollable(box: Element) {
  return box.scrollWidth > box.clientWidth + 1 && getComputedStyle(box).overflowX !== "visible";
}
