/** What a reader is told of code that did not run, or not to its end. */

import { message } from "../errors.js";
import { RuntimeFailure } from "../runtime/runtime.js";
import { EditFailure } from "./edited_runtime.js";
import { words } from "../page/words.js";

/** @import { Problem } from "./edited_runtime.js" */

/** @param {unknown} error */
export function wordsOf(error) {
  if (error instanceof EditFailure) return error.message;
  return isLost(error)
    ? words("workshop.stopped_first", { reason: error.message })
    : words("workshop.did_not_run", { reason: message(error) });
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
 * @param {string} told
 * @returns {Problem}
 */
export function problemWithout(told) {
  return { message: told, definition: "", line: 0 };
}

/**
 * @param {unknown} error
 * @returns {error is RuntimeFailure}
 */
function isLost(error) {
  return error instanceof RuntimeFailure && error.kind === "lost";
}
