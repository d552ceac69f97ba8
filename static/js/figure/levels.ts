/**
 * The level of accuracy of a figure's frames: at rest the default or what the reader chose, while
 * something moves what `chooser.ts` takes, never more accurate than at rest.
 */

import { named, readValue, type Control, type Schema } from "./controls.ts";
import { Chooser } from "./chooser.ts";
import type { Moving } from "./stage_report.ts";

/** Value of the menu with which the engine chooses. */
export const AUTOMATIC = "automatic";

/** What is known of this device, for the whole visit. */
const chooser = new Chooser();

export class FigureLevels {
  readonly #of: { scene: string; tiers: string[]; recorded: Schema["recorded"] };
  /** What moved last, and the level that was shown. */
  #moved: { control: string; level: number } | null = null;
  /** The cheapest level within the error that the reader allows; empty where it is not known. */
  #within = "";

  constructor(
    readonly form: HTMLFormElement,
    readonly schema: Schema,
    scene: string,
  ) {
    const { tiers, recorded } = schema;
    this.#of = { scene, tiers, recorded };
  }

  /** The level at rest; empty in a scene of one level. */
  get rest(): string {
    const { tiers, default_tier: usual } = this.schema;
    const chosen = chosenAccuracy(this.form, this.schema);
    if (tiers.includes(chosen)) return chosen;
    return (this.tolerance !== undefined && this.#within) || usual;
  }

  /** The error that the reader allows, in the unit of the scene's estimates. */
  get tolerance(): number | undefined {
    return this.schema.within[chosenAccuracy(this.form, this.schema)];
  }

  /** The cheapest level within the tolerance was found. */
  set within(level: string) {
    this.#within = level;
  }

  /** The level of the next frame while a control moves. */
  moving(control: string, now: number): string {
    const { tiers } = this.schema;
    if (tiers.length === 0) return "";
    return tiers[chooser.choose(this.#of, control, tiers.indexOf(this.rest), now)];
  }

  /** The hand has let go of a control. */
  settle(control: string) {
    chooser.rest(this.#of, control);
  }

  /**
   * A frame was painted.
   *
   * @param control What moved; empty for a frame of which nothing was cached.
   * @param ms From the event to the pixels.
   */
  shown(control: string, tier: string, isMoving: boolean, ms: number, now: number) {
    const level = this.schema.tiers.indexOf(tier);
    if (level < 0) return;
    chooser.shown(this.#of, control, level, ms, now);
    if (isMoving) this.#moved = { control, level };
  }

  /** What was shown while something moved, and what the next level would have taken. */
  get report(): Moving | null {
    if (!this.#moved) return null;
    const { control, level } = this.#moved;
    const { tiers } = this.schema;
    const ms = (of: number) => chooser.expected(this.#of, control, of);
    const next = level < tiers.indexOf(this.rest) ? level + 1 : null;
    const better = next === null ? null : { label: this.#label(tiers[next]), ms: ms(next) };
    return { tier: tiers[level], label: this.#label(tiers[level]), ms: ms(level), better };
  }

  #label(tier: string) {
    const option = this.form.querySelector(`${named("tier")} [value="${CSS.escape(tier)}"]`);
    return option?.textContent?.trim() ?? tier;
  }
}

/** What the menu of accuracies says; `AUTOMATIC` where there is none. */
function chosenAccuracy(form: HTMLFormElement, schema: Schema): string {
  return schema.tiers.length ? String(readValue(form, accuracyMenu(schema, ""))) : AUTOMATIC;
}

/** The menu of accuracies as a control of its figure. */
export function accuracyMenu({ tiers, within }: Schema, label: string) {
  const options = [AUTOMATIC, ...Object.keys(within), ...tiers];
  return { kind: "choice", name: "tier", label, default: AUTOMATIC, options } as Control;
}
