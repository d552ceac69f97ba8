/** A number: right within a tolerance, or one that a known mistake leads to. */

/** @import { Kind, Option } from "./questions.js" */

import { one } from "../page/dom.js";
import { words } from "../page/words.js";

/** @type {Kind} */
export const number = {
  missing: "question.type",

  prepare() {},

  read(form) {
    return typed(form, "answer");
  },

  fits(_question, given) {
    return Number.isFinite(given);
  },

  put(form, given) {
    one(form, 'input[name="answer"]', HTMLInputElement).value = String(given);
  },

  judge(question, given) {
    const option =
      recognised(question.options, given, question.tolerance ?? 0) ??
      question.options.filter(({ value }) => value === undefined)[0];
    const right = option.correct;
    return { right, words: words(right ? "question.right" : "question.wrong"), replies: [option] };
  },

  mark() {},
};

/**
 * The number in a field, or null where there is none.
 *
 * @param {HTMLFormElement} form
 * @param {string} name
 */
export function typed(form, name) {
  const value = one(form, `input[name="${name}"]`, HTMLInputElement).valueAsNumber;
  return Number.isFinite(value) ? value : null;
}

/**
 * The nearest of the known answers that a number may be taken for.
 *
 * @param {Option[]} options
 * @param {number} given
 * @param {number} tolerance
 * @returns {Option | undefined}
 */
export function recognised(options, given, tolerance) {
  const distance = (/** @type {Option} */ { value = Infinity }) => Math.abs(value - given);
  const slack = tolerance * (1 + 1e-9); // what stands at the border is inside
  const near = options.filter((option) => distance(option) <= slack);
  return near.sort((first, second) => distance(first) - distance(second))[0];
}
