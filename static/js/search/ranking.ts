/**
 * How words are compared, and which section comes first. Used twice: under Node, where the index
 * is made, and in the page, where it is asked.
 */

/** A section of the book, as the builder's `search/records.py` writes it. */
interface Section {
  /** Relative to the site's root. */
  address: string;
  chapter: string;
  title: string;
  /** Terms that it introduces. */
  introduced: string[];
  /** Terms of the glossary that it explains. */
  explains: string[];
  text: string;
  figures: string;
  questions: string;
}

/** A section that was found. `matched` has the words by which it was, as the index spells them. */
export type Hit = Section & { score: number; matched: string[] };

const FIELDS = ["title", "introduced", "explains", "chapter", "text", "figures", "questions"];
const BOOST = {
  title: 4,
  introduced: 2.5,
  explains: 2.5,
  chapter: 2,
  text: 2,
  figures: 1,
  questions: 0.3,
};
/** Of words that only begin as asked, or are only similar. */
const WEIGHTS = { prefix: 0.3, fuzzy: 0.2 };
/** Long sections are not held against a term that they repeat: they explain it. */
const BM25 = { k: 2, b: 0.3, d: 0.5 };
/** Factors for a whole query found in one piece. */
const WHOLE = { explained: 10, term: 2, title: 1.8, text: 1.25 };
/** For what stands before a chapter's first heading: there things are named, to be explained later. */
const OPENING = 0.6;
/** For an entry of the glossary: it says in a line what a section explains. */
const ENTRY = 0.4;
/** For the last section of the book; the first has 1. What comes again was explained before. */
const LAST = 0.9;

/** How words of a language are compared. */
export type Language = { stem: (word: string) => string; stopWords: Set<string> };

/** @param stopWords Words that say nothing of what is looked for, parted by blanks. */
export function language(stem: (word: string) => string, stopWords: string): Language {
  return { stem, stopWords: new Set(stopWords.split(" ").map(fold)) };
}

/** What the index is made with; it must be opened with the same. */
export function settings({ stem, stopWords }: Language) {
  return {
    fields: FIELDS,
    storeFields: ["address", ...FIELDS],
    stringifyField: (value: string | number | string[]) =>
      Array.isArray(value) ? value.join("\n") : String(value),
    processTerm: (word: string) => {
      const plain = fold(word);
      if (stopWords.has(plain)) return null;
      const root = stem(plain);
      return root === plain ? plain : [plain, root];
    },
  };
}

/** Without case, accents and small figures: `k₁` is `k1`. */
export function fold(text: string) {
  return text.normalize("NFKD").replace(/\p{M}/gu, "").replaceAll("\u2019", "'").toLowerCase();
}

/**
 * The sections that have all words; where there is none, those with words that are similar; where
 * there is none of these, those with some of the words. Best first.
 *
 * @param index A MiniSearch.
 */
export function find(
  index: any,
  language: Language,
  query: string,
): { hits: Hit[]; exact: boolean } {
  const { stem } = language;
  const words = wordsOf(query, language);
  if (words.length === 0) return { hits: [], exact: true };
  const attempts = [
    { combineWith: "AND", fuzzy: false },
    { combineWith: "AND", fuzzy: 0.25 },
    { combineWith: "OR", fuzzy: 0.25 },
  ];
  for (const { combineWith, fuzzy } of attempts) {
    const queries = words.map((word) => ({
      combineWith: "OR",
      queries: [...new Set([word, stem(word)])],
      prefix: word.length > 1,
      fuzzy,
    }));
    const found = index.search(
      { combineWith, queries },
      {
        boost: BOOST,
        weights: WEIGHTS,
        bm25: BM25,
        processTerm: (word: string) => word,
      },
    );
    if (found.length > 0) return { hits: ranked(index, found, words, language), exact: !fuzzy };
  }
  return { hits: [], exact: true };
}

function wordsOf(query: string, { stopWords }: Language) {
  const words = fold(query).match(/[\p{L}\p{N}]+/gu) ?? [];
  const telling = words.filter((word) => !stopWords.has(word));
  return telling.length > 0 ? telling : words;
}

/** @param found As MiniSearch tells it. */
function ranked(index: any, found: any[], words: string[], language: Language): Hit[] {
  const { stem } = language;
  const asked = words.map(stem).join(" ");
  const roots = (text: string) => wordsOf(text, language).map(stem).join(" ");
  const hits = found.map(({ terms: matched, ...section }) => {
    let { score } = section;
    const isAsked = (term: string) => roots(term) === asked;
    if (section.explains.some(isAsked)) score *= WHOLE.explained;
    if (section.introduced.some(isAsked)) score *= WHOLE.term;
    if (` ${roots(section.title)} `.includes(` ${asked} `)) score *= WHOLE.title;
    if (words.length > 1 && fold(section.text).includes(words.join(" "))) score *= WHOLE.text;
    score *= 1 - (1 - LAST) * (section.id / index.documentCount);
    if (section.title === "") score *= OPENING;
    if (section.address.startsWith("glossary/")) score *= ENTRY;
    return { ...section, matched, score };
  });
  return hits.sort((one, other) => other.score - one.score);
}
