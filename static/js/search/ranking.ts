/**
 * Which section comes first. Used twice: under Node, where the index is made, and in the page, where
 * it is searched.
 */

import { fold, formsOf, wordsIn, type Language, type Word } from "./words.ts";

/** A section of the book, as the builder's `search/index.py` writes it. */
interface Section {
  /** Relative to the site's root. */
  address: string;
  chapter: string;
  title: string;
  /** Terms that it introduces. */
  introduced: string[];
  /** Terms of the glossary and symbols that it explains. */
  explains: string[];
  /** Phrases by which readers search for it. */
  asked: string[];
  text: string;
  figures: string;
  questions: string;
}

/** A section that was found. `matched` has the words by which it was, as the index spells them. */
export type Hit = Section & { score: number; matched: string[] };

const FIELDS = [
  "title",
  "introduced",
  "explains",
  "asked",
  "chapter",
  "text",
  "figures",
  "questions",
];
const BOOST = {
  title: 4,
  introduced: 2.5,
  explains: 2.5,
  asked: 2.5,
  chapter: 2,
  text: 2,
  figures: 1,
  questions: 0.3,
};
/** Letters from which a word that the book has not may be misspelt, once and twice. */
const MISSPELT = { once: 6, twice: 12 };
/** Words of one family begin alike: with this share of the word, and endings of at most so many letters. */
const FAMILY = { shared: 0.7, least: 5, ending: 4 };
/** Letters of the shorter part of a compound. */
const COMPOUND = 3;
/** Letters of a word that may be the beginning of others, in a query of several words. */
const BEGINNING = 4;
/** Weights of words that only begin as the query, or are only similar. */
const WEIGHTS = { prefix: 0.3, fuzzy: 0.2 };
/** The length of a section counts little: one that repeats a term explains it. */
const BM25 = { k: 2, b: 0.3, d: 0.5 };
/** Factors for a whole query found in one piece; `part`: in a longer term that is explained, or such
 * a term in it. */
const WHOLE = { explained: 10, part: 3, term: 2, title: 1.8, text: 1.25 };
/** For what stands before a chapter's first heading: there things are named, to be explained later. */
const OPENING = 0.6;
/** For an entry of the glossary: it states in a line what a section explains. */
const ENTRY = 0.4;
/** For the last section of the book; the first has 1. What comes again was explained before. */
const LAST = 0.9;

/** What the index is made with; it must be opened with the same. */
export function indexOptions(language: Language) {
  return {
    fields: FIELDS,
    storeFields: ["address", ...FIELDS],
    stringifyField: (value: string | number | string[]) =>
      Array.isArray(value) ? value.join("\n") : String(value),
    tokenize: (text: string) =>
      wordsIn(text).flatMap(({ whole, parts }) => (whole ? [whole, ...parts] : parts)),
    processTerm: (word: string) => {
      const forms = formsOf(word, language);
      return forms.length > 0 ? forms : null;
    },
  };
}

/**
 * The sections that have all words; where there is none, those with some of them. Best first. A word
 * that the book has not, in any form, stands for its parts, its family, or words spelt nearly so.
 *
 * @param index A MiniSearch.
 */
export function searchSections(
  index: any,
  language: Language,
  query: string,
): { hits: Hit[]; exact: boolean } {
  const words = searchedWords(query, language);
  if (words.length === 0) return { hits: [], exact: true };
  const search = (queries: any[], combineWith: string): any[] =>
    index.search({ combineWith, queries }, SEARCH);
  const least = words.length > 1 ? BEGINNING : 2;
  const exactly = words.map((word) => queryFor(word, language, least));
  const isFound = (query: any) => search([query], "AND").length > 0;
  const known = exactly.map(isFound);
  const queries = words.map(({ whole }, place) =>
    known[place]
      ? exactly[place]
      : ([...relatives(whole, language)].find(isFound) ?? misspelt(whole)),
  );
  const all = search(queries, "AND");
  const found = all.length > 0 ? all : search(queries, "OR");
  const exact = found.length === 0 || (all.length > 0 && known.every(Boolean));
  return { hits: ranked(index, found, words, query, language), exact };
}

const SEARCH = {
  boost: BOOST,
  weights: WEIGHTS,
  bm25: BM25,
  tokenize: (form: string) => [form],
  processTerm: (form: string) => form,
};

/** What a word may mean that the book has not: two words written as one, or a word of its family. */
function* relatives(word: string, language: Language) {
  for (let at = COMPOUND; at <= word.length - COMPOUND; at++) {
    const parts = [word.slice(0, at), word.slice(at)];
    const queries = parts.map((part) => ({ combineWith: "OR", queries: formsOf(part, language) }));
    yield { combineWith: "AND", queries };
  }
  const least = Math.max(FAMILY.least, Math.ceil(FAMILY.shared * word.length));
  if (least > word.length) return;
  const boostDocument = (_section: number, term: string) => Number(isKin(word, term));
  yield { queries: [word.slice(0, least)], prefix: true, boostDocument };
}

/** Whether two words begin alike and differ in short endings only. */
function isKin(word: string, term: string) {
  let same = 0;
  while (same < word.length && word[same] === term[same]) same++;
  return Math.max(word.length, term.length) - same <= FAMILY.ending;
}

/** The words that are meant by one that the book has not: a short word is never another one. */
function misspelt(word: string) {
  const boostDocument = (_section: number, term: string) => Number(isMeant(word, term));
  return { queries: [word], fuzzy: word.length < MISSPELT.once ? false : 2, boostDocument };
}

/** Whether two words differ in one letter, or in the order of two, and not in the first one. */
function isMeant(word: string, term: string) {
  if (word[0] !== term[0]) return false;
  if (word.length >= MISSPELT.twice) return true;
  const shorter = Math.min(word.length, term.length);
  let start = 1;
  while (start < shorter && word[start] === term[start]) start++;
  let end = 0;
  while (end < shorter - start && word.at(-1 - end) === term.at(-1 - end)) end++;
  const [one, other] = [word, term].map((each) => each.slice(start, each.length - end));
  return Math.max(one.length, other.length) < 2 || one === [...other].reverse().join("");
}

/** A word in any of its forms, or all its parts. */
function queryFor({ whole, parts }: Word, language: Language, least: number) {
  const one = (word: string) => ({
    combineWith: "OR",
    queries: formsOf(word, language).map((form, place) => ({
      queries: [form],
      prefix: place === 0 && word.length >= least, // not of a stem: `lens` is no `length`
    })),
  });
  const queries: any[] = whole ? [one(whole)] : [];
  const searched = parts.filter((part) => !language.stopWords.has(part));
  if (searched.length > 0) queries.push({ combineWith: "AND", queries: searched.map(one) });
  return { combineWith: "OR", queries };
}

/** The words of a text but for stop words. */
function searchedWords(text: string, { stopWords }: Language): Word[] {
  return wordsIn(text).filter(({ whole, parts }) => parts.length > 0 || !stopWords.has(whole));
}

/** @param found As MiniSearch returns it. */
function ranked(index: any, found: any[], words: Word[], query: string, language: Language): Hit[] {
  const rootsOf = (words: Word[]) =>
    words
      .flatMap(({ whole, parts }) => (parts.length > 0 ? parts : [whole]))
      .flatMap((word) => formsOf(word, language).at(-1) ?? []);
  const roots = rootsOf(words);
  /** In any order, and in one word or several: `f-number`, `f number`. */
  const isSame = (term: string) => {
    const others = rootsOf(searchedWords(term, language));
    return others.join("") === roots.join("") || `${others.sort()}` === `${[...roots].sort()}`;
  };
  const contains = (whole: string[], part: string[]) =>
    part.length > 0 && ` ${whole.join(" ")} `.includes(` ${part.join(" ")} `);
  const isIn = (text: string) => contains(rootsOf(searchedWords(text, language)), roots);
  const includesTerm = (term: string) =>
    term.length >= BEGINNING && contains(roots, rootsOf(searchedWords(term, language)));
  const hits = found.map(({ terms: matched, ...section }) => {
    let { score } = section;
    const terms: string[] = [...section.explains, ...section.asked];
    if (terms.some(isSame)) score *= WHOLE.explained;
    else if (terms.some((term) => isIn(term) || includesTerm(term))) score *= WHOLE.part;
    if (section.introduced.some(isSame)) score *= WHOLE.term;
    if (isIn(section.title)) score *= WHOLE.title;
    if (words.length > 1 && fold(section.text).includes(fold(query))) score *= WHOLE.text;
    score *= 1 - (1 - LAST) * (section.id / index.documentCount);
    if (section.title === "") score *= OPENING;
    if (section.address.startsWith("glossary/")) score *= ENTRY;
    return { ...section, matched, score };
  });
  return hits.sort((one, other) => other.score - one.score);
}
