/** Single keys that turn pages and open things, and the card that lists them. */

import { maybe, one, within } from "./dom.ts";
import { openSearch } from "./search.ts";
import { recall, remember } from "./storage.ts";

const KEPT = "single-keys";
/** Where letters are typed, or keys have a meaning of their own. */
const TAKEN = [
  "input:not([type=range], [type=checkbox], [type=radio], [type=file])",
  "select, textarea, [contenteditable]",
  "dialog[open], .cm-editor",
].join(", ");

const ACTIONS: Record<string, () => void> = {
  "/": openSearch,
  "[": () => turn("prev"),
  "]": () => turn("next"),
  "?": openCard,
};

/** Listen on any page. */
export function install() {
  document.addEventListener("keydown", (event) => {
    const action = ACTIONS[event.key];
    if (!action || !isPlain(event) || recall(KEPT) === false) return;
    if (within(event, TAKEN, Element)) return;
    event.preventDefault();
    action();
  });
  document.addEventListener("click", (event) => {
    if (within(event, "[data-keys]", Element)) openCard();
    const card = within(event, "dialog.keys", HTMLDialogElement);
    if (card && (event.target === card || within(event, "[data-close]", Element))) card.close();
  });
  document.addEventListener("change", (event) => {
    const box = within(event, "input[name=single-keys]", HTMLInputElement);
    if (box) remember(KEPT, box.checked ? null : false);
  });
}

/** Some keyboards need AltGr for brackets, which some systems tell as Control and Alt. */
function isPlain(event: KeyboardEvent) {
  const { ctrlKey, altKey, metaKey, isComposing, defaultPrevented } = event;
  const modified = (ctrlKey || altKey) && !event.getModifierState("AltGraph");
  return !modified && !metaKey && !isComposing && !defaultPrevented;
}

function turn(side: "prev" | "next") {
  maybe(document, `.pager a[rel=${side}]`, HTMLAnchorElement)?.click();
}

function openCard() {
  const card = maybe(document, "dialog.keys", HTMLDialogElement);
  if (!card) return;
  one(card, "input", HTMLInputElement).checked = recall(KEPT) !== false;
  card.showModal();
}
