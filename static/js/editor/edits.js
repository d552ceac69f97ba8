/** What a reader has changed in the Python of one figure; kept in the browser. */

import { recall, remember } from "../page/storage.js";

/** @import { Sources } from "./sources.js" */
/**
 * A text in place of a definition, and the hash of the text that was there when it was written.
 * `runs`: whether the figure was drawn by these texts, as they are, when the reader left.
 *
 * @typedef {{text: string, original: string}} Edit
 * @typedef {{runs: boolean, edits: Record<string, Edit>}} Kept
 */

export class Edits {
  /** Whether the figure is drawn by these texts, as they are. */
  runs = false;

  /**
   * @param {string} name Under which they are kept.
   * @param {Sources} sources
   */
  constructor(name, sources) {
    this.name = name;
    this.sources = sources;
    /** @type {Kept | null} */
    const kept = recall(name);
    /** @type {Map<string, Edit>} */
    this.all = new Map(Object.entries(kept?.edits ?? {}));
  }

  /**
   * The reader's text of a definition, or null where it is the book's, or fits the book no more.
   *
   * @param {string} key
   */
  text(key) {
    return this.fits(key) ? (this.all.get(key)?.text ?? null) : null;
  }

  /**
   * Whether an edit was made of the text that the book has now.
   *
   * @param {string} key
   */
  fits(key) {
    const edit = this.all.get(key);
    return typeof edit?.text === "string" && edit.original === this.sources.definitions[key]?.hash;
  }

  /** Keys of the edits that fit. */
  get keys() {
    return [...this.all.keys()].filter((key) => this.fits(key));
  }

  /** What the interpreter takes: definitions and texts. */
  get json() {
    return JSON.stringify(Object.fromEntries(this.keys.map((key) => [key, this.text(key)])));
  }

  /**
   * The reader has written; the book's own words are no edit.
   *
   * @param {string} key
   * @param {string} text
   */
  write(key, text) {
    const { text: book, hash } = this.sources.definitions[key];
    if (text === book) this.all.delete(key);
    else this.all.set(key, { text, original: hash });
    this.runs = false;
    this.save();
  }

  /** @param {string} [key] Of the edit to forget; all where it is left out. */
  drop(key) {
    if (key === undefined) this.all.clear();
    else this.all.delete(key);
    this.save();
  }

  /** @param {boolean} runs */
  setRuns(runs) {
    this.runs = runs;
    this.save();
  }

  save() {
    const kept = { runs: this.runs, edits: Object.fromEntries(this.all) };
    remember(this.name, this.all.size > 0 ? kept : null);
  }
}
