/** How accurately a figure computes: as the reader chose, or cheaper while things move. */

import { choice } from "./controls.js";

/** @import { Control, Schema } from "./controls.js" */

/**
 * The tier that the reader chose.
 *
 * @param {HTMLFormElement} form
 * @param {Schema} schema
 */
export function chosenTier(form, { tiers, default_tier: settled }) {
  return tiers.length === 0 ? settled : choice(form, "tier").value;
}

/**
 * The tier chosen, or the draft where that is cheaper and things are moving.
 *
 * @param {HTMLFormElement} form
 * @param {Schema} schema
 * @param {boolean} moving
 */
export function shownTier(form, schema, moving) {
  const { tiers, draft_tier: draft } = schema;
  const chosen = chosenTier(form, schema);
  return moving && tiers.indexOf(draft) < tiers.indexOf(chosen) ? draft : chosen;
}

/**
 * Whether a drag of a control is answered by drafts.
 *
 * @param {HTMLFormElement} form
 * @param {Schema} schema
 * @param {Control | undefined} control
 */
export function isDrafted(form, schema, control) {
  const { drafted, drafted_in: byTier } = schema;
  if (control?.kind !== "slider") return false;
  if (drafted.length === 0 || drafted.includes(control.name)) return true;
  return byTier[chosenTier(form, schema)]?.includes(control.name) ?? false;
}
