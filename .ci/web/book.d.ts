/** Modules that are written while a book is built, by `book_files.py` and `features.py` there. */

/** What the scripts know of the book. */
declare module "*/book.js" {
  export const LANGUAGE: string;
  export const DECIMAL: string;
  export const STORAGE: string;
  export const WORDS: Record<string, string | { one: string; other: string }>;
}

/** Those of the scripts that it shows something for. */
declare module "*/book_parts.js" {
  export interface Part {
    /** Listen; called once. */
    install(): void;
    /** A page has come into place. */
    arrive?(): void;
    /** The address has become another one of the same page. */
    returned?(): void;
    /** The page is about to make way for another; its address may be that one's already. */
    leave?(page: string): void;
  }
  export const PARTS: Part[];
}

/** The kinds of questions that it asks. */
declare module "*/book_kinds.js" {
  export const KINDS: Record<string, import("../../static/js/question/question.js").Kind>;
}
