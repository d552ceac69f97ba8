/**
 * What was given in questions and not yet sent: it is there again when the reader comes back to the
 * page, by the history or by loading it anew, in the same tab.
 */

import { STORAGE } from "../book.js";
import { all, one } from "../page/dom.js";

interface Draft {
  /** The verdict on what was sent before, if anything was. */
  sent: string;
  /** Of things to be sorted. */
  order: string[];
  /** Of fields; of boxes, whether they are checked. */
  values: (string | boolean)[];
  /** Whether there is a sketch. */
  drawn: boolean;
}

const KEY = `${STORAGE}unsent`;

/** By page, and in it by form. */
let drafts: Record<string, Record<string, Draft>> = {};
/** Each form before a hand came to it. */
const untouched: WeakMap<HTMLFormElement, string> = new WeakMap();

/** Listen; called once, after whatever judges answers. */
export function install() {
  try {
    drafts = JSON.parse(sessionStorage.getItem(KEY) ?? "{}");
  } catch {
    // Denied, or not ours: there are none.
  }
  document.addEventListener("answers-forgotten", () => {
    drafts = {};
    save();
  });
}

/** Once the page is there, with the answers that were sent. */
export function arrive() {
  const unsent = drafts[location.pathname];
  for (const form of forms()) {
    untouched.set(form, JSON.stringify(draftOf(form)));
    const draft = unsent?.[form.id];
    if (draft?.sent === (form.dataset.answered ?? "")) restore(form, draft);
  }
}

/**
 * The page is left, for another of the book or for good.
 *
 * @param page Its address.
 */
export function leave(page: string) {
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

function forms() {
  return all(document, "main form:is([data-quiz], [data-predict])", HTMLFormElement);
}

function draftOf(form: HTMLFormElement): Draft {
  return {
    sent: form.dataset.answered ?? "",
    order: items(form).map(numberOf),
    values: fields(form).map((field) => (isBox(field) ? field.checked : field.value)),
    drawn: "drawn" in form.dataset,
  };
}

function restore(form: HTMLFormElement, { order, values, drawn }: Draft) {
  const byValue = new Map(items(form).map((item) => [numberOf(item), item]));
  for (const value of order) {
    const item = byValue.get(value);
    item?.parentElement?.append(item);
  }
  const restored = fields(form);
  if (values.length !== restored.length) return;
  for (const [index, field] of restored.entries()) {
    if (isBox(field)) field.checked = values[index] === true;
    else field.value = String(values[index]);
  }
  if (drawn) restored[0].dispatchEvent(new Event("input", { bubbles: true }));
}

function items(form: HTMLFormElement) {
  return all(form, ".order-item", HTMLElement);
}

function numberOf(item: HTMLElement) {
  return one(item, "input", HTMLInputElement).value;
}

function fields(form: HTMLFormElement) {
  return all(form, "input:not([type=hidden], [type=file])", HTMLInputElement);
}

function isBox({ type }: HTMLInputElement) {
  return type === "radio" || type === "checkbox";
}
