/** Opens the Python of figures: what does it is fetched when it is first needed. */

import { message } from "../errors.js";
import { SimulationFigure } from "../figure/element.js";
import * as figures from "../figure/feature.js";
import { say } from "../figure/status.js";
import { within } from "../page/dom.js";
import { offerRelease } from "../page/release.js";
import { recall } from "../page/storage.js";
import { words } from "../page/words.js";
import { sharedRuntime } from "../runtime/runtime.js";

/** @import { Workshop } from "./workshop.js" */

/** Where the reader opened the figure's Python, now or before. @type {WeakMap<SimulationFigure, Promise<Workshop>>} */
const workshops = new WeakMap();

/** Called once. */
export function install() {
  document.addEventListener("click", (event) => {
    const button = within(event, ".open-python", HTMLButtonElement);
    const figure = button?.closest("simulation-figure");
    if (figure instanceof SimulationFigure) open(figure);
  });
  document.addEventListener("figure-start", ({ target }) => {
    if (target instanceof SimulationFigure && recall(keyOf(target))?.runs) resume(target);
  });
  figures.install();
}

export const { arrive, returned } = figures;

/** @param {SimulationFigure} figure */
async function open(figure) {
  try {
    await (await workshopOf(figure)).toggle();
  } catch (error) {
    workshops.delete(figure);
    say(figure, words("figure.no_python", { reason: message(error) }));
    offerRelease();
  }
}

/**
 * Have the reader's own version of the figure's Python draw, as it did when the page was left.
 *
 * @param {SimulationFigure} figure
 */
async function resume(figure) {
  try {
    await (await workshopOf(figure)).resume();
  } catch {
    workshops.delete(figure); // the figure shows what the book's code draws
  }
}

/**
 * @param {SimulationFigure} figure
 * @returns {Promise<Workshop>}
 */
function workshopOf(figure) {
  const found = workshops.get(figure);
  if (found) return found;
  const made = create(figure);
  workshops.set(figure, made);
  const leave = () => {
    workshops.delete(figure);
    made.then((workshop) => workshop.leave()).catch(() => {}); // it was never there
  };
  figure.addEventListener("figure-leave", leave, { once: true });
  return made;
}

/**
 * @param {SimulationFigure} figure
 * @returns {Promise<Workshop>}
 */
async function create(figure) {
  const { Workshop } = await import("./workshop.js");
  const runtime = sharedRuntime();
  if (!runtime) throw new Error(words("figure.does_not_run"));
  return new Workshop(figure, figure.live, runtime, keyOf(figure));
}

/**
 * Key of a reader's version of a figure's Python in the browser's storage.
 *
 * @param {SimulationFigure} figure
 */
function keyOf(figure) {
  const root = new URL(document.body.dataset.root || "./", location.href).pathname;
  const page = location.pathname.slice(root.length).replace(/index\.html$/, "");
  return `python:${page}#${figure.closest("figure")?.id ?? ""}`;
}
