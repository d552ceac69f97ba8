/** The answers of a class, question by question, from the files that its students sent. */

import { numeral } from "../page/words.ts";
import { KINDS } from "./book_kinds.js";
import type { Given, Question } from "./question.ts";

export interface Asked {
  id: string;
  name: string;
  /** Its address, from the site's root. */
  place: string;
  /** With each of the numbers that it draws; the question alone, where it draws none. */
  variants: Variant[];
}

interface Variant extends Question {
  /** `f = 24; N = 5.6`. */
  drawn: string;
  options: (Question["options"][number] & { text: string })[];
  tolerance?: number;
}

export interface Try {
  text: string;
  right: boolean;
}

/** Answers of one student to one question. */
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
      const asked = question.variants.find(({ edition }) => edition === entry?.edition);
      if (!asked) return [];
      const last = judged(asked, entry.answer);
      const first = judged(asked, entry.first) ?? last;
      return first && last ? [{ who, first, last }] : [];
    });
    return { question, tried, trap: trapOf(tried) };
  });
  return results.filter(({ tried }) => tried.length > 0);
}

function judged(question: Variant, given: Given | undefined): Try | null {
  const kind = KINDS[question.kind];
  if (given === undefined || !kind.fits(question, given)) return null;
  return { text: textOf(question, given), right: kind.judge(question, given).right };
}

function textOf({ options, tolerance, drawn }: Variant, given: Given) {
  const places = [given].flat();
  const text =
    tolerance === undefined
      ? places.map((at) => options[at].text).join(" · ")
      : places.map((value) => numeral(String(value))).join(" ");
  return drawn ? `${drawn}: ${text}` : text;
}

function trapOf(tried: Tried[]): [string, number] | null {
  const counts = new Map<string, number>();
  for (const { first } of tried) {
    if (!first.right) counts.set(first.text, (counts.get(first.text) ?? 0) + 1);
  }
  const [most] = [...counts].sort(([, some], [, others]) => others - some);
  return most ?? null;
}
