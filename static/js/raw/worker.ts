/** Decodes one raw file. It ends afterwards, so that the browser has its memory back. */

import { LINEAR, isBayer, isCutOff, mosaicOf, pictureOf } from "./cells.ts";
import {
  DecoderMissing,
  loadLibRaw,
  type Developed,
  type LibRaw,
  type Metadata,
} from "./libraw.ts";
import { free } from "../runtime/free.ts";
import type { Mosaic } from "../runtime/messages.ts";

export interface RawRequest {
  file: Blob;
  /** Whether the codes of the cells are wanted, where they are a Bayer mosaic; else a picture. */
  mosaic: boolean;
  /** How many pixels the picture is wanted with. */
  megapixels: number;
}

/** Why a file is refused; a word of `script.raw`. */
type Fault = "no_decoder" | "unknown" | "damaged" | "huge";

export type RawReply =
  | { fetching: number }
  | { fault: Fault; sizes: Record<string, number> }
  | { picture: Developed; full: [number, number]; facts: string; mosaic?: Mosaic };

type Decoded = Extract<RawReply, { full: unknown }>;

class Refused extends Error {
  constructor(
    readonly fault: Fault,
    readonly sizes: Record<string, number> = {},
  ) {
    super(fault);
  }
}

const FOLDER = new URL("../../raw", import.meta.url).href;
const MOST_MEGAPIXELS = 120;
/** Larger pictures are developed at half their size, which takes a quarter of the memory. */
const MOST_IN_FULL = 60;
/** sRGB, with the camera's balance and no brighter than exposed: white is the sensor's. */
const AS_SHOT = {
  useCameraWb: 1,
  noAutoBright: 1,
  adjustMaximumThr: 0,
  outputBps: 8,
  outputColor: 1,
  gamm: [1 / 2.4, 12.92, 0, 0, 0, 0],
};

self.onmessage = async ({ data }: MessageEvent<RawRequest>) => {
  const answer = (reply: RawReply, transfer: Transferable[] = []) =>
    self.postMessage(reply, { transfer });
  try {
    const libraw = await loadLibRaw(FOLDER, (fetching) => answer({ fetching }));
    const reply = decode(libraw, new Uint8Array(await data.file.arrayBuffer()), data);
    const buffers = [reply.picture.data.buffer, reply.mosaic?.codes.buffer];
    answer(
      reply,
      buffers.filter((buffer) => buffer !== undefined),
    );
  } catch (error) {
    const other = error instanceof DecoderMissing ? "no_decoder" : "damaged";
    const { fault, sizes } = error instanceof Refused ? error : new Refused(other);
    answer({ fault, sizes });
  }
};

function decode(
  libraw: LibRaw,
  file: Uint8Array<ArrayBuffer>,
  { mosaic, megapixels }: RawRequest,
): Decoded {
  const about = openFile(libraw, file, mosaic ? LINEAR : {});
  const { width, height } = about;
  const pixels = (width * height) / 1e6;
  if (pixels > MOST_MEGAPIXELS) throw new Refused("huge", { width, height, most: MOST_MEGAPIXELS });
  const description = { full: [width, height] as [number, number], facts: factsOf(about) };
  const cells = mosaic && isBayer(about) ? cellsOf(libraw, about) : null;
  if (cells) return { ...description, ...cells };
  const half = pixels > MOST_IN_FULL || pixels / 4 >= megapixels;
  openFile(libraw, file, { ...AS_SHOT, halfSize: Number(half) });
  free(file);
  const picture = required(libraw.imageData(), "damaged");
  wholeCells(libraw, about);
  return { ...description, picture };
}

/** The cells that the file has, if any; some have developed colours only. */
function wholeCells(libraw: LibRaw, about: Metadata) {
  const cells = libraw.rawImageData();
  if (cells && isCutOff(about, cells)) throw new Refused("damaged");
  return cells;
}

function openFile(libraw: LibRaw, file: Uint8Array, settings: object): Metadata {
  try {
    libraw.open(file, settings as {});
  } catch {
    throw new Refused("unknown");
  }
  return libraw.metadata(true);
}

/** Cells of a file opened for `LINEAR`, if it has any. */
function cellsOf(libraw: LibRaw, about: Metadata) {
  const linear = required(libraw.imageData(), "damaged");
  const cells = wholeCells(libraw, about);
  if (!cells) return null;
  const { data, width, height } = pictureOf(about, linear);
  const picture = { width, height, colors: 4, data: new Uint8Array(data.buffer) };
  return { picture, mosaic: mosaicOf(about, cells, linear) };
}

function required<T>(value: T | undefined, fault: Fault): T {
  if (value === undefined) throw new Refused(fault);
  return value;
}

/** Orientation by EXIF of what LibRaw makes upright by a `flip`. */
const ORIENTATIONS: Record<number, number> = { 0: 1, 3: 3, 5: 8, 6: 6 };

/** Facts of a photograph, as in `simulations/engine/photograph.py`. */
function factsOf(about: Metadata) {
  const numbers = {
    exposure_s: about.shutter,
    f_number: about.aperture,
    iso: about.iso_speed,
    focal_mm: about.focal_len,
    focal_35mm_mm: about.lens.FocalLengthIn35mmFormat,
    orientation: ORIENTATIONS[about.flip],
    raw: 1,
  };
  const texts = { make: about.camera_make, model: about.camera_model, lens: about.lens.Lens };
  const known = Object.entries({ ...numbers, ...texts }).filter(([, value]) =>
    typeof value === "string" ? value : Number.isFinite(value) && value > 0,
  );
  return JSON.stringify(Object.fromEntries(known));
}
