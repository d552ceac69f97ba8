/** A number: right within a tolerance, or one that a known mistake leads to. */

import { find } from "../../../../static/js/page/dom.ts";
import { parseNumber, numeral, words } from "../../../../static/js/page/words.ts";
import type { Kind, Option, Question } from "../../../../static/js/question/question.ts";

interface Measured extends Question {
  tolerance: number;
  /** Of a prediction: the right number in words. */
  truth?: string;
}

export const kind: Kind<Measured, number> = {
  read(form) {
    const unit = find(form, ".unit", HTMLElement).textContent ?? "";
    const typed = field(form).value.trim();
    const value = parseNumber(typed.endsWith(unit) ? typed.replace(unit, "") : typed);
    return Number.isFinite(value) ? value : null;
  },

  missing: ({ truth }) => words(truth === undefined ? "question.type" : "predict.number"),

  fits: (_question, given) => Number.isFinite(given),

  put(form, given) {
    field(form).value = numeral(String(given));
  },

  /** As it was read. */
  mark(form, _question, given) {
    if (given !== null) field(form).value = numeral(String(given));
  },

  judge({ options, tolerance }, given) {
    const reply =
      recognised(options, given, tolerance) ?? options.find(({ value }) => value === undefined);
    return { right: reply?.correct ?? false, replies: reply ? [reply] : [] };
  },

  compare(form, { truth = "" }, given) {
    const unit = find(form, ".unit", HTMLElement).textContent ?? "";
    return [given === null ? null : [`${numeral(String(given))} ${unit}`.trim()], [truth]];
  },
};

function field(form: HTMLFormElement) {
  return find(form, "fieldset input", HTMLInputElement);
}

/** The nearest of the known answers that a number may be taken for: as `Measure.within` of `kind.py`. */
function recognised(options: Option[], given: number, tolerance: number): Option | undefined {
  const distance = ({ value = Infinity }: Option) => Math.abs(value - given);
  const within = ({ correct, value = 0 }: Option) =>
    correct ? tolerance : Math.min(tolerance, Math.abs(value) / 2);
  const slack = 1 + 1e-9; // what stands at the border is inside
  const near = options.filter((option) => distance(option) <= within(option) * slack);
  return near.sort((first, second) => distance(first) - distance(second))[0];
}
