/**
 * Frames into the page. The first live frame takes the place of the initial frame in the same box, so
 * nothing moves. Only what differs from the frame before is written.
 */

import { findAll, findOptional, find } from "../page/dom.ts";
import { setText } from "../page/text.ts";
import { numeral, words } from "../page/words.ts";
import type { Readout } from "../runtime/messages.ts";
import { Overlay } from "./overlay.ts";

interface Panel {
  name: string;
  title: string;
  width: number;
  height: number;
  overlay: string;
  raster: { width: number; height: number } | null;
  pixelated: boolean;
}

export interface FrameMeta {
  panels: Panel[];
  readouts: Readout[];
  description: string;
  handles: import("./handles.ts").Place[];
}

type PanelElements = { view: HTMLElement; overlay: Overlay | null; title: Element | null };

export class Painter {
  /** By the panel's name, which several figures may show. */
  #boxes: Map<string, PanelElements[]> = new Map();
  /** Each readout as it was written last. */
  #written: Map<string, string> = new Map();

  /** @param figures A figure and its parts, each with some of the panels. */
  constructor(readonly figures: HTMLElement[]) {}

  /** @param rasters The pixels of the panels that have any, in their order. */
  paint(meta: FrameMeta, rasters: ArrayBuffer[]) {
    const pixels = rasters.values();
    for (const panel of meta.panels) {
      const raster = panel.raster && pixels.next().value;
      for (const { view, overlay, title } of this.#boxesOf(panel.name)) {
        fitPanel(view, panel);
        if (panel.raster) paintRaster(view, panel, panel.raster, raster);
        overlay?.show(panel.overlay);
        setText(title, panel.title);
      }
    }
    for (const readout of meta.readouts) this.#write(readout);
  }

  #boxesOf(name: string) {
    let boxes = this.#boxes.get(name);
    if (!boxes) {
      boxes = panelsOf(this.figures, name).map((panel) => {
        const view = find(panel, ".panel-view", HTMLElement);
        const svg = view.querySelector("svg.overlay");
        return {
          view,
          overlay: svg && new Overlay(svg),
          title: panel.querySelector(".panel-title"),
        };
      });
      this.#boxes.set(name, boxes);
    }
    return boxes;
  }

  #write(readout: Readout) {
    const now = `${readout.text}|${readout.unit}|${readout.role}`;
    if (this.#written.get(readout.name) === now) return;
    this.#written.set(readout.name, now);
    for (const figure of this.figures) paintReadout(figure, readout);
  }
}

/** The panels of that name that figures show. */
export function panelsOf(figures: HTMLElement[], name: string) {
  const selector = `.panel[data-panel="${CSS.escape(name)}"]`;
  return figures.flatMap((figure) => findAll(figure, selector, HTMLElement));
}

/** Give a panel the shape of its content: photographs of the reader have different ones. */
function fitPanel(view: HTMLElement, { width, height }: Panel) {
  const svg = findOptional(view, "svg.overlay", SVGSVGElement);
  const box = svg?.viewBox.baseVal;
  if (!svg || (box?.width === width && box.height === height)) return;
  svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  const [panel, body] = [view.parentElement, view.closest<HTMLElement>(".figure-body")];
  panel?.style.setProperty("--ratio", `${width} / ${height}`);
  panel?.style.setProperty("--units", `${width}`);
  const isFirst = body?.querySelector(".panel") === panel;
  if (isFirst) body?.style.setProperty("--first", `${width} / ${height}`);
}

function paintRaster(
  view: HTMLElement,
  panel: Panel,
  { width, height }: { width: number; height: number },
  pixels: ArrayBuffer | null | undefined,
) {
  if (!pixels) throw new Error(words("figure.no_pixels", { panel: panel.name }));
  const image = new ImageData(new Uint8ClampedArray(pixels), width, height); // a view, no copy
  const canvas =
    findOptional(view, "canvas.live", HTMLCanvasElement) ?? document.createElement("canvas");
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  canvas.getContext("2d")?.putImageData(image, 0, 0);
  canvas.classList.toggle("pixelated", panel.pixelated);
  if (!canvas.isConnected) insertCanvas(view, canvas);
}

/**
 * Put the pixels of a figure's initial frame on canvases, as its first live frame.
 */
export function adoptInitialFrames(figure: HTMLElement) {
  for (const initial of findAll(figure, "img.still", HTMLImageElement)) {
    const take = () => {
      if (!initial.parentElement || !initial.naturalWidth) return;
      const canvas = document.createElement("canvas");
      [canvas.width, canvas.height] = [initial.naturalWidth, initial.naturalHeight];
      canvas.getContext("2d")?.drawImage(initial, 0, 0);
      canvas.classList.toggle("pixelated", initial.classList.contains("pixelated"));
      insertCanvas(initial.parentElement, canvas);
    };
    if (initial.complete) take();
    else initial.addEventListener("load", take, { once: true });
  }
}

function insertCanvas(view: HTMLElement, canvas: HTMLCanvasElement) {
  canvas.classList.add("live");
  const title = view.closest(".panel")?.querySelector(".panel-title");
  const initial = findOptional(view, "img.still", HTMLImageElement);
  canvas.role = "img";
  if (title) canvas.setAttribute("aria-labelledby", title.id);
  else canvas.setAttribute("aria-label", initial?.alt ?? "");
  if (initial) initial.replaceWith(canvas);
  else view.prepend(canvas);
}

function paintReadout(figure: HTMLElement, readout: Readout) {
  const output = figure.querySelector(`output[name="${CSS.escape(readout.name)}"]`);
  const box = output?.parentElement;
  if (!box) return;
  const text = numeral(readout.text);
  if (output.textContent !== text) box.dataset.moved = "";
  setText(output, text);
  const unit = box.querySelector(".unit");
  setText(unit, readout.unit);
  unit?.classList.toggle("close", readout.unit === "°");
  const classes = readout.role ? `readout role-${readout.role}` : "readout";
  if (box.className !== classes) box.className = classes;
}
