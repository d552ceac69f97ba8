/**
 * Frames into the page. The first live frame takes the still's place in the same box, so
 * nothing moves.
 *
 * @typedef {{name: string, title: string, width: number, height: number, overlay: string,
 *   raster: {width: number, height: number} | null, pixelated: boolean}} Panel
 * @typedef {{name: string, label: string, text: string, unit: string, role: string}} Readout
 * @typedef {{panels: Panel[], readouts: Readout[], description: string, handles: import("./handles.js").Place[]}} Meta
 */

import { maybe, one } from "../page/dom.js";
import { setText } from "../page/text.js";
import { numeral, words } from "../page/words.js";

/**
 * @param {HTMLElement} figure
 * @param {Meta} meta
 * @param {ArrayBuffer[]} rasters The pixels of the panels that have any, in their order.
 */
export function paint(figure, meta, rasters) {
  const pixels = rasters.values();
  for (const panel of meta.panels) {
    const box = one(figure, `.panel[data-panel="${CSS.escape(panel.name)}"]`, HTMLElement);
    const view = one(box, ".panel-view", HTMLElement);
    if (panel.raster) paintRaster(view, panel, panel.raster, pixels.next().value);
    paintOverlay(view.querySelector("svg.overlay"), panel);
    setText(box.querySelector(".panel-title"), panel.title);
  }
  for (const readout of meta.readouts) paintReadout(figure, readout);
}

/**
 * @param {HTMLElement} view
 * @param {Panel} panel
 * @param {{width: number, height: number}} size
 * @param {ArrayBuffer | undefined} pixels
 */
function paintRaster(view, panel, { width, height }, pixels) {
  if (!pixels) throw new Error(words("figure.no_pixels", { panel: panel.name }));
  const image = new ImageData(new Uint8ClampedArray(pixels), width, height);
  const canvas = maybe(view, "canvas.live", HTMLCanvasElement) ?? document.createElement("canvas");
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  canvas.getContext("2d")?.putImageData(image, 0, 0);
  canvas.classList.toggle("pixelated", panel.pixelated);
  if (!canvas.isConnected) putInPlace(view, canvas);
}

/**
 * @param {HTMLElement} view
 * @param {HTMLCanvasElement} canvas
 */
function putInPlace(view, canvas) {
  canvas.classList.add("live");
  const still = view.querySelector("img.still");
  if (still) still.replaceWith(canvas);
  else view.prepend(canvas);
}

/**
 * @param {Element | null} svg
 * @param {Panel} panel
 */
function paintOverlay(svg, panel) {
  if (svg) svg.innerHTML = panel.overlay;
}

/**
 * @param {HTMLElement} figure
 * @param {Readout} readout
 */
function paintReadout(figure, readout) {
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
