/** The reader's method among the tiers of a ladder, in sentences. */

import type { Ladder, Result } from "./chart.ts";
import { numeral, words } from "../page/words.ts";

/** Errors that differ by less are alike: a share, or decibels. Smaller than `rounding` they all are. */
const ALIKE = { share: 0.01, decibels: 0.1, rounding: 1e-12 };

/**
 * How the reader's method does against the book's `tier` of the same kind, and the fastest
 * tier that beats it; or else the tiers that are next in speed and in error. Times are alike where
 * their middle halves overlap.
 */
export function comparisonSentences(
  yours: Result,
  tiers: Result[],
  ladder: Ladder,
  tier: string,
): string[] {
  const [metric] = ladder.metrics;
  const label = (id: string) => ladder.tiers.find((each) => each.id === id)?.label ?? id;
  const loss = ({ errors }: Result) => {
    const error = errors[metric.id];
    if (error === null) return metric.higher ? -Number.MAX_VALUE : Number.MAX_VALUE;
    return metric.higher ? -error : error;
  };
  const speed = (one: Result, other: Result) =>
    one.high_ms < other.low_ms ? 1 : one.low_ms > other.high_ms ? -1 : 0;
  const quality = (one: Result, other: Result) => {
    const [a, b] = [loss(one), loss(other)];
    const share = Math.max(ALIKE.share * Math.abs(b), metric.higher ? 0 : ALIKE.rounding);
    const slack = metric.unit === "dB" ? ALIKE.decibels : share;
    return a < b - slack ? 1 : a > b + slack ? -1 : 0;
  };
  const sentences: string[] = [];
  const book = tiers.find((each) => each.tier === tier);
  if (book) {
    const ratio = book.milliseconds / yours.milliseconds;
    const times = numeral(String(Number((ratio < 1 ? 1 / ratio : ratio).toPrecision(2))));
    const key = ["slower", "as_fast", "faster"][speed(yours, book) + 1];
    sentences.push(words(`exercise.${key}`, { times, tier: label(tier) }));
    const [value, other] = [yours, book].map(({ errors }) => errorText(errors[metric.id]));
    const error = { metric: metric.label, value, other, unit: metric.unit };
    sentences.push(words(`exercise.${quality(yours, book) === 0 ? "as_exact" : "error"}`, error));
  }
  const winner = tiers
    .filter((each) => {
      const [time, error] = [speed(each, yours), quality(each, yours)];
      return time >= 0 && error >= 0 && time + error > 0;
    })
    .sort((one, other) => one.milliseconds - other.milliseconds)[0];
  if (winner) {
    const [time, error] = [speed(winner, yours), quality(winner, yours)];
    const key = time === 0 ? "beaten_in_error" : error === 0 ? "beaten_in_time" : "beaten";
    return [...sentences, words(`exercise.${key}`, { tier: label(winner.tier) })];
  }
  sentences.push(words("exercise.unbeaten"));
  const quicker = tiers
    .filter((each) => speed(each, yours) > 0)
    .sort((one, other) => loss(one) - loss(other))[0];
  const better = tiers
    .filter((each) => quality(each, yours) > 0)
    .sort((one, other) => one.milliseconds - other.milliseconds)[0];
  if (quicker) sentences.push(words("exercise.faster_tier", { tier: label(quicker.tier) }));
  if (better) sentences.push(words("exercise.more_accurate_tier", { tier: label(better.tier) }));
  return sentences;
}

function errorText(error: number | null) {
  return error === null ? "∞" : numeral(String(Number(error.toPrecision(3))));
}
