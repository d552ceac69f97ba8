/** Words of the index, of queries, and of excerpts. */

/** How words of a language are compared. */
export interface Language {
  stem: (word: string) => string;
  /** Words that are not searched for. */
  stopWords: Set<string>;
  /** Words that count as another one: `blurry` as `blur`. */
  synonyms: Map<string, string>;
}

/** A word of a text, between two places. */
export interface Word {
  start: number;
  end: number;
  /** The form that is compared; empty where only its parts are. */
  whole: string;
  /** Parts of `wave-front`, `undistortPoints` or `24x36`; none of a simple word. */
  parts: string[];
}

const WORD = /[\p{L}\p{N}\p{M}]+(?:[-_‐‑][\p{L}\p{N}\p{M}]+)*/gu;
/** Between the parts of a word: hyphens, a capital after a small letter, the x between two sizes. */
const PARTS = /[-_‐‑]|(?<=\p{Ll}{2})(?=\p{Lu}\p{Ll})|(?<=\d)x(?=\d)/u;
/** `k_1`, which is one symbol. */
const SYMBOL = /^\p{L}_/u;
const SIZES = /^\d+x\d+$/u;

/**
 * @param stopWords Separated by spaces.
 * @param synonyms Groups, separated by commas; each counts as its first word.
 */
export function languageOf(
  stem: (word: string) => string,
  stopWords: string,
  synonyms: string,
): Language {
  const groups = synonyms.split(",").map((group) => group.trim().split(" ").map(fold));
  return {
    stem,
    stopWords: new Set(stopWords.split(" ").map(fold)),
    synonyms: new Map(
      groups.flatMap(([first, ...others]) => others.map((other) => [other, first])),
    ),
  };
}

/** Without case, accents and small figures: `k₁` is `k1`. */
export function fold(text: string) {
  return text.normalize("NFKD").replace(/\p{M}/gu, "").replaceAll("\u2019", "'").toLowerCase();
}

export function wordsIn(text: string): Word[] {
  return [...text.matchAll(WORD)].map(({ 0: found, index: start }) => {
    const parts = SYMBOL.test(found) ? [] : found.split(PARTS).map(fold);
    const whole = SIZES.test(found) ? "" : fold(found).replace(/[-_‐‑]/gu, "");
    return { start, end: start + found.length, whole, parts: parts.length > 1 ? parts : [] };
  });
}

/** All forms under which the index has a word. */
export function formsOf(word: string, { stem, stopWords, synonyms }: Language): string[] {
  const plain = fold(word);
  if (stopWords.has(plain)) return [];
  const same = synonyms.get(plain) ?? plain;
  return [...new Set([plain, same, stem(same)])];
}
