/** The results of the search dialog, as a list of links. */

import { element, find } from "../page/dom.ts";
import { setText } from "../page/text.ts";
import { words } from "../page/words.ts";
import { searchSections, indexOptions, type Hit } from "./ranking.ts";
import { formsOf, languageOf, type Language, wordsIn } from "./words.ts";

/** The sections of the book, and how words of its language are compared. */
export interface Index {
  /** A MiniSearch. */
  sections: any;
  language: Language;
}

/** Links that are shown at once. */
const MOST = 20;

/** A browser does not fetch a failed module again at the same address. */
let attempts = 0;

/** The index, opened, or an error where it, or what opens it, cannot be fetched. */
export async function fetchIndex(): Promise<Index> {
  const again = attempts > 0 ? `?again=${attempts}` : "";
  attempts += 1;
  const library = (name: string) => import(address("assets", `search/${name}`) + again);
  const [{ default: MiniSearch }, { stemmer }, index] = await Promise.all([
    library("minisearch.js"),
    library("stemmer.js"),
    fetchJson("search/index.json"),
  ]);
  const compared = languageOf(stemmer, words("search.stop_words"), words("search.synonyms"));
  return { sections: MiniSearch.loadJS(index, indexOptions(compared)), language: compared };
}

async function fetchJson(path: string) {
  const reply = await fetch(address("root", path), { cache: "no-cache" });
  if (!reply.ok) throw new Error(words("search.index_answered", { status: reply.status }));
  return reply.json();
}

function address(folder: "assets" | "root", path: string) {
  return new URL((document.body.dataset[folder] ?? "") + path, location.href).href;
}

/** The words whose results a list shows. */
const shownQuery: WeakMap<Element, string> = new WeakMap();

/** Show what is found for the words that stand in the dialog now. */
export function show(dialog: HTMLDialogElement, { sections, language: compared }: Index) {
  const query = find(dialog, "input", HTMLInputElement).value.trim();
  const list = find(dialog, ".search-results", HTMLElement);
  if (shownQuery.get(list) === query) return;
  shownQuery.set(list, query);
  const { hits, exact } = searchSections(sections, compared, query);
  const template = find(dialog, "template", HTMLTemplateElement);
  list.replaceChildren(...hits.slice(0, MOST).map((hit) => item(template, hit, compared)));
  list.scrollTop = 0;
  setText(find(dialog, ".search-status", HTMLElement), summary(query, hits.length, exact));
  find(dialog, ".search-hint", HTMLElement).hidden = query !== "";
  find(dialog, ".search-nothing", HTMLElement).hidden = query === "" || hits.length > 0;
}

function summary(query: string, count: number, exact: boolean) {
  if (query === "") return "";
  if (count === 0) return words("search.none", { words: query });
  const key = exact ? "search.found" : "search.near";
  return words(count > MOST ? `${key}_best` : key, { count, most: MOST });
}

function item(template: HTMLTemplateElement, hit: Hit, compared: Language) {
  const copy = template.content.cloneNode(true) as DocumentFragment;
  find(copy, "a", HTMLAnchorElement).href = address("root", hit.address);
  setText(find(copy, ".result-chapter", Element), hit.chapter);
  const title = excerpt(hit.title || hit.chapter, hit.matched, compared, Infinity);
  find(copy, ".result-title", Element).append(...title.map(pieceElement));
  find(copy, ".result-excerpt", Element).append(...excerptOf(hit, compared));
  return copy;
}

/**
 * An excerpt of that part of the section in which most of the words were found; before the text,
 * what it explains under other words.
 */
function excerptOf(hit: Hit, compared: Language) {
  const names = [...hit.explains, ...hit.asked];
  const [text, ...others] = [hit.text, hit.figures, hit.questions, ...names].map((part) =>
    excerpt(part, hit.matched, compared),
  );
  const best = others.reduce(
    (one, other) => (matchCount(other) > matchCount(one) ? other : one),
    text,
  );
  const isName = others.indexOf(best) > 1;
  return (isName ? [...best, { text: " · ", hit: false }, ...text] : best).map(pieceElement);
}

/** How many different words were found. */
function matchCount(pieces: { text: string; hit: boolean }[]) {
  return new Set(pieces.filter(({ hit }) => hit).map(({ text }) => text.toLowerCase())).size;
}

function pieceElement({ text, hit }: { text: string; hit: boolean }) {
  return element(hit ? "mark" : "span", "", text);
}

/** Words of an excerpt, and of these how many before what was found. */
const LENGTH = 34;
const BEFORE = 8;

/**
 * The stretch of `text` with most of the words that were found, the first of several; as pieces,
 * each with or without a mark.
 *
 * @param matched Words as the index spells them, or their stems.
 * @param length In words.
 */
function excerpt(
  text: string,
  matched: string[],
  language: Language,
  length: number = LENGTH,
): { text: string; hit: boolean }[] {
  const wanted = new Set(matched);
  const words = wordsIn(text).map(({ start, end, whole, parts }) => {
    const forms = [whole, ...parts].flatMap((word) => formsOf(word, language));
    return { start, end, found: forms.find((form) => wanted.has(form)) };
  });
  if (words.length === 0) return [];
  const first = words.length > length ? bestStart(words, length) : 0;
  const last = Math.min(first + length, words.length) - 1;
  const start = first === 0 ? 0 : words[first].start;
  const end = last === words.length - 1 ? text.length : words[last].end;
  const hits = words.slice(first, last + 1).filter((word) => word.found !== undefined);
  const pieces = [{ text: start > 0 ? "… " : "", hit: false }];
  let at = start;
  for (const word of hits) {
    pieces.push({ text: text.slice(at, word.start), hit: false });
    pieces.push({ text: text.slice(word.start, word.end), hit: true });
    at = word.end;
  }
  pieces.push({ text: text.slice(at, end) + (end < text.length ? " …" : ""), hit: false });
  return pieces.filter((piece) => piece.text !== "");
}

function bestStart(words: { found: string | undefined }[], length: number) {
  let best = { start: 0, found: 0 };
  for (const [place, { found }] of words.entries()) {
    if (found === undefined) continue;
    const ahead = words.slice(place, place + length - BEFORE);
    const kinds = new Set(ahead.flatMap((word) => word.found ?? []));
    if (kinds.size > best.found) best = { start: place - BEFORE, found: kinds.size };
  }
  return Math.max(0, Math.min(best.start, words.length - length));
}
