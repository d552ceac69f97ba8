/**
 * A finger that comes down on the ground of a panel may be on its way to scroll the page. One that
 * rests there first has taken hold of the ground, and drags it up and down, too.
 */

import { within } from "../page/dom.ts";

/** Milliseconds of rest after which the ground is in the reader's hand. */
const REST = 250;
/** How far a finger at rest may move, in CSS pixels. */
const STILL = 8;

/** Whether a finger that has not rested goes rather up or down than sideways. */
export function mayScroll(down: PointerEvent, now: PointerEvent) {
  if (within(now, ".handles.taken", HTMLElement)) return false;
  return Math.abs(now.clientY - down.clientY) >= Math.abs(now.clientX - down.clientX);
}

/**
 * @param layer The handles of a panel.
 * @param signal Ends all listening.
 */
export function holdGround(layer: HTMLElement, signal: AbortSignal) {
  let down: { clientX: number; clientY: number } | null = null;
  let timer = 0;
  const letGo = () => {
    clearTimeout(timer);
    down = null;
    layer.classList.remove("taken");
  };
  const press = (event: TouchEvent) => {
    letGo();
    if (event.touches.length > 1 || !within(event, ".handle-ground, .handle.drag", HTMLElement)) {
      return;
    }
    down = event.touches[0];
    timer = setTimeout(() => layer.classList.add("taken"), REST);
  };
  const move = (event: TouchEvent) => {
    if (!down) return;
    const { clientX, clientY } = event.touches[0];
    if (layer.classList.contains("taken")) event.preventDefault();
    else if (Math.hypot(clientX - down.clientX, clientY - down.clientY) > STILL) letGo();
  };
  layer.addEventListener("touchstart", press, { passive: true, signal });
  layer.addEventListener("touchmove", move, { passive: false, signal });
  for (const end of ["touchend", "touchcancel"]) layer.addEventListener(end, letGo, { signal });
}
