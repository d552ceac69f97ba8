/** What is said of an answer: the verdict, and what the book says of it. */

/** @import { Option } from "./questions.js" */

/**
 * @param {HTMLElement} feedback
 * @param {string} verdict
 * @param {Option[]} replies
 */
export function say(feedback, verdict, replies) {
  const words = document.createElement("p");
  words.className = "verdict";
  words.textContent = verdict;
  feedback.replaceChildren(words, ...replies.filter(told).map(explanation));
}

/** @param {Option} reply */
function told(reply) {
  return reply.explanation_html !== "";
}

/** @param {Option} reply */
function explanation({ correct, explanation_html: html }) {
  const element = document.createElement("div");
  element.className = `explanation ${correct ? "correct" : "wrong"}`;
  element.innerHTML = html; // the book's own, as its page has it
  return element;
}
