/** The answers of a class, question by question, from the files that its students sent. */

import { numeral } from "../page/words.ts";
import { KINDS } from "./book_kinds.js";
import type { Given, Question } from "./question.ts";

export interface Asked extends Question {
  name: string;
  /** Its address, from the site's root. */
  place: string;
  options: (Question["options"][number] & { text: string })[];
  tolerance?: number;
}

export interface Try {
  text: string;
  right: boolean;
}

/** Of one student to one question. */
export interface Tried {
  who: string;
  first: Try;
  last: Try;
}

export interface Result {
  question: Asked;
  tried: Tried[];
  /** The wrong answer that most gave at first, and how many. */
  trap: [string, number] | null;
}

/** Answers of a file by the names under which a browser stores them. */
export type Answers = Record<string, any>;

/** The questions that anyone has answered; answers to other editions of them are left out. */
export function resultsOf(questions: Asked[], files: Map<string, Answers>): Result[] {
  const results = questions.map((question) => {
    const tried = [...files].flatMap(([who, answers]) => {
      const entry = answers[`quiz:${question.id}`];
      if (entry?.edition !== question.edition) return [];
      const last = judged(question, entry.answer);
      const first = judged(question, entry.first) ?? last;
      return first && last ? [{ who, first, last }] : [];
    });
    return { question, tried, trap: trapOf(tried) };
  });
  return results.filter(({ tried }) => tried.length > 0);
}

function judged(question: Asked, given: Given | undefined): Try | null {
  const kind = KINDS[question.kind];
  if (given === undefined || !kind.fits(question, given)) return null;
  return { text: textOf(question, given), right: kind.judge(question, given).right };
}

function textOf({ options, tolerance }: Asked, given: Given) {
  const places = [given].flat();
  if (tolerance !== undefined) return places.map((value) => numeral(String(value))).join(" ");
  return places.map((at) => options[at].text).join(" · ");
}

function trapOf(tried: Tried[]): [string, number] | null {
  const counts = new Map<string, number>();
  for (const { first } of tried) {
    if (!first.right) counts.set(first.text, (counts.get(first.text) ?? 0) + 1);
  }
  const [most] = [...counts].sort(([, some], [, others]) => others - some);
  return most ?? null;
}
