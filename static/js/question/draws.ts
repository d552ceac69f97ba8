/**
 * Questions that draw their numbers. A seed and the question's id decide which: the seed of a class,
 * which comes with an address, or else the reader's own. A reader may ask for other numbers. A stored
 * answer names its numbers by the edition of the variant.
 */

import { data, one } from "../page/dom.ts";
import { forget, recall, remember } from "../page/storage.ts";
import type { Question } from "./question.ts";
import { hash, ownSeed } from "./shuffle.ts";

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
