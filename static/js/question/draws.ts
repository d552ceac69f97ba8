/**
 * Questions that draw their numbers. Which they are follows from a seed, the one that a class got
 * with an address or else the reader's own, and from the question's id; until the reader asks for
 * others. An answer is kept with the numbers that it answers, by the edition of its variant.
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

/** The reader has asked for no other numbers. */
export function forgetOthers() {
  forget(/^drawn:/);
}

/** Put the numbers of this reader into a question, if it draws any. */
export function draw(form: HTMLFormElement) {
  const variants = variantsOf(form);
  if (variants.length > 0) ask(form, variants, drawn(form, variants));
}

/** Put the next numbers into a question, to stay there. */
export function drawOthers(form: HTMLFormElement) {
  const variants = variantsOf(form);
  const at = (placeOf(form) + 1) % variants.length;
  remember(keyOf(form), variants[at].edition);
}

/** What is kept with an answer, from now on the only sign of its numbers. */
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
