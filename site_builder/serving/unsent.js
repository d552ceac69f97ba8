/**
 * What was given in questions and not sent, while the page is loaded anew; what figures are set to
 * is in the address.
 *
 * @typedef {object} Answer
 * @property {string[]} order Of things to be sorted.
 * @property {string[]} chosen
 * @property {string[]} texts Of fields, those of a sketch's points among them.
 * @property {boolean} drawn Whether there is a sketch.
 */

const KEPT = "unsent-answers";

/** Until the page is there again. */
export function keepAnswers() {
  const answers = forms().map((form) => [form.id, given(form)]);
  sessionStorage.setItem(KEPT, JSON.stringify({ page: location.pathname, answers }));
}

/** Once it is there. */
export function putBackAnswers() {
  const { page, answers } = JSON.parse(sessionStorage.getItem(KEPT) ?? "{}");
  sessionStorage.removeItem(KEPT);
  if (page !== location.pathname) return;
  const kept = new Map(answers);
  for (const form of forms()) {
    const answer = kept.get(form.id);
    if (answer) put(form, answer);
  }
}

function forms() {
  return /** @type {HTMLFormElement[]} */ ([
    ...document.querySelectorAll("main form:is([data-quiz], [data-predict])"),
  ]);
}

/**
 * @param {HTMLFormElement} form
 * @returns {Answer}
 */
function given(form) {
  return {
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
 * @param {Answer} answer
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
  return [...form.querySelectorAll(".order-item")];
}

/** @param {Element} thing */
function valueOf(thing) {
  return /** @type {HTMLInputElement} */ (thing.querySelector("input")).value;
}

/** @param {HTMLFormElement} form */
function boxes(form) {
  return inputs(form, ":is([type=radio], [type=checkbox])");
}

/** @param {HTMLFormElement} form */
function texts(form) {
  return inputs(form, ":not([type=radio], [type=checkbox], [type=hidden], [type=file])");
}

/**
 * @param {HTMLFormElement} form
 * @param {string} kind
 */
function inputs(form, kind) {
  return /** @type {HTMLInputElement[]} */ ([...form.querySelectorAll(`input${kind}`)]);
}
