/**
 * Words in the text that set a figure. Its sliders glide there, so that the eye can follow; a hand
 * on the figure, or Escape, stops them where they are.
 */

import { all, one } from "../page/dom.js";
import { moveControls, readValues, uncover } from "./controls.js";
import { record, settingsOf } from "./permalink.js";

/** @import { Value } from "./controls.js" */

/** Milliseconds that sliders take to where they are sent. */
const GLIDE = 700;
/** Longest wait for the page to be scrolled to a figure, in milliseconds. */
const SCROLL = 1000;
/** Share of the panels that must be in view for a move to be seen. */
const IN_VIEW = 0.6;

/**
 * The link that a figure follows: a later one makes an earlier one void.
 *
 * @type {WeakMap<HTMLElement, HTMLAnchorElement>}
 */
const followed = new WeakMap();
/**
 * What ends the motion of a figure.
 *
 * @type {WeakMap<HTMLElement, () => void>}
 */
const moving = new WeakMap();

/**
 * Do what a link of the text says.
 *
 * @param {HTMLAnchorElement} link
 */
export async function follow(link) {
  const place = document.getElementById(link.dataset.figure ?? "");
  const figure = place && one(place, "simulation-figure", HTMLElement);
  if (!figure) return;
  const values = destination(link, figure);
  const { form, controls } = settingsOf(figure);
  const shown = readValues(form, controls);
  followed.set(figure, link);
  uncover(
    form,
    Object.keys(values).filter((name) => values[name] !== shown[name]),
  );
  jump(figure, values);
  await bringIntoView(one(figure, ".panels", HTMLElement));
  if (followed.get(figure) === link) glide(figure, values);
}

/**
 * The values that a link sets. A link of a prediction or of its answer sets every control: to the
 * page's start, to what earlier links of the same prediction say, and to what it says itself. So
 * the claim holds whatever was tried before.
 *
 * @param {HTMLAnchorElement} link
 * @param {HTMLElement} figure
 * @returns {Record<string, Value>}
 */
function destination(link, figure) {
  const prediction = predictionOf(link);
  if (!prediction) return valuesOf(link);
  const links = all(document, "a.set", HTMLAnchorElement).filter(
    (other) => other.dataset.figure === link.dataset.figure && predictionOf(other) === prediction,
  );
  const upToHere = links.slice(0, links.indexOf(link) + 1);
  return Object.assign({ ...settingsOf(figure).start }, ...upToHere.map(valuesOf));
}

/**
 * @param {HTMLAnchorElement} link
 * @returns {Record<string, Value>}
 */
function valuesOf(link) {
  return JSON.parse(link.dataset.values ?? "{}");
}

/**
 * Id of the prediction whose question or answer holds a link, if one does.
 *
 * @param {HTMLElement} link
 */
function predictionOf(link) {
  const place = link.closest("[data-predict], [data-answers]");
  return place instanceof HTMLElement
    ? (place.dataset.predict ?? place.dataset.answers)
    : undefined;
}

/**
 * Keep in the history what the figure shows, and after it where it is going.
 *
 * @param {HTMLElement} figure
 * @param {Record<string, Value>} values
 */
export function jump(figure, values) {
  moving.get(figure)?.();
  record(figure, "replace");
  record(figure, "push", values);
  figure.dataset.moving = "";
}

/**
 * Move the controls of a figure to `values`.
 *
 * @param {HTMLElement} figure
 * @param {Record<string, Value>} values What is left out stays.
 */
export function glide(figure, values) {
  const { form, controls } = settingsOf(figure);
  const sliders = controls.filter(({ kind, name }) => kind === "slider" && name in values);
  const others = controls.filter((control) => !sliders.includes(control));
  moveControls(form, others, values, "change");
  const from = readValues(form, sliders);
  const there = sliders.every(({ name }) => from[name] === values[name]);
  if (there || isCalm() || figure.dataset.state !== "live") {
    moveControls(form, sliders, values, "change");
    delete figure.dataset.moving;
    return;
  }
  const stop = everyFrame(GLIDE, (share) => {
    if (!figure.isConnected) {
      quit();
      return;
    }
    const eased = share * share * (3 - 2 * share);
    const now = Object.fromEntries(
      sliders.map(({ name }) => {
        const [start, end] = [Number(from[name]), Number(values[name])];
        return [name, share < 1 ? start + eased * (end - start) : end];
      }),
    );
    moveControls(form, sliders, now, "input");
    if (share === 1) end();
  });
  const quit = () => {
    stop();
    hands.abort();
    moving.delete(figure);
    delete figure.dataset.moving;
  };
  const end = () => {
    quit();
    moveControls(form, sliders, readValues(form, sliders), "change");
    record(figure, "replace");
  };
  const hands = stopByHand(figure, end);
  // Another state of the page is asked for: what the move would leave behind is not to be kept.
  addEventListener("popstate", quit, { signal: hands.signal });
  moving.set(figure, end);
}

/**
 * Call `draw` with the share of the time that has gone by, the last time with 1.
 *
 * @param {number} ms
 * @param {(share: number) => void} draw
 * @returns {() => void} Ends it.
 */
function everyFrame(ms, draw) {
  let begun = 0;
  const tick = (/** @type {number} */ now) => {
    begun ||= now;
    const share = Math.min((now - begun) / ms, 1);
    if (share < 1) request = requestAnimationFrame(tick);
    draw(share);
  };
  let request = requestAnimationFrame(tick);
  return () => cancelAnimationFrame(request);
}

/**
 * @param {HTMLElement} figure
 * @param {() => void} end
 */
function stopByHand(figure, end) {
  const hands = new AbortController();
  const { signal } = hands;
  for (const type of ["pointerdown", "keydown"]) figure.addEventListener(type, end, { signal });
  const onEscape = (/** @type {KeyboardEvent} */ event) => event.key === "Escape" && end();
  document.addEventListener("keydown", onEscape, { signal });
  return hands;
}

/**
 * @param {HTMLElement} panels
 * @returns {Promise<void>} Once they stand still.
 */
function bringIntoView(panels) {
  const { top, bottom, height } = panels.getBoundingClientRect();
  const seen = Math.min(bottom, innerHeight) - Math.max(top, 0);
  if (seen >= IN_VIEW * Math.min(height, innerHeight)) return Promise.resolve();
  const calm = isCalm();
  const block = height < innerHeight ? "nearest" : "start";
  const arrived = new Promise((resolve) => {
    document.addEventListener("scrollend", resolve, { once: true });
    setTimeout(resolve, calm ? 0 : SCROLL);
  });
  panels.scrollIntoView({ behavior: calm ? "instant" : "smooth", block });
  return arrived;
}

function isCalm() {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}
