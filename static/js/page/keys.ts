/** Single keys that turn pages and open things, and the card that lists them. */

import { findOptional, find, closestTo } from "./dom.ts";
import { openSearch } from "./search.ts";
import { loadItem, saveItem } from "./storage.ts";

const KEY = "single-keys";
/** Places where letters are typed, or keys have another meaning. */
const IGNORED_IN = [
  "input:not([type=range], [type=checkbox], [type=radio], [type=file])",
  "select, textarea, [contenteditable]",
  "dialog[open], .cm-editor",
].join(", ");

const ACTIONS: Record<string, () => void> = {
  "/": openSearch,
  "[": () => turnPage("prev"),
  "]": () => turnPage("next"),
  "?": openCard,
};

/** Listen on any page. */
export function install() {
  document.addEventListener("keydown", (event) => {
    const action = ACTIONS[event.key];
    if (!action || !isUnmodified(event) || loadItem(KEY) === false) return;
    if (closestTo(event, IGNORED_IN, Element)) return;
    event.preventDefault();
    action();
  });
  document.addEventListener("click", (event) => {
    if (closestTo(event, "[data-keys]", Element)) openCard();
    const card = closestTo(event, "dialog.keys", HTMLDialogElement);
    if (card && (event.target === card || closestTo(event, "[data-close]", Element))) card.close();
  });
  document.addEventListener("change", (event) => {
    const box = closestTo(event, "input[name=single-keys]", HTMLInputElement);
    if (box) saveItem(KEY, box.checked ? null : false);
  });
}

/** Some keyboards need AltGr for brackets, which some systems report as Control and Alt. */
function isUnmodified(event: KeyboardEvent) {
  const { ctrlKey, altKey, metaKey, isComposing, defaultPrevented } = event;
  const modified = (ctrlKey || altKey) && !event.getModifierState("AltGraph");
  return !modified && !metaKey && !isComposing && !defaultPrevented;
}

function turnPage(side: "prev" | "next") {
  findOptional(document, `.pager a[rel=${side}]`, HTMLAnchorElement)?.click();
}

function openCard() {
  const card = findOptional(document, "dialog.keys", HTMLDialogElement);
  if (!card) return;
  find(card, "input", HTMLInputElement).checked = loadItem(KEY) !== false;
  card.showModal();
}
