/**
 * Gestures on figures as wholes, and on words that speak of them. What answers them is fetched
 * when it is first needed. Listeners sit on the document, so that they outlive a change of chapter.
 */

import { isPlain, within } from "../page/dom.ts";

/** What may have the colour of an idea: words, parts of formulae, readouts, handles, controls. */
const COLOURED = '[class*="role-"], .control';

/** Figures that the reader has changed since the page was opened. */
const touched = new WeakSet();

/** Listen; to be called before links to other pages are listened for, since some are answered here. */
export function installGestures() {
  document.addEventListener("click", clicked);
  document.addEventListener("input", touch);
  document.addEventListener("figure-rest", rested);
  // What a press copies must be at hand when it comes: browsers forbid it a moment later.
  document.addEventListener("toggle", fetchTools, true);
  document.documentElement.classList.toggle("full-screen", document.fullscreenEnabled);
  for (const type of ["pointerover", "focusin"]) document.addEventListener(type, highlight);
}

/** The address has become another one of the same page: its figures follow. */
export async function returned() {
  if (!document.querySelector("simulation-figure")) return;
  const { showAddress } = await import("./permalink.ts");
  showAddress();
}

async function clicked(event: MouseEvent) {
  touch(event);
  const link = within(event, "a.set[href]", HTMLAnchorElement);
  const toFigure = within(event, ".figure-link a", HTMLAnchorElement);
  const tool = within(event, ".tools button", HTMLButtonElement);
  if (link && isPlain(event)) {
    event.preventDefault();
    (await import("./animate.ts")).follow(link);
  }
  if (toFigure) {
    const { offerWayBack, scrolled } = await import("./way_back.ts");
    await scrolled();
    offerWayBack(toFigure);
  }
  if (tool) (await import("./tools.ts")).use(tool);
}

function touch(event: Event) {
  const form = within(event, "form.controls [name]", Element)?.closest("form");
  if (form) touched.add(form);
}

/** Keep what the reader has done in the address, once the figure rests. */
async function rested(event: Event) {
  const figure = within(event, "simulation-figure", HTMLElement);
  const form = figure?.querySelector("form.controls");
  for (const readout of figure?.querySelectorAll("[data-moved]") ?? []) {
    readout.removeAttribute("data-moved");
  }
  if (!figure || !form || !touched.has(form) || "moving" in figure.dataset) return;
  const permalink = await import("./permalink.ts").catch(ignore); // else the address stays
  permalink?.record(figure, "replace");
}

function fetchTools(event: Event) {
  if (within(event, ".tools .share", HTMLElement)) import("./tools.ts").catch(ignore);
}

async function highlight(event: Event) {
  const pointed = within(event, COLOURED, Element);
  if (pointed) (await import("./highlight.ts").catch(ignore))?.point(pointed);
}

/** Optional work: its failure is not reported. */
function ignore() {}
