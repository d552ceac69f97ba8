/** What scripts say, in the language of the book: `site_builder/languages/` has the texts. */

import * as book from "../book.js";

/** The words of the page that is shown, which may be a translation. */
let current: Pick<typeof book, "DECIMAL" | "FIGURES" | "WORDS"> = book;

/** Use the words of a page: a translation carries its own, all other pages have those of the book. */
export function useWordsOf(page: Document) {
  const own = page.getElementById("words");
  current = own ? JSON.parse(own.textContent ?? "") : book;
}

/**
 * The text under `key` with its placeholders filled; of one that depends on a number, the form for
 * `count`.
 */
export function words(key: string, values: Record<string, string | number> = {}): string {
  const text = current.WORDS[key];
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
  const { DECIMAL } = current;
  return DECIMAL === "." ? text : text.replaceAll(/(?<=\d)\.(?=\d)/g, DECIMAL);
}

const NUMBER = /[−-]?\d+(?:\.\d+)?/g;

/** A text of a figure, translated where the page has a translation; `#` stands for each number. */
export function figureText(text: string) {
  const key = text.trim().replaceAll(NUMBER, "#");
  if (!Object.hasOwn(current.FIGURES, key)) return text;
  const label = current.FIGURES[key];
  const numbers = text.match(NUMBER) ?? [];
  let next = 0;
  return label.replaceAll("#", () => numeral(numbers[next++]));
}

/** A drawing with its texts translated. */
export function figureMarkup(markup: string) {
  const { FIGURES } = current;
  if (Object.keys(FIGURES).length === 0) return markup;
  return markup.replaceAll(/(?<=>)[^<>]+(?=<)/g, (text) => figureText(text));
}

/** The same number for other programs. */
export function fromNumeral(text: string) {
  const { DECIMAL } = current;
  return DECIMAL === "." ? text : text.replaceAll(DECIMAL, ".");
}

/**
 * The number that a reader typed or pasted, with any minus sign, a decimal point or comma, thousands
 * set apart, a power of ten, and digits of any width; NaN of what is none. Of `1,000`, in which the sign may be either, the book's
 * language decides.
 */
export function numberTyped(text: string) {
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
  const isGrouped = last !== current.DECIMAL && /^[-+]?[1-9]\d{0,2}[.,]\d{3}$/.test(bare);
  const decimal = isGrouped || bare.split(last).length > 2 ? "" : last;
  const thousands = /[.,](?=\d{3}(?!\d))/g;
  const number = bare.replaceAll(thousands, (sign) => (sign === decimal ? sign : ""));
  const plain = number.replace(",", ".");
  return /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(plain) ? Number(plain) : NaN;
}
