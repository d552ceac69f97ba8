/**
 * A figure in use: its controls ask for frames, the worker computes them, the page shows them.
 *
 * States, in `data-state`: `still` as built; `waiting` for the reader to ask, where the link is
 * metered; `starting` once a frame is requested; `live` after each painted frame; `failed` with a
 * message and a button. `data-frames` counts frames after their pixels are in the page; `data-tier`
 * is the accuracy of the frame that is shown.
 */

import { message } from "../errors.ts";
import { isSparing, sparingReason, startSurvived, stopSparing } from "../page/data_saver.ts";
import { all, data, one, within } from "../page/dom.ts";
import { offerRelease } from "../page/release.ts";
import { words } from "../page/words.ts";
import type { FrameReply } from "../runtime/messages.ts";
import { RuntimeFailure, sharedRuntime, type Caller } from "../runtime/runtime.ts";
import { announcer } from "./announce.ts";
import { playInView } from "./arrival.ts";
import { isAction } from "../../../simulations/engine/controls/action/kind.ts";
import { isSlider, showValue } from "../../../simulations/engine/controls/slider/kind.ts";
import type { Control } from "./control.ts";
import { fieldOf, readValue, readValues, writeValue, type Schema } from "./controls.ts";
import { Handles, type Pull } from "./handles.ts";
import { isInitial } from "./initial_frame.ts";
import { Motion } from "./motion.ts";
import { OwnPicture } from "./own_picture.ts";
import { Painter, takeStills } from "./painter.ts";
import { Prerendered } from "./prerendered.ts";
import { LatestWins } from "./scheduler.ts";
import { Accuracy, showStages, type Stage } from "./stage_report.ts";
import { clearFailure, say } from "./status.ts";
import { chosenTier, isDrafted, shownTier } from "./tiers.ts";

type Job = { values: string; tier: string; time: number; urgency: number };

/** A frame that the reader waits for goes before one that only should be ready. */
const URGENCY = { idle: -1, far: 0, near: 1, touched: 2, held: 3 };

export type Sound = { rate: number; samples: Float32Array<ArrayBuffer> };

let figures = 0;
/** When the device last found a network again: earlier requests may have failed for lack of it. */
let onlineSince = 0;

export class LiveFigure {
  #key = `figure-${++figures}`;
  #scheduler: LatestWins<Job> = new LatestWins((job) => this.#run(job));
  #listeners = new AbortController();
  #near = false;
  /** What the last frame was requested for. */
  #asked = "";
  #sound: Sound | null = null;
  /** Of an initial frame that was taken for the live one, and is not computed yet. */
  #uncached: Job | null = null;

  /** What the stages of the shown frame did. */
  stages: Stage[] = [];
  readonly schema: Schema;
  readonly form: HTMLFormElement;
  readonly painter: Painter;
  readonly prerendered: Prerendered;
  readonly announce: (text: string) => void;
  readonly accuracy: Accuracy;
  readonly motion: Motion;
  readonly own: OwnPicture;
  readonly handles: Handles;
  readonly observer: IntersectionObserver;

  constructor(
    readonly figure: HTMLElement,
    public runtime: Caller,
  ) {
    const { signal } = this.#listeners;
    this.schema = data(figure, "script.schema");
    this.form = one(figure, "form.controls", HTMLFormElement);
    this.painter = new Painter(figure);
    this.prerendered = new Prerendered(this.painter, this.form, this.schema, (places) => {
      this.handles.show(places);
    });
    this.announce = announcer(one(figure, ".description", HTMLElement));
    this.accuracy = new Accuracy(figure, async ({ values, tier }, urgency) => {
      return (await this.runtime.call("error", this.#request(values, tier), urgency)).estimate;
    });
    this.motion = new Motion(this.form, this.schema, (moving, time) => this.#ask(time, moving));
    this.own = new OwnPicture(figure, this.schema.photograph, () => this.#askAgain(), signal);
    this.#listen(signal);
    const pull = (pull: Pull) => this.#pull(pull);
    this.handles = new Handles(figure, this.form, this.schema, pull, signal);
    playInView(figure, this.schema, this.motion, signal);
    this.observer = this.#startInView();
  }

  /** The figure has left the page. */
  leave() {
    this.observer.disconnect();
    this.#listeners.abort();
    this.prerendered.end();
    this.motion.stop();
    this.accuracy.stop();
    this.#scheduler.clear();
    this.runtime.forget(this.#key);
    if (this.own.isLarge) this.runtime.close(); // an interpreter gives no memory back before
  }

  /** Whether the frame that was requested last is shown, or has failed. */
  get rests() {
    return this.#scheduler.idle;
  }

  /** Try again what failed, or start what waited for the reader; the figure keeps its values. */
  retry() {
    this.figure.dataset.state = "starting";
    say(this.figure, "");
    this.#askAgain();
  }

  /** From now on, get frames from another runtime, beginning with the present one. */
  drawnBy(runtime: Caller) {
    this.runtime = runtime;
    this.#asked = "";
    this.#askAgain();
  }

  /** The request for the frame of the form's present values. */
  request() {
    return this.#request(this.#values, this.#tier(""));
  }

  /**
   * Which condition is the first to hold of the form's present values.
   *
   * @throws {RuntimeFailure}
   */
  async judge(conditions: string[]): Promise<number | null> {
    beginAll();
    const request = this.#request(this.#values, chosenTier(this.form, this.schema));
    const judged = { ...request, conditions };
    return (await this.runtime.call("judge", judged, () => URGENCY.touched)).met;
  }

  /**
   * The sound of the present frame; null where its scene has none.
   *
   * @throws {RuntimeFailure}
   */
  async sound(): Promise<Sound | null> {
    if (this.#sound) return this.#sound;
    beginAll();
    const reply = await this.runtime.call("render", this.request(), () => URGENCY.touched);
    this.#sound ??= soundOf(reply);
    return this.#sound;
  }

  /** Ask for the first frame as soon as it is known whether the figure is in view. */
  #startInView() {
    this.figure.dataset.state = isSparing() ? "waiting" : "starting";
    if (this.#waits) say(this.figure, sparingReason(), { begin: true, lasting: true });
    const observer = new IntersectionObserver(
      ([entry]) => {
        this.#near = entry.isIntersecting;
        this.accuracy.near = this.#near;
        if (this.#near) this.prerendered.near();
        this.#cache();
        const isNew = !this.#asked && this.figure.dataset.state !== "failed";
        if (isNew) this.#ask(performance.now(), "", URGENCY.far);
      },
      { rootMargin: "50% 0px" },
    );
    observer.observe(this.figure);
    return observer;
  }

  #listen(signal: AbortSignal) {
    const { form, figure } = this;
    form.addEventListener("submit", (event) => event.preventDefault(), { signal });
    form.addEventListener("input", (event) => this.#changed(event, true), { signal });
    form.addEventListener("change", (event) => this.#changed(event, false), { signal });
    form.addEventListener("click", (event) => this.#pressed(event), { signal });
    one(figure, ".retry", HTMLButtonElement).addEventListener("click", retryAll, { signal });
    one(figure, ".begin", HTMLButtonElement).addEventListener("click", beginAll, { signal });
  }

  /** Whether Python must not start before the reader asks. */
  get #waits() {
    return this.figure.dataset.state === "waiting";
  }

  get #scene() {
    return this.figure.dataset.simulation ?? "";
  }

  /** The form's present values, as JSON. */
  get #values() {
    return JSON.stringify(readValues(this.form, this.schema.controls));
  }

  #control(event: Event): Control | undefined {
    const name = within(event, "[name]", Element)?.getAttribute("name");
    return this.schema.controls.find((control) => control.name === name);
  }

  #changed(event: Event, dragging: boolean) {
    const control = this.#control(event);
    if (isSlider(control)) {
      this.motion.stop();
      showValue(fieldOf(this.form, control.name) as HTMLInputElement, control);
    }
    const drafted = dragging && isDrafted(this.form, this.schema, control);
    this.#ask(event.timeStamp, drafted && control ? control.name : "");
  }

  #pressed(event: Event) {
    const control = this.#control(event);
    if (!isAction(control)) return;
    if (control.drives) {
      this.motion.press(control, event.timeStamp);
    } else {
      const state = Number(readValue(this.form, control));
      writeValue(this.form, control, (state + 1) % control.labels.length);
      this.#ask(event.timeStamp, "");
    }
  }

  #askAgain() {
    this.#ask(performance.now(), "");
  }

  /**
   * Request the frame of the form's present values, unless it was the last one requested.
   *
   * @param moving Name of the control whose moves are drafted, if one moves.
   */
  #ask(time: number, moving: string, urgency: number = URGENCY.touched) {
    if (!this.figure.isConnected || this.#waits) return;
    const [values, tier] = [this.#values, this.#tier(moving)];
    const asked = `${values} ${tier} ${this.own.key}`;
    if (asked === this.#asked) return;
    this.#asked = asked;
    this.#scheduler.submit({ values, tier, time, urgency });
  }

  #tier(moving: string) {
    return shownTier(this.form, this.schema, moving);
  }

  #request(values: string, tier: string) {
    return { figure: this.#key, scene: this.#scene, values, tier };
  }

  /**
   * Have a frame computed and shown; once more where the worker was lost, or the network was away.
   */
  async #run(job: Job) {
    for (let attempt = 0; ; attempt += 1) {
      const begun = performance.now();
      try {
        await this.own.handOver(this.runtime, this.#key);
        if (!(await this.#adopt(job))) await this.#render(job);
        return;
      } catch (error) {
        if (!this.figure.isConnected) return;
        const lost = error instanceof RuntimeFailure && error.kind === "lost";
        if (attempt > 0 || !(lost || onlineSince > begun)) {
          this.#fail(error);
          return;
        }
        this.figure.dataset.state = "starting";
        if (this.#scheduler.stale) return;
      }
    }
  }

  async #render(job: Job) {
    const request = this.#request(job.values, job.tier);
    const reply = await this.runtime.call("render", request, () => this.#urgency(job.urgency));
    if (this.figure.isConnected) this.#show(reply, job);
  }

  #urgency(least: number) {
    return Math.max(least, this.#near ? URGENCY.near : URGENCY.far);
  }

  /**
   * Take the page's initial frame for the live one where it is that, as soon as the worker could
   * draw others; compute it once the figure is near, so that its stages are cached.
   */
  async #adopt(job: Job) {
    const runtime = sharedRuntime();
    const isUnchanged = () => !this.own.key && isInitial(this.figure, this.schema, job);
    if (!runtime || this.runtime !== runtime || !isUnchanged()) return false;
    const scene = { figure: this.#key, scene: this.#scene };
    const urgency = () => this.#urgency(job.urgency);
    const { sources } = await runtime.call("prepare", scene, urgency);
    if (sources !== document.body.dataset.sources || !isUnchanged()) return false;
    if (this.figure.isConnected) {
      this.prerendered.end();
      takeStills(this.figure);
      clearFailure(this.figure);
      this.#painted(job, 0);
      this.#uncached = job;
      this.#cache();
    }
    return true;
  }

  /** Of a figure that is near: on a slow device others would keep the hand waiting for seconds. */
  #cache() {
    const job = this.#near ? this.#uncached : null;
    if (!job) return;
    this.#uncached = null;
    this.#compute(job).catch(() => {}); // reported when the figure is touched
  }

  async #compute(job: Job) {
    if (this.figure.dataset.frames !== "1" || !this.rests) return;
    const request = this.#request(job.values, job.tier);
    const { meta, computeMs } = await this.runtime.call("render", request, () => URGENCY.idle);
    if (this.figure.dataset.frames !== "1" || !this.rests) return;
    this.stages = JSON.parse(meta).stages;
    this.figure.dataset.computeMs = computeMs.toFixed(1);
    this.accuracy.shown(job, computeMs, true);
  }

  /** What a pull at a handle means for the controls: the hand waits for it before all else. */
  async #pull(pull: Pull) {
    if (this.#waits) throw new RuntimeFailure("start", sparingReason());
    const request = this.#request(pull.values, this.figure.dataset.tier ?? "");
    return this.runtime.call("pull", { ...request, ...pull }, () => URGENCY.held);
  }

  #show(reply: FrameReply, job: Job) {
    const meta = JSON.parse(reply.meta);
    this.prerendered.end();
    this.painter.paint(meta, reply.rasters);
    this.stages = meta.stages;
    this.#sound = soundOf(reply);
    this.handles.show(meta.handles);
    showStages(this.figure, meta.stages);
    this.accuracy.shown(job, reply.computeMs, job.tier === this.#tier(""));
    this.announce(meta.description);
    clearFailure(this.figure);
    this.#painted(job, reply.computeMs);
  }

  #painted(job: Job, computeMs: number) {
    const { figure } = this;
    figure.dataset.computeMs = computeMs.toFixed(1);
    figure.dataset.latencyMs = (performance.now() - job.time).toFixed(1);
    if (figure.dataset.tier !== job.tier) figure.dataset.tier = job.tier;
    figure.dataset.frames = String(Number(figure.dataset.frames ?? 0) + 1);
    if (figure.dataset.state !== "live") {
      figure.dataset.state = "live";
      startSurvived();
    }
    figure.dispatchEvent(new Event("painted"));
  }

  #fail(error: unknown) {
    this.motion.stop();
    this.#asked = "";
    this.figure.dataset.state = "failed";
    const { kind, loadError = "" } = error instanceof RuntimeFailure ? error : { kind: "page" };
    if (["status", "other"].includes(loadError)) offerRelease();
    say(this.figure, words(`figure.${kind}`, { reason: message(error) }), { retry: true });
    this.figure.dispatchEvent(new Event("figure-rest", { bubbles: true }));
  }
}

function soundOf({ meta, sound }: FrameReply): Sound | null {
  return sound ? { rate: JSON.parse(meta).sound.rate, samples: new Float32Array(sound) } : null;
}

addEventListener("online", () => {
  onlineSince = performance.now();
  retryAll();
});

/** The reader has asked for Python in one figure: all start. */
function beginAll() {
  stopSparing();
  callAll("waiting", "begin");
}

/** What kept one figure from its frame has most often kept them all. */
function retryAll() {
  callAll("failed", "retry");
}

function callAll(state: "waiting" | "failed", method: "begin" | "retry") {
  for (const figure of all(document, `simulation-figure[data-state="${state}"]`, HTMLElement)) {
    (figure as any)[method]();
  }
}
