/** What a prediction has besides: its answer, hidden until then, and the guess beside what is right. */

import { all, maybe, within } from "../page/dom.ts";
import { words } from "../page/words.ts";
import type { Shown } from "./question.ts";

/** The prediction whose answer is asked for by this click, without a guess. */
export function revealedBy(event: MouseEvent) {
  const button = within(event, "[data-reveal]", HTMLButtonElement);
  const id = button?.dataset.reveal || button?.closest("form")?.dataset.predict;
  return id ? maybe(document, `form[data-predict="${id}"]`, HTMLFormElement) : null;
}

/** A link to what is still hidden leads to the question before it. */
export function leadToHidden(event: MouseEvent) {
  const link = within(event, 'a[href^="#"]', HTMLAnchorElement);
  const target = link && document.getElementById(decodeURIComponent(link.hash.slice(1)));
  const answer = target?.parentElement?.closest<HTMLElement>(".answer:not([data-open])");
  if (answer) document.getElementById(`predict-${answer.dataset.answers}`)?.scrollIntoView();
}

/** Links of the question to the experiment are plain words until the guess is made. */
export function holdLinks(form: HTMLFormElement, isMade: boolean) {
  for (const link of all(form, ".predict-question a.set", HTMLAnchorElement)) {
    const { held } = link.dataset;
    if (isMade && held !== undefined) {
      link.href = held;
      delete link.dataset.held;
    } else if (!isMade && held === undefined) {
      link.dataset.held = link.getAttribute("href") ?? "";
      link.removeAttribute("href");
    }
  }
}

/** What is hidden until this prediction is made. */
export function answersTo(form: HTMLFormElement) {
  return all(document, `[data-answers="${form.dataset.predict}"]`, HTMLElement);
}

/** The guess, if there is one, and what was computed. */
export function sideBySide(guess: Shown | null, truth: Shown) {
  const list = document.createElement("dl");
  list.className = "meeting row";
  if (guess) list.append(group("guessed role-ray", words("predict.your_guess"), guess));
  list.append(group("computed role-image", words("predict.computed"), truth));
  return list;
}

function group(className: string, name: string, shown: Shown) {
  const parts = Object.assign(document.createElement("div"), { className });
  const [term, value] = [document.createElement("dt"), document.createElement("dd")];
  term.className = "fine";
  term.textContent = name;
  value.append(...shown);
  parts.append(term, value);
  return parts;
}
