/** What is said of an answer: the verdict, and what the book says of it. */

import type { Option } from "./questions.js";

export function say(feedback: HTMLElement, verdict: string, replies: Option[]) {
  const words = document.createElement("p");
  words.className = "verdict";
  words.textContent = verdict;
  feedback.replaceChildren(words, ...replies.filter(told).map(explanation));
}

function told(reply: Option) {
  return reply.explanation_html !== "";
}

function explanation({ correct, explanation_html: html }: Option) {
  const element = document.createElement("div");
  element.className = `explanation ${correct ? "correct" : "wrong"}`;
  element.innerHTML = html; // the book's own, as its page has it
  return element;
}
