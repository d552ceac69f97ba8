/**
 * Once all figures of a page are live and the reader rests, the scenes of the next chapter are
 * imported, so that its figures are live as soon as the page is turned.
 */

import { isMetered } from "../page/data_saver.ts";
import { all, maybe } from "../page/dom.ts";
import { linkedPage, prefetch } from "../page/prefetch.ts";
import { sharedRuntime } from "../runtime/runtime.ts";

/** Milliseconds of rest after the last input. */
const REST = 500;
/** After anything that the reader waits for. */
const URGENCY = () => -2;

let lastInput = 0;

/** Called once. */
export function watchInput() {
  for (const kind of ["pointerdown", "pointermove", "keydown", "input"]) {
    addEventListener(kind, () => (lastInput = performance.now()), { passive: true });
  }
}

/** Called for each page. */
export async function prewarmNext() {
  const main = document.getElementById("main");
  const link = maybe(document, ".pager a[rel=next]", HTMLAnchorElement);
  const url = link && linkedPage(link);
  if (!url || isMetered() || !(await atRest(main)) || !navigator.onLine) return;
  const page = await prefetch(url);
  const [, scenes = ""] = /data-scenes="([^"]*)"/.exec(page?.text ?? "") ?? [];
  for (const scene of scenes.split(" ").filter(Boolean)) {
    if (!(await atRest(main))) return;
    const importing = sharedRuntime()?.call("prepare", { scene }, URGENCY);
    await importing?.catch(() => {}); // reported when a figure needs it
  }
}

/** @returns False where the page has been turned meanwhile. */
async function atRest(main: HTMLElement | null): Promise<boolean> {
  while (main?.isConnected && !isAtRest()) await new Promise((done) => setTimeout(done, REST));
  return main?.isConnected ?? false;
}

function isAtRest() {
  const figures = all(document, "simulation-figure", HTMLElement);
  const live = figures.length > 0 && figures.every(({ dataset }) => dataset.state === "live");
  return live && performance.now() - lastInput > REST;
}
