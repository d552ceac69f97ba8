/**
 * What a figure reports of its own computation: what became of each stage, how long the frame took,
 * and how far it is from the truth. The last is asked for only while the figure rests and the report
 * is open.
 */

import { message } from "../errors.ts";
import { all, maybe } from "../page/dom.ts";
import { setText, withUnit } from "../page/text.ts";
import { inWords, numeral, words, type Said } from "../page/words.ts";
import type { Readout } from "../runtime/messages.ts";

export type Stage = { name: string; status: "computed" | "reused" | "skipped"; reason: Reason };

/** A scene's own words, or the engine's. */
type Reason = string | Said[];

type Estimate = Pick<Readout, "name" | "label" | "text" | "unit">;
type Shown = { values: string; tier: string };

/** Milliseconds without a new frame after which the error is measured. */
const REST = 400;
/** After anything that the reader waits for. */
const URGENCY = () => -1;

export function showStages(figure: HTMLElement, stages: Stage[]) {
  const list = maybe(figure, ".stages > ol", HTMLOListElement);
  const first = list?.firstElementChild;
  if (!list || !first) return;
  while (list.children.length < stages.length) list.append(first.cloneNode(true));
  // A frame that refuses its values has no stages: its items wait for the next one.
  for (const [index, item] of all(list, ":scope > li", HTMLLIElement).entries()) {
    item.hidden = index >= stages.length;
    if (item.hidden) continue;
    const { name, status, reason } = stages[index];
    item.dataset.status = status;
    setText(item.querySelector(".stage-name"), name);
    setText(item.querySelector(".stage-status"), words(`stage_report.${status}`));
    setText(item.querySelector(".stage-reason"), reasonText(reason));
  }
  setText(figure.querySelector(".stages-count"), countStages(stages));
}

/** Why a stage was computed or not, as the builder writes it. */
export function reasonText(reason: Reason) {
  return [reason].flat().map(inWords).join("; ");
}

/** `4 computed, 8 reused, 1 skipped`, as the builder writes it. */
export function countStages(stages: Stage[]) {
  const count = (status: string) => stages.filter((stage) => stage.status === status).length;
  const [computed, reused, skipped] = ["computed", "reused", "skipped"].map(count);
  return words("stage_report.count", { computed, reused, skipped });
}

/** The line with error and time under a figure that has a reference. */
export class Accuracy {
  /** What is shown and not yet measured. */
  #waiting: Shown | null = null;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #near = false;
  /** What the picture shows of estimates: each was written into the elements of its name. */
  #told: Map<string, string> = new Map();
  /** A figure's first frame also waits for its code to be loaded, and says so. */
  #frames = 0;

  readonly line: HTMLElement | null;
  readonly report: HTMLDetailsElement | null;

  /** @param ask The next estimate for a frame; null where there is no better one. */
  constructor(
    readonly figure: HTMLElement,
    readonly ask: (shown: Shown, urgency: () => number) => Promise<Estimate | null>,
  ) {
    this.line = maybe(figure, ".accuracy", HTMLElement);
    this.report = maybe(figure, "details.stage-report", HTMLDetailsElement);
    this.report?.addEventListener("toggle", () => this.#rest());
  }

  /** A frame was painted; drafts, which are not `settled`, are not measured. */
  shown({ values, tier }: Shown, ms: number, settled: boolean) {
    if (!this.line && !this.#times) return;
    this.stop();
    for (const [name, text] of this.#told) this.#tell(name, text);
    this.#frames += 1;
    this.#set("frame", words(this.#frames > 1 ? "stage_report.frame" : "stage_report.first_frame"));
    this.#set("ms", withUnit(numeral(ms.toFixed(ms < 10 ? 1 : 0)), "ms"));
    this.#set("value", "…");
    delete this.line?.dataset.judged;
    if (!settled) return;
    this.#waiting = { values, tier };
    this.#rest();
  }

  /** Figures far from view are not measured until the reader comes near. */
  set near(near: boolean) {
    this.#near = near;
    if (near) this.#rest();
  }

  get #isSeen() {
    return this.#near && (this.report?.open || this.#times);
  }

  /** Whether the picture has room for times. */
  get #times() {
    return !!this.figure.querySelector("[data-estimate]");
  }

  stop() {
    clearTimeout(this.#timer);
    this.#waiting = null;
  }

  #rest() {
    clearTimeout(this.#timer);
    const shown = this.#waiting;
    if (shown && this.#isSeen) this.#timer = setTimeout(() => this.#measure(shown), REST);
  }

  /** One estimate after another, each a call of its own, so that a drag never waits for all. */
  async #measure(shown: Shown) {
    try {
      while (this.#waiting === shown && this.#isSeen) {
        const estimate = await this.ask(shown, URGENCY);
        if (this.#waiting !== shown) return;
        if (estimate) {
          if (!this.#tell(estimate.name, estimate.text)) this.#write(estimate);
        } else {
          this.#waiting = null;
          if (this.line) this.line.dataset.judged = "true";
        }
      }
    } catch (error) {
      if (this.#waiting !== shown) return;
      this.#waiting = null;
      const text = words("stage_report.not_measured", { reason: message(error) });
      this.#write({ name: "", label: words("stage_report.error"), text, unit: "" });
    }
  }

  /** Write a number where the picture has room for it. */
  #tell(name: string, text: string) {
    const places = this.figure.querySelectorAll(`[data-estimate="${CSS.escape(name)}"]`);
    for (const place of places) setText(place, numeral(text));
    if (places.length) this.#told.set(name, text);
    return places.length > 0;
  }

  #write({ label, text, unit }: Estimate) {
    this.#set("label", label);
    this.#set("value", withUnit(numeral(text), unit));
  }

  #set(part: string, text: string) {
    setText(this.line?.querySelector(`.accuracy-${part}`), text);
  }
}
