/**
 * Predictions: a guess is made, or the answer asked for; then both stand side by side, and what
 * waited for the guess is shown. A guess is made once, and remembered.
 */

import { all, data, maybe, one, within } from "../page/dom.js";
import { onOtherTab, recall, remember } from "../page/storage.js";
import { words } from "../page/words.js";
import { shuffleOptions } from "./choice.js";
import { meet } from "./meeting.js";
import { typed } from "./number.js";
import { curve, fitsSketch, installSketches, prepareSketch, putCurve } from "./sketch.js";

export interface Sketch {
  field: Record<"left" | "right" | "top" | "bottom", number>;
  x: [number, number];
  y: [number, number];
  truth: number[];
}

export interface Prediction {
  id: string;
  kind: "number" | "choice" | "sketch";
  edition: string;
  options: import("./questions.js").Option[];
  tolerance?: number;
  truth?: string;
  sketch?: Sketch;
}

export type Guess = number | number[];

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
  onOtherTab((key) => {
    for (const form of all(document, "form[data-predict]", HTMLFormElement)) {
      if (key === `predict:${form.dataset.predict}`) restore(form);
    }
  });
  installSketches();
}

/** Show what was guessed on an earlier visit. */
export function arrive() {
  for (const form of all(document, "form[data-predict]", HTMLFormElement)) {
    prepare(form, predictionOf(form));
    restore(form);
  }
}

/** Show what was guessed, here or in another tab. */
function restore(form: HTMLFormElement) {
  const prediction = predictionOf(form);
  const kept = recall(`predict:${prediction.id}`);
  if (kept?.edition !== prediction.edition || !fits(prediction, kept.guess)) return;
  if (kept.guess !== null) put(form, prediction, kept.guess);
  show(form, prediction, kept.guess);
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

/** A link to what still waits for a guess leads to the line that says so. */
function leadToWaiting(event: MouseEvent) {
  const link = within(event, 'a[href^="#"]', HTMLAnchorElement);
  const target = link && document.getElementById(decodeURIComponent(link.hash.slice(1)));
  const answer = target?.parentElement?.closest(".answer:not([data-open])");
  answer?.scrollIntoView();
}

function commit(form: HTMLFormElement) {
  const prediction = predictionOf(form);
  const guess = read(form, prediction);
  if (guess !== null) settle(form, guess);
  else one(form, ".feedback", HTMLElement).textContent = words(`predict.${prediction.kind}`);
}

/** The guess stands, or null: the reader wants to know without one. */
function settle(form: HTMLFormElement, guess: Guess | null) {
  const prediction = predictionOf(form);
  remember(`predict:${prediction.id}`, { edition: prediction.edition, guess });
  show(form, prediction, guess);
}

function show(form: HTMLFormElement, prediction: Prediction, guess: Guess | null) {
  const right = meet(form, prediction, guess);
  form.dataset.answered = guess === null ? "revealed" : right ? "correct" : "wrong";
  one(form, "fieldset", HTMLFieldSetElement).disabled = true;
  for (const answer of answersTo(form)) answer.dataset.open = "";
}

function predictionOf(form: HTMLFormElement): Prediction {
  return data(form, "script.predict-data");
}

function answersTo(form: HTMLFormElement) {
  return all(document, `[data-answers="${form.dataset.predict}"]`, HTMLElement);
}

function prepare(form: HTMLFormElement, prediction: Prediction) {
  if (prediction.kind === "choice") shuffleOptions(form, `predict:${prediction.id}`);
  if (prediction.sketch) prepareSketch(form, prediction.sketch);
}

function read(form: HTMLFormElement, prediction: Prediction): Guess | null {
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

/** Whether what was remembered can be a guess of this kind. */
function fits(prediction: Prediction, guess: any) {
  if (guess === null) return true;
  if (prediction.sketch) return fitsSketch(guess, prediction.sketch);
  return Number.isFinite(guess) && (prediction.kind === "number" || guess in prediction.options);
}

function put(form: HTMLFormElement, prediction: Prediction, guess: any) {
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
