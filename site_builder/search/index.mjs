/**
 * Makes the index of the search: on standard input sections as JSON, a page a line, indexed as they
 * come; on standard output the index.
 *
 * Arguments: the files of MiniSearch, of the stemmer, and of the book's own ranking and words; stop
 * words and synonyms.
 */

import { createInterface } from "node:readline";
import { pathToFileURL } from "node:url";

const [paths, compared] = [process.argv.slice(2, 6), process.argv.slice(6)];
const [library, stemmer, ranking, words] = paths.map((path) => pathToFileURL(path).href);
const { default: MiniSearch } = await import(library);
const { stemmer: stem } = await import(stemmer);
const { indexOptions } = await import(ranking);
const { languageOf } = await import(words);

const ours = indexOptions(languageOf(stem, ...compared));
/** Of words seen before: a book says most of them again and again. */
const known = new Map();
/** @param {string} word */
const processTerm = (word) => {
  if (!known.has(word)) known.set(word, ours.processTerm(word));
  return known.get(word);
};

/** A MiniSearch that looks for a term in its tree once, and not wherever a text has it. */
class Index extends MiniSearch {
  /** @type {Map<string, Map<number, Map<number, number>>>} */
  places = new Map();

  /**
   * @param {number} field
   * @param {number} section
   * @param {string} term
   */
  addTerm(field, section, term) {
    let fields = this.places.get(term);
    if (!fields) this.places.set(term, (fields = this._index.fetch(term, () => new Map())));
    let counts = fields.get(field);
    if (!counts) fields.set(field, (counts = new Map()));
    counts.set(section, (counts.get(section) ?? 0) + 1);
  }
}
const index = new Index({ ...ours, processTerm });
for await (const page of createInterface(process.stdin)) index.addAll(JSON.parse(page));
process.stdout.write(JSON.stringify(index));
