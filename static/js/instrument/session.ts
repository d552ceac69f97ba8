/** The settings that kept photographs are measured with. */

import { isAddressed } from "../figure/address.ts";
import { moveControls, readValues } from "../figure/controls.ts";
import type { SimulationFigure } from "../figure/element.ts";
import { settingsOf } from "../figure/permalink.ts";
import { recall, remember } from "../page/storage.ts";
import { keyOf } from "./photo.ts";

export function keepSession(scene: string, figure: SimulationFigure) {
  const { form, controls } = settingsOf(figure);
  remember(keyOf(scene), readValues(form, controls));
}

export function forgetSession(scene: string) {
  remember(keyOf(scene), null);
}

/** Put a figure to the settings that were kept, unless the address of its page has some. */
export function restoreSession(scene: string, figure: SimulationFigure) {
  const { form, controls } = settingsOf(figure);
  const kept = recall(keyOf(scene));
  if (kept && !isAddressed(figure)) moveControls(form, controls, kept, "change");
}
