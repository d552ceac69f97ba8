/** Texts of errors. */

/** Longest text of an error that is shown. */
const LONGEST = 2000;

/** Escape sequences of terminals, control characters, and characters that reverse the direction. */
const CONTROL = /(?![\n\t])\p{Cc}(?:\[[\d;?]*[A-Za-z])?|[\u202a-\u202e\u2066-\u2069]/gu;

/** The text of an error, as it can be shown. */
export function errorText(error: unknown): string {
  return printable(fullErrorText(error));
}

/** A text without control characters, and cut, as it can be shown. */
export function printable(text: string): string {
  const start = text.slice(0, LONGEST).replaceAll(CONTROL, "").trim();
  return text.length > LONGEST ? `${start} …` : start;
}

/** The message of what was thrown, whatever it is: the interpreter's file system throws objects. */
export function fullErrorText(error: unknown): string {
  if (error instanceof Error) return error.message || error.name;
  if (typeof error !== "object" || error === null) return String(error);
  const { message, name, ...rest } = error as Record<string, unknown>;
  return String(message || [name, JSON.stringify(rest)].filter(Boolean).join(" "));
}
