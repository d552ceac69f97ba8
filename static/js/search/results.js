/** What is found for the words in the search dialog, as a list of links. */

import { one } from "../page/dom.js";
import { setText } from "../page/text.js";
import { excerpt } from "./excerpt.js";
import { find, settings } from "./ranking.js";

/** @import { Hit } from "./ranking.js" */

/**
 * The sections of the book, and how their words are brought to their stems.
 *
 * @typedef {object} Index
 * @property {any} sections A MiniSearch.
 * @property {(word: string) => string} stem
 */

/** Links that are shown at once. */
const MOST = 20;

/** A module that could not be fetched is not asked for again at the same address. */
let attempts = 0;

/**
 * The index, opened.
 *
 * @returns {Promise<Index>}
 * @throws {Error} Where it, or what opens it, cannot be fetched.
 */
export async function fetchIndex() {
  const again = attempts > 0 ? `?again=${attempts}` : "";
  attempts += 1;
  /** @param {string} name */
  const library = (name) => import(address("assets", `search/${name}`) + again);
  const [{ default: MiniSearch }, { stemmer }, reply] = await Promise.all([
    library("minisearch.js"),
    library("stemmer.js"),
    fetch(address("root", "search/index.json"), { cache: "no-cache" }),
  ]);
  if (!reply.ok) throw new Error(`the index answered ${reply.status}`);
  const stem = remembering(stemmer);
  return { sections: MiniSearch.loadJS(await reply.json(), settings(stem)), stem };
}

/**
 * @param {"assets" | "root"} folder
 * @param {string} path
 */
function address(folder, path) {
  return new URL((document.body.dataset[folder] ?? "") + path, location.href).href;
}

/** The words whose results a list shows. @type {WeakMap<Element, string>} */
const shown = new WeakMap();

/**
 * Show what is found for the words that stand in the dialog now.
 *
 * @param {HTMLDialogElement} dialog
 * @param {Index} index
 */
export function show(dialog, { sections, stem }) {
  const words = one(dialog, "input", HTMLInputElement).value.trim();
  const list = one(dialog, ".search-results", HTMLElement);
  if (shown.get(list) === words) return;
  shown.set(list, words);
  const { hits, exact } = find(sections, stem, words);
  const template = one(dialog, "template", HTMLTemplateElement);
  list.replaceChildren(...hits.slice(0, MOST).map((hit) => item(template, hit, stem)));
  list.scrollTop = 0;
  setText(one(dialog, ".search-status", HTMLElement), summary(words, hits.length, exact));
  one(dialog, ".search-hint", HTMLElement).hidden = words !== "";
  one(dialog, ".search-nothing", HTMLElement).hidden = words === "" || hits.length > 0;
}

/**
 * @param {string} words
 * @param {number} count
 * @param {boolean} exact
 */
function summary(words, count, exact) {
  if (words === "") return "";
  if (count === 0) return `Nothing found for “${words}”.`;
  const sections = `${count} section${count === 1 ? "" : "s"}`;
  const best = count > MOST ? `, of which the best ${MOST} are shown` : "";
  return exact
    ? `${sections}${best}.`
    : `Nothing has just these words. Near them: ${sections}${best}.`;
}

/**
 * @param {HTMLTemplateElement} template
 * @param {Hit} hit
 * @param {(word: string) => string} stem
 */
function item(template, hit, stem) {
  const copy = /** @type {DocumentFragment} */ (template.content.cloneNode(true));
  one(copy, "a", HTMLAnchorElement).href = address("root", hit.address);
  setText(one(copy, ".result-chapter", Element), hit.chapter);
  const title = excerpt(hit.title, hit.matched, stem, Infinity);
  one(copy, ".result-title", Element).append(...title.map(element));
  one(copy, ".result-excerpt", Element).append(...said(hit, stem));
  return copy;
}

/**
 * An excerpt of that part of the section in which the words were found.
 *
 * @param {Hit} hit
 * @param {(word: string) => string} stem
 */
function said(hit, stem) {
  const pieces = excerpt(hit.text, hit.matched, stem);
  if (pieces.some((piece) => piece.hit)) return pieces.map(element);
  const other = [hit.figures, hit.questions].map((text) => excerpt(text, hit.matched, stem));
  const found = other.find((excerpt) => excerpt.some((piece) => piece.hit));
  return (found ?? pieces).map(element);
}

/** @param {{text: string, hit: boolean}} piece */
function element({ text, hit }) {
  const element = document.createElement(hit ? "mark" : "span");
  element.textContent = text;
  return element;
}

/**
 * Each word is brought to its stem once.
 *
 * @param {(word: string) => string} stem
 */
function remembering(stem) {
  /** @type {Map<string, string>} */
  const stems = new Map();
  return (/** @type {string} */ word) => {
    let root = stems.get(word);
    if (root === undefined) stems.set(word, (root = stem(word)));
    return root;
  };
}
