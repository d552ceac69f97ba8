/** What scripts say, in the language of the book: `site_builder/languages/` has the texts. */

import { DECIMAL, WORDS } from "../book.js";

/**
 * The text under `key` with its placeholders filled; of one that depends on a number, the form for
 * `count`.
 *
 * @param {string} key
 * @param {Record<string, string | number>} [values]
 * @returns {string}
 */
export function words(key, values = {}) {
  const text = WORDS[key];
  const form = typeof text === "string" ? text : text[values.count === 1 ? "one" : "other"];
  return form.replaceAll(/\{(\w+)\}/g, (_, name) => String(values[name]));
}

/**
 * A number in digits with the decimal sign of the language, as `Words.decimals` of the builder.
 *
 * @param {string} text
 */
export function decimals(text) {
  return DECIMAL === "." ? text : text.replaceAll(/(?<=\d)\.(?=\d)/g, DECIMAL);
}

/**
 * The same number for other programs.
 *
 * @param {string} text
 */
export function undecimals(text) {
  return DECIMAL === "." ? text : text.replaceAll(DECIMAL, ".");
}
