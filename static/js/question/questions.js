/**
 * Questions: an answer is told at once why it is right, or why it tempts. All kinds but one work
 * without the interpreter; answers are remembered where the browser allows.
 *
 * @typedef {{correct: boolean, explanation_html: string, value?: number}} Option
 * @typedef {{id: string, kind: string, edition: string, options: Option[], tolerance?: number,
 *   conditions?: string[]}} Question
 * @typedef {number | number[]} Given An answer as it is remembered.
 * @typedef {{right: boolean, words: string, replies: Option[]}} Verdict
 */

/**
 * What one kind of question does.
 *
 * @typedef {object} Kind
 * @property {() => void} [install] Listen for what it alone knows; called once.
 * @property {string} missing Key of what is said where there is no answer yet.
 * @property {(form: HTMLFormElement, question: Question) => void} prepare Before it is answered.
 * @property {(form: HTMLFormElement, question: Question) => Given | null | Promise<Given>} read
 * @property {(question: Question, given: any) => boolean} fits Whether a remembered answer can be
 *   one of this question.
 * @property {(form: HTMLFormElement, given: any) => void} put Show a remembered answer.
 * @property {(question: Question, given: any) => Verdict} judge
 * @property {(form: HTMLFormElement, question: Question, given: any) => void} mark What is right
 *   and what wrong of it; null where nothing is given.
 */

import { message } from "../errors.js";
import { all, data, one, within } from "../page/dom.js";
import { recall, remember } from "../page/storage.js";
import { KINDS } from "./book_kinds.js";
import { say } from "./feedback.js";
import { showProgress } from "./progress.js";
import { words } from "../page/words.js";

/** Listen for answers on any page, now and after a change of chapter. */
export function install() {
  document.addEventListener("submit", (event) => {
    const form = within(event, "form.quiz", HTMLFormElement);
    if (!form) return;
    event.preventDefault();
    answer(form);
  });
  document.addEventListener("answers-forgotten", forget);
  document.addEventListener("answers-read", arrive);
  for (const kind of new Set(Object.values(KINDS))) kind.install?.();
}

/** Put each question of the page in the reader's order, with the answer of an earlier visit. */
export function arrive() {
  for (const form of all(document, "form.quiz", HTMLFormElement)) {
    const question = questionOf(form);
    const kind = KINDS[question.kind];
    kind.prepare(form, question);
    const kept = recall(`quiz:${question.id}`);
    const known = kept?.edition === question.edition && kind.fits(question, kept.answer);
    if (known) kind.put(form, kept.answer);
    show(form, question, known ? kept.answer : null);
  }
  showProgress();
}

/** Forget the answers of this page. */
function forget() {
  for (const form of all(document, "form.quiz", HTMLFormElement)) {
    remember(`quiz:${form.dataset.quiz}`, null);
    form.reset();
  }
  arrive();
}

/**
 * Judge what the form says: at once, but for the kind that asks Python.
 *
 * @param {HTMLFormElement} form
 */
function answer(form) {
  const question = questionOf(form);
  const given = KINDS[question.kind].read(form, question);
  if (!(given instanceof Promise)) settle(form, question, given);
  else given.then((told) => settle(form, question, told)).catch((error) => fail(form, error));
}

/**
 * @param {HTMLFormElement} form
 * @param {Question} question
 * @param {Given | null} given
 */
function settle(form, question, given) {
  show(form, question, given);
  if (given === null) {
    const { missing } = KINDS[question.kind];
    one(form, ".feedback", HTMLElement).textContent = missing && words(missing);
  } else {
    const right = form.dataset.answered === "correct";
    remember(`quiz:${question.id}`, { edition: question.edition, answer: given, right });
  }
  showProgress();
}

/**
 * @param {HTMLFormElement} form
 * @param {unknown} error
 */
function fail(form, error) {
  show(form, questionOf(form), null);
  const reason = message(error);
  one(form, ".feedback", HTMLElement).textContent = words("question.no_judge", { reason });
  showProgress();
}

/**
 * @param {HTMLFormElement} form
 * @returns {Question}
 */
function questionOf(form) {
  return data(form, "script.quiz-data");
}

/**
 * The verdict on an answer, or none.
 *
 * @param {HTMLFormElement} form
 * @param {Question} question
 * @param {Given | null} given
 */
function show(form, question, given) {
  const kind = KINDS[question.kind];
  const feedback = one(form, ".feedback", HTMLElement);
  kind.mark(form, question, given);
  if (given === null) {
    delete form.dataset.answered;
    feedback.replaceChildren();
    return;
  }
  const verdict = kind.judge(question, given);
  form.dataset.answered = verdict.right ? "correct" : "wrong";
  say(feedback, verdict.words, verdict.replies);
}
