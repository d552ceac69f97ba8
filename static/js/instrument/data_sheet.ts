/** The data sheet: results of all instruments of a page for the reader's camera. */

import { findAll, download, find } from "../page/dom.ts";
import { loadItem, saveItem } from "../page/storage.ts";
import { withUnit } from "../page/text.ts";
import { numeral } from "../page/words.ts";
import type { Readout } from "../runtime/messages.ts";
import type { Instrument } from "./instrument.ts";

/** One instrument's results. */
interface Part {
  scene: string;
  title: string;
  photographs: string[];
  settings: Record<string, unknown>;
  lines: Readout[];
}

const CAMERA = "instrument-camera";
/** Instruments whose file another one measures with: the lens, and the tone curve. */
const INPUTS = [
  { from: "calibration", file: "camera-and-poses", to: "single-view" },
  { from: "photon-transfer", file: "sensor", to: "slanted-edge" },
];
/** Lines after the main one with the conditions of the measurement. */
const CONDITIONS = 3;
/** Letters of a value; what is longer is a sentence on why there is none. */
const LONGEST = 30;
/** Milliseconds for which a figure rests before its results are requested. */
const PAUSE = 250;

let timer = 0;

export class DataSheet {
  readonly name: HTMLInputElement;

  constructor(
    readonly box: HTMLElement,
    readonly instruments: Instrument[],
  ) {
    this.name = find(box, ".data-sheet-name", HTMLInputElement);
    this.name.value ||= loadItem(CAMERA) ?? "";
    this.name.onchange = () => saveItem(CAMERA, this.name.value || null);
  }

  /** Show the present results, once the figures rest. */
  refresh() {
    clearTimeout(timer);
    const request = setTimeout(async () => {
      const parts = await this.#parts();
      if (request === timer) this.#show(parts); // else later ones are under way
    }, PAUSE);
    timer = request;
  }

  press({ classList }: HTMLButtonElement) {
    if (classList.contains("data-sheet-print")) this.#print();
    else this.#save();
  }

  async #parts(): Promise<Part[]> {
    const used = this.instruments.filter(({ isUsed }) => isUsed);
    for (const { from, file, to } of INPUTS) {
      const user = used.find(({ scene }) => scene === to);
      if (user)
        user.measureWith(
          await exportedText(
            file,
            used.find(({ scene }) => scene === from),
          ),
        );
    }
    return (await Promise.all(used.map(measuredPart))).filter((part) => part !== null);
  }

  #show(parts: Part[]) {
    const { content } = find(this.box, "template", HTMLTemplateElement);
    const shown = find(this.box, ".data-sheet-parts", HTMLElement);
    const isOpen = findAll(shown, "details", HTMLDetailsElement).map(({ open }) => open);
    shown.replaceChildren(
      ...parts.map((part, at) => sectionOf(content, part, isOpen[at] ?? false)),
    );
    find(this.box, ".data-sheet-empty", HTMLElement).hidden = parts.length > 0;
    find(this.box, ".data-sheet-tools", HTMLElement).hidden = parts.length === 0;
    find(this.box, "time", HTMLTimeElement).textContent = new Date().toLocaleDateString();
  }

  /** Nothing of the page but the sheet. */
  #print() {
    for (const fold of findAll(this.box, "details", HTMLDetailsElement)) fold.open = true;
    document.body.classList.add("printing-sheet");
    addEventListener("afterprint", () => document.body.classList.remove("printing-sheet"), {
      once: true,
    });
    print();
  }

  async #save() {
    const [camera, measured] = [this.name.value, new Date().toISOString()];
    const sheet = { camera, measured, instruments: await this.#parts() };
    download("camera.json", `${JSON.stringify(sheet, null, 2)}\n`, "application/json");
  }
}

/** The result of an instrument, JSON; "" for none. */
async function exportedText(name: string, instrument: Instrument | undefined): Promise<string> {
  const live = instrument?.figure.live;
  const request = live && { ...live.request(), name };
  const made = request && (await live.runtime.call("export", request).catch(() => null));
  return made?.text ?? "";
}

/** The results of one instrument; null where it has none. */
async function measuredPart(instrument: Instrument): Promise<Part | null> {
  const { scene } = instrument;
  const { live } = instrument.figure;
  if (!live) return null;
  const request = live.request();
  const none = { lines: [], measured: null };
  const { lines, measured } = await live.runtime.call("sheet", request).catch(() => none);
  if (lines.length === 0) return null;
  const photographs = instrument.names(measured);
  const settings = JSON.parse(request.values);
  return { scene, title: live.schema.title, photographs, settings, lines };
}

/** The section of an instrument, copied from the template's. */
function sectionOf(
  content: DocumentFragment,
  { title, photographs, lines }: Part,
  isOpen: boolean,
) {
  const section = content.cloneNode(true) as DocumentFragment;
  const [main, ...others] = lines;
  const ends = [...new Set([photographs[0], photographs.at(-1)])].join(" … ");
  const parts = ["h3", ".data-sheet-number", ".data-sheet-what", ".data-sheet-files"];
  const value = valueText(main);
  const measured = value.length > LONGEST ? ["–", `${main.label}: ${value}`] : [value, main.label];
  for (const [at, text] of [title, ...measured, ends].entries()) {
    find(section, parts[at], HTMLElement).textContent = text;
  }
  const [conditions, rest] = findAll(section, "table", HTMLTableElement);
  for (const [at, line] of others.entries()) {
    const row = (at < CONDITIONS ? conditions : rest).insertRow();
    const what = document.createElement("th");
    [what.scope, what.textContent] = ["row", line.label];
    row.append(what);
    row.insertCell().textContent = valueText(line);
  }
  const fold = find(section, "details", HTMLDetailsElement);
  [fold.open, fold.hidden] = [isOpen, rest.rows.length === 0];
  return section;
}

function valueText({ text, unit }: Readout) {
  return withUnit(numeral(text), unit);
}
