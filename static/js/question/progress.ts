/** How far the reader has come: of a chapter by the answers on its page, of the book by memory. */

import { all, data, maybe, one } from "../page/dom.ts";
import { recall } from "../page/storage.ts";
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
  const chapters: Record<string, Record<string, string[]>> = data(section, "script.progress-data");
  const questions = Object.values(chapters).flatMap(Object.entries);
  const answers = questions.flatMap(([id, editions]) => {
    const answer = recall(`quiz:${id}`);
    return editions.includes(answer?.edition) ? [answer] : [];
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
      const [item, link] = [document.createElement("li"), document.createElement("a")];
      link.href = `#${form.id}`;
      link.textContent = form.querySelector(".asked")?.textContent?.trim() ?? "";
      item.append(link);
      return item;
    }),
  );
}

function forms() {
  return all(document, "form.quiz", HTMLFormElement);
}
