/** What scripts say, in the language of the book: `site_builder/languages/` has the texts. */

import { DECIMAL, WORDS } from "../book.js";

/**
 * The text under `key` with its placeholders filled; of one that depends on a number, the form for
 * `count`.
 */
export function words(key: string, values: Record<string, string | number> = {}): string {
  const text = WORDS[key];
  const form = typeof text === "string" ? text : text[values.count === 1 ? "one" : "other"];
  return form.replaceAll(/\{(\w+)\}/g, (_, name) => String(values[name]));
}

/**
 * What the engine says, in the language of the book; what a scene, or Python itself, says is text.
 * As `simulations/engine/message.py`.
 */
export type Said = { key: string; values: Record<string, string> };

export function inWords(said: string | Said) {
  return typeof said === "string" ? said : words(said.key, said.values);
}

/**
 * A number as the language writes it: its decimal sign, and words for what is none. As `numeral` of
 * the builder's `languages/words.py`.
 */
export function numeral(text: string): string {
  if (text === "undefined") return words("number.undefined");
  const [, limit] = /^under (.+)$/.exec(text) ?? [];
  if (limit) return words("number.under", { limit: numeral(limit) });
  return DECIMAL === "." ? text : text.replaceAll(/(?<=\d)\.(?=\d)/g, DECIMAL);
}

/** The same number for other programs. */
export function fromNumeral(text: string) {
  return DECIMAL === "." ? text : text.replaceAll(DECIMAL, ".");
}
