/** A guess and the computed answer, side by side. */

import { all, one } from "../page/dom.js";
import { numeral, words } from "../page/words.js";
import { say } from "./feedback.js";
import { recognised } from "./number.js";
import type { Prediction, Guess } from "./predictions.js";
import { farthest } from "./sketch.js";

/** How far, of the height of its axis, a sketched curve may be off and pass for the true one. */
const CLOSE = 0.1;

/**
 * Set them side by side, and tell whether they agree.
 *
 * @param guess Null where the reader made none.
 */
export function meet(form: HTMLFormElement, prediction: Prediction, guess: any): boolean {
  switch (prediction.kind) {
    case "number":
      return meetNumber(form, prediction, guess);
    case "choice":
      return meetChoice(form, prediction, guess);
    case "sketch":
      return meetSketch(form, prediction, guess);
  }
}

function meetNumber(form: HTMLFormElement, prediction: Prediction, guess: number | null) {
  const { options, tolerance = 0 } = prediction;
  const right = options.find(({ correct }) => correct);
  const taken = guess === null ? right : recognised(options, guess, tolerance);
  const agrees = taken === right;
  say(feedback(form), verdict(guess, agrees), taken ? [taken] : []);
  const unit = one(form, ".unit", HTMLElement).textContent ?? "";
  const said = guess === null ? null : [`${numeral(String(guess))} ${unit}`.trim()];
  sideBySide(form, said, [prediction.truth ?? ""]);
  return agrees;
}

function meetChoice(form: HTMLFormElement, { options }: Prediction, guess: number | null) {
  const right = options.findIndex(({ correct }) => correct);
  const agrees = guess === right;
  const replies = agrees || guess === null ? [options[right]] : [options[guess], options[right]];
  say(feedback(form), verdict(guess, agrees), replies);
  const wordsOf = (index: number) => {
    const input = one(form, `input[name="guess"][value="${index}"]`, HTMLInputElement);
    const text = one(input.parentElement ?? form, ".option-text", HTMLElement);
    return [...text.cloneNode(true).childNodes];
  };
  sideBySide(form, guess === null ? null : wordsOf(guess), wordsOf(right));
  for (const input of all(form, 'input[name="guess"]', HTMLInputElement)) {
    const { correct } = options[Number(input.value)];
    const chosen = Number(input.value) === guess;
    input.parentElement?.classList.toggle("correct", correct);
    input.parentElement?.classList.toggle("wrong", chosen && !correct);
  }
  return agrees;
}

function meetSketch(form: HTMLFormElement, { sketch }: Prediction, guess: number[] | null) {
  if (!sketch || guess === null) {
    say(feedback(form), verdict(null, false), []);
    return false;
  }
  const { x, drawn, truth } = farthest(guess, sketch);
  const agrees = Math.abs(drawn - truth) <= CLOSE * (sketch.y[1] - sketch.y[0]);
  say(feedback(form), verdict(guess, agrees), []);
  const where = document.createElement("p");
  where.className = "explanation";
  const numbers = { x: short(x), drawn: short(drawn), truth: short(truth) };
  where.textContent = words("predict.farthest", numbers);
  feedback(form).append(where);
  return agrees;
}

/** Two digits after the first, with a true minus sign. */
function short(value: number) {
  return numeral(String(Number(value.toPrecision(3))).replace("-", "\u2212"));
}

function verdict(guess: Guess | null, agrees: boolean) {
  if (guess === null) return words("predict.without");
  return words(agrees ? "predict.agrees" : "predict.differs");
}

function feedback(form: HTMLFormElement) {
  return one(form, ".feedback", HTMLElement);
}

function sideBySide(
  form: HTMLFormElement,
  guess: (Node | string)[] | null,
  truth: (Node | string)[],
) {
  const list = document.createElement("dl");
  list.className = "meeting";
  for (const [name, said, kind] of [
    [words("predict.your_guess"), guess, "guessed"],
    [words("predict.computed"), truth, "computed"],
  ]) {
    if (!Array.isArray(said)) continue;
    const group = document.createElement("div");
    group.className = String(kind);
    const [term, value] = [document.createElement("dt"), document.createElement("dd")];
    term.textContent = String(name);
    value.append(...said);
    group.append(term, value);
    list.append(group);
  }
  feedback(form).prepend(list);
}
