/** What a figure is set to and what it measures, as a table for other programs. */

import { isSlider } from "../../../simulations/engine/controls/slider/kind.ts";
import { all } from "../page/dom.ts";
import { csv } from "../page/download.ts";
import { fromNumeral } from "../page/words.ts";
import { readValues } from "./controls.ts";
import { settingsOf } from "./permalink.ts";

/**
 * Comma-separated values: a line for each setting and each number, entries of a matrix row by row.
 */
export function numbersOf(figure: HTMLElement) {
  const { form, controls } = settingsOf(figure);
  const values = readValues(form, controls);
  const settings = controls.map((control) => {
    const unit = isSlider(control) ? control.unit : "";
    return ["setting", control.name, control.label, String(values[control.name]), unit];
  });
  const readouts = all(figure, "output", HTMLOutputElement).flatMap(readoutRows);
  return csv([["kind", "name", "label", "value", "unit"], ...settings, ...readouts]);
}

function readoutRows(output: HTMLOutputElement): string[][] {
  const box = output.parentElement;
  const label = box?.querySelector(".readout-label")?.textContent ?? "";
  const unit = box?.querySelector(".unit")?.textContent ?? "";
  const lines = fromNumeral(output.value).replaceAll("\u2212", "-").split("\n");
  if (lines.length === 1) return [["readout", output.name, label, lines[0], unit]];
  return lines.flatMap((line, row) =>
    line
      .trim()
      .split(/\s+/)
      .map((entry, column) => {
        const name = `${output.name}[${row + 1},${column + 1}]`;
        return ["readout", name, label, entry, unit];
      }),
  );
}
