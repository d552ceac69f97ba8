/** How accurately a figure computes: as the reader chose, or cheaper while things move. */

import { isSlider } from "../../../simulations/engine/controls/slider/kind.ts";
import type { Control } from "./control.ts";
import { readValue, type Schema } from "./controls.ts";

/** The tier that the reader chose. */
export function chosenTier(form: HTMLFormElement, { tiers, default_tier: tier }: Schema) {
  if (tiers.length === 0) return tier;
  const menu = { kind: "choice", name: "tier", label: "", default: tier, options: tiers };
  return String(readValue(form, menu as Control));
}

/**
 * The tier chosen, or a draft where a control is moving: its own, or the scene's where that is
 * cheaper.
 *
 * @param moving Name of the control whose moves are drafted; empty where all is at rest.
 */
export function shownTier(form: HTMLFormElement, schema: Schema, moving: string) {
  const { tiers, draft_tier: draft, own_drafts: own } = schema;
  const chosen = chosenTier(form, schema);
  if (moving && own[chosen]?.[moving]) return own[chosen][moving];
  return moving && tiers.indexOf(draft) < tiers.indexOf(chosen) ? draft : chosen;
}

/** Whether a drag of a control is answered by drafts. */
export function isDrafted(form: HTMLFormElement, schema: Schema, control: Control | undefined) {
  const { drafted, drafted_in: byTier, own_drafts: own } = schema;
  if (!isSlider(control)) return false;
  if (own[chosenTier(form, schema)]?.[control.name]) return true;
  if (drafted.length === 0 || drafted.includes(control.name)) return true;
  return byTier[chosenTier(form, schema)]?.includes(control.name) ?? false;
}
