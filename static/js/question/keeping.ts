/**
 * The buttons below a chapter's questions: forget the answers, save them, read them again. What
 * shows answers on the page follows the events `answers-forgotten` and `answers-read`. And the
 * page on which the saved answers of a class are merged.
 */

import { message } from "../errors.ts";
import { maybe, one, within } from "../page/dom.ts";
import { forget } from "../page/storage.ts";
import { words } from "../page/words.ts";

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
    const { answersIn } = await import("./progress_file.ts");
    await (await import("./class_page.ts")).showClass(page, files, answersIn);
  });
  document.addEventListener("change", (event) => {
    const input = within(event, ".progress-file", HTMLInputElement);
    const section = maybe(document, "section.progress", HTMLElement);
    const file = input?.files?.[0];
    if (input && section && file) read(section, file).finally(() => (input.value = ""));
  });
}

function reset(section: HTMLElement) {
  if (section.dataset.progress === "book") forget(/^(quiz|predict):/);
  document.dispatchEvent(new Event("answers-forgotten"));
  say(section, words("progress.forgotten"));
}

async function save(section: HTMLElement) {
  const { saveProgress } = await import("./progress_file.ts");
  const count = saveProgress();
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
