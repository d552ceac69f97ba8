/** Which section is read: its links in the contents are marked, and links to other languages lead to it. */

import { all } from "./dom.ts";

/** A section is read once its heading is above this part of the window. */
const LINE = 0.35;

/** All that lies above counts as in sight: a jump over a heading is noticed, too. */
const headings = new IntersectionObserver(mark, {
  rootMargin: `9999999px 0px -${100 * (1 - LINE)}% 0px`,
});

/** Observe the sections of the page that is shown. */
export function watchSections() {
  headings.disconnect();
  for (const heading of listed()) headings.observe(heading);
}

/** The headings that the contents list, in the order of the page. */
function listed() {
  const links = all(document, "#contents .sections a", HTMLAnchorElement);
  return links.flatMap((link) => document.getElementById(idOf(link)) ?? []);
}

function mark() {
  const current = listed().findLast(
    (heading) => heading.getBoundingClientRect().top < LINE * innerHeight,
  );
  for (const link of all(document, ".other-language", HTMLAnchorElement)) {
    link.hash = current?.id ?? "";
  }
  for (const link of all(document, ".sections a", HTMLAnchorElement)) {
    const isCurrent = current !== undefined && idOf(link) === current.id;
    link.ariaCurrent = isCurrent ? "location" : null;
    if (isCurrent) reveal(link);
  }
}

/** Scroll the list, and nothing else, so that the link is in sight. */
function reveal(link: HTMLElement) {
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
