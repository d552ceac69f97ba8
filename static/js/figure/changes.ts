/** The changes of the points of a figure, which a button takes back one by one. */

import { isPoints } from "../../../simulations/engine/controls/points/kind.ts";
import { maybe } from "../page/dom.ts";
import type { Control, Value } from "./control.ts";
import { moveControls, readValue } from "./controls.ts";

export class Changes {
  /** Values that the controls had, the last one being the present. */
  #had: Map<string, Value[]> = new Map();

  constructor(
    readonly form: HTMLFormElement,
    readonly controls: Control[],
    signal: AbortSignal,
  ) {
    const points = controls.filter(isPoints);
    for (const control of points) this.#had.set(control.name, [readValue(form, control)]);
    if (points.length)
      form.addEventListener("change", () => points.forEach(this.#keep), { signal });
  }

  undo(name: string) {
    const had = this.#had.get(name) ?? [];
    if (had.length < 2) return;
    had.pop();
    moveControls(this.form, this.controls, { [name]: had[had.length - 1] }, "change");
  }

  #keep = (control: Control) => {
    const had = this.#had.get(control.name) ?? [];
    const now = readValue(this.form, control);
    if (now !== had[had.length - 1]) had.push(now);
    const button = maybe(this.form, `[data-undo="${control.name}"]`, HTMLButtonElement);
    if (button) button.disabled = had.length < 2;
  };
}
