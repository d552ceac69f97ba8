/** What a reader is told of code that did not run, or not to its end. */

import { message } from "../errors.js";
import { RuntimeFailure } from "../runtime/runtime.js";
import { EditFailure } from "./edited_runtime.js";

/** @import { Problem } from "./edited_runtime.js" */

/** @param {unknown} error */
export function wordsOf(error) {
  if (error instanceof EditFailure) return error.message;
  return isLost(error)
    ? `Your code was stopped: ${error.message}. The figure stays as it was.`
    : `Your code did not run (${message(error)}).`;
}

/**
 * Where it failed, as far as that is known.
 *
 * @param {unknown} error
 * @returns {Problem}
 */
export function problemOf(error) {
  if (error instanceof EditFailure) return error.problem;
  return problemWithout(isLost(error) ? wordsOf(error) : message(error));
}

/**
 * A problem that no line is known for.
 *
 * @param {string} words
 * @returns {Problem}
 */
export function problemWithout(words) {
  return { message: words, definition: "", line: 0 };
}

/**
 * @param {unknown} error
 * @returns {error is RuntimeFailure}
 */
function isLost(error) {
  return error instanceof RuntimeFailure && error.kind === "lost";
}
