/**
 * The report of a figure's computation: the status of each stage, the time of the frame, and its error.
 * The error is estimated only while the figure rests and the report is open.
 */

import { errorText } from "../errors.ts";
import { findAll, findOptional } from "../page/dom.ts";
import { setText, withUnit } from "../page/text.ts";
import { messageText, parseNumber, numeral, words, type Message } from "../page/words.ts";
import type { Readout } from "../runtime/messages.ts";
import type { FigureLevels } from "./levels.ts";
import { withParts } from "./parts.ts";

export type Stage = { name: string; status: "computed" | "reused" | "skipped"; reason: Reason };

/** The text of a scene, or messages of the engine. */
type Reason = string | Message[];

type Estimate = Pick<Readout, "name" | "label" | "text" | "unit">;
/** Control values, level, and which picture of the reader's. */
type MeasuredFrame = { values: string; tier: string; pictures: string };

/** The level while something moves, its time, and the time of the next level. */
export type Moving = {
  tier: string;
  label: string;
  ms: number;
  better: { label: string; ms: number } | null;
};

/** Steps of an estimate after which it is trusted as far as a factor of two. */
const TRUSTED_AFTER = 4;

/** Milliseconds without a new frame after which the error is measured. */
const REST = 400;
/** After anything that the reader waits for. */
const URGENCY = () => -1;

function milliseconds(ms: number) {
  return withUnit(numeral(ms.toFixed(ms < 10 ? 1 : 0)), "ms");
}

export function showStages(figure: HTMLElement, stages: Stage[]) {
  const list = findOptional(figure, ".stages > ol", HTMLOListElement);
  const first = list?.firstElementChild;
  if (!list || !first) return;
  while (list.children.length < stages.length) list.append(first.cloneNode(true));
  // A frame that refuses its values has no stages: its items wait for the next one.
  for (const [index, item] of findAll(list, ":scope > li", HTMLLIElement).entries()) {
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
  return [reason].flat().map(messageText).join("; ");
}

/** `4 computed, 8 reused, 1 skipped`, as the builder writes it. */
export function countStages(stages: Stage[]) {
  const count = (status: string) => stages.filter((stage) => stage.status === status).length;
  const [computed, reused, skipped] = ["computed", "reused", "skipped"].map(count);
  return words("stage_report.count", { computed, reused, skipped });
}

/** The line with error and time under a figure that has a reference. */
export class Accuracy {
  /** The frame whose error is not yet measured. */
  #waiting: MeasuredFrame | null = null;
  /** The frame that is shown, if it is of the level at rest. */
  #shown: MeasuredFrame | null = null;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #near = false;
  /** Estimates written into the picture, by the name of their elements. */
  #written: Map<string, string> = new Map();
  /** Number of frames; the first also waits for its code, and is labelled so. */
  #frames = 0;

  /** The search for the cheapest level within the reader's tolerance that was finished last. */
  #searched = "";

  readonly line: HTMLElement | null;
  readonly report: HTMLDetailsElement | null;

  /**
   * @param nextEstimate The next estimate for a frame; null where there is no better one.
   * @param onFound Called once the cheapest level within the reader's tolerance is known.
   */
  constructor(
    readonly figure: HTMLElement,
    readonly levels: FigureLevels,
    readonly nextEstimate: (
      shown: MeasuredFrame,
      urgency: () => number,
    ) => Promise<Estimate | null>,
    readonly onFound: () => void,
  ) {
    this.line = findOptional(figure, ".accuracy", HTMLElement);
    this.report = findOptional(figure, "details.stage-report", HTMLDetailsElement);
    this.report?.addEventListener("toggle", () => this.#rest());
  }

  /** A frame was painted; frames of other levels than the one at rest are not measured. */
  framePainted(shown: MeasuredFrame, ms: number) {
    this.#writeMoving();
    if (!this.line && !this.#hasTimes) return;
    this.stop();
    for (const [name, text] of this.#written) this.#writeInPicture(name, text);
    this.#frames += 1;
    this.#set("frame", words(this.#frames > 1 ? "stage_report.frame" : "stage_report.first_frame"));
    this.#set("ms", milliseconds(ms));
    this.#set("value", "…");
    delete this.line?.dataset.judged;
    this.#shown = shown.tier === this.levels.rest ? shown : null;
    this.measure();
  }

  /** Measure the frame that is shown: another tolerance needs no new frame. */
  measure() {
    this.#waiting = this.#shown;
    this.#rest();
  }

  /** Figures far from view are not measured until the reader comes near. */
  set near(near: boolean) {
    this.#near = near;
    if (near) this.#rest();
  }

  get #isSeen() {
    return this.#near && (this.report?.open || this.#hasTimes);
  }

  /** Whether the picture, or that of a part, has room for times. */
  get #hasTimes() {
    return this.#places("[data-estimate]").length > 0;
  }

  #places(selector: string) {
    return withParts(this.figure).flatMap((figure) => findAll(figure, selector, SVGElement));
  }

  stop() {
    clearTimeout(this.#timer);
    this.#waiting = null;
  }

  #rest() {
    clearTimeout(this.#timer);
    const shown = this.#waiting;
    const isSearch = this.#near && this.levels.tolerance !== undefined;
    if (!shown || !(this.#isSeen || isSearch)) return;
    this.#timer = setTimeout(() => this.#measure(shown), REST);
  }

  /** The error of the frame, of what was shown while it moved, and of cheaper levels. */
  async #measure(shown: MeasuredFrame) {
    try {
      if (this.#isSeen) {
        await this.#estimate(shown, (estimate) => {
          if (!this.#writeInPicture(estimate.name, estimate.text)) this.#write(estimate);
          return this.#isSeen;
        });
        if (!this.#isSeen) return;
        if (this.line) this.line.dataset.judged = "true";
        await this.#judgeMoving(shown);
      }
      await this.#search(shown);
      if (this.#isSeen) this.#waiting = null;
    } catch (error) {
      if (this.#waiting !== shown) return;
      this.#waiting = null;
      const text = words("stage_report.not_measured", { reason: errorText(error) });
      this.#write({ name: "", label: words("stage_report.error"), text, unit: "" });
    }
  }

  /**
   * One estimate after another, each a call of its own, so that a drag never waits for all.
   *
   * @param use Returns whether a better one is wanted.
   */
  async #estimate(shown: MeasuredFrame, use: (estimate: Estimate) => boolean | undefined) {
    const waiting = this.#waiting;
    for (;;) {
      const estimate = await this.nextEstimate(shown, URGENCY);
      if (this.#waiting !== waiting) throw new Error("another frame is shown");
      if (!estimate || !use(estimate)) return;
    }
  }

  async #judgeMoving(shown: MeasuredFrame) {
    const moving = this.levels.report;
    if (!moving || !this.line || moving.tier === shown.tier) return;
    await this.#estimate({ ...shown, tier: moving.tier }, (estimate) => {
      if (estimate.unit) this.#writeMoving(estimate);
      return this.#isSeen;
    });
  }

  /** The cheapest level within the error that the reader allows; where none is, the most accurate. */
  async #search(shown: MeasuredFrame) {
    const { tolerance, schema } = this.levels;
    const search = `${shown.values} ${shown.pictures} ${tolerance}`;
    if (tolerance === undefined || search === this.#searched) return;
    let within = schema.tiers[schema.tiers.length - 1];
    for (const tier of schema.tiers) {
      if (!(await this.#isWithin({ ...shown, tier }, tolerance))) continue;
      within = tier;
      break;
    }
    this.#searched = search;
    this.levels.within = within;
    this.onFound();
  }

  async #isWithin(shown: MeasuredFrame, most: number) {
    let [error, steps] = [Infinity, 0];
    await this.#estimate(shown, ({ text, unit }) => {
      if (!unit) return true;
      error = parseNumber(text.replace("under ", ""));
      steps += 1;
      return steps < TRUSTED_AFTER || (error > most / 2 && error < 2 * most);
    });
    return error <= most;
  }

  /** `While you drag: 200 columns, 14 ms; 400 columns would take 52 ms on this device.` */
  #writeMoving(error?: Estimate) {
    const line = findOptional(this.figure, ".moving", HTMLElement);
    const moving = this.levels.report;
    if (!line || !moving) return;
    const { better } = moving;
    const level = error
      ? `${moving.label} (${error.label} ${withUnit(numeral(error.text), error.unit)})`
      : moving.label;
    const time = milliseconds(moving.ms);
    line.hidden = false;
    const text = better
      ? words("stage_report.moving", {
          level,
          time,
          better: better.label,
          longer: milliseconds(better.ms),
        })
      : words("stage_report.moving_at_rest", { level, time });
    setText(line, text);
  }

  /** Write a number where the picture has room for it. */
  #writeInPicture(name: string, text: string) {
    const places = this.#places(`[data-estimate="${CSS.escape(name)}"]`);
    for (const place of places) setText(place, numeral(text));
    if (places.length) this.#written.set(name, text);
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
