/** The page on which the files of a class are merged: its tables, and the same as one file. */

import { message } from "../errors.ts";
import { data, one } from "../page/dom.ts";
import { csv, download } from "../page/download.ts";
import { words } from "../page/words.ts";
import { type Answers, type Asked, type Result, resultsOf, type Try } from "./class_answers.ts";

let results: Result[] = [];

/**
 * Show what the files say in the place of what was shown; a student is called as the file is.
 *
 * @param answersIn Reads a file.
 */
export async function showClass(
  page: HTMLElement,
  files: Iterable<File>,
  answersIn: (file: File) => Promise<Answers>,
) {
  const read = new Map<string, Answers>();
  const said: string[] = [];
  for (const file of files) {
    try {
      read.set(file.name.replace(/\.json$/i, ""), await answersIn(file));
    } catch (error) {
      said.push(words("progress.not_read", { file: file.name, reason: message(error) }));
    }
  }
  results = resultsOf(data(page, "script.class-data") as Asked[], read);
  said.unshift(words("class.merged", { count: read.size, questions: results.length }));
  one(page, ".class-said", HTMLElement).textContent = said.join(" ");
  one(page, ".class-csv", HTMLButtonElement).hidden = results.length === 0;
  const place = one(page, ".class-tables", HTMLElement);
  place.replaceChildren(...results.map((result) => shown(result, place.dataset.root ?? "")));
}

export function saveClass() {
  const head = ["question", "who", "first", "first_right", "last", "last_right", "trap"];
  const rows = results.flatMap(({ question, tried, trap }) =>
    tried.map(({ who, first, last }) => [
      question.id,
      inert(who),
      inert(first.text),
      Number(first.right),
      inert(last.text),
      Number(last.right),
      inert(trap?.[0] ?? ""),
    ]),
  );
  download("class.csv", csv([head, ...rows]), "text/csv");
}

/** Text that no program for tables takes for a formula; numbers stay numbers. */
function inert(text: string) {
  return /^[=+\-@\t\r]/.test(text) && !Number.isFinite(Number(text)) ? `'${text}` : text;
}

function shown({ question, tried, trap }: Result, root: string) {
  const [details, summary] = [element("details"), element("summary")];
  const right = (at: "first" | "last") => tried.filter((each) => each[at].right).length;
  const counts = { count: tried.length, first: right("first"), last: right("last") };
  summary.textContent = `${question.name}: ${words("class.counts", counts)}`;
  if (trap) summary.textContent += ` ${words("class.trap", { answer: trap[0], count: trap[1] })}`;
  const link = Object.assign(element("a"), { href: `${root}${question.place}` });
  link.textContent = question.name;
  const table = element("table");
  const head = ["class.who", "class.first", "class.last"].map((key) => cell("th", words(key)));
  table.append(
    row(head),
    ...tried.map(({ who, first, last }) =>
      row([cell("td", who), ...[first, last].map((each) => cell("td", marked(each)))]),
    ),
  );
  details.append(summary, link, table);
  return details;
}

function marked({ text, right }: Try) {
  return `${right ? "✓" : "✗"} ${text}`;
}

function row(cells: HTMLElement[]) {
  const made = element("tr");
  made.append(...cells);
  return made;
}

function cell(tag: "th" | "td", text: string) {
  return Object.assign(element(tag), { textContent: text });
}

function element<Tag extends keyof HTMLElementTagNameMap>(tag: Tag) {
  return document.createElement(tag);
}
