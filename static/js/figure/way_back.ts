/** From a figure that a link of the text led to, out of its own view, one press leads back. */

import { maybe, one } from "../page/dom.ts";
import { words } from "../page/words.ts";

/** Longest wait for the page to be scrolled, in milliseconds. */
const SCROLL = 1000;

/** @returns Once a scroll that begins now has ended, or after `limit` milliseconds. */
export function scrolled(limit = SCROLL): Promise<unknown> {
  return new Promise((resolve) => {
    document.addEventListener("scrollend", resolve, { once: true });
    setTimeout(resolve, limit);
  });
}

/** Offer the way back to a link, if the page has been scrolled away from it, until it is seen again. */
export function offerWayBack(link: HTMLElement) {
  maybe(document, ".way-back", HTMLElement)?.remove();
  const { top, bottom } = link.getBoundingClientRect();
  if (bottom > 0 && top < innerHeight) return;
  const button = document.createElement("button");
  button.type = "button";
  button.className = "way-back screen";
  const asked = link.closest("[data-quiz], [data-predict], [data-answers]");
  button.textContent = words(asked ? "way_back.question" : "way_back.text");
  button.addEventListener("click", () => {
    link.scrollIntoView({ block: "center" });
    link.focus({ preventScroll: true });
  });
  one(document, "main", HTMLElement).append(button);
  const seen = new IntersectionObserver(([entry]) => {
    if (!entry?.isIntersecting) return;
    seen.disconnect();
    button.remove();
  });
  seen.observe(link);
}
