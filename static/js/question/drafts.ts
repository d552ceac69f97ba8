/**
 * Answers that were given and not yet sent: they are there again when the reader comes back to the
 * page, by the history or by loading it anew, in the same tab.
 */

import { STORAGE } from "../book.js";
import { isAnswer } from "../page/storage.ts";
import { KINDS } from "./book_kinds.js";
import { forms, type Answer, questionOf } from "./question.ts";

interface Draft {
  /** Edition of the question. */
  edition: string;
  /** The verdict on what was sent before, if anything was. */
  sent: string;
  given: Answer | null;
}

const KEY = `${STORAGE}unsent`;

/** Drafts by page, and in it by form. */
let drafts: Record<string, Record<string, Draft>> = {};
/** The draft of each form before the reader changed it. */
const untouched: WeakMap<HTMLFormElement, string> = new WeakMap();

export function installDrafts() {
  try {
    drafts = { ...JSON.parse(sessionStorage.getItem(KEY) ?? "{}") };
  } catch {
    // Denied, or not ours: there are none.
  }
  document.addEventListener("answers-forgotten", () => {
    drafts = {};
    save();
  });
}

/** Once the page is there, with the answers that were sent. */
export function restoreDrafts() {
  const unsent = drafts[location.pathname];
  for (const form of forms()) {
    untouched.set(form, JSON.stringify(draftOf(form)));
    const draft = unsent?.[form.id];
    const question = questionOf(form);
    if (draft?.edition !== question.edition || !isAnswer(draft.given)) continue;
    if (draft.sent !== (form.dataset.answered ?? "")) continue;
    const kind = KINDS[question.kind];
    if (kind.fits(question, draft.given)) kind.put?.(form, draft.given);
  }
}

/** The page with this address is left, for another of the book or for good. */
export function leavePage(page: string) {
  const unsent = forms()
    .map((form) => ({ form, draft: draftOf(form) }))
    .filter(({ form, draft }) => JSON.stringify(draft) !== untouched.get(form))
    .map(({ form, draft }) => [form.id, draft]);
  if (unsent.length === 0 && !(page in drafts)) return;
  delete drafts[page];
  if (unsent.length > 0) drafts[page] = Object.fromEntries(unsent);
  save();
}

/** Where the browser refuses, drafts last until the book is left. */
function save() {
  try {
    sessionStorage.setItem(KEY, JSON.stringify(drafts));
  } catch {
    // Denied, or full.
  }
}

function draftOf(form: HTMLFormElement): Draft {
  const question = questionOf(form);
  const kind = KINDS[question.kind];
  const given = kind.put ? kind.read(form, question) : null;
  const { edition } = question;
  const sent = form.dataset.answered ?? "";
  return { edition, sent, given: given instanceof Promise ? null : given };
}
