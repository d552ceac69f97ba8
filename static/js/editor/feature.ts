/** Opens the Python of figures; the editor is fetched when it is first needed. */

import { errorText } from "../errors.ts";
import { glideTo, recordJump } from "../figure/animate.ts";
import { SimulationFigure } from "../figure/element.ts";
import * as figures from "../figure/feature.ts";
import { showMessage } from "../figure/status.ts";
import { closestTo } from "../page/dom.ts";
import { offerRelease } from "../page/release.ts";
import { loadItem } from "../page/storage.ts";
import { words } from "../page/words.ts";
import { sharedRuntime } from "../runtime/runtime.ts";
import type { Workshop } from "./workshop.ts";

/** Where the reader opened the figure's Python, now or before. */
const workshops: WeakMap<SimulationFigure, Promise<Workshop>> = new WeakMap();

/** Called once. */
export function install() {
  document.addEventListener("click", (event) => {
    const button = closestTo(event, ".open-python", HTMLButtonElement);
    const figure = button?.closest("simulation-figure");
    if (figure instanceof SimulationFigure) open(figure);
  });
  document.addEventListener("figure-start", ({ target }) => {
    if (target instanceof SimulationFigure && loadItem(editsKey(target))?.runs) resume(target);
  });
  figures.install();
}

export const { setUpPage, followAddress } = figures;

/**
 * Draw a figure of the page with a text in place of one of the book's definitions.
 *
 * @param id Element id of the figure.
 * @param key Of the definition.
 * @param values To which the controls are set.
 */
export async function drawFigureWith(
  id: string,
  key: string,
  text: string,
  values: Record<string, string>,
) {
  const figure = document.getElementById(id)?.querySelector("simulation-figure");
  if (!(figure instanceof SimulationFigure)) throw new Error(words("question.no_figure"));
  figure.scrollIntoView({ block: "center" });
  recordJump(figure, values);
  glideTo(figure, values);
  await (await workshopOf(figure)).runWith(key, text);
}

async function open(figure: SimulationFigure) {
  try {
    await (await workshopOf(figure)).toggle();
  } catch (error) {
    workshops.delete(figure);
    showMessage(figure, words("figure.no_python", { reason: errorText(error) }));
    offerRelease();
  }
}

/** Draw by the reader's edits again, as when the page was left. */
async function resume(figure: SimulationFigure) {
  try {
    await (await workshopOf(figure)).resume();
  } catch {
    workshops.delete(figure); // the figure shows what the book's code draws
  }
}

function workshopOf(figure: SimulationFigure): Promise<Workshop> {
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

async function create(figure: SimulationFigure): Promise<Workshop> {
  const { Workshop } = await import("./workshop.ts");
  const runtime = sharedRuntime();
  if (!runtime) throw new Error(words("figure.does_not_run"));
  return new Workshop(figure, figure.live, runtime, editsKey(figure));
}

/** Key of a reader's version of a figure's Python in the browser's storage. */
function editsKey(figure: SimulationFigure) {
  const root = new URL(document.body.dataset.root || "./", location.href).pathname;
  const page = location.pathname.slice(root.length).replace(/index\.html$/, "");
  return `python:${page}#${figure.closest("figure")?.id ?? ""}`;
}
