/**
 * A figure in use: it requests frames for the values of its controls, and shows them. What it says
 * of itself in `data-` attributes is in `status.ts`; retries are in `recovery.ts`.
 */

import { isStartDeferred, deferralReason } from "../page/data_saver.ts";
import { data, find, closestTo } from "../page/dom.ts";
import type { FrameReply } from "../runtime/messages.ts";
import { RuntimeFailure, sharedRuntime, type Caller } from "../runtime/runtime.ts";
import { announcer, clearFailure, setState, showFailure, showLive, showMessage } from "./status.ts";
import { isAction } from "../../../simulations/engine/controls/action/kind.ts";
import { isSlider, showValue } from "../../../simulations/engine/controls/slider/kind.ts";
import {
  type Control,
  fieldOf,
  readValue,
  readValues,
  type Schema,
  writeValue,
} from "./controls.ts";
import { Handles, type Pull } from "./handles.ts";
import { FigureLevels } from "./levels.ts";
import { Motion, moveInView } from "./motion.ts";
import { ReaderPicture } from "./reader_picture.ts";
import { Painter, adoptInitialFrames } from "./painter.ts";
import { Prerendered } from "./prerendered.ts";
import { areFolded, Mirrors, withParts } from "./parts.ts";
import { attemptTwice, startAll, retryAll, reportWaiting } from "./recovery.ts";
import { LatestWins } from "./scheduler.ts";
import { Accuracy, showStages, type Stage } from "./stage_report.ts";

/**
 * A frame to compute: of which control values (JSON), at which level once it begins; the control that
 * has moved, if one has, and whether it still moves; the reader's pictures, as a key; the time of the
 * reader's event.
 */
type Job = {
  values: string;
  tier: string;
  control: string;
  isMoving: boolean;
  pictures: string;
  time: number;
  urgency: number;
};

/** A frame that the reader waits for goes before one that only should be ready. */
const URGENCY = { idle: -1, far: 0, near: 1, touched: 2, held: 3 };

export type Sound = { rate: number; samples: Float32Array<ArrayBuffer> };

let figures = 0;

export class LiveFigure {
  #key = `figure-${++figures}`;
  #scheduler: LatestWins<Job> = new LatestWins((job) => this.#run(job));
  #listeners = new AbortController();
  /** Of the figure and its parts, those near the window. */
  #nearby: Set<Element> = new Set();
  /** What the last frame was requested for, and what the last one shows. */
  #requested = "";
  #painted = "";
  #sound: Sound | null = null;
  /** Job of an initial frame that was taken for the live one, and is not computed yet. */
  #uncached: Job | null = null;

  /** What the stages of the shown frame did. */
  stages: Stage[] = [];
  /** This figure, and the parts that show panels of its frames. */
  readonly figures: HTMLElement[];
  readonly mirrors: Mirrors;
  readonly schema: Schema;
  readonly form: HTMLFormElement;
  readonly painter: Painter;
  readonly prerendered: Prerendered;
  readonly announce: (text: string) => void;
  readonly accuracy: Accuracy;
  readonly levels: FigureLevels;
  readonly motion: Motion;
  readonly pictures: ReaderPicture;
  readonly handles: Handles;
  readonly observer: IntersectionObserver;

  constructor(
    readonly figure: HTMLElement,
    public runtime: Caller,
  ) {
    const { signal } = this.#listeners;
    this.schema = data(figure, "script.schema");
    this.form = find(figure, "form.controls", HTMLFormElement);
    this.levels = new FigureLevels(this.form, this.schema, this.#scene);
    this.figures = withParts(figure);
    this.mirrors = new Mirrors(this.figures.slice(1), this.form, this.schema.controls, signal);
    this.painter = new Painter(this.figures);
    this.prerendered = new Prerendered(this.painter, this.form, this.schema, (places) => {
      this.handles.show(places);
    });
    this.announce = announcer(this.figures);
    const estimate: Accuracy["nextEstimate"] = async ({ values, tier }, urgency) => {
      return (await this.runtime.call("error", this.#request(values, tier), urgency)).estimate;
    };
    this.accuracy = new Accuracy(figure, this.levels, estimate, () => this.#askAgain());
    this.motion = new Motion(this.form, this.schema, (control, time, isMoving) => {
      if (!isMoving) this.levels.settle(control);
      this.#ask(time, control, isMoving);
    });
    this.pictures = new ReaderPicture(figure, this.schema, () => this.#askAgain(), signal);
    this.#listen(signal);
    const pull = (pull: Pull) => this.#pull(pull);
    this.handles = new Handles(this.figures, this.form, this.schema, pull, signal);
    moveInView(this.figures, this.motion, signal);
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
    if (this.pictures.isLarge) this.runtime.close(); // an interpreter gives no memory back before
  }

  /** Whether the frame that was requested last is shown, or has failed. */
  get rests() {
    return this.#scheduler.idle;
  }

  /** Try again what failed, or start what waited for the reader; the figure keeps its values. */
  retry() {
    setState(this.figure, "starting");
    showMessage(this.figure, "");
    this.#askAgain();
  }

  /** From now on, get frames from another runtime, beginning with the present one. */
  drawnBy(runtime: Caller) {
    this.runtime = runtime;
    this.#requested = this.#painted = "";
    this.#askAgain();
  }

  /** The request for the frame of the form's present values. */
  request() {
    return this.#request(this.#values, this.levels.rest);
  }

  /** Which condition is the first to hold of the form's present values, or a `RuntimeFailure`. */
  async judge(conditions: string[]): Promise<number | null> {
    startAll();
    const judged = { ...this.request(), conditions };
    return (await this.runtime.call("judge", judged, () => URGENCY.touched)).met;
  }

  /** The sound of the present frame, null where its scene has none, or a `RuntimeFailure`. */
  async sound(): Promise<Sound | null> {
    if (this.#sound) return this.#sound;
    startAll();
    const reply = await this.runtime.call("render", this.request(), () => URGENCY.touched);
    this.#sound ??= soundOf(reply);
    return this.#sound;
  }

  /**
   * Ask for the first frame as soon as it is known whether the figure is in view; where its section
   * is folded up, once that is opened.
   */
  #startInView() {
    if (isStartDeferred()) setState(this.figure, "waiting");
    if (this.#waits) showMessage(this.figure, deferralReason(), { begin: true, lasting: true });
    const begin = () => {
      const isNew = !this.#requested && this.figure.dataset.state !== "failed";
      if (isNew) this.#ask(performance.now(), "", false, URGENCY.far);
    };
    const { signal } = this.#listeners;
    for (const each of this.figures) {
      each.closest("details")?.addEventListener("toggle", begin, { signal });
    }
    const observer = new IntersectionObserver(
      (entries) => {
        for (const { target, isIntersecting } of entries) {
          if (isIntersecting) this.#nearby.add(target);
          else this.#nearby.delete(target);
        }
        this.accuracy.near = this.#near;
        if (this.#near) this.prerendered.near();
        this.#cache();
        begin();
      },
      { rootMargin: "50% 0px" },
    );
    for (const each of this.figures) observer.observe(each);
    return observer;
  }

  #listen(signal: AbortSignal) {
    const { form } = this;
    form.addEventListener("submit", (event) => event.preventDefault(), { signal });
    form.addEventListener("input", (event) => this.#changed(event, true), { signal });
    form.addEventListener("change", (event) => this.#changed(event, false), { signal });
    form.addEventListener("click", (event) => this.#pressed(event), { signal });
    for (const each of this.figures) {
      const retry = find(each, ".retry", HTMLButtonElement);
      retry.addEventListener("click", () => this.#tryAgain(), { signal });
      find(each, ".begin", HTMLButtonElement).addEventListener("click", startAll, { signal });
    }
  }

  /** After a failure, or in place of a worker that keeps the figure waiting. */
  #tryAgain() {
    if (this.figure.dataset.state === "failed") {
      retryAll();
    } else {
      showMessage(this.figure, "");
      this.runtime.restart();
    }
  }

  /** Whether it, or a part of it, is near the window. */
  get #near() {
    return this.#nearby.size > 0;
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
    const name = closestTo(event, "[name]", Element)?.getAttribute("name");
    return this.schema.controls.find((control) => control.name === name);
  }

  #changed(event: Event, dragging: boolean) {
    const control = this.#control(event);
    if (isSlider(control)) {
      this.motion.stop();
      showValue(fieldOf(this.form, control.name) as HTMLInputElement, control);
    }
    const moved = isSlider(control) ? control.name : "";
    if (moved && !dragging) this.levels.settle(moved);
    this.#ask(event.timeStamp, moved, dragging && moved !== "");
    if (!control) this.accuracy.measure(); // the menu of accuracies
  }

  #pressed(event: Event) {
    const control = this.#control(event);
    if (!isAction(control)) return;
    if (control.drives) {
      this.motion.press(control, event.timeStamp);
    } else {
      const state = Number(readValue(this.form, control));
      writeValue(this.form, control, (state + 1) % control.labels.length);
      this.#ask(event.timeStamp);
    }
  }

  #askAgain() {
    this.#ask(performance.now());
  }

  /**
   * Request the frame of the form's present values, unless it was the last one requested.
   *
   * @param control Name of the control that has moved, if one has.
   * @param isMoving Whether it goes on.
   */
  #ask(time: number, control = "", isMoving = false, urgency: number = URGENCY.touched) {
    this.mirrors.show(readValues(this.form, this.schema.controls));
    if (!this.figure.isConnected || this.#waits || areFolded(this.figures)) return;
    if (this.figure.dataset.state === "still") setState(this.figure, "starting");
    const [values, tier, pictures] = [this.#values, this.levels.rest, this.pictures.key];
    const job = { values, tier, control, isMoving, pictures, time, urgency };
    const requested = `${frameKey(job)} ${isMoving}`;
    if (requested === this.#requested) return;
    this.#requested = requested;
    this.#scheduler.submit(job);
  }

  #request(values: string, tier: string) {
    return { figure: this.#key, scene: this.#scene, values, tier };
  }

  async #run(job: Job) {
    // At the last moment, when the time of the frame before is known.
    if (job.isMoving) job.tier = this.levels.moving(job.control, performance.now());
    job.pictures = this.pictures.key;
    if (frameKey(job) === this.#painted) return;
    const attempt = async () => {
      await this.pictures.sendTo(this.runtime, this.#key);
      if (!(await this.#adopt(job))) await this.#render(job);
    };
    const isWanted = () => this.figure.isConnected && !this.#scheduler.stale;
    const stop = reportWaiting(this.figure, this.runtime, () => this.#near);
    const error = await attemptTwice(this.figure, attempt, isWanted);
    stop();
    if (error === undefined || !this.figure.isConnected) return;
    this.motion.stop();
    this.#requested = this.#painted = "";
    showFailure(this.figure, error);
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
    const isUnchanged = () => !this.pictures.key && isInitial(this.figure, this.schema, job);
    if (!runtime || this.runtime !== runtime || !isUnchanged()) return false;
    const scene = { figure: this.#key, scene: this.#scene };
    const urgency = () => this.#urgency(job.urgency);
    const { sources } = await runtime.call("prepare", scene, urgency);
    if (sources !== document.body.dataset.sources || !isUnchanged()) return false;
    if (this.figure.isConnected) {
      this.prerendered.end();
      this.figures.forEach(adoptInitialFrames);
      clearFailure(this.figure);
      this.#painted = frameKey(job);
      showLive(this.figure, job, 0);
      this.#uncached = job;
      setTimeout(() => this.#cache()); // once this job is done and the figure rests
    }
    return true;
  }

  /** Cache a near figure only: on slow devices others would delay the hand for seconds. */
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
    this.#learn(job, computeMs);
    this.accuracy.framePainted(job, computeMs);
    this.figure.dispatchEvent(new Event("painted"));
  }

  /** What a pull at a handle means for the controls: the hand waits for it before all else. */
  async #pull(pull: Pull) {
    if (this.#waits) throw new RuntimeFailure("start", deferralReason());
    const request = this.#request(pull.values, this.figure.dataset.level ?? "");
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
    this.#painted = frameKey(job);
    this.announce(meta.description);
    clearFailure(this.figure);
    const isFirst = this.figure.dataset.frames === "0";
    if (isFirst) this.#learn({ ...job, control: "" }, reply.computeMs);
    else if (job.control) this.#learn(job, performance.now() - job.time);
    this.accuracy.framePainted(job, reply.computeMs);
    showLive(this.figure, job, reply.computeMs);
  }

  #learn({ control, tier, isMoving }: Job, ms: number) {
    this.levels.shown(control, tier, isMoving, ms, performance.now());
  }
}

/** What a frame shows. */
function frameKey({ values, tier, pictures }: Job) {
  return `${values} ${tier} ${pictures}`;
}

function soundOf({ meta, sound }: FrameReply): Sound | null {
  return sound ? { rate: JSON.parse(meta).sound.rate, samples: new Float32Array(sound) } : null;
}

/**
 * Whether an untouched figure shows the frame of its page, drawn when the book was built, and that is
 * the frame asked for.
 */
function isInitial(
  { dataset }: HTMLElement,
  { controls, values }: Schema,
  asked: { values: string; tier: string },
) {
  const initial = Object.fromEntries(controls.map(({ name }) => [name, values[name]]));
  const untouched = dataset.frames === "0" && dataset.early === undefined;
  return (
    untouched && (dataset.level ?? "") === asked.tier && JSON.stringify(initial) === asked.values
  );
}
