/**
 * Links in the text that set a figure. Its sliders glide there, so that the eye can follow; a press on
 * the figure, or Escape, stops them where they are.
 */

import { isSlider } from "../../../simulations/engine/controls/slider/kind.ts";
import { findAll, element, findOptional, find } from "../page/dom.ts";
import { words } from "../page/words.ts";
import { moveControls, readValues, unfoldControls, type Value } from "./controls.ts";
import { leaderOf, withParts } from "./parts.ts";
import { record, settingsOf } from "./permalink.ts";

/** Milliseconds that sliders take to where they are sent. */
const GLIDE_MS = 700;
/** Share of the panels that must be in view for a move to be seen. */
const IN_VIEW = 0.6;

/** The link that a figure follows: a later one supersedes it. */
const followed: WeakMap<HTMLElement, Element> = new WeakMap();
/** What ends the motion of a figure. */
const moving: WeakMap<HTMLElement, () => void> = new WeakMap();

/** Whether the reader prefers less motion. */
export function prefersReducedMotion() {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}

/** Set a figure to the values of a link in the text. */
export async function followLink(link: HTMLAnchorElement) {
  const shown = figureOf(link);
  if (!shown) return;
  const figure = leaderOf(shown);
  const values = valuesOfLink(link, figure);
  const { form, controls } = settingsOf(figure);
  const before = readValues(form, controls);
  const changed = Object.keys(values).filter((name) => values[name] !== before[name]);
  followed.set(figure, link);
  unfoldControls(form, changed);
  recordJump(figure, values);
  await bringIntoView(find(shown, ".panels", HTMLElement));
  offerReturn(link);
  if (followed.get(figure) === link) glideTo(figure, values);
}

/** The figure that a link names, which may be a part. */
function figureOf({ dataset }: HTMLElement) {
  const place = document.getElementById(dataset.figure ?? "");
  return place && find(place, "simulation-figure", HTMLElement);
}

/**
 * The values that a link sets. A link of a prediction or of its answer sets every control: to the
 * page's start, to the values of earlier links of the same prediction, and to its own. So
 * the claim holds whatever was tried before.
 */
function valuesOfLink(link: HTMLAnchorElement, figure: HTMLElement): Record<string, Value> {
  const valuesOf = ({ dataset }: HTMLElement) => JSON.parse(dataset.values ?? "{}");
  const prediction = predictionOf(link);
  if (!prediction) return valuesOf(link);
  const links = findAll(document, "a.set", HTMLAnchorElement).filter((other) => {
    const named = predictionOf(other) === prediction && figureOf(other);
    return named && leaderOf(named) === figure;
  });
  const upToHere = links.slice(0, links.indexOf(link) + 1);
  return Object.assign({ ...settingsOf(figure).start }, ...upToHere.map(valuesOf));
}

/** Id of the prediction whose question or answer holds a link, if one does. */
function predictionOf(link: HTMLElement) {
  const place = link.closest("[data-predict], [data-answers]");
  return place?.getAttribute("data-predict") ?? place?.getAttribute("data-answers");
}

/** Keep in the history what the figure shows, and after it where it is going. */
export function recordJump(figure: HTMLElement, values: Record<string, Value>) {
  moving.get(figure)?.();
  record(figure, "replace");
  record(figure, "push", values);
  figure.dataset.moving = "";
}

/** Move the controls of a figure to `values`; what is left out stays. */
export function glideTo(figure: HTMLElement, values: Record<string, Value>) {
  const { form, controls } = settingsOf(figure);
  const sliders = controls.filter((control) => isSlider(control) && control.name in values);
  const others = controls.filter((control) => !sliders.includes(control));
  moveControls(form, others, values, "change");
  const from = readValues(form, sliders);
  const there = sliders.every(({ name }) => from[name] === values[name]);
  if (there || prefersReducedMotion() || figure.dataset.state !== "live") {
    moveControls(form, sliders, values, "change");
    delete figure.dataset.moving;
    return;
  }
  const listeners = new AbortController();
  const { signal } = listeners;
  const quit = () => {
    stop();
    listeners.abort();
    moving.delete(figure);
    delete figure.dataset.moving;
  };
  const end = () => {
    quit();
    moveControls(form, sliders, readValues(form, sliders), "change");
    record(figure, "replace");
  };
  const stop = animateShare(GLIDE_MS, (share) => {
    if (!figure.isConnected) {
      quit();
      return;
    }
    const eased = share * share * (3 - 2 * share);
    const now = sliders.map(({ name }) => {
      const [start, last] = [Number(from[name]), Number(values[name])];
      return [name, share < 1 ? start + eased * (last - start) : last];
    });
    moveControls(form, sliders, Object.fromEntries(now), "input");
    if (share === 1) end();
  });
  for (const type of ["pointerdown", "keydown"]) {
    for (const each of withParts(figure)) each.addEventListener(type, end, { signal });
  }
  document.addEventListener("keydown", ({ key }) => key === "Escape" && end(), { signal });
  // Another state of the page is requested, so the end of this move is not recorded.
  addEventListener("popstate", quit, { signal });
  moving.set(figure, end);
}

/** Call `draw` with the share of the time gone by, last with 1; what is returned ends it. */
export function animateShare(ms: number, draw: (share: number, now: number) => void): () => void {
  let begun = 0;
  const tick = (now: number) => {
    begun ||= now;
    const share = Math.min((now - begun) / ms, 1);
    if (share < 1) request = requestAnimationFrame(tick);
    draw(share, now);
  };
  let request = requestAnimationFrame(tick);
  return () => cancelAnimationFrame(request);
}

/** @returns Once they stand still. */
function bringIntoView(panels: HTMLElement): Promise<unknown> {
  const { top, bottom, height } = panels.getBoundingClientRect();
  const seen = Math.min(bottom, innerHeight) - Math.max(top, 0);
  if (seen >= IN_VIEW * Math.min(height, innerHeight)) return Promise.resolve();
  const calm = prefersReducedMotion();
  const arrived = calm ? Promise.resolve() : scrolled();
  const block = height < innerHeight ? "nearest" : "start";
  panels.scrollIntoView({ behavior: calm ? "instant" : "smooth", block });
  return arrived;
}

/** Longest wait for the page to be scrolled, in milliseconds. */
const LONGEST_SCROLL_MS = 1000;

/** @returns Once a scroll that begins now has ended, or after `limit` milliseconds. */
export function scrolled(limit = LONGEST_SCROLL_MS): Promise<unknown> {
  return new Promise((resolve) => {
    document.addEventListener("scrollend", resolve, { once: true });
    setTimeout(resolve, limit);
  });
}

/** Offer the way back to a link, if the page has been scrolled away from it, until it is seen again. */
export function offerReturn(link: HTMLElement) {
  findOptional(document, ".way-back", HTMLElement)?.remove();
  const { top, bottom } = link.getBoundingClientRect();
  if (bottom > 0 && top < innerHeight) return;
  const question = link.closest("[data-quiz], [data-predict], [data-answers]");
  const text = words(question ? "way_back.question" : "way_back.text");
  const button = element("button", "way-back screen", text);
  button.type = "button";
  button.addEventListener("click", () => {
    link.scrollIntoView({ block: "center" });
    link.focus({ preventScroll: true });
  });
  find(document, "main", HTMLElement).append(button);
  const seen = new IntersectionObserver(([entry]) => {
    if (!entry?.isIntersecting) return;
    seen.disconnect();
    button.remove();
  });
  seen.observe(link);
}
