/**
 * What went wrong, in words, whatever was thrown: the interpreter's file system throws plain objects.
 *
 * @param {unknown} error
 * @returns {string}
 */
export function message(error) {
  if (error instanceof Error) return error.message;
  if (typeof error !== "object" || error === null) return String(error);
  const { message, name, ...rest } = /** @type {Record<string, unknown>} */ (error);
  return String(message || [name, JSON.stringify(rest)].filter(Boolean).join(" "));
}
