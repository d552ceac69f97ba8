/**
 * Frames into the page. The first live frame takes the still's place in the same box, so
 * nothing moves.
 *
 * @typedef {{name: string, title: string, width: number, height: number, overlay: string,
 *   raster: {width: number, height: number} | null, pixelated: boolean}} Panel
 * @typedef {{name: string, label: string, text: string, unit: string, role: string}} Readout
 * @typedef {{panels: Panel[], readouts: Readout[], description: string}} Meta
 */

import { setText } from "./text.js";

/** @param {HTMLElement} figure @param {Meta} meta @param {ArrayBuffer[]} rasters */
export function paint(figure, meta, rasters) {
  let next = 0;
  for (const panel of meta.panels) {
    const box = figure.querySelector(`.panel[data-panel="${CSS.escape(panel.name)}"]`);
    if (!box) throw new Error(`the page has no panel "${panel.name}"`);
    if (panel.raster) paintRaster(box.querySelector(".panel-view"), panel, rasters[next++]);
    paintOverlay(box.querySelector("svg.overlay"), panel);
    setText(box.querySelector(".panel-title"), panel.title);
  }
  for (const readout of meta.readouts) paintReadout(figure, readout);
}

/** @param {Element} view @param {Panel} panel @param {ArrayBuffer} pixels */
function paintRaster(view, panel, pixels) {
  const { width, height } = panel.raster;
  const image = new ImageData(new Uint8ClampedArray(pixels), width, height);
  const canvas = view.querySelector("canvas.live") ?? document.createElement("canvas");
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  canvas.getContext("2d").putImageData(image, 0, 0);
  canvas.classList.toggle("pixelated", panel.pixelated);
  if (!canvas.isConnected) putInPlace(view, canvas);
}

/** @param {Element} view @param {HTMLCanvasElement} canvas */
function putInPlace(view, canvas) {
  canvas.classList.add("live");
  const still = view.querySelector("img.still");
  if (still) still.replaceWith(canvas);
  else view.prepend(canvas);
}

/** @param {Element | null} svg @param {Panel} panel */
function paintOverlay(svg, panel) {
  if (svg) svg.innerHTML = panel.overlay;
}

/** @param {HTMLElement} figure @param {Readout} readout */
function paintReadout(figure, readout) {
  const output = figure.querySelector(`output[name="${CSS.escape(readout.name)}"]`);
  const box = output?.parentElement;
  if (!box) return;
  setText(output, readout.text);
  const unit = box.querySelector(".unit");
  setText(unit, readout.unit);
  unit?.classList.toggle("close", readout.unit === "°");
  const classes = readout.role ? `readout role-${readout.role}` : "readout";
  if (box.className !== classes) box.className = classes;
}
