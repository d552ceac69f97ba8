/**
 * How far the reader has come: of a chapter by the answers on its page, of the book by memory. Below
 * it buttons: forget the answers, save them, read them again. What shows answers on the page follows
 * the events `answers-forgotten` and `answers-read`. And the page on which the saved answers of a
 * class are merged.
 */

import { errorText } from "../errors.ts";
import { findAll, data, element, findOptional, find, closestTo } from "../page/dom.ts";
import { loadItem, removeItems } from "../page/storage.ts";
import { setText } from "../page/text.ts";
import { words } from "../page/words.ts";

type Tally = { right: number; wrong: number; count: number };

/** Show it where the page has a place for it; of the book, once there is some. */
export function showProgress() {
  const section = findOptional(document, "section.progress", HTMLElement);
  if (!section) return;
  const ofBook = section.dataset.progress === "book";
  const tally = ofBook ? tallyOfBook(section) : tallyOfPage();
  setText(find(section, ".progress-count", HTMLElement), tallyText(tally));
  if (!ofBook) listMissed(section);
  else if (tally.right + tally.wrong > 0) section.hidden = false;
}

function tallyText({ right, wrong, count }: Tally) {
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
    const answer = loadItem(`quiz:${id}`);
    return answer?.edition === edition ? [answer] : [];
  });
  const right = answers.filter((answer) => answer.right === true).length;
  return { right, wrong: answers.length - right, count: questions.length };
}

function listMissed(section: HTMLElement) {
  const list = find(section, ".missed", HTMLElement);
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
  return findAll(document, "form.quiz", HTMLFormElement);
}

/** Listen for them on any page. */
export function install() {
  document.addEventListener("click", (event) => {
    const section = closestTo(event, "section.progress", HTMLElement);
    if (!section) return;
    if (closestTo(event, "[data-progress-reset]", Element)) reset(section);
    if (closestTo(event, "[data-progress-export]", Element)) exportFile(section);
    if (closestTo(event, "[data-progress-import]", Element)) fileInput(section).click();
  });
  document.addEventListener("click", async (event) => {
    if (closestTo(event, ".class-csv", Element)) (await import("./class_page.ts")).saveClass();
  });
  document.addEventListener("change", async (event) => {
    const files = closestTo(event, ".class-files", HTMLInputElement)?.files;
    const page = findOptional(document, "article.class", HTMLElement);
    if (!files || !page) return;
    const { progressIn } = await import("./progress_file.ts");
    await (await import("./class_page.ts")).showClass(page, files, progressIn);
  });
  document.addEventListener("change", (event) => {
    const input = closestTo(event, ".progress-file", HTMLInputElement);
    const section = findOptional(document, "section.progress", HTMLElement);
    const file = input?.files?.[0];
    if (input && section && file) importFile(section, file).finally(() => (input.value = ""));
  });
}

function reset(section: HTMLElement) {
  if (section.dataset.progress === "book") removeItems(/^(quiz|predict|code):/);
  document.dispatchEvent(new Event("answers-forgotten"));
  showMessage(section, words("progress.forgotten"));
}

async function exportFile(section: HTMLElement) {
  const { saveProgress } = await import("./progress_file.ts");
  const count = saveProgress(find(section, ".progress-name", HTMLInputElement).value.trim());
  showMessage(section, words("progress.saved", { count }));
}

async function importFile(section: HTMLElement, file: File) {
  const { readProgress } = await import("./progress_file.ts");
  try {
    const count = await readProgress(file, `${document.body.dataset.root ?? ""}book.json`);
    document.dispatchEvent(new Event("answers-read"));
    showMessage(section, words("progress.read", { file: file.name, count }));
  } catch (error) {
    showMessage(section, words("progress.not_read", { file: file.name, reason: errorText(error) }));
  }
}

function fileInput(section: HTMLElement) {
  return find(section, ".progress-file", HTMLInputElement);
}

function showMessage(section: HTMLElement, text: string) {
  find(section, ".progress-status", HTMLElement).textContent = text;
}
