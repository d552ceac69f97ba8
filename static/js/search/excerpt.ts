/** The words of a section around what was found in it. */

import { formsOf, wordsIn, type Language } from "./words.ts";

/** Words of an excerpt, and of these how many before what was found. */
const LENGTH = 34;
const BEFORE = 8;

/**
 * The stretch of `text` with most of the words that were found, the first of several; as pieces,
 * each with or without a mark.
 *
 * @param matched Words as the index spells them, or their stems.
 * @param length In words.
 */
export function excerpt(
  text: string,
  matched: string[],
  language: Language,
  length: number = LENGTH,
): { text: string; hit: boolean }[] {
  const wanted = new Set(matched);
  const words = wordsIn(text).map(({ start, end, whole, parts }) => {
    const forms = [whole, ...parts].flatMap((word) => formsOf(word, language));
    return { start, end, found: forms.find((form) => wanted.has(form)) };
  });
  if (words.length === 0) return [];
  const first = words.length > length ? bestStart(words, length) : 0;
  const last = Math.min(first + length, words.length) - 1;
  const start = first === 0 ? 0 : words[first].start;
  const end = last === words.length - 1 ? text.length : words[last].end;
  const hits = words.slice(first, last + 1).filter((word) => word.found !== undefined);
  const pieces = [{ text: start > 0 ? "… " : "", hit: false }];
  let at = start;
  for (const word of hits) {
    pieces.push({ text: text.slice(at, word.start), hit: false });
    pieces.push({ text: text.slice(word.start, word.end), hit: true });
    at = word.end;
  }
  pieces.push({ text: text.slice(at, end) + (end < text.length ? " …" : ""), hit: false });
  return pieces.filter((piece) => piece.text !== "");
}

function bestStart(words: { found: string | undefined }[], length: number) {
  let best = { start: 0, found: 0 };
  for (const [place, { found }] of words.entries()) {
    if (found === undefined) continue;
    const ahead = words.slice(place, place + length - BEFORE);
    const kinds = new Set(ahead.flatMap((word) => word.found ?? []));
    if (kinds.size > best.found) best = { start: place - BEFORE, found: kinds.size };
  }
  return Math.max(0, Math.min(best.start, words.length - length));
}
