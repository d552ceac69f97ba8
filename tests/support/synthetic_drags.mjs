/** Drags of synthetic figures on synthetic devices, by the book's chooser; no clock runs. */

import { Chooser } from "./js/figure/chooser.js";

/** Milliseconds between two events of a hand. */
const EVENT_MS = 1000 / 60;
const LASTS_MS = 5000;

/** How many times as long as usual a frame takes: of the time in ms, and of a chance from 0 to 1. */
const SLOWNESS = {
  constant: () => 1,
  slow_start: (now) => (now < 300 ? 8 : 1),
  sudden_load: (now) => (1500 < now && now < 3000 ? 4 : 1),
  heavy_tails: (_, chance) => (chance < 0.05 ? 6 : 1),
  one_slow_frame: (now) => (2000 < now && now < 2000 + EVENT_MS ? 10 : 1),
};
/** Which control moves at a time. */
const HANDS = {
  one: () => "a",
  two: (now) => (Math.floor(now / 400) % 2 ? "a" : "b"),
};

/** A seeded generator of numbers from 0 to 1: mulberry32. */
function random(seed) {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/**
 * A scene of two to five levels and two controls, whose costs in ms rise with the level. Recorded
 * costs are wrong by a factor of up to three for all, and of up to 1.3 for each; some scenes have none.
 */
function figure(seed, next) {
  const tiers = Array.from({ length: 2 + Math.floor(next() * 4) }, (_, level) => `level-${level}`);
  const factor = 3 ** (2 * next() - 1);
  const isRecorded = next() < 0.7;
  const [costs, recorded] = [{}, Object.fromEntries(tiers.map((tier) => [tier, {}]))];
  for (const control of ["a", "b"]) {
    costs[control] = [];
    let cost = 6 + 6 * next();
    for (const tier of tiers) {
      costs[control].push(cost);
      const wrong = factor * 1.3 ** (2 * next() - 1);
      if (isRecorded) recorded[tier][control] = Math.max((wrong * cost - 6) / 2, 0.05);
      cost *= 1.1 + 2.4 * next();
    }
  }
  return { of: { scene: `scene-${seed}`, tiers, recorded }, costs };
}

/** The frames of one drag: an event each display frame, of which the worker takes the newest. */
function drag({ of, costs }, chooser, slowness, hand, next) {
  const frames = [];
  let [running, waiting, before] = [null, null, ""];
  const start = (job, now) => {
    const level = chooser.choose(of, job.control, of.tiers.length - 1, now);
    const ms = costs[job.control][level] * slowness(now, next()) * Math.exp(0.3 * next() - 0.15);
    return { ...job, level, end: now + ms };
  };
  for (let now = 0; now < LASTS_MS; now += EVENT_MS) {
    while (running && running.end <= now) {
      const { at, control, level, end } = running;
      chooser.shown(of, control, level, end - at, end);
      frames.push({ control, level, at, ms: end - at });
      running = waiting && start(waiting, end);
      waiting = null;
    }
    const control = hand(now);
    if (before && control !== before) chooser.rest(of, before);
    before = control;
    if (running) waiting = { at: now, control };
    else running = start({ at: now, control }, now);
  }
  return frames;
}

export function drags(seeds) {
  const found = [];
  for (let seed = 0; seed < seeds; seed++) {
    for (const [device, slowness] of Object.entries(SLOWNESS)) {
      for (const [hands, hand] of Object.entries(HANDS)) {
        const next = random(seed);
        const scene = figure(seed, next);
        const chooser = new Chooser();
        const most = scene.of.tiers.length - 1;
        chooser.shown(scene.of, "", most, scene.costs.a[most], 0); // the frame that it came alive with
        const frames = drag(scene, chooser, slowness, hand, next);
        found.push({ seed, device, hands, costs: scene.costs, frames });
      }
    }
  }
  return found;
}
