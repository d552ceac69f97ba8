/** Instruments; their scripts are fetched when the first photograph comes in. */

import { SimulationFigure } from "../figure/element.ts";
import { findAll, findOptional, find, closestTo } from "../page/dom.ts";
import { loadItem } from "../page/storage.ts";
import type { DataSheet } from "./data_sheet.ts";
import type { Instrument } from "./instrument.ts";

/** Instruments by the figure that has photographs, or had. */
const instruments: WeakMap<SimulationFigure, Promise<Instrument>> = new WeakMap();

/** Called once. */
export function install() {
  document.addEventListener("click", handleClick);
  document.addEventListener("change", handleChange);
  document.addEventListener("dragover", (event) => {
    if (boxOf(event)) event.preventDefault(); // so that it can be dropped
  });
  document.addEventListener("drop", (event) => {
    const box = boxOf(event);
    const files = event.dataTransfer?.files;
    if (!box || !files?.length) return;
    event.preventDefault();
    add(box, files);
  });
  document.addEventListener("painted", refreshSheet, true);
  addEventListener("beforeunload", (event) => {
    if (findOptional(document, "[data-unsaved]", HTMLElement)) event.preventDefault(); // needs a confirmation
  });
}

/** Called for each page. */
export function setUpPage() {
  for (const box of findAll(document, ".intake", HTMLElement)) {
    const scene = figureOf(box)?.dataset.simulation ?? "";
    if (loadItem(`instrument:${scene}`))
      instrumentOf(box).then((instrument) => instrument.restore());
  }
}

function boxOf(event: Event) {
  return closestTo(event, ".intake", HTMLElement);
}

function figureOf(inside: HTMLElement) {
  const figure = inside.closest("figure")?.querySelector("simulation-figure");
  return figure instanceof SimulationFigure ? figure : null;
}

async function handleClick(event: MouseEvent) {
  const button = closestTo(event, "button", HTMLButtonElement);
  if (!button) return;
  const box = boxOf(event);
  if (box) await runButton(box, button);
  else if (button.matches(".made-files button")) await makeFile(button);
  else if (button.matches(".data-sheet button")) (await dataSheet())?.press(button);
}

async function runButton(box: HTMLElement, { classList }: HTMLButtonElement) {
  if (classList.contains("intake-choose")) {
    findOptional(box, "input[type=file]", HTMLElement)?.click();
    return;
  }
  const instrument = await instrumentOf(box);
  if (/intake-(try|clear)/.test(classList.value)) find(box, ".intake-choose", HTMLElement).focus();
  if (classList.contains("intake-try")) await instrument.addSamples();
  if (classList.contains("intake-stop")) instrument.stop();
  if (classList.contains("intake-go-on")) await instrument.work();
  if (classList.contains("intake-clear")) instrument.remove(instrument.photos);
}

async function handleChange(event: Event) {
  const [box, input] = [boxOf(event), closestTo(event, "input", HTMLInputElement)];
  if (!box || !input) return;
  if (input.type === "checkbox") {
    await (await instrumentOf(box)).setKeeping(input.checked);
  } else if (input.files) {
    const files = [...input.files];
    input.value = ""; // the same file may be chosen again
    await add(box, files);
  }
}

async function add(box: HTMLElement, files: Iterable<File>) {
  const list = [...files]; // before the browser takes them away
  await (await instrumentOf(box)).add(list);
}

async function makeFile(button: HTMLButtonElement) {
  const figure = figureOf(button);
  if (!figure) return;
  const { makeFile } = await import("./files.ts");
  await makeFile(button, figure, (await instruments.get(figure)) ?? null);
}

async function instrumentOf(box: HTMLElement): Promise<Instrument> {
  const figure = figureOf(box);
  if (!figure) throw new Error("an intake without a figure");
  const made = () =>
    import("./instrument.ts").then(({ Instrument }) => new Instrument(figure, box));
  const found = instruments.get(figure) ?? made();
  instruments.set(figure, found);
  return found;
}

async function dataSheet(): Promise<DataSheet | null> {
  const box = findOptional(document, ".data-sheet", HTMLElement);
  if (!box) return null;
  const { DataSheet } = await import("./data_sheet.ts");
  const figures = findAll(document, "simulation-figure", SimulationFigure);
  const used = await Promise.all(figures.map((figure) => instruments.get(figure)));
  return new DataSheet(
    box,
    used.filter((one) => one !== undefined && "sheet" in one.box.dataset) as Instrument[],
  );
}

/** A figure with photographs has changed. */
async function refreshSheet({ target }: Event) {
  if (target instanceof SimulationFigure && instruments.has(target)) (await dataSheet())?.refresh();
}
