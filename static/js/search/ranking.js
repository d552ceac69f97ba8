/**
 * How words are compared, and which section comes first. Used twice: under Node, where the index
 * is made, and in the page, where it is asked.
 */

/**
 * A section of the book, as the builder's `search/records.py` writes it.
 *
 * @typedef {object} Section
 * @property {string} address Relative to the site's root.
 * @property {string} chapter
 * @property {string} title
 * @property {string[]} introduced Terms that it introduces.
 * @property {string[]} explains Terms of the glossary that it explains.
 * @property {string} text
 * @property {string} figures
 * @property {string} questions
 */

/**
 * A section that was found. `matched` has the words by which it was, as the index spells them.
 *
 * @typedef {Section & {score: number, matched: string[]}} Hit
 */

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
const STOP_WORDS = new Set(
  "a an and are as at be by for from how in is it its of on or that the this to what which with why".split(
    " ",
  ),
);

/**
 * What the index is made with; it must be opened with the same.
 *
 * @param {(word: string) => string} stem
 */
export function settings(stem) {
  return {
    fields: FIELDS,
    storeFields: ["address", ...FIELDS],
    /** @param {string | number | string[]} value */
    stringifyField: (value) => (Array.isArray(value) ? value.join("\n") : String(value)),
    /** @param {string} word */
    processTerm: (word) => {
      const plain = fold(word);
      if (STOP_WORDS.has(plain)) return null;
      const root = stem(plain);
      return root === plain ? plain : [plain, root];
    },
  };
}

/**
 * Without case, accents and small figures: `k₁` is `k1`.
 *
 * @param {string} text
 */
export function fold(text) {
  return text.normalize("NFKD").replace(/\p{M}/gu, "").replaceAll("\u2019", "'").toLowerCase();
}

/**
 * The sections that have all words; where there is none, those with words that are similar; where
 * there is none of these, those with some of the words. Best first.
 *
 * @param {any} index A MiniSearch.
 * @param {(word: string) => string} stem
 * @param {string} query
 * @returns {{hits: Hit[], exact: boolean}}
 */
export function find(index, stem, query) {
  const words = wordsOf(query);
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
        processTerm: (/** @type {string} */ word) => word,
      },
    );
    if (found.length > 0) return { hits: ranked(index, found, words, stem), exact: !fuzzy };
  }
  return { hits: [], exact: true };
}

/** @param {string} query */
function wordsOf(query) {
  const words = fold(query).match(/[\p{L}\p{N}]+/gu) ?? [];
  const telling = words.filter((word) => !STOP_WORDS.has(word));
  return telling.length > 0 ? telling : words;
}

/**
 * @param {any} index
 * @param {any[]} found As MiniSearch tells it.
 * @param {string[]} words
 * @param {(word: string) => string} stem
 * @returns {Hit[]}
 */
function ranked(index, found, words, stem) {
  const asked = words.map(stem).join(" ");
  /** @param {string} text */
  const roots = (text) => wordsOf(text).map(stem).join(" ");
  const hits = found.map(({ terms: matched, ...section }) => {
    let { score } = section;
    const isAsked = (/** @type {string} */ term) => roots(term) === asked;
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
