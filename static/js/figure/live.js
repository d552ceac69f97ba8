/**
 * The life of a figure: its controls ask for frames, the worker draws them, the page shows them.
 *
 * States, in `data-state`: `still` as served; `waiting` for the reader to ask, where the link is to
 * be spared; `starting` once a frame is asked for; `live` after each painted frame; `failed` with a
 * message and a button. `data-frames` counts frames after their pixels are in the page. `data-tier`
 * is the accuracy of the frame that is shown.
 */

import { message } from "../errors.js";
import { all, data, one, within } from "../page/dom.js";
import { RuntimeFailure, sharedRuntime } from "../runtime/runtime.js";
import { announcer } from "./announce.js";
import { pressAction, readValues, showSliderValue } from "./controls.js";
import { Early } from "./early.js";
import { Handles } from "./handles.js";
import { Motion } from "./motion.js";
import { OwnPicture } from "./own_picture.js";
import { Painter, takeStills } from "./painter.js";
import { LatestWins } from "./scheduler.js";
import { isOfPage, isServed } from "./served.js";
import { say, sayNothingOfFailure } from "./status.js";
import { chosenTier, isDrafted, shownTier } from "./tiers.js";
import { warmTouches } from "./warming.js";
import { Accuracy, showStages } from "./workings.js";
import { painted } from "../page/pauses.js";
import { offerRelease } from "../page/release.js";
import { isSparing, spareNoMore } from "../page/sparing.js";
import { words } from "../page/words.js";

/** @import { Caller } from "../runtime/runtime.js" */
/** @import { Stage } from "./workings.js" */
/** @import { Control, Schema } from "./controls.js" */
/** @import { Readout } from "./painter.js" */
/** @import { Pull } from "./handles.js" */
/** @import { Judged } from "./workings.js" */
/** @typedef {{values: string, tier: string, time: number, urgency: number}} Job */

/** A frame that the reader waits for goes before one that only should be ready. */
const URGENCY = { idle: -1, far: 0, near: 1, touched: 2, held: 3 };
/** How often a frame is asked for again, by itself, after the worker was lost or a network found. */
const RESTARTS = 1;

let figures = 0;
/** When the device last found a network again: what was tried before may have failed for that. */
let backAt = 0;

export class LiveFigure {
  #key = `figure-${++figures}`;
  /** @type {LatestWins<Job>} */
  #scheduler = new LatestWins((job) => this.#run(job));
  #listeners = new AbortController();
  /** @type {IntersectionObserver} */
  #observer;
  #near = false;
  #asked = "";
  /**
   * @param {HTMLElement} figure
   * @param {Caller} runtime
   */
  constructor(figure, runtime) {
    this.figure = figure;
    this.runtime = runtime;
    /** @type {Stage[]} What the stages of the shown frame did. */
    this.stages = [];
    /** @type {Schema} */
    this.schema = data(figure, "script.schema");
    this.form = one(figure, "form.controls", HTMLFormElement);
    this.painter = new Painter(figure);
    this.early = new Early(this.painter, this.form, this.schema, (handles) => {
      this.handles.show(handles);
    });
    this.announce = announcer(one(figure, ".description", HTMLElement));
    this.accuracy = new Accuracy(figure, (job, urgency) => this.#askError(job, urgency));
    this.motion = new Motion(this.form, this.schema, (moving, time) => this.#ask(time, moving));
    const again = () => this.#ask(performance.now(), "");
    this.own = new OwnPicture(figure, this.schema.photograph, again, this.#listeners.signal);
    this.#listen();
    this.handles = new Handles(
      figure,
      this.form,
      this.schema,
      (pull) => this.#askPull(pull),
      this.#listeners.signal,
    );
    this.#observer = this.#startInView();
  }

  /** The figure has left the page. */
  leave() {
    this.#observer.disconnect();
    this.#listeners.abort();
    this.early.end();
    this.motion.stop();
    this.accuracy.stop();
    this.#scheduler.clear();
    this.runtime.forget(this.#key);
  }

  /** Whether the frame that was asked for last is shown, or has failed. */
  get rests() {
    return this.#scheduler.idle;
  }

  /** Try again what failed, or what waited to be asked for; the figure keeps its values. */
  retry() {
    this.figure.dataset.state = "starting";
    say(this.figure, "");
    this.#ask(performance.now(), "");
  }

  /**
   * From now on, have the frames of another, beginning with the present one.
   *
   * @param {Caller} runtime
   */
  drawnBy(runtime) {
    this.runtime = runtime;
    this.#asked = "";
    this.#ask(performance.now(), "");
  }

  /** What is asked for the frame of the form's present values. */
  request() {
    const values = JSON.stringify(readValues(this.form, this.schema.controls));
    return this.#request(values, this.#tier(""));
  }

  /**
   * Which condition is the first to hold of what the controls say now.
   *
   * @param {string[]} conditions
   * @returns {Promise<number | null>}
   * @throws {RuntimeFailure} Where Python cannot tell.
   */
  async judge(conditions) {
    beginAll();
    const values = JSON.stringify(readValues(this.form, this.schema.controls));
    const state = this.#request(values, chosenTier(this.form, this.schema));
    return (await this.runtime.call("judge", { ...state, conditions }, () => URGENCY.touched)).met;
  }

  /** Ask for the first frame as soon as it is known whether the figure is in view. */
  #startInView() {
    this.figure.dataset.state = isSparing() ? "waiting" : "starting";
    if (this.#waits) say(this.figure, words("figure.sparing"), { begin: true, lasting: true });
    const observer = new IntersectionObserver(
      ([entry]) => {
        this.#near = entry.isIntersecting;
        this.accuracy.near = this.#near;
        if (this.#near) this.early.near();
        const isNew = !this.#asked && this.figure.dataset.state !== "failed";
        if (isNew) this.#ask(performance.now(), "", URGENCY.far);
      },
      { rootMargin: "50% 0px" },
    );
    observer.observe(this.figure);
    // What is ready is no work: it need not wait for the page to be laid out.
    if (sharedRuntime()?.sourcesOf(this.#scene)) this.#ask(performance.now(), "", URGENCY.far);
    return observer;
  }

  #listen() {
    const { signal } = this.#listeners;
    this.form.addEventListener("submit", (event) => event.preventDefault(), { signal });
    this.form.addEventListener("input", (event) => this.#changed(event, true), { signal });
    this.form.addEventListener("change", (event) => this.#changed(event, false), { signal });
    this.form.addEventListener("click", (event) => this.#pressed(event), { signal });
    one(this.figure, ".retry", HTMLButtonElement).addEventListener("click", retryAll, { signal });
    one(this.figure, ".begin", HTMLButtonElement).addEventListener("click", beginAll, { signal });
  }

  /** Whether Python is not to start before the reader asks. */
  get #waits() {
    return this.figure.dataset.state === "waiting";
  }

  /**
   * @param {Event} event
   * @returns {Control | undefined}
   */
  #control(event) {
    const name = within(event, "[name]", Element)?.getAttribute("name");
    return this.schema.controls.find((control) => control.name === name);
  }

  /**
   * @param {Event} event
   * @param {boolean} dragging
   */
  #changed(event, dragging) {
    const control = this.#control(event);
    if (control?.kind === "slider") {
      this.motion.stop();
      showSliderValue(this.form, control);
    }
    const drafted = dragging && isDrafted(this.form, this.schema, control);
    this.#ask(event.timeStamp, drafted && control ? control.name : "");
  }

  /** @param {Event} event */
  #pressed(event) {
    const control = this.#control(event);
    if (control?.kind !== "action") return;
    if (control.drives) {
      this.motion.press(control, event.timeStamp);
    } else {
      pressAction(this.form, control);
      this.#ask(event.timeStamp, "");
    }
  }

  /**
   * Ask for the frame of the form's present values, unless it is the one asked for last.
   *
   * @param {number} time
   * @param {string} moving Name of the control whose moves are drafted, if one moves.
   * @param {number} [urgency]
   */
  #ask(time, moving, urgency = URGENCY.touched) {
    if (!this.figure.isConnected || this.#waits) return;
    const values = JSON.stringify(readValues(this.form, this.schema.controls));
    const tier = this.#tier(moving);
    const asked = `${values} ${tier} ${this.own.number}`;
    if (asked === this.#asked) return;
    this.#asked = asked;
    this.#scheduler.submit({ values, tier, time, urgency });
  }

  /** @param {string} moving */
  #tier(moving) {
    return shownTier(this.form, this.schema, moving);
  }

  /** @param {Job} job */
  async #run(job) {
    for (let attempt = 0; ; attempt += 1) {
      const begun = performance.now();
      try {
        await this.own.handOver(this.runtime, this.#key);
        if (await this.#adopt(job)) return;
        const reply = await this.#call(job);
        if (this.figure.isConnected) this.#show(reply, job);
        return;
      } catch (error) {
        if (!this.figure.isConnected) return;
        const lost = error instanceof RuntimeFailure && error.kind === "lost";
        if (!(lost || backAt > begun) || attempt >= RESTARTS) {
          this.#fail(error);
          return;
        }
        this.figure.dataset.state = "starting";
        if (this.#scheduler.stale) return;
      }
    }
  }

  /** @param {Job} job */
  #call({ values, tier, urgency }) {
    return this.runtime.call("render", this.#request(values, tier), () => this.#urgency(urgency));
  }

  /** @param {number} least */
  #urgency(least) {
    return Math.max(least, this.#near ? URGENCY.near : URGENCY.far);
  }

  /**
   * Take the page's own frame for the live one where it is that, as soon as the worker could draw
   * others; then have the stages of those ready.
   *
   * @param {Job} job
   */
  async #adopt(job) {
    const isStill = () => !this.own.number && isServed(this.figure, this.schema, job);
    if (this.runtime !== sharedRuntime() || !isStill()) return false;
    const scene = { figure: this.#key, scene: this.#scene };
    const urgency = () => this.#urgency(job.urgency);
    const sources =
      sharedRuntime()?.sourcesOf(this.#scene) ??
      (await this.runtime.call("prepare", scene, urgency)).sources;
    if (!isOfPage(sources) || !isStill()) return false;
    if (this.figure.isConnected) {
      this.early.end();
      takeStills(this.figure);
      sayNothingOfFailure(this.figure);
      this.#lives(job, 0);
      this.#warm(job);
    }
    return true;
  }

  /**
   * Compute, while nobody waits, what the next frame shares with the page's own.
   *
   * @param {Job} job
   */
  async #warm(job) {
    await painted();
    if (this.figure.dataset.frames !== "1" || !this.figure.isConnected) return;
    try {
      const asked = this.#request(job.values, job.tier);
      const reply = await this.runtime.call("render", asked, () => URGENCY.idle);
      if (this.figure.dataset.frames !== "1" || !this.rests) return;
      this.stages = JSON.parse(reply.meta).stages;
      this.figure.dataset.computeMs = reply.computeMs.toFixed(1);
      this.accuracy.shown(job, reply.computeMs, true);
      const isUntouched = () => this.figure.isConnected && this.figure.dataset.frames === "1";
      await warmTouches(this.runtime, asked, this.schema, isUntouched);
    } catch {
      // Whoever touches the figure hears of it.
    }
  }

  /**
   * What a pull at a handle means for the controls: the hand waits for it before all else.
   *
   * @param {Pull} pull
   */
  async #askPull(pull) {
    if (this.#waits) throw new RuntimeFailure("start", words("figure.sparing"));
    const { tier } = this.figure.dataset;
    const payload = { figure: this.#key, scene: this.#scene, tier, ...pull };
    return this.runtime.call("pull", payload, () => URGENCY.held);
  }

  /**
   * @param {string} values
   * @param {string} tier
   */
  #request(values, tier) {
    return { figure: this.#key, scene: this.#scene, values, tier };
  }

  get #scene() {
    return this.figure.dataset.simulation ?? "";
  }

  /**
   * @param {Judged} judged
   * @param {() => number} urgency
   * @returns {Promise<Readout | null>}
   */
  async #askError({ values, tier }, urgency) {
    return (await this.runtime.call("error", this.#request(values, tier), urgency)).estimate;
  }

  /**
   * @param {{meta: string, rasters: ArrayBuffer[], computeMs: number}} reply
   * @param {Job} job
   */
  #show(reply, job) {
    const { figure } = this;
    const meta = JSON.parse(reply.meta);
    this.early.end();
    this.painter.paint(meta, reply.rasters);
    this.runtime.recycle(reply.rasters);
    this.stages = meta.stages;
    this.handles.show(meta.handles);
    showStages(figure, meta.stages);
    this.accuracy.shown(job, reply.computeMs, job.tier === this.#tier(""));
    this.announce(meta.description);
    sayNothingOfFailure(figure);
    this.#lives(job, reply.computeMs);
  }

  /**
   * The frame of a job is in the page.
   *
   * @param {Job} job
   * @param {number} computeMs
   */
  #lives(job, computeMs) {
    const { figure } = this;
    figure.dataset.computeMs = computeMs.toFixed(1);
    figure.dataset.latencyMs = (performance.now() - job.time).toFixed(1);
    if (figure.dataset.tier !== job.tier) figure.dataset.tier = job.tier;
    figure.dataset.frames = String(Number(figure.dataset.frames ?? 0) + 1);
    if (figure.dataset.state !== "live") figure.dataset.state = "live";
    figure.dispatchEvent(new Event("painted"));
  }

  /** @param {unknown} error */
  #fail(error) {
    this.motion.stop();
    this.#asked = "";
    this.figure.dataset.state = "failed";
    const { kind, fault = "" } = error instanceof RuntimeFailure ? error : { kind: "page" };
    if (["status", "other"].includes(fault)) offerRelease();
    say(this.figure, words(`figure.${kind}`, { reason: message(error) }), { retry: true });
    this.figure.dispatchEvent(new Event("figure-rest", { bubbles: true }));
  }
}

addEventListener("online", () => {
  backAt = performance.now();
  retryAll();
});

/** The reader has asked for Python in one figure: it serves them all. */
function beginAll() {
  spareNoMore();
  for (const figure of all(document, 'simulation-figure[data-state="waiting"]', HTMLElement)) {
    if ("begin" in figure && typeof figure.begin === "function") figure.begin();
  }
}

/** What kept one figure from its frame has most often kept them all. */
function retryAll() {
  for (const figure of all(document, 'simulation-figure[data-state="failed"]', HTMLElement)) {
    if ("retry" in figure && typeof figure.retry === "function") figure.retry();
  }
}
