/**
 * Answers and guesses as a file: to keep them, or to take them to another device. What is read is
 * checked as a whole before any of it is stored.
 */

import { STORAGE } from "../book.js";
import { printable } from "../errors.ts";
import { download } from "../page/dom.ts";
import { hasValidShape, saveItem, storedItems } from "../page/storage.ts";
import { words } from "../page/words.ts";

const FORMAT = `${STORAGE.replace(":", "")}-progress`;
const VERSION = 1;
const NAMES = /^(quiz|predict):[a-z0-9]+(-[a-z0-9]+)*$/;
const LARGEST = 1_000_000;
const LONGEST_NAME = 80;
/** What some system allows in no name of a file. */
const NO_FILE = /[\p{C}\s\\/:*?"<>|.]+/gu;

interface Progress {
  /** The reader, as they call themselves; empty where they gave no name. */
  who: string;
  answers: Record<string, unknown>;
}

/** Offer the file, with the reader's name in it and in its name; how many answers it has. */
export function saveProgress(who: string): number {
  const answers = storedItems(NAMES);
  const text = JSON.stringify({ format: FORMAT, version: VERSION, who, answers }, null, 1);
  const name = [FORMAT, who.replaceAll(NO_FILE, " ").trim()].filter(Boolean).join(" ");
  download(`${name.replaceAll(" ", "-")}.json`, text, "application/json");
  return Object.keys(answers).length;
}

/**
 * Store the answers of a file to questions that the book asks.
 *
 * @param catalogue Address of `book.json`.
 * @returns Their number.
 * @throws {Error} Where the file is none, or the catalogue does not arrive; nothing is stored then.
 */
export async function readProgress(file: File, catalogue: string): Promise<number> {
  const { answers } = await progressIn(file);
  const reply = await fetch(catalogue);
  if (!reply.ok) throw new Error(`${reply.url}: ${reply.status}`);
  const { quizzes, predictions } = await reply.json();
  const names = [["quiz", quizzes] as const, ["predict", predictions] as const].flatMap(
    ([kind, questions]) => questions.map(({ id }: { id: string }) => `${kind}:${id}`),
  );
  const known = names.filter((name) => Object.hasOwn(answers, name));
  for (const name of known) saveItem(name, answers[name]);
  return known.length;
}

function checked(content: any): Progress {
  if (content?.format !== FORMAT) throw new Error(words("progress.no_answers_file"));
  if (content.version !== VERSION) {
    const version = printable(String(content.version));
    throw new Error(words("progress.version", { version, legal: VERSION }));
  }
  const { who, answers } = content;
  if (typeof answers !== "object" || answers === null || Array.isArray(answers)) {
    throw new Error(words("progress.no_answers"));
  }
  for (const [name, entry] of Object.entries(answers)) {
    if (!NAMES.test(name) || !hasValidShape(name, entry)) {
      throw new Error(words("progress.broken", { name: JSON.stringify(printable(name)) }));
    }
  }
  const name = typeof who === "string" ? printable(who.slice(0, LONGEST_NAME)) : "";
  return { who: name, answers };
}

/** What a file holds, or an error where it holds no answers. */
export async function progressIn(file: File): Promise<Progress> {
  if (file.size > LARGEST) throw new Error(words("progress.too_large"));
  const text = await file.text();
  let content: any;
  try {
    content = JSON.parse(text);
  } catch {
    throw new Error(words("progress.no_json"));
  }
  return checked(content);
}
