/**
 * What was given in questions and not yet sent: it is there again when the reader comes back to the
 * page, by the history or by loading it anew, in the same tab.
 *
 * @typedef {object} Given
 * @property {string} sent The verdict on what was sent before, if anything was.
 * @property {string[]} order Of things to be sorted.
 * @property {string[]} chosen
 * @property {string[]} texts Of fields, those of a sketch's points among them.
 * @property {boolean} drawn Whether there is a sketch.
 */

import { STORAGE } from "../book.js";
import { all, one } from "../page/dom.js";

const KEPT = `${STORAGE}unsent`;

/** By page, and in it by form. @type {Record<string, Record<string, Given>>} */
let kept = {};
/** Each form as it was before a hand came to it. @type {WeakMap<HTMLFormElement, string>} */
const untouched = new WeakMap();

/** Listen; called once, after whatever judges answers. */
export function install() {
  kept = recallAll();
  document.addEventListener("answers-forgotten", () => {
    kept = {};
    keepAll();
  });
}

/** Once the page is there, with the answers that were sent. */
export function arrive() {
  const unsent = kept[location.pathname];
  for (const form of forms()) {
    untouched.set(form, JSON.stringify(given(form)));
    const answer = unsent?.[form.id];
    if (isGiven(answer) && answer.sent === sentIn(form)) put(form, answer);
  }
}

/**
 * The page is left, for another of the book or for good.
 *
 * @param {string} page Its address.
 */
export function leave(page) {
  const unsent = forms().flatMap((form) => {
    const now = given(form);
    return JSON.stringify(now) === untouched.get(form) ? [] : [[form.id, now]];
  });
  if (unsent.length === 0 && !(page in kept)) return;
  delete kept[page];
  if (unsent.length > 0) kept[page] = Object.fromEntries(unsent);
  keepAll();
}

/** @returns {typeof kept} */
function recallAll() {
  try {
    const all = JSON.parse(sessionStorage.getItem(KEPT) ?? "{}");
    return all instanceof Object ? all : {};
  } catch {
    return {};
  }
}

/** Where the browser refuses, it lasts until the book is left. */
function keepAll() {
  try {
    sessionStorage.setItem(KEPT, JSON.stringify(kept));
  } catch {
    // Denied, or full.
  }
}

/** @param {Given | undefined} answer */
function isGiven(answer) {
  return !!answer && [answer.order, answer.chosen, answer.texts].every(Array.isArray);
}

function forms() {
  return all(document, "main form:is([data-quiz], [data-predict])", HTMLFormElement);
}

/** @param {HTMLFormElement} form */
function sentIn(form) {
  return form.dataset.answered ?? "";
}

/**
 * @param {HTMLFormElement} form
 * @returns {Given}
 */
function given(form) {
  return {
    sent: sentIn(form),
    order: things(form).map(valueOf),
    chosen: boxes(form)
      .filter(({ checked }) => checked)
      .map(({ value }) => value),
    texts: texts(form).map(({ value }) => value),
    drawn: "drawn" in form.dataset,
  };
}

/**
 * @param {HTMLFormElement} form
 * @param {Given} answer
 */
function put(form, { order, chosen, texts: written, drawn }) {
  const sorted = new Map(things(form).map((thing) => [valueOf(thing), thing]));
  for (const value of order) {
    const thing = sorted.get(value);
    thing?.parentElement?.append(thing);
  }
  for (const box of boxes(form)) box.checked = chosen.includes(box.value);
  const fields = texts(form);
  if (written.length !== fields.length) return;
  fields.forEach((field, index) => (field.value = written[index]));
  if (drawn) fields[0].dispatchEvent(new Event("input", { bubbles: true }));
}

/** @param {HTMLFormElement} form */
function things(form) {
  return all(form, ".order-item", HTMLElement);
}

/** @param {HTMLElement} thing */
function valueOf(thing) {
  return one(thing, "input", HTMLInputElement).value;
}

/** @param {HTMLFormElement} form */
function boxes(form) {
  return all(form, "input:is([type=radio], [type=checkbox])", HTMLInputElement);
}

/** @param {HTMLFormElement} form */
function texts(form) {
  const kinds = ":not([type=radio], [type=checkbox], [type=hidden], [type=file])";
  return all(form, `input${kinds}`, HTMLInputElement);
}
