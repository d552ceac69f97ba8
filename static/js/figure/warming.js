/**
 * Stages before they are asked for: computed while nobody waits, so that the first touch on a figure
 * finds what its frame shares with the one at rest. A call is a slice: whoever asks for a frame
 * meanwhile goes before the next.
 */

import { servedValues } from "./served.js";
import { draftTiers } from "./tiers.js";

/** @import { Caller } from "../runtime/runtime.js" */
/** @import { Schema } from "./controls.js" */
/** @typedef {{figure: string, scene: string, values: string, tier: string}} Asked */

/** After the frames that figures rest in, before the next chapter. */
const DRAFTS = () => -2;
/** Anything that the reader waits for goes before it. */
export const LEAST_URGENT = () => -3;

/** How often a move is tried: so often browsers see code run before they compile it well. */
const MOVES = 14;
/** @type {WeakSet<Caller>} Where moves have been tried. */
const practised = new WeakSet();

/**
 * What a hand will ask of a figure whose frame at rest is computed: where nothing was moved yet, some
 * moves of its first slider; then its drafts; at last that frame again, which is at hand, so that
 * what is kept for it is not the first to go.
 *
 * @param {Caller} runtime
 * @param {Asked} asked That frame.
 * @param {Schema} schema
 * @param {() => boolean} isWanted Asked before each.
 */
export async function warmTouches(runtime, asked, schema, isWanted) {
  const moves = practised.has(runtime) ? [] : movesOf(asked, schema);
  if (moves.length) practised.add(runtime);
  const drafts = draftTiers(schema, asked.tier).map((tier) => ({ ...asked, tier }));
  const touches = [...moves, ...drafts];
  for (const touch of touches.length ? [...touches, asked] : []) {
    if (isWanted()) await runtime.call("warm", touch, DRAFTS);
  }
}

/**
 * Frames of moves of the first slider, as the figure would ask for them.
 *
 * @param {Asked} asked
 * @param {Schema} schema
 * @returns {Asked[]}
 */
function movesOf(asked, schema) {
  const slider = schema.controls.find((control) => control.kind === "slider");
  if (!slider) return [];
  const { name, min, max } = slider;
  const tier = draftTiers(schema, asked.tier)[0] ?? asked.tier;
  const values = JSON.parse(asked.values);
  return Array.from({ length: MOVES }, (_, index) => {
    const place = min + ((index + 0.5) / MOVES) * (max - min);
    return { ...asked, tier, values: JSON.stringify({ ...values, [name]: place }) };
  });
}

/** A figure's own tag and what it says of its controls, which comes first in it. */
const FIGURES = /<simulation-figure\b[^>]*>\s*<script\b[^>]*\bschema\b[^>]*>[^<]*<\/script>/g;

/**
 * What to call for the figures of a page that is not yet open, of each scene the first: the frame
 * at rest, then its drafts, and at last that one again.
 *
 * @param {string} text Of the page, of which no more is parsed than that: a whole chapter would keep
 *   the page that is read from answering.
 * @returns {Asked[]}
 */
export function aheadOf(text) {
  const figures = (text.match(FIGURES) ?? []).join("</simulation-figure>");
  const page = new DOMParser().parseFromString(figures, "text/html");
  /** @type {Map<string, Asked[]>} */
  const scenes = new Map();
  for (const figure of page.querySelectorAll("simulation-figure")) {
    const scene = figure.getAttribute("data-simulation") ?? "";
    const schema = JSON.parse(figure.querySelector("script.schema")?.textContent ?? "null");
    if (!schema || scenes.has(scene)) continue;
    const values = servedValues(schema);
    const [rest, drafts] = [schema.default_tier, draftTiers(schema, schema.default_tier)];
    const tiers = drafts.length ? [rest, ...drafts, rest] : [rest];
    scenes.set(
      scene,
      tiers.map((tier) => ({ figure: "", scene, values, tier })),
    );
  }
  return [...scenes.values()].flat();
}
