/**
 * Predictions: a guess is made, or the answer asked for; then both stand side by side, and what
 * waited for the guess is shown. A guess is made once, and remembered.
 *
 * @typedef {{field: Record<"left" | "right" | "top" | "bottom", number>, x: [number, number],
 *   y: [number, number], truth: number[]}} Sketch
 * @typedef {{id: string, kind: "number" | "choice" | "sketch", edition: string,
 *   options: import("./questions.js").Option[], tolerance?: number, truth?: string,
 *   sketch?: Sketch}} Prediction
 * @typedef {number | number[]} Guess
 */

import { all, data, maybe, one, within } from "../page/dom.js";
import { recall, remember } from "../page/storage.js";
import { shuffleOptions } from "./choice.js";
import { meet } from "./meeting.js";
import { typed } from "./number.js";
import { curve, fitsSketch, installSketches, prepareSketch, putCurve } from "./sketch.js";
import { words } from "../page/words.js";

/** Listen for guesses on any page. */
export function install() {
  document.addEventListener("submit", (event) => {
    const form = within(event, "form[data-predict]", HTMLFormElement);
    if (!form) return;
    event.preventDefault();
    commit(form);
  });
  document.addEventListener("click", (event) => {
    const button = within(event, "[data-reveal]", HTMLButtonElement);
    const id = button?.dataset.reveal || button?.closest("form")?.dataset.predict;
    const form = id ? maybe(document, `form[data-predict="${id}"]`, HTMLFormElement) : null;
    if (form) settle(form, null);
    leadToWaiting(event);
  });
  document.addEventListener("answers-forgotten", forget);
  document.addEventListener("answers-read", arrive);
  installSketches();
}

/** Show what was guessed on an earlier visit. */
export function arrive() {
  for (const form of all(document, "form[data-predict]", HTMLFormElement)) {
    const prediction = predictionOf(form);
    prepare(form, prediction);
    const kept = recall(`predict:${prediction.id}`);
    if (kept?.edition !== prediction.edition || !fits(prediction, kept.guess)) continue;
    if (kept.guess !== null) put(form, prediction, kept.guess);
    show(form, prediction, kept.guess);
  }
}

/** Forget the guesses of this page. */
function forget() {
  for (const form of all(document, "form[data-predict]", HTMLFormElement)) {
    remember(`predict:${form.dataset.predict}`, null);
    form.reset();
    delete form.dataset.answered;
    one(form, "fieldset", HTMLFieldSetElement).disabled = false;
    one(form, ".feedback", HTMLElement).replaceChildren();
    for (const answer of answersTo(form)) delete answer.dataset.open;
    prepare(form, predictionOf(form));
  }
}

/**
 * A link to what still waits for a guess leads to the line that says so.
 *
 * @param {MouseEvent} event
 */
function leadToWaiting(event) {
  const link = within(event, 'a[href^="#"]', HTMLAnchorElement);
  const target = link && document.getElementById(decodeURIComponent(link.hash.slice(1)));
  const answer = target?.parentElement?.closest(".answer:not([data-open])");
  answer?.scrollIntoView();
}

/** @param {HTMLFormElement} form */
function commit(form) {
  const prediction = predictionOf(form);
  const guess = read(form, prediction);
  if (guess !== null) settle(form, guess);
  else one(form, ".feedback", HTMLElement).textContent = words(`predict.${prediction.kind}`);
}

/**
 * The guess stands, or null: the reader wants to know without one.
 *
 * @param {HTMLFormElement} form
 * @param {Guess | null} guess
 */
function settle(form, guess) {
  const prediction = predictionOf(form);
  remember(`predict:${prediction.id}`, { edition: prediction.edition, guess });
  show(form, prediction, guess);
}

/**
 * @param {HTMLFormElement} form
 * @param {Prediction} prediction
 * @param {Guess | null} guess
 */
function show(form, prediction, guess) {
  const right = meet(form, prediction, guess);
  form.dataset.answered = guess === null ? "revealed" : right ? "correct" : "wrong";
  one(form, "fieldset", HTMLFieldSetElement).disabled = true;
  for (const answer of answersTo(form)) answer.dataset.open = "";
}

/**
 * @param {HTMLFormElement} form
 * @returns {Prediction}
 */
function predictionOf(form) {
  return data(form, "script.predict-data");
}

/** @param {HTMLFormElement} form */
function answersTo(form) {
  return all(document, `[data-answers="${form.dataset.predict}"]`, HTMLElement);
}

/**
 * @param {HTMLFormElement} form
 * @param {Prediction} prediction
 */
function prepare(form, prediction) {
  if (prediction.kind === "choice") shuffleOptions(form, `predict:${prediction.id}`);
  if (prediction.sketch) prepareSketch(form, prediction.sketch);
}

/**
 * @param {HTMLFormElement} form
 * @param {Prediction} prediction
 * @returns {Guess | null}
 */
function read(form, prediction) {
  switch (prediction.kind) {
    case "number":
      return typed(form, "guess");
    case "choice": {
      const chosen = maybe(form, 'input[name="guess"]:checked', HTMLInputElement);
      return chosen && Number(chosen.value);
    }
    case "sketch":
      return curve(form);
  }
}

/**
 * Whether what was remembered can be a guess of this kind.
 *
 * @param {Prediction} prediction
 * @param {any} guess
 */
function fits(prediction, guess) {
  if (guess === null) return true;
  if (prediction.sketch) return fitsSketch(guess, prediction.sketch);
  return Number.isFinite(guess) && (prediction.kind === "number" || guess in prediction.options);
}

/**
 * @param {HTMLFormElement} form
 * @param {Prediction} prediction
 * @param {any} guess
 */
function put(form, prediction, guess) {
  switch (prediction.kind) {
    case "number":
      one(form, 'input[name="guess"]', HTMLInputElement).value = String(guess);
      break;
    case "choice":
      one(form, `input[name="guess"][value="${guess}"]`, HTMLInputElement).checked = true;
      break;
    case "sketch":
      putCurve(form, guess);
  }
}
