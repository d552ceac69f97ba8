/**
 * The search of the book: its button, its key, its dialog. What finds and shows is fetched when the
 * reader is about to search, and stays for the visit.
 */

import { errorText } from "../errors.ts";
import { findAll, findOptional, find, closestTo } from "./dom.ts";
import { setText } from "./text.ts";
import { words } from "./words.ts";

/** Letters of a question: what is longer is cut, as it is typed or pasted. */
const LONGEST = 200;

type Results = typeof import("../search/results.ts");

/** Listen for the search button and the search dialog of any page. */
export function install() {
  for (const type of ["pointerover", "focusin"]) {
    document.addEventListener(type, (event) => {
      if (closestTo(event, "[data-search]", Element)) fetchResults().catch(() => {});
    });
  }
  document.addEventListener("click", handleClick);
  document.addEventListener("input", (event) => {
    const dialog = closestTo(event, "dialog.search", HTMLDialogElement);
    if (dialog) showResults(dialog);
  });
  document.addEventListener("keydown", handleKey);
}

/** Open the dialog of this page; it may be opened before there is anything to search with. */
export function openSearch() {
  const dialog = findOptional(document, "dialog.search", HTMLDialogElement);
  if (!dialog || dialog.open) return;
  dialog.showModal();
  searchField(dialog).select();
  showResults(dialog);
}

function handleClick(event: MouseEvent) {
  if (closestTo(event, "[data-search]", Element)) openSearch();
  const dialog = closestTo(event, "dialog.search", HTMLDialogElement);
  if (!dialog) return;
  const example = closestTo(event, "[data-words]", HTMLElement);
  if (example) {
    searchField(dialog).value = example.textContent ?? "";
    searchField(dialog).focus();
  }
  if (example || closestTo(event, ".search-retry", Element)) showResults(dialog);
  else if (event.target === dialog || closestTo(event, "a, [data-close]", Element)) dialog.close();
}

/** Show the results for the words that stand in the field once the index has arrived. */
async function showResults(dialog: HTMLDialogElement) {
  const failed = find(dialog, ".search-failed", HTMLElement);
  const status = find(dialog, ".search-status", HTMLElement);
  const { value } = searchField(dialog);
  if (value.length > LONGEST) searchField(dialog).value = value.slice(0, LONGEST);
  const waits = setTimeout(() => setText(status, words("search.fetching")), 300);
  try {
    const { show, index } = await fetchResults();
    show(dialog, index);
    failed.hidden = true;
  } catch (error) {
    setText(status, words("search.failed", { reason: errorText(error) }));
    failed.hidden = false;
  } finally {
    clearTimeout(waits);
  }
}

type Opened = { show: Results["show"]; index: import("../search/results.ts").Index };

/** By the language of the page. */
const openedByLanguage: Map<string, Promise<Opened>> = new Map();

function fetchResults() {
  const { lang } = document.documentElement;
  const opened =
    openedByLanguage.get(lang) ??
    import("../search/results.ts")
      .then(async ({ show, fetchIndex }) => ({ show, index: await fetchIndex() }))
      .catch((error) => {
        openedByLanguage.delete(lang);
        throw error;
      });
  openedByLanguage.set(lang, opened);
  return opened;
}

function handleKey(event: KeyboardEvent) {
  const dialog = closestTo(event, "dialog.search", HTMLDialogElement);
  if (!dialog || event.isComposing) return;
  const stops = [searchField(dialog), ...findAll(dialog, "a[data-result]", HTMLAnchorElement)];
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
  } else if (place > 0 && isTypingKey(event)) {
    stops[0].focus(); // which takes what was typed
  }
}

function isTypingKey({ key, ctrlKey, metaKey, altKey }: KeyboardEvent) {
  return (key.length === 1 || key === "Backspace") && !ctrlKey && !metaKey && !altKey;
}

function searchField(dialog: HTMLDialogElement) {
  return find(dialog, "input", HTMLInputElement);
}
