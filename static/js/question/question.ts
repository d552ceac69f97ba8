/** Questions in a page, and the interface of their kinds. */

import { findAll, data } from "../page/dom.ts";

export type Option = { correct: boolean; explanation_html: string; value?: number };

/** The data of a question in a page; kinds add to it. */
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
  /** The text of the verdict; by default whether it is right. */
  words?: string;
  replies: Option[];
  /** Text after the replies. */
  remark?: string;
}

/** Words, or parts of the page. */
export type Content = (Node | string)[];

/** The functions of one kind of question. */
export interface Kind<Q extends Question = any, G extends Answer = any> {
  /** Listen for what it alone knows; called once. */
  install?: () => void;
  /** Before it is answered. */
  prepare?: (form: HTMLFormElement, question: Q) => void;
  /** The answer, or null where there is none yet. */
  read: (form: HTMLFormElement, question: Q) => G | null | Promise<G>;
  /** The message where there is none. */
  missing?: (question: Q) => string;
  /** Whether a stored answer can be one of this question. */
  fits: (question: Q, given: any) => boolean;
  /** Show a stored answer; without it, answers are no drafts. */
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
