/**
 * The search of the book: its button, its key, its dialog. What finds and shows is fetched when the
 * reader is about to search, and stays for the visit.
 */

import { message } from "../errors.ts";
import { all, maybe, one, within } from "./dom.ts";
import { setText } from "./text.ts";
import { words } from "./words.ts";

/** Letters of a question: what is longer is cut, as it is typed or pasted. */
const LONGEST = 200;

type Results = typeof import("../search/results.ts");

/** Listen for the search button and the search dialog of any page. */
export function install() {
  for (const type of ["pointerover", "focusin"]) {
    document.addEventListener(type, (event) => {
      if (within(event, "[data-search]", Element)) fetchResults().catch(() => {});
    });
  }
  document.addEventListener("click", clicked);
  document.addEventListener("input", (event) => {
    const dialog = within(event, "dialog.search", HTMLDialogElement);
    if (dialog) refresh(dialog);
  });
  document.addEventListener("keydown", pressed);
}

/** Open the dialog of this page; it may be opened before there is anything to search with. */
export function openSearch() {
  const dialog = maybe(document, "dialog.search", HTMLDialogElement);
  if (!dialog || dialog.open) return;
  dialog.showModal();
  field(dialog).select();
  refresh(dialog);
}

function clicked(event: MouseEvent) {
  if (within(event, "[data-search]", Element)) openSearch();
  const dialog = within(event, "dialog.search", HTMLDialogElement);
  if (!dialog) return;
  const example = within(event, "[data-words]", HTMLElement);
  if (example) {
    field(dialog).value = example.textContent ?? "";
    field(dialog).focus();
  }
  if (example || within(event, ".search-retry", Element)) refresh(dialog);
  else if (event.target === dialog || within(event, "a, [data-close]", Element)) dialog.close();
}

/** Show what is found for the words as they are when all is at hand. */
async function refresh(dialog: HTMLDialogElement) {
  const failed = one(dialog, ".search-failed", HTMLElement);
  const status = one(dialog, ".search-status", HTMLElement);
  const { value } = field(dialog);
  if (value.length > LONGEST) field(dialog).value = value.slice(0, LONGEST);
  const waits = setTimeout(() => setText(status, words("search.fetching")), 300);
  try {
    const { show, index } = await fetchResults();
    show(dialog, index);
    failed.hidden = true;
  } catch (error) {
    setText(status, words("search.failed", { reason: message(error) }));
    failed.hidden = false;
  } finally {
    clearTimeout(waits);
  }
}

type Opened = { show: Results["show"]; index: import("../search/results.ts").Index };

/** By the language of the page. */
const fetching: Map<string, Promise<Opened>> = new Map();

function fetchResults() {
  const { lang } = document.documentElement;
  const opened =
    fetching.get(lang) ??
    import("../search/results.ts")
      .then(async ({ show, fetchIndex }) => ({ show, index: await fetchIndex() }))
      .catch((error) => {
        fetching.delete(lang);
        throw error;
      });
  fetching.set(lang, opened);
  return opened;
}

function pressed(event: KeyboardEvent) {
  const dialog = within(event, "dialog.search", HTMLDialogElement);
  if (!dialog || event.isComposing) return;
  const stops = [field(dialog), ...all(dialog, "a[data-result]", HTMLAnchorElement)];
  const place = stops.findIndex((stop) => stop === document.activeElement);
  const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
  if (event.key === "Escape") {
    event.preventDefault(); // a search field would only be emptied
    dialog.close();
  } else if (step && place >= 0) {
    event.preventDefault();
    stops[Math.min(Math.max(place + step, 0), stops.length - 1)].focus();
  } else if (event.key === "Enter" && place === 0) {
    event.preventDefault();
    stops[1]?.click();
  } else if (place > 0 && (event.key === "Home" || event.key === "End")) {
    event.preventDefault();
    stops[event.key === "Home" ? 1 : stops.length - 1].focus();
  } else if (place > 0 && isTyped(event)) {
    stops[0].focus(); // which takes what was typed
  }
}

function isTyped({ key, ctrlKey, metaKey, altKey }: KeyboardEvent) {
  return (key.length === 1 || key === "Backspace") && !ctrlKey && !metaKey && !altKey;
}

function field(dialog: HTMLDialogElement) {
  return one(dialog, "input", HTMLInputElement);
}
