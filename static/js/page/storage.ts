/**
 * Settings, answers and edits in the browser's storage. What it does not store, denied or full, lasts
 * until the book is left, and a message appears once.
 */

import { STORAGE } from "../book.js";
import { words } from "./words.ts";

type Check = (value: any) => boolean;

/** Most letters under one name, and in a name or an edition; most numbers in an answer. */
const LONGEST = 1_000_000;
const LONGEST_NAME = 200;
const MOST_NUMBERS = 1000;

const isName: Check = (value) => typeof value === "string" && value.length <= LONGEST_NAME;
const isObject: Check = (value) => typeof value === "object" && value !== null;

/** Whether a value can be an answer to any question. */
export const isAnswer: Check = (value) => {
  if (typeof value?.code === "string") return Number.isInteger(value.reply);
  const numbers = Array.isArray(value) ? value : [value];
  return numbers.length <= MOST_NUMBERS && numbers.every(Number.isFinite);
};

const isEdit: Check = (edit) => isObject(edit) && typeof edit.text === "string";

/** Shapes of values by the beginning of their names; others are checked where they are used. */
const SHAPES: Record<string, Check> = {
  quiz: (entry) =>
    isName(entry.edition) &&
    isAnswer(entry.answer) &&
    typeof entry.right === "boolean" &&
    isAnswer(entry.first ?? 0),
  predict: (entry) => isName(entry.edition) && isAnswer(entry.guess === null ? 0 : entry.guess),
  code: ({ text }) => typeof text === "string",
  python: ({ edits }) => isObject(edits) && Object.values(edits).every(isEdit),
};

/** Whether a value, from storage or a file, has the shape of values under `name`. */
export function hasValidShape(name: string, value: any): boolean {
  const [kind] = name.split(":", 1);
  return !Object.hasOwn(SHAPES, kind) || (isObject(value) && SHAPES[kind](value));
}

/** Values that could not be stored. */
const unstored: Map<string, unknown> = new Map();

/** Names of values whose loss is reported. */
const REPORTED = /^(quiz|predict|python|code):/;
let isReported = false;

/** Event on `window` when such a value could not be stored, once. */
export const STORAGE_FAILED = "storage-failed";

/** The value under `key`, or null; a value that is too long or of another shape is dropped. */
export function loadItem(key: string): any {
  if (unstored.has(key)) return unstored.get(key);
  try {
    const text = localStorage.getItem(STORAGE + key) ?? "null";
    const value = text.length > LONGEST ? undefined : JSON.parse(text);
    if (value === null || (value !== undefined && hasValidShape(key, value))) return value;
  } catch {
    // Denied, or no JSON.
  }
  console.warn(words("page.unusable", { name: key.slice(0, LONGEST_NAME) }));
  return null;
}

/** Store a value under `key`; null removes it. */
export function saveItem(key: string, value: unknown) {
  try {
    const text = JSON.stringify(value);
    if (value === null) localStorage.removeItem(STORAGE + key);
    else if (text.length > LONGEST) throw new Error("too long to be loaded again");
    else localStorage.setItem(STORAGE + key, text);
    unstored.delete(key);
  } catch {
    unstored.set(key, value);
    if (isReported || value === null || !REPORTED.test(key)) return;
    isReported = true;
    dispatchEvent(new Event(STORAGE_FAILED));
  }
}

/** Call `changed` with the key of a value that another tab stores or removes; null for all. */
export function onOtherTabChange(changed: (key: string | null) => void) {
  addEventListener("storage", ({ key, storageArea }) => {
    if ((key !== null && !key.startsWith(STORAGE)) || storageArea === sessionStorage) return;
    const own = key?.slice(STORAGE.length) ?? null;
    if (own) unstored.delete(own); // theirs came later
    changed(own);
  });
}

/** All values under names that fit. */
export function storedItems(names: RegExp): Record<string, unknown> {
  let stored: string[] = [];
  try {
    stored = Object.keys(localStorage).filter((key) => key.startsWith(STORAGE));
  } catch {
    // Denied: there is only what passes.
  }
  const keys = new Set([...stored.map((key) => key.slice(STORAGE.length)), ...unstored.keys()]);
  const fitting = [...keys].filter((key) => names.test(key)).map((key) => [key, loadItem(key)]);
  return Object.fromEntries(fitting.filter(([, value]) => value !== null));
}

/** Remove the values under names that fit. */
export function removeItems(names: RegExp) {
  for (const key of Object.keys(storedItems(names))) saveItem(key, null);
}
