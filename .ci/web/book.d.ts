/** `js/book.js`, which is written while a book is built: site_builder/output/book_files.py. */
declare module "*/book.js" {
  export const LANGUAGE: string;
  export const DECIMAL: string;
  export const STORAGE: string;
  export const WORDS: Record<string, string | { one: string; other: string }>;
}
