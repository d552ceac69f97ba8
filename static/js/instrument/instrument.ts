/**
 * A figure that measures the reader's photographs: it takes files in, has them read one after
 * another, and gives the figure what was found. Nothing leaves the device.
 */

import type { SimulationFigure } from "../figure/element.ts";
import { moveControls, named } from "../figure/controls.ts";
import { settingsOf } from "../figure/permalink.ts";
import { nextNumber } from "../figure/photograph.ts";
import { maybe, one } from "../page/dom.ts";
import { recall, remember } from "../page/storage.ts";
import { setText } from "../page/text.ts";
import { words } from "../page/words.ts";
import { closed } from "../runtime/runtime.ts";
import {
  erase,
  keep,
  keepSession,
  keptPhotos,
  keyOf,
  type Photo,
  restoreSession,
  type State,
  WANTED,
} from "./keeping.ts";
import { PhotoList } from "./list.ts";
import { Reader, ReaderEnded } from "./reader.ts";

export class Instrument {
  photos: Photo[] = [];
  chosen: Photo | null = null;
  #reader: Reader;
  #isWorking = false;
  #isStopped = false;
  /** What is said beside the state of the work, until photographs come or go. */
  #remark = "";
  #keeps = recall(WANTED) !== false;
  /** What the control that counts photographs last followed. */
  #counted = 0;
  #given = "";
  #givenNumber = 0;
  readonly scene: string;
  /** Absolute address of the runtime folder. */
  readonly url: string;
  readonly list: PhotoList;

  /** @param box The `.intake`. */
  constructor(
    readonly figure: SimulationFigure,
    readonly box: HTMLElement,
  ) {
    const { runtime = "" } = document.body.dataset;
    this.scene = figure.dataset.simulation ?? "";
    this.url = new URL(runtime, location.href).href;
    this.#reader = new Reader(
      this.url,
      this.scene,
      "reads" in box.dataset,
      "mosaic" in box.dataset,
    );
    one(box, ".intake-keep", HTMLInputElement).checked = this.#keeps;
    this.list = new PhotoList(box, {
      look: (photo) => this.look(photo),
      remove: (photo) => this.remove([photo]),
    });
    figure.addEventListener("figure-leave", () => this.#leave(), { once: true });
    figure.addEventListener("painted", () => {
      if (this.#keeps && this.#own.length > 0) keepSession(this.scene, figure);
      setTimeout(() => this.#showWork()); // the figure rests, or goes on
    });
    figure.addEventListener("figure-rest", () => setTimeout(() => this.#showWork()));
  }

  /** Whether the figure shows the reader's photographs in place of the book's. */
  get isUsed() {
    return this.#used.length > 0;
  }

  /** The names of the photographs that the figure has, or of those with these numbers. */
  names(numbers: number[] | null) {
    return this.#used
      .filter(({ number }) => numbers?.includes(number) ?? true)
      .map(({ name }) => name);
  }

  add(files: Iterable<File>) {
    this.remove(this.photos.filter(({ isSample }) => isSample));
    for (const file of files) {
      if (this.photos.some(({ name, file: { size } }) => name === file.name && size === file.size))
        this.#remark = words("instrument.twice", { name: file.name });
      else this.#take({ id: `${Date.now()}-${nextNumber()}`, name: file.name, file, ...WAITING });
    }
    return this.work();
  }

  /** Simulated photographs, which Python makes as they are read. */
  addSamples() {
    for (const name of JSON.parse(this.box.dataset.samples ?? "[]")) {
      this.#take({ id: name, name, file: new Blob(), isSample: true, ...WAITING });
    }
    return this.work();
  }

  /** Photographs that were kept, with the settings that they were measured with. */
  async restore() {
    this.#keeps = true;
    one(this.box, ".intake-keep", HTMLInputElement).checked = true;
    try {
      for (const photo of await keptPhotos(this.scene)) this.#take(photo);
    } catch {
      this.#stopKeeping(words("instrument.not_kept"));
      return;
    }
    restoreSession(this.scene, this.figure);
    this.#use();
    await this.work();
  }

  /** Read what waits, until it is done or stopped. */
  async work() {
    this.#isStopped = false;
    if (this.#isWorking) return;
    this.#isWorking = true;
    for (let photo = this.#next; photo && !this.#isStopped; photo = this.#next) {
      await this.#read(photo);
    }
    this.#isWorking = false;
    this.#reader.close();
    this.#showWork();
  }

  stop() {
    this.#isStopped = true;
    this.#reader.close();
    this.#showWork();
  }

  look(photo: Photo | null) {
    this.chosen = photo;
    this.#use();
  }

  remove(photos: Photo[]) {
    this.#remark = "";
    this.photos = this.photos.filter((photo) => !photos.includes(photo));
    for (const photo of photos) this.list.remove(photo);
    if (this.chosen && photos.includes(this.chosen)) this.chosen = null;
    if (this.#own.length === 0) remember(keyOf(this.scene), null);
    if (this.#keeps && photos.length > 0)
      erase(photos).catch(() => this.#stopKeeping(words("instrument.not_kept")));
    if (photos.some(({ state }) => state === "reading")) this.#reader.close();
    this.#use();
  }

  /** Keep all photographs on this device from now on, or none any more. */
  async keep(wanted: boolean) {
    this.#keeps = wanted;
    remember(WANTED, wanted ? null : false);
    if (wanted) {
      keepSession(this.scene, this.figure);
      await this.#keep(this.photos);
    } else {
      remember(keyOf(this.scene), null);
      await erase(this.photos).catch(() => {}); // there are none
    }
    this.#showWork();
  }

  get #next() {
    return this.photos.find(({ state }) => state === "waiting");
  }

  get #own() {
    return this.photos.filter(({ isSample }) => !isSample);
  }

  get #used() {
    const ready = this.photos.filter(({ state }) => state === "ready");
    return "reads" in this.box.dataset ? ready : ready.filter((photo) => photo === this.chosen);
  }

  #take(photo: Omit<Photo, "number">) {
    const taken: Photo = { ...photo, number: nextNumber() };
    this.photos.push(taken);
    this.list.show(taken);
    this.#keep([taken]);
  }

  async #read(photo: Photo) {
    photo.state = "reading";
    this.#showWork();
    this.list.show(photo);
    try {
      await this.#reader.read(photo, (said) => {
        if (this.photos.includes(photo)) this.list.show(photo, said);
      });
    } catch (error) {
      photo.state = "waiting";
      if (!(error instanceof ReaderEnded)) throw error;
      if (error.message !== closed().message) {
        this.#isStopped = true;
        this.#remark = error.message;
      }
    }
    if (!this.photos.includes(photo)) return;
    this.list.show(photo);
    this.#keep([photo]);
    this.#use();
  }

  /** Measure with what another instrument found, JSON, or with nothing: "". */
  useFile(given: string) {
    if (given === this.#given) return;
    this.#given = given;
    this.#givenNumber = nextNumber();
    this.#use();
  }

  /** Give the figure what is ready; the first that is, is looked at. */
  #use() {
    this.chosen ??= this.photos.find(({ state }) => state === "ready") ?? null;
    this.list.mark(this.chosen);
    const readings = this.#used.map(({ number, name, data }) => ({ number, name, data }));
    const isRead = "reads" in this.box.dataset;
    const given = this.#given && {
      number: this.#givenNumber,
      name: "given",
      data: JSON.parse(this.#given),
    };
    this.figure.live?.own.use(this.chosen, isRead ? readings : given ? [given] : []);
    if (isRead) this.#showCount(readings.length);
    if (this.figure.dataset.state === "waiting" && this.photos.length) this.figure.begin();
    this.#showWork();
  }

  /** A control that counts photographs follows them, unless the reader has chosen fewer. */
  #showCount(count: number) {
    const { form, controls } = settingsOf(this.figure);
    const field = form.querySelector(named("photographs"));
    if (!(field instanceof HTMLInputElement)) return;
    const [now, most] = [Number(field.value), Number(field.max)];
    const all = count ? Math.min(Math.max(count, Number(field.min)), most) : most;
    if (all !== now && (now > all || now === this.#counted)) {
      moveControls(form, controls, { photographs: all }, "change");
    }
    this.#counted = all;
  }

  async #keep(photos: Photo[]) {
    const own = photos.filter(({ isSample }) => !isSample);
    if (!this.#keeps || own.length === 0) return;
    try {
      await keep(this.scene, own, this.photos);
    } catch (error) {
      const isFull = error instanceof DOMException && error.name === "QuotaExceededError";
      this.#stopKeeping(isFull ? words("instrument.full") : words("instrument.not_kept"));
    }
  }

  #stopKeeping(why: string) {
    this.#keeps = false;
    remember(keyOf(this.scene), null);
    one(this.box, ".intake-keep", HTMLInputElement).checked = false;
    this.#remark = why;
    this.#showWork();
  }

  #showWork() {
    const count = this.photos.length;
    const done = this.#done;
    const waits = done < count;
    this.box.toggleAttribute("data-unsaved", !this.#keeps && this.#own.length > 0);
    one(this.box, ".intake-foot", HTMLElement).hidden = count === 0;
    one(this.box, ".intake-foot label", HTMLElement).hidden = this.#own.length === 0;
    const trial = maybe(this.box, ".intake-try", HTMLElement);
    if (trial) trial.hidden = count > 0;
    one(this.box, ".intake-work", HTMLElement).hidden = !waits;
    const bar = one(this.box, "progress", HTMLProgressElement);
    [bar.max, bar.value] = [Math.max(count, 1), done];
    const goesOn = this.#isWorking && !this.#isStopped;
    one(this.box, ".intake-stop", HTMLElement).hidden = !goesOn;
    one(this.box, ".intake-go-on", HTMLElement).hidden = goesOn;
    const line = maybe(this.box, ".intake-said", HTMLElement);
    const said = [this.#state(count, waits && goesOn ? done + 1 : 0), this.#remark];
    if (line) setText(line, said.filter(Boolean).join(" "));
  }

  get #done() {
    return this.#count("ready") + this.#count("refused");
  }

  #count(wanted: State) {
    return this.photos.filter(({ state }) => state === wanted).length;
  }

  /** @param at The photograph that is read; 0 for none. */
  #state(count: number, at: number) {
    if (at) return words("instrument.progress", { at, count });
    if (this.#done < count) return words("instrument.stopped");
    if (this.isUsed && !this.figure.rests) return words("instrument.measuring");
    if (!count) return "";
    const [ready, refused] = [this.#count("ready"), this.#count("refused")];
    const said = words("instrument.ready_count", { ready, count });
    return refused ? `${said} ${words("instrument.refused_count", { count: refused })}` : said;
  }

  #leave() {
    this.#isStopped = true;
    this.#reader.close();
    for (const photo of this.photos.splice(0)) this.list.remove(photo);
  }
}

const WAITING = { state: "waiting", said: "", thumbnail: null, data: null } as const;
