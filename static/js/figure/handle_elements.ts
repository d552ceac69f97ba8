/**
 * Handles as elements of the page: the settings they drive, their places, the handle at a press, and
 * keys: arrow keys step the controls that a handle drives.
 */

import { isSlider } from "../../../simulations/engine/controls/slider/kind.ts";
import { type Control, named, type Value } from "./controls.ts";
import { findAll, findOptional, find, closestTo } from "../page/dom.ts";

/** In view box units of a panel. */
export type Point = [number, number];

/** Handles that are nearer to the pointer than this, in CSS pixels, compete for it. */
const REACH = 22;

/** The handle at a press: the nearest mark within reach, else the one under the pointer. */
export function handleAt(layer: HTMLElement, event: PointerEvent): HTMLElement | null {
  const near = findAll(layer, "[data-handle]:not(.drag, .aim, [hidden])", HTMLElement)
    .map((element) => ({ element, distance: distanceTo(element, event) }))
    .filter(({ distance }) => distance <= REACH)
    .sort((a, b) => a.distance - b.distance);
  if (near.length > 0) return near[0].element;
  const ground = closestTo(event, ".handle-ground", HTMLElement)?.dataset.groundOf;
  const target = ground
    ? findOptional(layer, `[data-handle="${CSS.escape(ground)}"]`, HTMLElement)
    : closestTo(event, "[data-handle]", HTMLElement);
  return target && !target.hidden ? target : null;
}

export function handleName(element: HTMLElement) {
  return element.dataset.handle ?? "";
}

export function drivenSettings(element: HTMLElement) {
  return (element.dataset.drives ?? "").split(" ");
}

function reversedSettings(element: HTMLElement) {
  return (element.dataset.reversed ?? "").split(" ");
}

/** The view box of the panel that a handle lies in. */
function viewBox(element: HTMLElement) {
  const view = element.closest(".panel") ?? element;
  return find(view, "svg.overlay", SVGSVGElement).viewBox.baseVal;
}

/** Where a pointer is, in view box units of the handle's panel. */
export function pointerPlace(element: HTMLElement, event: PointerEvent): Point {
  const { width, height } = viewBox(element);
  const box = (element.closest(".handles") ?? element).getBoundingClientRect();
  return [
    ((event.clientX - box.left) / box.width) * width,
    ((event.clientY - box.top) / box.height) * height,
  ];
}

/** Where a handle is, in view box units of its panel. */
export function handlePlace(element: HTMLElement): Point {
  const { width, height } = viewBox(element);
  return [
    (Number.parseFloat(element.style.getPropertyValue("--x")) / 100) * width,
    (Number.parseFloat(element.style.getPropertyValue("--y")) / 100) * height,
  ];
}

/** Where a handle is, in per cent of the panel: `x 41, y 30`. */
export function placeText({ style }: HTMLElement) {
  const share = (property: string) =>
    Math.round(Number.parseFloat(style.getPropertyValue(property)));
  return `x ${share("--x")}, y ${share("--y")}`;
}

/** Move a handle to a place of its panel. */
export function placeHandle(element: HTMLElement, place: { x: number; y: number; step?: number }) {
  const { width, height } = viewBox(element);
  if (place.step) element.dataset.step = String(place.step);
  setProperty(element, "--x", ((100 * place.x) / width).toFixed(3));
  setProperty(element, "--y", ((100 * place.y) / height).toFixed(3));
}

function setProperty({ style }: HTMLElement, property: string, value: string) {
  if (style.getPropertyValue(property) !== value) style.setProperty(property, value);
}

/** CSS pixels from a handle's mark to the pointer. */
function distanceTo(element: HTMLElement, event: PointerEvent) {
  const box = element.getBoundingClientRect();
  const [x, y] = [box.left + box.width / 2, box.top + box.height / 2];
  return Math.hypot(event.clientX - x, event.clientY - y);
}

/**
 * A finger that comes down on the ground of a panel may be on its way to scroll the page. One that
 * rests there first drags the ground, up and down, too.
 *
 * Milliseconds of rest after which the finger drags the ground.
 */
const REST = 250;
/** How far a finger at rest may move, in CSS pixels. */
const REST_RADIUS = 8;

/** Whether a finger that has not rested goes rather up or down than sideways. */
export function mayScroll(down: PointerEvent, now: PointerEvent) {
  if (closestTo(now, ".handles.taken", HTMLElement)) return false;
  return Math.abs(now.clientY - down.clientY) >= Math.abs(now.clientX - down.clientX);
}

/**
 * @param layer The handles of a panel.
 * @param signal Ends all listening.
 */
export function installGroundHold(layer: HTMLElement, signal: AbortSignal) {
  let down: { clientX: number; clientY: number } | null = null;
  let timer = 0;
  const letGo = () => {
    clearTimeout(timer);
    down = null;
    layer.classList.remove("taken");
  };
  const press = (event: TouchEvent) => {
    letGo();
    if (
      event.touches.length > 1 ||
      !closestTo(event, ".handle-ground, .handle.drag", HTMLElement)
    ) {
      return;
    }
    down = event.touches[0];
    timer = setTimeout(() => layer.classList.add("taken"), REST);
  };
  const move = (event: TouchEvent) => {
    if (!down) return;
    const { clientX, clientY } = event.touches[0];
    if (layer.classList.contains("taken")) event.preventDefault();
    else if (Math.hypot(clientX - down.clientX, clientY - down.clientY) > REST_RADIUS) letGo();
  };
  layer.addEventListener("touchstart", press, { passive: true, signal });
  layer.addEventListener("touchmove", move, { passive: false, signal });
  for (const end of ["touchend", "touchcancel"]) layer.addEventListener(end, letGo, { signal });
}

/** Steps of a slider that a page key takes at once. */
const PAGE_STEPS = 10;

const KEYS: Record<string, { axis: number; steps: number } | undefined> = {
  ArrowRight: { axis: 0, steps: 1 },
  ArrowLeft: { axis: 0, steps: -1 },
  ArrowUp: { axis: 1, steps: 1 },
  ArrowDown: { axis: 1, steps: -1 },
  PageUp: { axis: 1, steps: PAGE_STEPS },
  PageDown: { axis: 1, steps: -PAGE_STEPS },
  Home: { axis: 0, steps: -Infinity },
  End: { axis: 0, steps: Infinity },
};

/** The value of the control that a key steps; null for a key without a meaning. */
export function valuesByKey(
  event: KeyboardEvent,
  element: HTMLElement,
  form: HTMLFormElement,
  controls: Control[],
): Record<string, Value> | null {
  const key = KEYS[event.key];
  if (!key || event.altKey || event.ctrlKey || event.metaKey) return null;
  const names = drivenSettings(element);
  const setting = names[Math.min(key.axis, names.length - 1)];
  const control = controls.find(({ name }) => name === setting);
  if (!control) return null;
  const back = Number.isFinite(key.steps) && reversedSettings(element).includes(setting);
  const steps = (back ? -1 : 1) * key.steps * (event.shiftKey ? PAGE_STEPS : 1);
  return { [setting]: steppedValue(form, control, steps) };
}

/** Where a key moves a handle of points to; null where it does not. */
export function placeByKey(event: KeyboardEvent, element: HTMLElement): Point | null {
  const key = KEYS[event.key];
  const step = Number(element.dataset.step ?? 0) * (event.shiftKey ? PAGE_STEPS : 1);
  if (!key || !step || !event.key.startsWith("Arrow")) return null;
  if (event.altKey || event.ctrlKey || event.metaKey) return null;
  const [x, y] = handlePlace(element);
  return key.axis === 0 ? [x + key.steps * step, y] : [x, y - key.steps * step];
}

/** A control's value some steps further, or its first or last. */
function steppedValue(form: HTMLFormElement, control: Control, steps: number): Value {
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
