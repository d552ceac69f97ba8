/**
 * Questions: an answer is told at once why it is right, or why it tempts. All kinds but one work
 * without the interpreter; answers are remembered where the browser allows.
 */

import { message } from "../errors.js";
import { all, data, one, within } from "../page/dom.js";
import { onOtherTab, recall, remember } from "../page/storage.js";
import { words } from "../page/words.js";
import { KINDS } from "./book_kinds.js";
import { say } from "./feedback.js";
import { showProgress } from "./progress.js";

export type Option = { correct: boolean; explanation_html: string; value?: number };

export interface Question {
  id: string;
  kind: string;
  edition: string;
  options: Option[];
  tolerance?: number;
  conditions?: string[];
}

/** An answer as it is remembered. */
type Given = number | number[];

type Verdict = { right: boolean; words: string; replies: Option[] };

/** What one kind of question does. */
export interface Kind {
  /** Listen for what it alone knows; called once. */
  install?: () => void;
  /** Key of what is said where there is no answer yet. */
  missing: string;
  /** Before it is answered. */
  prepare: (form: HTMLFormElement, question: Question) => void;
  read: (form: HTMLFormElement, question: Question) => Given | null | Promise<Given>;
  /** Whether a remembered answer can be one of this question. */
  fits: (question: Question, given: any) => boolean;
  /** Show a remembered answer. */
  put: (form: HTMLFormElement, given: any) => void;
  judge: (question: Question, given: any) => Verdict;
  /** What is right and what wrong of it; null where nothing is given. */
  mark: (form: HTMLFormElement, question: Question, given: any) => void;
}

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
  onOtherTab((key) => {
    for (const form of all(document, "form.quiz", HTMLFormElement)) {
      if (key === null || key === keyOf(form)) restore(form);
    }
  });
  addEventListener("pageshow", ({ persisted }) => {
    if (!persisted) return; // else other pages may have been read meanwhile
    for (const form of all(document, "form.quiz", HTMLFormElement)) {
      if (recall(keyOf(form))) restore(form);
    }
  });
  for (const kind of new Set(Object.values(KINDS))) kind.install?.();
}

/** Put each question of the page in the reader's order, with the answer of an earlier visit. */
export function arrive() {
  for (const form of all(document, "form.quiz", HTMLFormElement)) put(form);
  showProgress();
}

/** @param form Untouched. */
function put(form: HTMLFormElement) {
  const question = questionOf(form);
  const kind = KINDS[question.kind];
  kind.prepare(form, question);
  const kept = recall(keyOf(form));
  const known = kept?.edition === question.edition && kind.fits(question, kept.answer);
  if (known) kind.put(form, kept.answer);
  show(form, question, known ? kept.answer : null);
}

/** Show what was answered elsewhere meanwhile. */
function restore(form: HTMLFormElement) {
  form.reset();
  put(form);
  showProgress();
}

/** Under which name the answer is kept. */
function keyOf(form: HTMLFormElement) {
  return `quiz:${form.dataset.quiz}`;
}

/** Forget the answers of this page. */
function forget() {
  for (const form of all(document, "form.quiz", HTMLFormElement)) {
    remember(`quiz:${form.dataset.quiz}`, null);
    form.reset();
  }
  arrive();
}

/** Judge what the form says: at once, but for the kind that asks Python. */
function answer(form: HTMLFormElement) {
  const question = questionOf(form);
  const given = KINDS[question.kind].read(form, question);
  if (!(given instanceof Promise)) settle(form, question, given);
  else given.then((told) => settle(form, question, told)).catch((error) => fail(form, error));
}

function settle(form: HTMLFormElement, question: Question, given: Given | null) {
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

function fail(form: HTMLFormElement, error: unknown) {
  show(form, questionOf(form), null);
  const reason = message(error);
  one(form, ".feedback", HTMLElement).textContent = words("question.no_judge", { reason });
  showProgress();
}

function questionOf(form: HTMLFormElement): Question {
  return data(form, "script.quiz-data");
}

/** The verdict on an answer, or none. */
function show(form: HTMLFormElement, question: Question, given: Given | null) {
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
