/** One answer that is right, or several. */

import { all, one } from "../page/dom.js";
import { words } from "../page/words.js";
import type { Kind, Question } from "./questions.js";
import { shuffled } from "./shuffle.js";

export const choice: Kind = {
  missing: "question.choose",

  prepare(form, question) {
    shuffleOptions(form, question.id);
  },

  read(form) {
    const chosen = boxes(form).filter((box) => box.checked);
    return chosen.length === 0 ? null : chosen.map((box) => Number(box.value)).sort();
  },

  fits(question, given) {
    const known = (index: any) => Number.isInteger(index) && index in question.options;
    return Array.isArray(given) && given.length > 0 && given.every(known);
  },

  put(form, given) {
    for (const box of boxes(form)) box.checked = given.includes(Number(box.value));
  },

  judge(question, given) {
    const right = question.options.every(({ correct }, index) => correct === given.includes(index));
    return {
      right,
      words: verdict(question, given, right),
      replies: given.map((index: number) => question.options[index]),
    };
  },

  mark(form, question, given) {
    for (const box of boxes(form)) {
      const chosen = given?.includes(Number(box.value)) ?? false;
      const { correct } = question.options[Number(box.value)];
      const label = box.closest("label.option");
      label?.classList.toggle("chosen", chosen);
      label?.classList.toggle("correct", chosen && correct);
      label?.classList.toggle("wrong", chosen && !correct);
    }
  },
};

/** Show the options in the reader's own order; each keeps its value. */
export function shuffleOptions(form: HTMLFormElement, name: string) {
  const labels = all(form, "label.option", HTMLElement);
  const place = (label: HTMLElement) => Number(one(label, "input", HTMLInputElement).value);
  labels.sort((first, second) => place(first) - place(second));
  const parent = labels[0]?.parentElement;
  parent?.append(...shuffled(name, labels.length).map((index) => labels[index]));
}

function boxes(form: HTMLFormElement) {
  return all(form, 'input[name="answer"]', HTMLInputElement);
}

function verdict(question: Question, chosen: number[], right: boolean) {
  if (right) return words("question.right");
  if (chosen.every((index) => question.options[index].correct)) {
    return words("question.missing");
  }
  return words(question.kind === "multiple" ? "question.not_all" : "question.wrong");
}
