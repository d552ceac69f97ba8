/** A reader's changes to the Python of one figure, in the browser's storage. */

import { loadItem, saveItem } from "../page/storage.ts";
import type { Sources } from "./sources.ts";

/**
 * A text in place of a definition, and the hash of the text that was there when it was written.
 * `runs`: whether the figure was drawn by these texts, as they are, when the reader left.
 */
type Edit = { text: string; original: string };

type Stored = { runs: boolean; edits: Record<string, Edit> };

/** All state is in storage, so that two tabs with one figure add to each other's edits. */
export class Edits {
  /** @param name Key in storage. */
  constructor(
    readonly name: string,
    readonly sources: Sources,
  ) {}

  /** Edits by definition, those that no longer fit included. */
  get entries(): Map<string, Edit> {
    return new Map(Object.entries(this.#stored.edits));
  }

  /**
   * The reader's text of a definition, or null where it is the book's, or fits the book no more.
   */
  text(key: string) {
    return this.isCurrent(key) ? (this.entries.get(key)?.text ?? null) : null;
  }

  /** Whether an edit was made of the text that the book has now. */
  isCurrent(key: string) {
    const edit = this.entries.get(key);
    return typeof edit?.text === "string" && edit.original === this.sources.definitions[key]?.hash;
  }

  /** Keys of the edits that fit. */
  get currentKeys() {
    return [...this.entries.keys()].filter((key) => this.isCurrent(key));
  }

  /** JSON of definitions and texts, for the interpreter. */
  get json() {
    return JSON.stringify(Object.fromEntries(this.currentKeys.map((key) => [key, this.text(key)])));
  }

  /** Store a text; that of the book is no edit. */
  set(key: string, text: string) {
    const { text: book, hash } = this.sources.definitions[key];
    const entries = this.entries;
    if (text === book) entries.delete(key);
    else entries.set(key, { text, original: hash });
    this.#save(entries, false);
  }

  /** @param key Of the edit to forget; all where it is left out. */
  remove(key?: string) {
    const entries = this.entries;
    if (key === undefined) entries.clear();
    else entries.delete(key);
    this.#save(entries, this.#stored.runs);
  }

  /** @param runs Whether the figure is drawn by these texts, as they are. */
  setRuns(runs: boolean) {
    if (runs !== this.#stored.runs) this.#save(this.entries, runs);
  }

  get #stored(): Stored {
    return loadItem(this.name) ?? { runs: false, edits: {} };
  }

  #save(entries: Map<string, Edit>, runs: boolean) {
    saveItem(this.name, entries.size > 0 ? { runs, edits: Object.fromEntries(entries) } : null);
  }
}
