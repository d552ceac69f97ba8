/** Files that a figure makes of its results, and a photograph made anew. */

import { errorText } from "../errors.ts";
import type { SimulationFigure } from "../figure/element.ts";
import { decodePicture } from "../figure/photograph.ts";
import { download, findOptional } from "../page/dom.ts";
import { words } from "../page/words.ts";
import { Runtime } from "../runtime/runtime.ts";
import type { Instrument } from "./instrument.ts";
import { MOST_MEGAPIXELS } from "./reader.ts";

/** Make the file of a button of the row. */
export async function makeFile(
  button: HTMLButtonElement,
  figure: SimulationFigure,
  instrument: Instrument | null,
) {
  const report = (text: string) => {
    const line =
      button.parentElement && findOptional(button.parentElement, "[aria-live]", HTMLElement);
    if (line) line.textContent = text;
  };
  try {
    const { export: name, file = "" } = button.dataset;
    if (name !== undefined) await saveText(figure, name, file);
    else await saveDeveloped(figure, instrument, report);
    report(words("instrument.saved", { file: file || developedName(instrument) }));
  } catch (error) {
    report(words("instrument.broke_off", { reason: errorText(error) }));
  }
  figure.addEventListener("painted", () => report(""), { once: true }); // it is of other results
}

async function saveText(figure: SimulationFigure, name: string, file: string) {
  if (!figure.live) throw new Error(words("figure.does_not_run"));
  const { runtime } = figure.live;
  const { text } = await runtime.call("export", { ...figure.live.request(), name });
  download(file, text);
}

/** In a separate interpreter, as a whole photograph takes much memory. */
async function saveDeveloped(
  figure: SimulationFigure,
  instrument: Instrument | null,
  report: (text: string) => void,
) {
  const chosen = instrument?.chosen;
  if (!figure.live || !instrument || !chosen) throw new Error(words("instrument.nothing_chosen"));
  report(words("instrument.making", { name: chosen.name }));
  const request = figure.live.request();
  const runtime = new Runtime(instrument.url, () => [request.scene]);
  try {
    await figure.live.pictures.sendTo(runtime, request.figure);
    const picture = await decodePicture(chosen, chosen.number, MOST_MEGAPIXELS);
    const { width, height } = picture;
    const { rasters } = await runtime.call("develop", { ...request, picture });
    const pixels = new ImageData(new Uint8ClampedArray(rasters[0]), width, height);
    download(developedName(instrument), await png(pixels));
  } finally {
    runtime.close();
  }
}

function developedName(instrument: Instrument | null) {
  return `${instrument?.chosen?.name.replace(/\.\w+$/, "") ?? ""}-corrected.png`;
}

async function png(pixels: ImageData) {
  const canvas = new OffscreenCanvas(pixels.width, pixels.height);
  canvas.getContext("2d")?.putImageData(pixels, 0, 0);
  return await canvas.convertToBlob({ type: "image/png" });
}
