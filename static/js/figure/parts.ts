/**
 * Parts of a figure: figures of the same page that show other panels of its scene. Their settings are
 * those of the figure that leads them, which computes one frame for all. A part has controls of its
 * own, which mirror the leader's.
 */

import { findAll, find, closestTo } from "../page/dom.ts";
import { type Control, moveControls, named, readValue, type Value } from "./controls.ts";
import { KINDS } from "./control_kinds.js";

/** Selects figures that lead: all but parts. */
export const LEADS = "simulation-figure:not([data-with])";

/** The figure that has a figure's settings: itself, where it is no part. */
export function leaderOf(figure: HTMLElement): HTMLElement {
  const leader = document.getElementById(figure.dataset.with ?? "");
  return leader ? find(leader, "simulation-figure", HTMLElement) : figure;
}

/** Those that have been looked up. */
const known: WeakMap<HTMLElement, HTMLElement[]> = new WeakMap();

/** A figure that leads, and its parts. */
export function withParts(leader: HTMLElement): HTMLElement[] {
  let together = known.get(leader);
  if (!together) {
    const id = CSS.escape(leader.closest("figure")?.id ?? "");
    const parts = findAll(document, `simulation-figure[data-with="${id}"]`, HTMLElement);
    together = [leader, ...parts];
    known.set(leader, together);
  }
  return together;
}

/** Whether all of them stand in sections that are folded up. */
export function areFolded(figures: HTMLElement[]) {
  return figures.every((figure) => figure.closest("details:not([open])"));
}

/** Forms of parts, which move their leader's form and follow it. */
export class Mirrors {
  #forms: HTMLFormElement[];

  /**
   * @param form The leader's.
   * @param signal Ends all listening.
   */
  constructor(
    parts: HTMLElement[],
    readonly form: HTMLFormElement,
    readonly controls: Control[],
    signal: AbortSignal,
  ) {
    this.#forms = parts.map((part) => find(part, "form.controls", HTMLFormElement));
    for (const mirror of this.#forms) {
      mirror.addEventListener("submit", (event) => event.preventDefault(), { signal });
      for (const type of ["input", "change"] as const) {
        mirror.addEventListener(type, (event) => this.#moved(mirror, event, type), { signal });
      }
      mirror.addEventListener("click", (event) => this.#pressed(event), { signal });
    }
  }

  /** Show what the leader's controls are set to. */
  show(values: Record<string, Value>) {
    for (const mirror of this.#forms) {
      for (const control of this.controls) {
        const field = mirror.querySelector(named(control.name));
        if (field) KINDS[control.kind].write(field, control, values[control.name]);
      }
    }
  }

  #moved(mirror: HTMLFormElement, event: Event, type: "input" | "change") {
    const name = closestTo(event, "[name]", Element)?.getAttribute("name");
    const control = this.controls.find((one) => one.name === name);
    if (!control) return;
    const values = { [control.name]: readValue(mirror, control) };
    moveControls(this.form, this.controls, values, type);
  }

  /** Buttons of a part are pressed in its leader's form: actions, and those that pull or undo. */
  #pressed(event: Event) {
    const button = closestTo(event, "button", HTMLButtonElement);
    if (!button) return;
    const { pull = "", undo = "" } = button.dataset;
    const same = button.name
      ? named(button.name)
      : pull
        ? `[data-pull="${CSS.escape(pull)}"]`
        : `[data-undo="${CSS.escape(undo)}"]`;
    this.form.querySelector<HTMLElement>(same)?.click();
  }
}
