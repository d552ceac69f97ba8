/** Modules that are written while a book is built, by `site_builder/output/scripts.py` and `site_builder/assets/page_assets.py`. */

/** What the scripts know of the book. */
declare module "*/book.js" {
  export const DECIMAL: string;
  export const STORAGE: string;
  export const WORDS: Record<string, string | { one: string; other: string }>;
}

/** The kinds of controls that figures have. */
declare module "*/control_kinds.js" {
  export const KINDS: Record<string, import("../../static/js/figure/controls.ts").Kind>;
}

/** The kinds of questions that it asks. */
declare module "*/book_kinds.js" {
  export const KINDS: Record<string, import("../../static/js/question/question.ts").Kind>;
}
