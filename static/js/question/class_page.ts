/**
 * The page on which the files of a class are merged: the answers of its students question by
 * question, in tables and as one file.
 */

import { errorText } from "../errors.ts";
import { csv, data, download, element, find } from "../page/dom.ts";
import { numeral, words } from "../page/words.ts";
import { KINDS } from "./book_kinds.js";
import type { Answer, Question } from "./question.ts";

interface ClassQuestion extends Question {
  name: string;
  /** Its address, from the site's root. */
  place: string;
  options: (Question["options"][number] & { text: string })[];
  tolerance?: number;
}

interface Attempt {
  text: string;
  right: boolean;
}

/** Answers of one student to one question. */
interface StudentAttempts {
  who: string;
  first: Attempt;
  last: Attempt;
}

interface Result {
  question: ClassQuestion;
  tried: StudentAttempts[];
  /** The wrong answer that most gave at first, and how many. */
  trap: [string, number] | null;
}

/** Answers of a file by the names under which a browser stores them. */
type Answers = Record<string, any>;

/** The questions that anyone has answered; answers to other editions of them are left out. */
function resultsOf(questions: ClassQuestion[], files: Map<string, Answers>): Result[] {
  const results = questions.map((question) => {
    const tried = [...files].flatMap(([who, answers]) => {
      const entry = answers[`quiz:${question.id}`];
      if (entry?.edition !== question.edition) return [];
      const last = attemptOf(question, entry.answer);
      const first = attemptOf(question, entry.first) ?? last;
      return first && last ? [{ who, first, last }] : [];
    });
    return { question, tried, trap: trapOf(tried) };
  });
  return results.filter(({ tried }) => tried.length > 0);
}

function attemptOf(question: ClassQuestion, given: Answer | undefined): Attempt | null {
  const kind = KINDS[question.kind];
  if (given === undefined || !kind.fits(question, given)) return null;
  return { text: textOf(question, given), right: kind.judge(question, given).right };
}

function textOf({ options, tolerance }: ClassQuestion, given: Answer) {
  if (typeof given === "object" && "code" in given) return given.code;
  const places = [given].flat();
  return tolerance === undefined
    ? places.map((at) => options[at].text).join(" · ")
    : places.map((value) => numeral(String(value))).join(" ");
}

function trapOf(tried: StudentAttempts[]): [string, number] | null {
  const counts = new Map<string, number>();
  for (const { first } of tried) {
    if (!first.right) counts.set(first.text, (counts.get(first.text) ?? 0) + 1);
  }
  const [most] = [...counts].sort(([, some], [, others]) => others - some);
  return most ?? null;
}

let results: Result[] = [];

/** Show the answers of the files in place of earlier ones. A student without a name has that of the file. */
export async function showClass(
  page: HTMLElement,
  files: Iterable<File>,
  progressIn: (file: File) => Promise<{ who: string; answers: Answers }>,
) {
  const answersByStudent = new Map<string, Answers>();
  const messages: string[] = [];
  for (const file of files) {
    try {
      const { who, answers } = await progressIn(file);
      answersByStudent.set(
        uniqueName(who || file.name.replace(/\.json$/i, ""), answersByStudent),
        answers,
      );
    } catch (error) {
      messages.push(words("progress.not_read", { file: file.name, reason: errorText(error) }));
    }
  }
  results = resultsOf(data(page, "script.class-data") as ClassQuestion[], answersByStudent);
  messages.unshift(
    words("class.merged", { count: answersByStudent.size, questions: results.length }),
  );
  find(page, ".class-status", HTMLElement).textContent = messages.join(" ");
  find(page, ".class-csv", HTMLButtonElement).hidden = results.length === 0;
  const place = find(page, ".class-tables", HTMLElement);
  place.replaceChildren(
    ...results.map((result) => resultElement(result, place.dataset.root ?? "")),
  );
}

/** The name, numbered where two share it. */
function uniqueName(name: string, taken: ReadonlyMap<string, unknown>) {
  let chosen = name;
  for (let number = 2; taken.has(chosen); number += 1) chosen = `${name} (${number})`;
  return chosen;
}

export function saveClass() {
  const head = ["question", "who", "first", "first_right", "last", "last_right", "trap"];
  const rows = results.flatMap(({ question, tried, trap }) =>
    tried.map(({ who, first, last }) => [
      question.id,
      who,
      first.text,
      Number(first.right),
      last.text,
      Number(last.right),
      trap?.[0] ?? "",
    ]),
  );
  const mark = "\ufeff"; // by which programs for tables know that it is UTF-8: names are in it
  download("class.csv", mark + csv([head, ...rows]), "text/csv");
}

function resultElement({ question, tried, trap }: Result, root: string) {
  const [details, table] = [element("details"), element("table")];
  const right = (at: "first" | "last") => tried.filter((each) => each[at].right).length;
  const counts = { count: tried.length, first: right("first"), last: right("last") };
  const mistake = trap ? ` ${words("class.trap", { answer: trap[0], count: trap[1] })}` : "";
  const summary = `${question.name}: ${words("class.counts", counts)}${mistake}`;
  const link = element("a", "", question.name);
  link.href = `${root}${question.place}`;
  table.append(
    row(
      "th",
      ["class.who", "class.first", "class.last"].map((key) => words(key)),
    ),
    ...tried.map(({ who, first, last }) => row("td", [who, attemptText(first), attemptText(last)])),
  );
  details.append(element("summary", "", summary), link, table);
  return details;
}

function attemptText({ text, right }: Attempt) {
  return `${right ? "✓" : "✗"} ${text}`;
}

function row(tag: "th" | "td", texts: string[]) {
  const made = element("tr");
  made.append(...texts.map((text) => element(tag, "", text)));
  return made;
}
