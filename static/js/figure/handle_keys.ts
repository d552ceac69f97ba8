/** Handles by keyboard: arrow keys step the controls that a handle drives. */

import { isSlider } from "../../../simulations/engine/controls/slider/kind.ts";
import { type Control, named, type Value } from "./controls.ts";
import { center, driven, reversed, type Point } from "./handle_elements.ts";

/** Steps of a slider that a page key takes at once. */
const PAGE = 10;

const KEYS: Record<string, { axis: number; steps: number } | undefined> = {
  ArrowRight: { axis: 0, steps: 1 },
  ArrowLeft: { axis: 0, steps: -1 },
  ArrowUp: { axis: 1, steps: 1 },
  ArrowDown: { axis: 1, steps: -1 },
  PageUp: { axis: 1, steps: PAGE },
  PageDown: { axis: 1, steps: -PAGE },
  Home: { axis: 0, steps: -Infinity },
  End: { axis: 0, steps: Infinity },
};

/** What a key means for the control that it steps; null where it means nothing to the handle. */
export function keyed(
  event: KeyboardEvent,
  element: HTMLElement,
  form: HTMLFormElement,
  controls: Control[],
): Record<string, Value> | null {
  const key = KEYS[event.key];
  if (!key || event.altKey || event.ctrlKey || event.metaKey) return null;
  const names = driven(element);
  const setting = names[Math.min(key.axis, names.length - 1)];
  const control = controls.find(({ name }) => name === setting);
  if (!control) return null;
  const back = Number.isFinite(key.steps) && reversed(element).includes(setting);
  const steps = (back ? -1 : 1) * key.steps * (event.shiftKey ? PAGE : 1);
  return { [setting]: stepped(form, control, steps) };
}

/** Where a key moves a handle of points to; null where it does not. */
export function movedByKey(event: KeyboardEvent, element: HTMLElement): Point | null {
  const key = KEYS[event.key];
  const step = Number(element.dataset.step ?? 0) * (event.shiftKey ? PAGE : 1);
  if (!key || !step || !event.key.startsWith("Arrow")) return null;
  if (event.altKey || event.ctrlKey || event.metaKey) return null;
  const [x, y] = center(element);
  return key.axis === 0 ? [x + key.steps * step, y] : [x, y - key.steps * step];
}

/** A control's value some steps further, or its first or last. */
function stepped(form: HTMLFormElement, control: Control, steps: number): Value {
  const field = form.querySelector(named(control.name));
  if (field instanceof HTMLSelectElement) {
    const wanted = Math.max(0, Math.min(field.selectedIndex + steps, field.length - 1));
    return field.options[wanted].value;
  }
  if (!isSlider(control)) return control.default;
  const wanted = Number((field as HTMLInputElement).value) + steps * control.step;
  const digits = control.decimals + 2;
  return Number(Math.max(control.min, Math.min(wanted, control.max)).toFixed(digits));
}
