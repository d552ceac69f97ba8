/**
 * A figure that measures the reader's photographs: it takes files in, has them read one after
 * another, and gives the figure what was found. Nothing leaves the device.
 */

import type { SimulationFigure } from "../figure/element.ts";
import { moveControls, named } from "../figure/controls.ts";
import { settingsOf } from "../figure/permalink.ts";
import { nextPictureNumber } from "../figure/photograph.ts";
import { findOptional, find } from "../page/dom.ts";
import { loadItem, saveItem } from "../page/storage.ts";
import { setText } from "../page/text.ts";
import { words } from "../page/words.ts";
import { closedFailure } from "../runtime/runtime.ts";
import {
  deletePhotos,
  savePhotos,
  saveSession,
  loadPhotos,
  type Photo,
  restoreSession,
  sessionKey,
  type State,
  KEEP_KEY,
} from "./photo_store.ts";
import { PhotoList } from "./list.ts";
import { Reader, ReadingEnded } from "./reader.ts";

export class Instrument {
  photos: Photo[] = [];
  chosen: Photo | null = null;
  #reader: Reader;
  #isWorking = false;
  #isStopped = false;
  /** A remark beside the state of the work, until photographs come or go. */
  #remark = "";
  #isKeeping = loadItem(KEEP_KEY) !== false;
  /** The number that the control for counting photographs followed last. */
  #counted = 0;
  #otherResult = "";
  #otherResultNumber = 0;
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
    find(box, ".intake-keep", HTMLInputElement).checked = this.#isKeeping;
    this.list = new PhotoList(box, {
      choose: (photo) => this.choose(photo),
      remove: (photo) => this.remove([photo]),
    });
    figure.addEventListener("figure-leave", () => this.#leave(), { once: true });
    figure.addEventListener("painted", () => {
      if (this.#isKeeping && this.#readerPhotos.length > 0) saveSession(this.scene, figure);
      setTimeout(() => this.#showProgress()); // the figure rests, or goes on
    });
    figure.addEventListener("figure-rest", () => setTimeout(() => this.#showProgress()));
  }

  /** Whether the figure shows the reader's photographs in place of the book's. */
  get isUsed() {
    return this.#usedPhotos.length > 0;
  }

  /** The names of the photographs that the figure has, or of those with these numbers. */
  names(numbers: number[] | null) {
    return this.#usedPhotos
      .filter(({ number }) => numbers?.includes(number) ?? true)
      .map(({ name }) => name);
  }

  add(files: Iterable<File>) {
    this.remove(this.photos.filter(({ isSample }) => isSample));
    for (const file of files) {
      if (this.photos.some(({ name, file: { size } }) => name === file.name && size === file.size))
        this.#remark = words("instrument.twice", { name: file.name });
      else
        this.#addPhoto({
          id: `${Date.now()}-${Math.random()}`,
          name: file.name,
          file,
          ...NEW_PHOTO,
        });
    }
    return this.work();
  }

  /** Simulated photographs, which Python makes as they are read. */
  addSamples() {
    for (const name of JSON.parse(this.box.dataset.samples ?? "[]")) {
      this.#addPhoto({ id: name, name, file: new Blob(), isSample: true, ...NEW_PHOTO });
    }
    return this.work();
  }

  /** Restore stored photographs, with the settings that they were measured with. */
  async restore() {
    this.#isKeeping = true;
    find(this.box, ".intake-keep", HTMLInputElement).checked = true;
    try {
      for (const photo of await loadPhotos(this.scene)) this.#addPhoto(photo);
    } catch {
      this.#stopKeeping(words("instrument.not_kept"));
      return;
    }
    restoreSession(this.scene, this.figure);
    this.#updateFigure();
    await this.work();
  }

  /** Read the photographs that wait, until all are read or the reader stops it. */
  async work() {
    this.#isStopped = false;
    if (this.#isWorking) return;
    this.#isWorking = true;
    for (let photo = this.#next; photo && !this.#isStopped; photo = this.#next) {
      await this.#read(photo);
    }
    this.#isWorking = false;
    this.#reader.close();
    this.#showProgress();
  }

  stop() {
    this.#isStopped = true;
    this.#reader.close();
    this.#showProgress();
  }

  choose(photo: Photo | null) {
    this.chosen = photo;
    this.#updateFigure();
  }

  remove(photos: Photo[]) {
    this.#remark = "";
    this.photos = this.photos.filter((photo) => !photos.includes(photo));
    for (const photo of photos) this.list.remove(photo);
    if (this.chosen && photos.includes(this.chosen)) this.chosen = null;
    if (this.#isKeeping && photos.length > 0)
      this.#delete(photos).catch(() => this.#stopKeeping(words("instrument.not_kept")));
    if (photos.some(({ state }) => state === "reading")) this.#reader.close();
    this.#updateFigure();
  }

  /** Keep all photographs on this device from now on, or none any more. */
  async setKeeping(wanted: boolean) {
    this.#isKeeping = wanted;
    saveItem(KEEP_KEY, wanted ? null : false);
    if (wanted) {
      saveSession(this.scene, this.figure);
      await this.#save(this.photos);
    } else {
      await this.#delete().catch(() => {}); // there are none
    }
    this.#showProgress();
  }

  get #next() {
    return this.photos.find(({ state }) => state === "waiting");
  }

  get #readerPhotos() {
    return this.photos.filter(({ isSample }) => !isSample);
  }

  get #usedPhotos() {
    const ready = this.photos.filter(({ state }) => state === "ready");
    return "reads" in this.box.dataset ? ready : ready.filter((photo) => photo === this.chosen);
  }

  #addPhoto(photo: Omit<Photo, "number">) {
    const taken: Photo = { ...photo, number: nextPictureNumber() };
    this.photos.push(taken);
    this.list.show(taken);
    this.#save([taken]);
  }

  async #read(photo: Photo) {
    photo.state = "reading";
    this.#showProgress();
    this.list.show(photo);
    try {
      await this.#reader.read(photo, (text) => {
        if (this.photos.includes(photo)) this.list.show(photo, text);
      });
    } catch (error) {
      photo.state = "waiting";
      if (!(error instanceof ReadingEnded)) throw error;
      if (error.message !== closedFailure().message) {
        this.#isStopped = true;
        this.#remark = error.message;
      }
    }
    if (!this.photos.includes(photo)) return;
    this.list.show(photo);
    this.#save([photo]);
    this.#updateFigure();
  }

  /** Measure with the result of another instrument, JSON, or without: "". */
  measureWith(given: string) {
    if (given === this.#otherResult) return;
    this.#otherResult = given;
    this.#otherResultNumber = nextPictureNumber();
    this.#updateFigure();
  }

  /** Give the figure the photographs that are ready, and view the first of them unless one is chosen. */
  #updateFigure() {
    this.chosen ??= this.photos.find(({ state }) => state === "ready") ?? null;
    this.list.mark(this.chosen);
    const readings = this.#usedPhotos.map(({ number, name, data }) => ({ number, name, data }));
    const isRead = "reads" in this.box.dataset;
    const given = this.#otherResult && {
      number: this.#otherResultNumber,
      name: "given",
      data: JSON.parse(this.#otherResult),
    };
    this.figure.live?.pictures.set(this.chosen, isRead ? readings : given ? [given] : []);
    if (isRead) this.#showCount(readings.length);
    if (this.figure.dataset.state === "waiting" && this.photos.length) this.figure.begin();
    this.#showProgress();
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

  async #save(photos: Photo[]) {
    const readerPhotos = photos.filter(({ isSample }) => !isSample);
    if (this.#isKeeping && loadItem(KEEP_KEY) === false) this.#stopKeeping(""); // by another tab
    if (!this.#isKeeping || readerPhotos.length === 0) return;
    try {
      await savePhotos(this.scene, readerPhotos, this.photos);
    } catch (error) {
      const isFull = error instanceof DOMException && error.name === "QuotaExceededError";
      this.#stopKeeping(isFull ? words("instrument.full") : words("instrument.not_kept"));
    }
  }

  /** Delete stored photographs, by default all; the settings too, once no tab has any. */
  async #delete(photos?: Photo[]) {
    if ((await deletePhotos(this.scene, photos)) === 0) saveItem(sessionKey(this.scene), null);
  }

  #stopKeeping(why: string) {
    this.#isKeeping = false;
    saveItem(sessionKey(this.scene), null);
    find(this.box, ".intake-keep", HTMLInputElement).checked = false;
    this.#remark = why;
    this.#showProgress();
  }

  #showProgress() {
    const count = this.photos.length;
    const done = this.#done;
    const waits = done < count;
    this.box.toggleAttribute("data-unsaved", !this.#isKeeping && this.#readerPhotos.length > 0);
    find(this.box, ".intake-foot", HTMLElement).hidden = count === 0;
    find(this.box, ".intake-foot label", HTMLElement).hidden = this.#readerPhotos.length === 0;
    const trial = findOptional(this.box, ".intake-try", HTMLElement);
    if (trial) trial.hidden = count > 0;
    find(this.box, ".intake-work", HTMLElement).hidden = !waits;
    const bar = find(this.box, "progress", HTMLProgressElement);
    [bar.max, bar.value] = [Math.max(count, 1), done];
    const isReading = this.#isWorking && !this.#isStopped;
    find(this.box, ".intake-stop", HTMLElement).hidden = !isReading;
    find(this.box, ".intake-go-on", HTMLElement).hidden = isReading;
    const line = findOptional(this.box, ".intake-status", HTMLElement);
    const text = [this.#statusText(count, waits && isReading ? done + 1 : 0), this.#remark];
    if (line) setText(line, text.filter(Boolean).join(" "));
  }

  get #done() {
    return this.#count("ready") + this.#count("refused");
  }

  #count(wanted: State) {
    return this.photos.filter(({ state }) => state === wanted).length;
  }

  /** @param at The photograph that is read; 0 for none. */
  #statusText(count: number, at: number) {
    if (at) return words("instrument.progress", { at, count });
    if (this.#done < count) return words("instrument.stopped");
    if (this.isUsed && !this.figure.rests) return words("instrument.measuring");
    if (!count) return "";
    const [ready, refused] = [this.#count("ready"), this.#count("refused")];
    const text = words("instrument.ready_count", { ready, count });
    return refused ? `${text} ${words("instrument.refused_count", { count: refused })}` : text;
  }

  #leave() {
    this.#isStopped = true;
    this.#reader.close();
    for (const photo of this.photos.splice(0)) this.list.remove(photo);
  }
}

const NEW_PHOTO = { state: "waiting", message: "", thumbnail: null, data: null } as const;
