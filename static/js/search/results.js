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
  const [{ default: MiniSearch }, { stemmer: stem }, reply] = await Promise.all([
    library("minisearch.js"),
    library("stemmer.js"),
    fetch(address("root", "search/index.json"), { cache: "no-cache" }),
  ]);
  if (!reply.ok) throw new Error(`the index answered ${reply.status}`);
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
  one(copy, ".result-title", Element).append(...marked(hit.title, hit, stem));
  const said = [hit.text, hit.figures, hit.questions].find((text) => mentions(text, hit, stem));
  one(copy, ".result-excerpt", Element).append(...marked(said ?? hit.text, hit, stem, true));
  return copy;
}

/**
 * @param {string} text
 * @param {Hit} hit
 * @param {(word: string) => string} stem
 */
function mentions(text, hit, stem) {
  return excerpt(text, hit.matched, stem).some((piece) => piece.hit);
}

/**
 * @param {string} text
 * @param {Hit} hit
 * @param {(word: string) => string} stem
 * @param {boolean} [cut] Whether to show no more than the words around what was found.
 */
function marked(text, hit, stem, cut = false) {
  return excerpt(text, hit.matched, stem, cut ? undefined : Infinity).map((piece) => {
    const element = document.createElement(piece.hit ? "mark" : "span");
    element.textContent = piece.text;
    return element;
  });
}
