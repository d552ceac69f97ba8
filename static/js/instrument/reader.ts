/**
 * Reads photographs one after another, in a separate interpreter: the figure goes on answering,
 * and when this one ends, the browser has its memory back.
 */

import { errorText } from "../errors.ts";
import { runInTurn, decodeFile, thumbnailOf, toPicture } from "../figure/photograph.ts";
import { words } from "../page/words.ts";
import { Runtime, RuntimeFailure, closedFailure } from "../runtime/runtime.ts";
import type { Photo } from "./photo_store.ts";

/** Larger photographs are scaled down before they are read. */
export const MOST_MEGAPIXELS = 24;

/** Python does not run, or was ended: the photographs can wait. */
export class ReadingEnded extends Error {}

export class Reader {
  #runtime: Runtime | null = null;
  /** How often it was ended. */
  #ends = 0;

  /**
   * @param url Absolute address of the runtime folder.
   * @param reads Whether the scene reads photographs, or only looks at them.
   * @param mosaic Whether it reads the cells of raw files.
   */
  constructor(
    readonly url: string,
    readonly scene: string,
    readonly reads: boolean,
    readonly mosaic: boolean,
  ) {}

  /** Have a photograph ready or refused, or throw `ReadingEnded`; `report` shows what takes time. */
  async read(photo: Photo, report: (text: string) => void) {
    const ends = this.#ends;
    try {
      await runInTurn(() => this.#read(photo, ends, report));
      photo.state = "ready";
    } catch (error) {
      photo.message = refusal(photo.name, error);
      photo.state = "refused";
    }
  }

  /** End the interpreter. */
  close() {
    this.#ends += 1;
    this.#runtime?.close();
    this.#runtime = null;
  }

  /** @param ends How often the interpreter had been ended when the photograph was to be read. */
  async #read(photo: Photo, ends: number, report: (text: string) => void) {
    if (photo.isSample && photo.file.size === 0) photo.file = await this.#sample(photo.name);
    const megapixels = this.reads ? MOST_MEGAPIXELS : 0;
    const wanted = { mosaic: this.mosaic, megapixels, measured: true, report };
    const opened = await decodeFile(photo, wanted);
    photo.thumbnail ??= await thumbnailOf(opened.bitmap);
    if (this.reads && ends === this.#ends) {
      const picture = await toPicture(photo, opened, photo.number, MOST_MEGAPIXELS);
      const { data, unfit } = await this.#started().call("read", { scene: this.scene, picture });
      if (unfit) throw new Error(unfit);
      photo.data = data;
    }
    opened.bitmap.close();
    if (ends !== this.#ends) throw closedFailure();
  }

  async #sample(name: string) {
    const { rasters } = await this.#started().call("sample", { scene: this.scene, name });
    return new Blob(rasters, { type: "image/png" });
  }

  #started() {
    this.#runtime ??= new Runtime(this.url, () => [this.scene]);
    return this.#runtime;
  }
}

/** Why a photograph cannot be used, in a sentence; `ReadingEnded` where it is not its fault. */
function refusal(name: string, error: unknown): string {
  if (!(error instanceof RuntimeFailure)) return errorText(error);
  if (error.late) return words("instrument.late", { name });
  const isItsOwn = error.kind === "python" || error.loadError === "memory";
  if (!isItsOwn) throw new ReadingEnded(error.message);
  return words("instrument.failed", { name, reason: error.message });
}
