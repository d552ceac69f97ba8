/**
 * Quizzes: an answer is told at once why it is right, or why it tempts. Works without the
 * interpreter; answers are remembered where the browser allows.
 *
 * @typedef {{correct: boolean, explanation_html: string}} Option
 * @typedef {{id: string, kind: "single" | "multiple", options: Option[]}} Quiz
 */

import { recall, remember } from "./storage.js";

/** Listen for answers on any page, now and after a change of chapter. */
export function installQuizzes() {
  document.addEventListener("submit", (event) => {
    const form = event.target.closest("form.quiz");
    if (!form) return;
    event.preventDefault();
    answer(form);
  });
  restoreQuizzes();
}

/** Show the answers given on an earlier visit. */
export function restoreQuizzes() {
  for (const form of document.querySelectorAll("form.quiz")) {
    const chosen = recall(`quiz:${form.dataset.quiz}`);
    const boxes = [...form.querySelectorAll('input[name="answer"]')];
    if (!Array.isArray(chosen) || chosen.some((index) => !boxes[index])) continue;
    boxes.forEach((box, index) => (box.checked = chosen.includes(index)));
    judge(form, chosen);
  }
}

/** @param {HTMLFormElement} form */
function answer(form) {
  const chosen = [...form.querySelectorAll('input[name="answer"]:checked')].map((box) =>
    Number(box.value),
  );
  if (chosen.length === 0) {
    delete form.dataset.answered;
    form.querySelector(".feedback").textContent = "Choose an answer first.";
    return;
  }
  judge(form, chosen);
  remember(`quiz:${form.dataset.quiz}`, chosen);
}

/** @param {HTMLFormElement} form @param {number[]} chosen */
function judge(form, chosen) {
  /** @type {Quiz} */
  const quiz = JSON.parse(form.querySelector("script.quiz-data").textContent);
  const right = quiz.options.every((option, index) => option.correct === chosen.includes(index));
  form.dataset.answered = right ? "correct" : "wrong";
  form.querySelectorAll("label.option").forEach((label, index) => {
    label.classList.toggle("chosen", chosen.includes(index));
    label.classList.toggle("correct", chosen.includes(index) && quiz.options[index].correct);
    label.classList.toggle("wrong", chosen.includes(index) && !quiz.options[index].correct);
  });
  form.querySelector(".feedback").innerHTML = feedback(quiz, chosen, right);
}

/** The verdict and, for each chosen option, its own explanation. */
function feedback(quiz, chosen, right) {
  const explanations = chosen.map((index) => {
    const { correct, explanation_html: html } = quiz.options[index];
    return `<div class="explanation ${correct ? "correct" : "wrong"}">${html}</div>`;
  });
  return `<p class="verdict">${verdict(quiz, chosen, right)}</p>${explanations.join("")}`;
}

function verdict(quiz, chosen, right) {
  if (right) return "Right.";
  const wrong = chosen.some((index) => !quiz.options[index].correct);
  if (wrong) return quiz.kind === "multiple" ? "Not all of these. Try again." : "Not quite. Try again.";
  return "Right so far, but something is missing.";
}
