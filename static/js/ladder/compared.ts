/** The reader's method among the tiers of a ladder, in sentences. */

import type { Ladder, Result } from "./chart.ts";
import { numeral, words } from "../page/words.ts";

/** Errors that differ by less are alike: a share, or decibels. */
const ALIKE = { share: 0.01, decibels: 0.1 };

/**
 * How the reader's method does against the book's `tier` of the same kind; what beats it; and the
 * tiers that are next in speed and in error. Times are alike where their middle halves overlap.
 */
export function compared(yours: Result, tiers: Result[], ladder: Ladder, tier: string): string[] {
  const [metric] = ladder.metrics;
  const label = (id: string) => ladder.tiers.find((each) => each.id === id)?.label ?? id;
  const loss = ({ errors }: Result) => {
    const error = errors[metric.id];
    if (error === null) return metric.higher ? Number.NEGATIVE_INFINITY : 0;
    return metric.higher ? -error : error;
  };
  const speed = (one: Result, other: Result) =>
    one.high_ms < other.low_ms ? 1 : one.low_ms > other.high_ms ? -1 : 0;
  const quality = (one: Result, other: Result) => {
    const [a, b] = [loss(one), loss(other)];
    const slack = metric.unit === "dB" ? ALIKE.decibels : ALIKE.share * Math.abs(b);
    return a < b - slack ? 1 : a > b + slack ? -1 : 0;
  };
  const said: string[] = [];
  const book = tiers.find((each) => each.tier === tier);
  if (book) {
    const ratio = book.milliseconds / yours.milliseconds;
    const times = numeral((ratio < 1 ? 1 / ratio : ratio).toPrecision(2));
    const key = ["slower", "as_fast", "faster"][speed(yours, book) + 1];
    said.push(words(`exercise.${key}`, { times, tier: label(tier) }));
    const [own, other] = [yours, book].map(({ errors }) => errorText(errors[metric.id]));
    const error = { metric: metric.label, own, other, unit: metric.unit };
    said.push(words(`exercise.${quality(yours, book) === 0 ? "as_exact" : "error"}`, error));
  }
  const others = tiers.filter((each) => each.tier !== tier);
  const beats = (each: Result) =>
    speed(each, yours) >= 0 &&
    quality(each, yours) >= 0 &&
    speed(each, yours) + quality(each, yours) > 0;
  const winner = others.find(beats);
  said.push(
    winner ? words("exercise.beaten", { tier: label(winner.tier) }) : words("exercise.unbeaten"),
  );
  const quicker = others
    .filter((each) => speed(each, yours) > 0)
    .sort((one, other) => loss(one) - loss(other))[0];
  const better = others
    .filter((each) => quality(each, yours) > 0)
    .sort((one, other) => one.milliseconds - other.milliseconds)[0];
  if (quicker) said.push(words("exercise.way_faster", { tier: label(quicker.tier) }));
  if (better) said.push(words("exercise.way_better", { tier: label(better.tier) }));
  return said;
}

function errorText(error: number | null) {
  return error === null ? "∞" : numeral(String(Number(error.toPrecision(3))));
}
