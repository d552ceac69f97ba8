/**
 * The element of figures, and gestures on figures and on words that refer to them. The scripts that
 * answer gestures are fetched when they are first needed. Listeners sit on the document, so that they
 * outlive a change of chapter.
 */

import { isMetered } from "../page/data_saver.ts";
import { findAll, isPlainClick, findOptional, closestTo } from "../page/dom.ts";
import { linkedPage, prefetch } from "../page/navigate.ts";
import { sharedRuntime } from "../runtime/runtime.ts";
import { prefersReducedMotion } from "./animate.ts";
import { withParts } from "./parts.ts";
import { SimulationFigure } from "./element.ts";

/** Called once; before links to other pages are listened for, since some are answered here. */
export function install() {
  customElements.define("simulation-figure", SimulationFigure);
  installGestures();
  watchInput();
}

/** Called for each page. */
export function setUpPage() {
  prewarmNext();
  nudgeFirstHandle();
}

/** Elements that may have a colour: words, parts of formulae, readouts, handles, controls. */
const COLOURED = '[class*="role-"], .control';

/** Figures that the reader has changed since the page was opened. */
const touched = new WeakSet();

function installGestures() {
  document.addEventListener("click", handleClick);
  document.addEventListener("input", markTouched);
  document.addEventListener("figure-rest", clearMoved);
  for (const type of ["change", "figure-rest"]) document.addEventListener(type, recordState);
  document.documentElement.classList.toggle("full-screen", document.fullscreenEnabled);
  for (const type of ["pointerover", "focusin"]) {
    document.addEventListener(type, highlight);
    document.addEventListener(type, fetchTools);
  }
  for (const type of ["pointerdown", "keydown"]) document.addEventListener(type, noteUse);
  document.addEventListener("scroll", markDot, { capture: true, passive: true });
}

/** The address has become another one of the same page: its figures follow. */
export async function followAddress() {
  if (!document.querySelector("simulation-figure")) return;
  const { showAddress } = await import("./permalink.ts");
  showAddress();
}

async function handleClick(event: MouseEvent) {
  markTouched(event);
  const link = closestTo(event, "a.set[href]", HTMLAnchorElement);
  const toFigure = closestTo(event, ".figure-link a", HTMLAnchorElement);
  const tool = closestTo(event, ".tools button", HTMLButtonElement);
  const dot = closestTo(event, ".panel-dots > button", HTMLButtonElement);
  if (dot) bringIntoView(dot);
  if (link && isPlainClick(event)) {
    event.preventDefault();
    (await import("./animate.ts")).followLink(link);
  }
  if (toFigure) {
    const { offerReturn, scrolled } = await import("./animate.ts");
    await scrolled();
    offerReturn(toFigure);
  }
  if (tool) (await import("./tools.ts")).runTool(tool);
}

function markTouched(event: Event) {
  const form = closestTo(event, "form.controls [name]", Element)?.closest("form");
  if (form) touched.add(form);
}

function clearMoved(event: Event) {
  const figure = closestTo(event, "simulation-figure", HTMLElement);
  for (const each of figure ? withParts(figure) : []) {
    for (const readout of findAll(each, "[data-moved]", Element))
      readout.removeAttribute("data-moved");
  }
}

/** Keep what the reader has done in the address: once a control is let go, and what that or a handle
 * has set, once the figure rests. */
async function recordState(event: Event) {
  const figure = closestTo(event, "simulation-figure", HTMLElement);
  const form = figure?.querySelector("form.controls");
  const { dataset = {} } = figure ?? {};
  if (!figure || !form || !touched.has(form) || "moving" in dataset || "with" in dataset) return;
  const permalink = await import("./permalink.ts").catch(ignore); // else the address stays
  permalink?.record(figure, "replace");
}

/** Copying needs its script at the press: browsers forbid it a moment later. */
function fetchTools(event: Event) {
  if (closestTo(event, "simulation-figure", HTMLElement)) import("./tools.ts").catch(ignore);
}

async function highlight(event: Event) {
  const pointed = closestTo(event, COLOURED, Element);
  if (pointed) (await import("./highlight.ts").catch(ignore))?.highlightFrom(pointed);
}

/** Optional work: its failure is not reported. */
function ignore() {}

/**
 * Panels that stand in a strip: a dot for each brings it into view and marks the visible one.
 */
function bringIntoView(dot: HTMLButtonElement) {
  const dots = dot.parentElement;
  const strip = dots?.previousElementSibling?.querySelector(".other-panels");
  if (!dots || !strip) return;
  strip.scrollTo({
    left: (scrollRange(strip) * Number(dot.dataset.place)) / (dots.children.length - 1),
  });
}

function markDot({ target }: Event) {
  if (!(target instanceof HTMLElement) || !target.matches(".other-panels")) return;
  const dots = target.parentElement?.nextElementSibling;
  if (!dots?.matches(".panel-dots")) return;
  const place = Math.round((target.scrollLeft / scrollRange(target)) * (dots.children.length - 1));
  for (const dot of findAll(dots, "button", HTMLButtonElement)) {
    dot.ariaCurrent = Number(dot.dataset.place) === place ? "true" : null;
  }
}

/** How far a strip can be scrolled, in pixels. */
function scrollRange(strip: Element) {
  return Math.max(1, strip.scrollWidth - strip.clientWidth);
}

/** Milliseconds for which the handle shows what it is for. */
const NUDGE_MS = 3200;

/** Whether the reader has used a figure, here or on an earlier page. */
let used = false;

function noteUse(event: Event) {
  if (!closestTo(event, "simulation-figure", HTMLElement)) return;
  used = true;
  findOptional(document, ".nudged", HTMLElement)?.classList.remove("nudged");
}

/** Before its figure is live, a handle is not displayed and not in view. */
function nudgeFirstHandle() {
  const handle = findOptional(document, ".handle:not(.drag, .aim, [hidden])", HTMLElement);
  if (!handle || prefersReducedMotion()) return;
  const watcher = new IntersectionObserver(
    ([{ isIntersecting }]) => {
      if (!isIntersecting) return;
      watcher.disconnect();
      if (used) return;
      handle.classList.add("nudged");
      setTimeout(() => handle.classList.remove("nudged"), NUDGE_MS);
    },
    { threshold: 1, rootMargin: "-15% 0px" },
  );
  watcher.observe(handle);
}

/** Milliseconds of rest after the last input. */
const REST_MS = 500;
/** After anything that the reader waits for. */
const URGENCY = () => -2;

let lastInput = 0;

function watchInput() {
  for (const kind of ["pointerdown", "pointermove", "keydown", "input"]) {
    addEventListener(kind, () => (lastInput = performance.now()), { passive: true });
  }
}

/**
 * Once all figures of a page are live and the reader rests, the scenes of the next chapter are
 * imported, so that its figures are live as soon as the page is turned.
 */
async function prewarmNext() {
  const main = document.getElementById("main");
  const link = findOptional(document, ".pager a[rel=next]", HTMLAnchorElement);
  const url = link && linkedPage(link);
  if (!url || isMetered() || !(await waitForRest(main)) || !navigator.onLine) return;
  const page = await prefetch(url);
  const [, scenes = ""] = /data-scenes="([^"]*)"/.exec(page?.text ?? "") ?? [];
  for (const scene of scenes.split(" ").filter(Boolean)) {
    if (!(await waitForRest(main))) return;
    const importing = sharedRuntime()?.call("prepare", { scene }, URGENCY);
    await importing?.catch(() => {}); // reported when a figure needs it
  }
}

/** @returns False where the page has been turned meanwhile. */
async function waitForRest(main: HTMLElement | null): Promise<boolean> {
  while (main?.isConnected && !isAtRest()) await new Promise((done) => setTimeout(done, REST_MS));
  return main?.isConnected ?? false;
}

function isAtRest() {
  const shown = "simulation-figure:not(details:not([open]) *)";
  const figures = findAll(document, shown, HTMLElement);
  const live = figures.length > 0 && figures.every(({ dataset }) => dataset.state === "live");
  return live && performance.now() - lastInput > REST_MS;
}
