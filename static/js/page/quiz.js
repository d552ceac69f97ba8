/**
 * Quizzes: an answer is told at once why it is right, or why it tempts. Works without the
 * interpreter; answers are remembered where the browser allows.
 *
 * @typedef {{correct: boolean, explanation_html: string}} Option
 * @typedef {{id: string, kind: "single" | "multiple", options: Option[]}} Quiz
 */

import { all, data, one, within } from "./dom.js";
import { recall, remember } from "./storage.js";

/** Listen for answers on any page, now and after a change of chapter. */
export function installQuizzes() {
  document.addEventListener("submit", (event) => {
    const form = within(event, "form.quiz", HTMLFormElement);
    if (!form) return;
    event.preventDefault();
    answer(form);
  });
  restoreQuizzes();
}

/** Show the answers given on an earlier visit. */
export function restoreQuizzes() {
  for (const form of all(document, "form.quiz", HTMLFormElement)) {
    const chosen = recall(`quiz:${form.dataset.quiz}`);
    const boxes = all(form, 'input[name="answer"]', HTMLInputElement);
    if (!Array.isArray(chosen) || chosen.some((index) => !boxes[index])) continue;
    for (const [index, box] of boxes.entries()) box.checked = chosen.includes(index);
    judge(form, chosen);
  }
}

/** @param {HTMLFormElement} form */
function answer(form) {
  const checked = all(form, 'input[name="answer"]:checked', HTMLInputElement);
  const chosen = checked.map((box) => Number(box.value));
  if (chosen.length === 0) {
    delete form.dataset.answered;
    one(form, ".feedback", HTMLElement).textContent = "Choose an answer first.";
    return;
  }
  judge(form, chosen);
  remember(`quiz:${form.dataset.quiz}`, chosen);
}

/**
 * @param {HTMLFormElement} form
 * @param {number[]} chosen
 */
function judge(form, chosen) {
  /** @type {Quiz} */
  const quiz = data(form, "script.quiz-data");
  const right = quiz.options.every((option, index) => option.correct === chosen.includes(index));
  form.dataset.answered = right ? "correct" : "wrong";
  for (const [index, label] of all(form, "label.option", HTMLElement).entries()) {
    const { correct } = quiz.options[index];
    label.classList.toggle("chosen", chosen.includes(index));
    label.classList.toggle("correct", chosen.includes(index) && correct);
    label.classList.toggle("wrong", chosen.includes(index) && !correct);
  }
  one(form, ".feedback", HTMLElement).innerHTML = feedback(quiz, chosen, right);
}

/**
 * The verdict and, for each chosen option, its own explanation.
 *
 * @param {Quiz} quiz
 * @param {number[]} chosen
 * @param {boolean} right
 */
function feedback(quiz, chosen, right) {
  const explanations = chosen.map((index) => {
    const { correct, explanation_html: html } = quiz.options[index];
    return `<div class="explanation ${correct ? "correct" : "wrong"}">${html}</div>`;
  });
  return `<p class="verdict">${verdict(quiz, chosen, right)}</p>${explanations.join("")}`;
}

/**
 * @param {Quiz} quiz
 * @param {number[]} chosen
 * @param {boolean} right
 */
function verdict(quiz, chosen, right) {
  if (right) return "Right.";
  if (chosen.every((index) => quiz.options[index].correct)) {
    return "Right so far, but something is missing.";
  }
  return quiz.kind === "multiple" ? "Not all of these. Try again." : "Not quite. Try again.";
}
