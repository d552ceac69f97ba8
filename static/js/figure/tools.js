/** What can be done with a figure as a whole: the row of buttons below it. */

import { maybe, one } from "../page/dom.js";
import { sharedRuntime } from "../runtime/runtime.js";
import { message } from "../errors.js";
import { readValues } from "./controls.js";
import { glide, jump } from "./moves.js";
import { numbersOf } from "./numbers.js";
import { permalink, settingsOf } from "./permalink.js";
import { pictureOf } from "./picture.js";

/** @typedef {(figure: HTMLElement, button: HTMLButtonElement) => unknown} Tool */

/**
 * By the attribute of their button, as in `dataset`.
 *
 * @type {Record<string, Tool>}
 */
const TOOLS = {
  reset,
  fullScreen,
  copyLink: (figure) => copy(figure, permalink(figure), "Link"),
  copyPython,
  saveNumbers: (figure) =>
    save(figure, new Blob([numbersOf(figure)], { type: "text/csv" }), "numbers.csv"),
  savePanel,
};

/**
 * Do what a button of the row says.
 *
 * @param {HTMLButtonElement} button
 */
export async function use(button) {
  const figure = button.closest("simulation-figure");
  const name = Object.keys(TOOLS).find((tool) => tool in button.dataset);
  if (!(figure instanceof HTMLElement) || !name) return;
  tell(figure, "");
  one(figure, ".copied", HTMLTextAreaElement).hidden = true;
  try {
    await TOOLS[name](figure, button);
  } catch (error) {
    tell(figure, `That did not work: ${message(error)}`);
  }
}

/**
 * Back to where the page put it.
 *
 * @param {HTMLElement} figure
 */
function reset(figure) {
  const { start } = settingsOf(figure);
  jump(figure, start);
  glide(figure, start);
}

/**
 * @param {HTMLElement} figure
 * @param {HTMLButtonElement} button
 */
async function fullScreen(figure, button) {
  const whole = figure.closest("figure");
  if (document.fullscreenElement) {
    await document.exitFullscreen();
    return;
  }
  await whole?.requestFullscreen();
  button.setAttribute("aria-pressed", "true");
  const left = () => {
    if (document.fullscreenElement) return;
    document.removeEventListener("fullscreenchange", left);
    button.setAttribute("aria-pressed", "false");
  };
  document.addEventListener("fullscreenchange", left);
}

/**
 * Copy the script that prints what the figure shows.
 *
 * @param {HTMLElement} figure
 */
async function copyPython(figure) {
  const { form, controls } = settingsOf(figure);
  const { tier = "", ...values } = readValues(form, controls);
  const scene = figure.dataset.simulation ?? "";
  const edited = "edited" in figure.dataset;
  const own = figure.querySelector(".photograph-back:not([hidden])") !== null;
  const payload = { scene, values: JSON.stringify(values), tier, edited, own };
  const reply = await sharedRuntime()?.call("script", payload, () => 2);
  const unlike = [...(edited ? ["code"] : []), ...(own ? ["picture"] : [])].join(" and ");
  await copy(figure, reply.script, unlike ? `Python, with the book’s ${unlike},` : "Python");
}

/**
 * @param {HTMLElement} figure
 * @param {HTMLButtonElement} button
 */
async function savePanel(figure, button) {
  const name = button.dataset.savePanel ?? "";
  const panel = one(figure, `.panel[data-panel="${CSS.escape(name)}"]`, HTMLElement);
  const { blob, suffix } = await pictureOf(panel);
  save(figure, blob, `${name}.${suffix}`);
}

/**
 * Copy a text; where the browser forbids it, show it, ready to be copied by hand.
 *
 * @param {HTMLElement} figure
 * @param {string} text
 * @param {string} what
 */
async function copy(figure, text, what) {
  try {
    await navigator.clipboard.writeText(text);
    tell(figure, `${what} copied.`);
  } catch {
    const field = one(figure, ".copied", HTMLTextAreaElement);
    field.value = text;
    field.hidden = false;
    field.select();
    tell(figure, "The browser does not let the page copy. Here it is, selected:");
  }
}

/**
 * @param {HTMLElement} figure
 * @param {Blob} blob
 * @param {string} name
 */
function save(figure, blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = `${figure.closest("figure")?.id ?? "figure"}-${name}`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  tell(figure, `Saved as ${link.download}.`);
}

/**
 * @param {HTMLElement} figure
 * @param {string} words
 */
function tell(figure, words) {
  const line = maybe(figure, ".tools-said", HTMLElement);
  if (line) line.textContent = words;
}
