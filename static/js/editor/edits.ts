/** What a reader has changed in the Python of one figure; kept in the browser. */

import { loadItem, saveItem } from "../page/storage.ts";
import type { Sources } from "./sources.ts";

/**
 * A text in place of a definition, and the hash of the text that was there when it was written.
 * `runs`: whether the figure was drawn by these texts, as they are, when the reader left.
 */
type Edit = { text: string; original: string };

type Stored = { runs: boolean; edits: Record<string, Edit> };

export class Edits {
  /** Whether the figure is drawn by these texts, as they are. */
  runs = false;

  readonly entries: Map<string, Edit>;

  /** @param name Under which they are kept. */
  constructor(
    readonly name: string,
    readonly sources: Sources,
  ) {
    const stored: Stored | null = loadItem(name);
    this.entries = new Map(Object.entries(stored?.edits ?? {}));
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

  /** What the interpreter takes: definitions and texts. */
  get json() {
    return JSON.stringify(Object.fromEntries(this.currentKeys.map((key) => [key, this.text(key)])));
  }

  /** The reader has written; the book's own words are no edit. */
  set(key: string, text: string) {
    const { text: book, hash } = this.sources.definitions[key];
    if (text === book) this.entries.delete(key);
    else this.entries.set(key, { text, original: hash });
    this.runs = false;
    this.save();
  }

  /** @param key Of the edit to forget; all where it is left out. */
  remove(key?: string) {
    if (key === undefined) this.entries.clear();
    else this.entries.delete(key);
    this.save();
  }

  setRuns(runs: boolean) {
    this.runs = runs;
    this.save();
  }

  save() {
    const stored = { runs: this.runs, edits: Object.fromEntries(this.entries) };
    saveItem(this.name, this.entries.size > 0 ? stored : null);
  }
}
