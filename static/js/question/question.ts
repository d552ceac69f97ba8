/** Questions as a page has them, and what a kind of them does in it. */

import { findAll, data } from "../page/dom.ts";

export type Option = { correct: boolean; explanation_html: string; value?: number };

/** What a page has of a question; kinds add to it. */
export interface Question {
  id: string;
  kind: string;
  edition: string;
  options: Option[];
}

/** An answer as it is stored. */
export type Answer = number | number[] | Program;

/** A reader's code, and the index of the reply to it. */
export type Program = { code: string; reply: number };

export interface Verdict {
  right: boolean;
  /** What is said of it; by default no more than whether it is right. */
  words?: string;
  replies: Option[];
  /** Text after the replies. */
  remark?: string;
}

/** Words, or parts of the page. */
export type Content = (Node | string)[];

/** What one kind of question does. */
export interface Kind<Q extends Question = any, G extends Answer = any> {
  /** Listen for what it alone knows; called once. */
  install?: () => void;
  /** Before it is answered. */
  prepare?: (form: HTMLFormElement, question: Q) => void;
  /** The answer, or null where there is none yet. */
  read: (form: HTMLFormElement, question: Q) => G | null | Promise<G>;
  /** What is said where there is none. */
  missing?: (question: Q) => string;
  /** Whether a stored answer can be one of this question. */
  fits: (question: Q, given: any) => boolean;
  /** Show a stored answer; without it, answers are not kept as drafts. */
  put?: (form: HTMLFormElement, given: G) => void;
  judge: (question: Q, given: G) => Verdict;
  /** Mark what is right and what is wrong; null where nothing is given. */
  mark?: (form: HTMLFormElement, question: Q, given: G | null) => void;
  /** What was given to a prediction, if anything, and what is right, to stand side by side. */
  compare?: (form: HTMLFormElement, question: Q, given: G | null) => [Content | null, Content];
}

export function forms() {
  return findAll(document, "main form:is([data-quiz], [data-predict])", HTMLFormElement);
}

export function questionOf(form: HTMLFormElement): Question {
  return data(form, "script:is(.quiz-data, .predict-data)");
}

export function isPrediction(form: HTMLFormElement) {
  return form.dataset.predict !== undefined;
}
