/**
 * What was given in questions and not yet sent: it is there again when the reader comes back to the
 * page, by the history or by loading it anew, in the same tab.
 *
 * @typedef {object} Draft
 * @property {string} sent The verdict on what was sent before, if anything was.
 * @property {string[]} order Of things to be sorted.
 * @property {(string | boolean)[]} values Of fields; of boxes, whether they are checked.
 * @property {boolean} drawn Whether there is a sketch.
 */

import { STORAGE } from "../book.js";
import { all, one } from "../page/dom.js";

const KEY = `${STORAGE}unsent`;

/** By page, and in it by form. @type {Record<string, Record<string, Draft>>} */
let drafts = {};
/** Each form before a hand came to it. @type {WeakMap<HTMLFormElement, string>} */
const untouched = new WeakMap();

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
 * @param {string} page Its address.
 */
export function leave(page) {
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

/**
 * @param {HTMLFormElement} form
 * @returns {Draft}
 */
function draftOf(form) {
  return {
    sent: form.dataset.answered ?? "",
    order: items(form).map(valueOf),
    values: fields(form).map((field) => (isBox(field) ? field.checked : field.value)),
    drawn: "drawn" in form.dataset,
  };
}

/**
 * @param {HTMLFormElement} form
 * @param {Draft} draft
 */
function restore(form, { order, values, drawn }) {
  const byValue = new Map(items(form).map((item) => [valueOf(item), item]));
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

/** @param {HTMLFormElement} form */
function items(form) {
  return all(form, ".order-item", HTMLElement);
}

/** @param {HTMLElement} item */
function valueOf(item) {
  return one(item, "input", HTMLInputElement).value;
}

/** @param {HTMLFormElement} form */
function fields(form) {
  return all(form, "input:not([type=hidden], [type=file])", HTMLInputElement);
}

/** @param {HTMLInputElement} field */
function isBox({ type }) {
  return type === "radio" || type === "checkbox";
}
