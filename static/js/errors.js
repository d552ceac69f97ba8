/**
 * What went wrong, in words, whatever was thrown.
 *
 * @param {unknown} error
 * @returns {string}
 */
export function message(error) {
  return error instanceof Error ? error.message : String(error);
}
