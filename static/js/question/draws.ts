/**
 * Orders and numbers that are the reader's own: by chance once, then the same on every visit.
 *
 * Questions that draw their numbers. A seed and the question's id decide which: the seed of a class,
 * which comes with an address, or else the reader's own. A reader may ask for other numbers. A stored
 * answer names its numbers by the edition of the variant.
 */

import { data, one } from "../page/dom.ts";
import { forget, recall, remember } from "../page/storage.ts";
import type { Question } from "./question.ts";

interface Variant extends Question {
  fieldset_html: string;
}

/** `?seed=WORD` in the address stays until another seed comes, or none: `?seed=`. */
export function takeSeed() {
  const seed = new URLSearchParams(location.search).get("seed");
  if (seed === null || seed === seedOfClass()) return;
  remember("seed", seed || null);
  forgetOthers();
}

function seedOfClass(): string {
  const seed = recall("seed");
  return typeof seed === "string" ? seed : "";
}

/** Forget which other numbers the reader asked for. */
export function forgetOthers() {
  forget(/^drawn:/);
}

/** Put the numbers of this reader into a question, if it draws any. */
export function draw(form: HTMLFormElement) {
  const variants = variantsOf(form);
  if (variants.length > 0) ask(form, variants, drawn(form, variants));
}

/** Choose the next numbers for a question; `draw` shows them. */
export function drawOthers(form: HTMLFormElement) {
  const variants = variantsOf(form);
  const at = (placeOf(form) + 1) % variants.length;
  remember(keyOf(form), variants[at].edition);
}

/** What to store with an answer; its edition names its numbers from now on, and no choice of others. */
export function keptWith(form: HTMLFormElement): { seed?: string } {
  if (variantsOf(form).length === 0) return {};
  remember(keyOf(form), null);
  const seed = seedOfClass();
  return seed ? { seed } : {};
}

/** The numbers that the reader asked for, then those answered with this seed, then the seed's. */
function drawn(form: HTMLFormElement, variants: Variant[]) {
  const answer = recall(`quiz:${form.dataset.quiz}`);
  const seed = seedOfClass();
  const answered = (answer?.seed ?? "") === seed ? answer?.edition : null;
  const edition = recall(keyOf(form)) ?? answered;
  const at = variants.findIndex((variant) => variant.edition === edition);
  return at >= 0 ? at : hash(`${seed || ownSeed()} ${form.dataset.quiz}`) % variants.length;
}

function ask(form: HTMLFormElement, variants: Variant[], at: number) {
  if (at !== placeOf(form)) {
    one(form, "fieldset", HTMLFieldSetElement).innerHTML = variants[at].fieldset_html; // the book's own
  }
  form.dataset.variant = String(at);
}

/** Place of the variant that the page shows. */
function placeOf(form: HTMLFormElement) {
  return Number(form.dataset.variant ?? 0);
}

function keyOf(form: HTMLFormElement) {
  return `drawn:${form.dataset.quiz}`;
}

function variantsOf(form: HTMLFormElement): Variant[] {
  return form.dataset.quiz ? (data(form, "script.quiz-data").variants ?? []) : [];
}

/** What this reader's orders come from; where nothing is remembered, as long as the page lasts. */
let seed = "";

/** The numbers from 0 to `count` − 1 in the reader's order of the things called `name`. */
export function shuffled(name: string, count: number) {
  const own = ownSeed();
  const hashes = Array.from({ length: count }, (_, index) => hash(`${own}${name} ${index}`));
  return [...hashes.keys()].sort((one, other) => hashes[one] - hashes[other]);
}

/** What is drawn for this reader alone follows from it. */
function ownSeed() {
  if (!seed) {
    const stored = recall("order");
    seed =
      typeof stored === "string" ? stored : crypto.getRandomValues(new Uint32Array(2)).join("-");
    remember("order", seed);
  }
  return seed;
}

/**
 * FNV-1a, which spreads short texts over 32 bits, with the last step of MurmurHash3, which mixes them.
 */
function hash(text: string) {
  let value = 0x811c9dc5;
  for (const letter of text) value = Math.imul(value ^ letter.charCodeAt(0), 0x01000193);
  value = Math.imul(value ^ (value >>> 16), 0x85ebca6b);
  value = Math.imul(value ^ (value >>> 13), 0xc2b2ae35);
  return (value ^ (value >>> 16)) >>> 0;
}
