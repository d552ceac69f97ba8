/**
 * Sections beyond the first pass. Each is folded until it is opened: by hand, by a link to what is
 * in it, or with all others by the choice in the chapter's header. The history knows which are open,
 * so that a reload or a return finds the page as it was left.
 */

import { findAll, hashTarget, unfold, closestTo } from "./dom.ts";
import { loadItem, saveItem } from "./storage.ts";

const KEY = "everything";

/** Listen on any page. */
export function install() {
  document.addEventListener("change", (event) => {
    const pass = closestTo(event, "input[name=pass]", HTMLInputElement);
    if (!pass) return;
    saveItem(KEY, pass.value === "whole");
    for (const fold of deeperFolds()) fold.open = pass.value === "whole";
  });
  // Before the browser follows it.
  document.addEventListener("click", (event) => {
    const link = closestTo(event, 'a[href*="#"]', HTMLAnchorElement);
    if (link?.pathname === location.pathname) unfold(hashTarget(link.hash));
  });
}

/** Open what the reader wants open, what was open, and what the address leads to. */
export function setUpPage() {
  const isWhole = loadItem(KEY) === true;
  for (const pass of findAll(document, "input[name=pass]", HTMLInputElement)) {
    pass.checked = (pass.value === "whole") === isWhole;
  }
  const places: number[] = history.state?.opened ?? [];
  for (const [place, fold] of deeperFolds().entries()) {
    if (isWhole || places.includes(place)) fold.open = true;
  }
  const target = hashTarget();
  if (!target?.closest("details:not([open])")) return;
  unfold(target);
  target.scrollIntoView();
}

/** Which of the page's are open, by their places. */
export function openFolds() {
  return [...deeperFolds().entries()].flatMap(([place, { open }]) => (open ? [place] : []));
}

function deeperFolds() {
  return findAll(document, "details.deeper", HTMLDetailsElement);
}
