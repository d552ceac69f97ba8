/** Texts of scripts in the language of the book, from `site_builder/languages/`. */

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
 * A message of the engine, to be translated; messages of scenes and of Python are texts. As in
 * `simulations/engine/message.py`.
 */
export type Message = { key: string; values: Record<string, string> };

export function messageText(message: string | Message) {
  return typeof message === "string" ? message : words(message.key, message.values);
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

/**
 * The number that a reader typed or pasted, with any minus sign, a decimal point or comma, thousands
 * set apart, a power of ten, and digits of any width; NaN of what is none. Of `1,000`, in which the sign may be either, the book's
 * language decides.
 */
export function parseNumber(text: string) {
  const bare = text
    .replace(/(?<=10)[⁺⁻⁰¹²³⁴-⁹]+/, "^$&")
    .normalize("NFKC")
    .trim()
    .replaceAll(/[−–‐]/g, "-")
    .replace(/^-\s*/, "-")
    .replace(/(?<=^[-+]?)(?=10\s*\^)/, "1×")
    .replace(/\s*[×⋅·*x]\s*10\s*\^\s*([-+]?\d+)$/, "e$1")
    .replaceAll(/(?<=\d)[\s'’](?=\d{3}(?!\d))/g, "");
  const [last = ""] = /[.,](?=[^.,]*$)/.exec(bare) ?? [];
  const isGrouped = last !== DECIMAL && /^[-+]?[1-9]\d{0,2}[.,]\d{3}$/.test(bare);
  const decimal = isGrouped || bare.split(last).length > 2 ? "" : last;
  const thousands = /[.,](?=\d{3}(?!\d))/g;
  const number = bare.replaceAll(thousands, (sign) => (sign === decimal ? sign : ""));
  const plain = number.replace(",", ".");
  return /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(plain) ? Number(plain) : NaN;
}
