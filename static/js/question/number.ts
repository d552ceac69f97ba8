/** A number: right within a tolerance, or one that a known mistake leads to. */

import { one } from "../page/dom.js";
import { words } from "../page/words.js";
import type { Kind, Option } from "./questions.js";

export const number: Kind = {
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

/** The number in a field, or null where there is none. */
export function typed(form: HTMLFormElement, name: string) {
  const value = one(form, `input[name="${name}"]`, HTMLInputElement).valueAsNumber;
  return Number.isFinite(value) ? value : null;
}

/** The nearest of the known answers that a number may be taken for. */
export function recognised(
  options: Option[],
  given: number,
  tolerance: number,
): Option | undefined {
  const distance = ({ value = Infinity }: Option) => Math.abs(value - given);
  const slack = tolerance * (1 + 1e-9); // what stands at the border is inside
  const near = options.filter((option) => distance(option) <= slack);
  return near.sort((first, second) => distance(first) - distance(second))[0];
}
