/** One answer that is right, or several. */

import { findAll, find } from "../../../../static/js/page/dom.ts";
import { words } from "../../../../static/js/page/words.ts";
import { isPrediction, type Kind, type Question } from "../../../../static/js/question/question.ts";
import { shuffled } from "../../../../static/js/question/shuffle.ts";

/** Places of options; a guess of earlier releases is one number. */
type Chosen = number[] | number;

export const kind: Kind<Question, Chosen> = {
  prepare(form, question) {
    shuffle(form, isPrediction(form) ? `predict:${question.id}` : question.id);
  },

  read(form) {
    const chosen = boxes(form).filter((box) => box.checked);
    return chosen.length === 0 ? null : chosen.map((box) => Number(box.value)).sort();
  },

  missing: ({ kind }) => words(kind === "choice" ? "predict.choice" : "question.choose"),

  fits({ options }, given) {
    const places = [given].flat();
    return places.length > 0 && places.every((at) => Number.isInteger(at) && at in options);
  },

  put(form, given) {
    for (const box of boxes(form)) box.checked = [given].flat().includes(Number(box.value));
  },

  judge({ kind, options }, given) {
    const chosen = [given].flat();
    const replies = chosen.map((at) => options[at]);
    if (options.every(({ correct }, at) => correct === chosen.includes(at))) {
      return { right: true, replies };
    }
    if (kind === "choice") {
      return { right: false, replies: [...replies, ...options.filter(({ correct }) => correct)] };
    }
    if (replies.every(({ correct }) => correct)) {
      return { right: false, words: words("question.missing"), replies };
    }
    const wrong = words(kind === "multiple" ? "question.not_all" : "question.wrong");
    return { right: false, words: wrong, replies };
  },

  mark(form, { options }, given) {
    const isGuess = isPrediction(form) && form.dataset.answered !== undefined;
    for (const box of boxes(form)) {
      const chosen = [given].flat().includes(Number(box.value));
      const { correct } = options[Number(box.value)];
      const label = box.closest("label.option");
      label?.classList.toggle("correct", correct && (chosen || isGuess));
      label?.classList.toggle("wrong", chosen && !correct);
    }
  },

  compare(form, { options }, given) {
    const right = options.findIndex(({ correct }) => correct);
    return [given === null ? null : textOf(form, [given].flat()[0]), textOf(form, right)];
  },
};

/** Show the options in the reader's own order; each keeps its value. */
function shuffle(form: HTMLFormElement, name: string) {
  const labels = findAll(form, "label.option", HTMLElement);
  const place = (label: HTMLElement) => Number(find(label, "input", HTMLInputElement).value);
  labels.sort((first, second) => place(first) - place(second));
  const parent = labels[0]?.parentElement;
  parent?.append(...shuffled(name, labels.length).map((index) => labels[index]));
}

function boxes(form: HTMLFormElement) {
  return findAll(form, "fieldset input", HTMLInputElement);
}

function textOf(form: HTMLFormElement, option: number) {
  const box = find(form, `input[value="${option}"]`, HTMLInputElement);
  const text = find(box.parentElement ?? form, ".option-text", HTMLElement);
  return [...text.cloneNode(true).childNodes];
}
