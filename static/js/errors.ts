/**
 * What went wrong, in words, whatever was thrown: the interpreter's file system throws plain objects.
 */
export function message(error: unknown): string {
  if (error instanceof Error) return error.message;
  if (typeof error !== "object" || error === null) return String(error);
  const { message, name, ...rest } = error as Record<string, unknown>;
  return String(message || [name, JSON.stringify(rest)].filter(Boolean).join(" "));
}
