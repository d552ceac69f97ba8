/** Actions on a figure as a whole: the row of buttons below it. */

import { isSlider } from "../../../simulations/engine/controls/slider/kind.ts";
import { errorText } from "../errors.ts";
import { findAll, csv, data, download, findOptional, find } from "../page/dom.ts";
import { fromNumeral, words } from "../page/words.ts";
import { sharedRuntime } from "../runtime/runtime.ts";
import { glideTo, recordJump } from "./animate.ts";
import { readValues } from "./controls.ts";
import { leaderOf } from "./parts.ts";
import { embedding, permalink, settingsOf } from "./permalink.ts";
import { panelFile } from "./picture.ts";

/** Milliseconds for which a report of copying or saving stays. */
const REPORT_MS = 6000;

type Tool = (figure: HTMLElement, button: HTMLButtonElement) => unknown;

/** By the attribute of their button, as in `dataset`. */
const TOOLS: Record<string, Tool> = {
  reset,
  fullScreen,
  further: (_, button) => {
    button.ariaExpanded = String(button.ariaExpanded !== "true");
  },
  copyLink: (figure) => copy(figure, permalink(leaderOf(figure)), words("tools.link_copied")),
  copyEmbed: (figure, { dataset: { copyEmbed = "", height = "" } }) =>
    copy(figure, embedding(leaderOf(figure), copyEmbed, height), words("tools.embed_copied")),
  copyPython,
  playSound: async (figure, button) => (await import("./sound.ts")).toggleSound(figure, button),
  saveNumbers: (figure) => save(figure, "numbers.csv", numbersOf(figure), "text/csv"),
  savePanel,
};

/** Run the action of a button of the row. */
export async function runTool(button: HTMLButtonElement) {
  const figure = button.closest("simulation-figure");
  const name = Object.keys(TOOLS).find((tool) => tool in button.dataset);
  if (!(figure instanceof HTMLElement) || !name) return;
  report(figure, "");
  find(figure, ".copied", HTMLTextAreaElement).hidden = true;
  try {
    await TOOLS[name](figure, button);
  } catch (error) {
    report(figure, words("tools.failed", { reason: errorText(error) }));
  }
}

/** Back to where the page put it. */
function reset(part: HTMLElement) {
  const figure = leaderOf(part);
  const { start } = settingsOf(figure);
  recordJump(figure, start);
  glideTo(figure, start);
}

async function fullScreen(figure: HTMLElement, button: HTMLButtonElement) {
  if (document.fullscreenElement) {
    await document.exitFullscreen();
    return;
  }
  const whole = figure.closest("figure");
  await whole?.requestFullscreen();
  const enter = button.textContent;
  button.textContent = button.dataset.exit ?? enter;
  const changed = () => {
    if (document.fullscreenElement) return;
    document.removeEventListener("fullscreenchange", changed);
    button.textContent = enter;
  };
  document.addEventListener("fullscreenchange", changed);
}

/** Copy the script that prints what the figure shows. */
async function copyPython(figure: HTMLElement) {
  const runtime = sharedRuntime();
  if (!runtime) return;
  const leader = leaderOf(figure);
  const { form, controls } = settingsOf(leader);
  const { tier: _, ...values } = readValues(form, controls);
  const edited = "edited" in leader.dataset;
  const own = leader.querySelector(".photograph-back:not([hidden])") !== null;
  const { title } = data(leader, "script.schema");
  const notes = [
    words("script.title", { title }),
    ...(edited ? [words("script.edited")] : []),
    ...(own ? [words("script.reader_picture")] : []),
    words("script.needs"),
  ];
  const { script } = await runtime.call("script", {
    scene: figure.dataset.simulation ?? "",
    values: JSON.stringify(values),
    tier: figure.dataset.level ?? "",
    notes: JSON.stringify(notes),
  });
  const unlike = edited && own ? "_both" : edited ? "_code" : own ? "_picture" : "";
  await copy(figure, script, words(`tools.python_copied${unlike}`));
}

async function savePanel(figure: HTMLElement, button: HTMLButtonElement) {
  const name = button.dataset.savePanel ?? "";
  const panel = find(figure, `.panel[data-panel="${CSS.escape(name)}"]`, HTMLElement);
  const { blob, suffix } = await panelFile(panel);
  save(figure, `${name}.${suffix}`, blob);
}

/** Copy a text and report `done`; where the browser forbids it, show the text to be copied by hand. */
async function copy(figure: HTMLElement, text: string, done: string) {
  try {
    await navigator.clipboard.writeText(text);
    report(figure, done);
  } catch {
    const field = find(figure, ".copied", HTMLTextAreaElement);
    field.value = text;
    field.hidden = false;
    field.select();
    report(figure, words("tools.copy_yourself"));
  }
}

function save(figure: HTMLElement, name: string, content: BlobPart, type?: string) {
  const file = `${figure.closest("figure")?.id ?? "figure"}-${name}`;
  download(file, content, type);
  report(figure, words("tools.saved", { file }));
}

/** Report an action for some seconds. */
function report(figure: HTMLElement, text: string) {
  const line = findOptional(figure, ".tools-status", HTMLElement);
  if (!line) return;
  clearTimeout(Number(line.dataset.timer));
  line.textContent = text;
  line.dataset.timer = String(setTimeout(() => (line.textContent = ""), REPORT_MS));
}

/**
 * Settings and readouts of a figure as comma-separated values: a line for each, matrices row by row.
 */
function numbersOf(figure: HTMLElement) {
  const { form, controls } = settingsOf(leaderOf(figure));
  const values = readValues(form, controls);
  const settings = controls.map((control) => {
    const unit = isSlider(control) ? control.unit : "";
    return ["setting", control.name, control.label, String(values[control.name]), unit];
  });
  const readouts = findAll(figure, "output", HTMLOutputElement).flatMap(readoutRows);
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
