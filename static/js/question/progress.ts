/**
 * How far the reader has come: of a chapter by the answers on its page, of the book by memory. Below
 * it buttons: forget the answers, save them, read them again. What shows answers on the page follows
 * the events `answers-forgotten` and `answers-read`. And the page on which the saved answers of a
 * class are merged.
 */

import { message } from "../errors.ts";
import { all, data, element, maybe, one, within } from "../page/dom.ts";
import { forget, recall } from "../page/storage.ts";
import { setText } from "../page/text.ts";
import { words } from "../page/words.ts";

type Tally = { right: number; wrong: number; count: number };

/** Tell it where the page has a place for it; of the book, once there is some. */
export function showProgress() {
  const section = maybe(document, "section.progress", HTMLElement);
  if (!section) return;
  const ofBook = section.dataset.progress === "book";
  const tally = ofBook ? tallyOfBook(section) : tallyOfPage();
  setText(one(section, ".progress-count", HTMLElement), inWords(tally));
  if (!ofBook) listMissed(section);
  else if (tally.right + tally.wrong > 0) section.hidden = false;
}

function inWords({ right, wrong, count }: Tally) {
  const open = count - right - wrong;
  const parts = [words("progress.answered", { right, count })];
  if (wrong > 0) parts.push(words("progress.missed", { count: wrong }));
  if (open > 0 && open < count) parts.push(words("progress.open", { count: open }));
  return `${parts.join(", ")}.`;
}

function tallyOfPage(): Tally {
  const state = forms().map((form) => form.dataset.answered);
  const count = (kind: string) => state.filter((each) => each === kind).length;
  return { right: count("correct"), wrong: count("wrong"), count: state.length };
}

function tallyOfBook(section: HTMLElement): Tally {
  const editions: Record<string, string> = data(section, "script.progress-data");
  const questions = Object.entries(editions);
  const answers = questions.flatMap(([id, edition]) => {
    const answer = recall(`quiz:${id}`);
    return answer?.edition === edition ? [answer] : [];
  });
  const right = answers.filter((answer) => answer.right === true).length;
  return { right, wrong: answers.length - right, count: questions.length };
}

function listMissed(section: HTMLElement) {
  const list = one(section, ".missed", HTMLElement);
  const missed = forms().filter((form) => form.dataset.answered === "wrong");
  list.hidden = missed.length === 0;
  list.replaceChildren(
    ...missed.map((form) => {
      const text = form.querySelector(".asked")?.textContent?.trim() ?? "";
      const item = element("li");
      item.append(Object.assign(element("a", "", text), { href: `#${form.id}` }));
      return item;
    }),
  );
}

function forms() {
  return all(document, "form.quiz", HTMLFormElement);
}

/** Listen for them on any page. */
export function install() {
  document.addEventListener("click", (event) => {
    const section = within(event, "section.progress", HTMLElement);
    if (!section) return;
    if (within(event, "[data-progress-reset]", Element)) reset(section);
    if (within(event, "[data-progress-export]", Element)) save(section);
    if (within(event, "[data-progress-import]", Element)) picker(section).click();
  });
  document.addEventListener("click", async (event) => {
    if (within(event, ".class-csv", Element)) (await import("./class_page.ts")).saveClass();
  });
  document.addEventListener("change", async (event) => {
    const files = within(event, ".class-files", HTMLInputElement)?.files;
    const page = maybe(document, "article.class", HTMLElement);
    if (!files || !page) return;
    const { progressIn } = await import("./progress_file.ts");
    await (await import("./class_page.ts")).showClass(page, files, progressIn);
  });
  document.addEventListener("change", (event) => {
    const input = within(event, ".progress-file", HTMLInputElement);
    const section = maybe(document, "section.progress", HTMLElement);
    const file = input?.files?.[0];
    if (input && section && file) read(section, file).finally(() => (input.value = ""));
  });
}

function reset(section: HTMLElement) {
  if (section.dataset.progress === "book") forget(/^(quiz|predict|code):/);
  document.dispatchEvent(new Event("answers-forgotten"));
  say(section, words("progress.forgotten"));
}

async function save(section: HTMLElement) {
  const { saveProgress } = await import("./progress_file.ts");
  const count = saveProgress(one(section, ".progress-name", HTMLInputElement).value.trim());
  say(section, words("progress.saved", { count }));
}

async function read(section: HTMLElement, file: File) {
  const { readProgress } = await import("./progress_file.ts");
  try {
    const count = await readProgress(file);
    document.dispatchEvent(new Event("answers-read"));
    say(section, words("progress.read", { file: file.name, count }));
  } catch (error) {
    say(section, words("progress.not_read", { file: file.name, reason: message(error) }));
  }
}

function picker(section: HTMLElement) {
  return one(section, ".progress-file", HTMLInputElement);
}

function say(section: HTMLElement, text: string) {
  one(section, ".progress-said", HTMLElement).textContent = text;
}
