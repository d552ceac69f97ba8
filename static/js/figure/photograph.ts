/**
 * Pictures of the reader: decoded in the page, upright, at the size that a scene computes with,
 * for Python. They are sent nowhere.
 */

import { words } from "../page/words.ts";
import { isRaw } from "../raw/is_raw.ts";
import type { Mosaic, Picture } from "../runtime/messages.ts";
import { contextOf } from "../runtime/pixels.ts";

/** A file, and what it is called. */
export type Source = { name: string; file: Blob };

/** Width and height to which a picture is cut, or the most megapixels of one that is not. */
export type Size = [number, number] | number;

/** A file's picture, to be closed after use; of a raw file with the decoder's facts. */
interface DecodedPicture {
  bitmap: ImageBitmap;
  /** Before it was scaled down. */
  full: [width: number, height: number];
  facts?: string;
  mosaic?: Mosaic;
}

/** How to decode a file; a raw one into its cells, if they are wanted and there are any, or a picture of some megapixels. */
interface DecodeOptions {
  mosaic: boolean;
  megapixels: number;
  /** Whether the codes of a PNG are measured, so that a profile or gamma in it changes nothing. */
  measured: boolean;
  /** Reports what takes time. */
  report: (text: string) => void;
}

/** Larger files, and pictures of more pixels, are refused before they fill the memory. */
const LARGEST_MB = 60;
const LARGEST_MEGAPIXELS = 120;
/** How much of a side may be cut off without a word. */
const UNSEEN_CROP = 0.01;
/** A side of fewer pixels shows nothing worth a lens. */
const SMALLEST_PX = 16;
/** Bytes at the beginning of a file that hold the camera's facts of the picture. */
const HEAD = 1024 * 1024;
/** Longer side of a thumbnail. */
const THUMBNAIL_PX = 192;

let pictures = 0;
/** Ends when all acts of `runInTurn` have. */
let turn: Promise<unknown> = Promise.resolve();

/** A number that no other picture has. */
export function nextPictureNumber() {
  return ++pictures;
}

/** A picture at a scene's size, or an error with its reason and a remedy. */
export function decodePicture(
  source: Source,
  number: number,
  size: Size,
  mosaic: boolean = false,
): Promise<Picture> {
  const megapixels = typeof size === "number" ? size : (size[0] * size[1]) / 1e6;
  const measured = typeof size === "number";
  const wanted = { mosaic, megapixels, measured, report: () => {} };
  return runInTurn(
    async () => await toPicture(source, await decodeFile(source, wanted), number, size),
  );
}

/** A page opens, or reads, one picture after another: each takes much memory. */
export function runInTurn<T>(act: () => Promise<T>): Promise<T> {
  const done = turn.then(act);
  turn = done.catch(() => {});
  return done;
}

/** A file's picture, to be closed or sent away, or an error with words for the reader. */
export async function decodeFile(
  source: Source,
  { report, measured, ...wanted }: DecodeOptions,
): Promise<DecodedPicture> {
  const { name, file } = source;
  if (await isRaw(file)) {
    const { openRaw } = await import("../raw/raw_file.ts");
    const picture = await openRaw(name, { file, ...wanted }, report);
    if (picture) return picture;
    return await decodeByBrowser(source, "raw.unknown", measured); // some browsers know more kinds
  }
  return await decodeByBrowser(source, "photograph.unreadable", measured);
}

/** Decode by the browser itself. */
async function decodeByBrowser(
  { name, file }: Source,
  refusal: "raw.unknown" | "photograph.unreadable",
  measured: boolean,
): Promise<DecodedPicture> {
  const mb = file.size / 1e6;
  if (mb > LARGEST_MB) {
    const sizes = { size: mb.toFixed(0), most: LARGEST_MB };
    throw new Error(words("photograph.large", { file: name, ...sizes }));
  }
  const png = await sizeOfPng(file);
  const stated = png ?? (await statedSize(file));
  if (stated) refuseSize(name, stated);
  const coded = png && measured ? await withoutColours(file) : file;
  const bitmap =
    coded && (await createImageBitmap(coded, { imageOrientation: "from-image" }).catch(() => null));
  if (!bitmap) throw new Error(words(refusal, { file: name }));
  try {
    refuseSize(name, bitmap);
  } catch (error) {
    bitmap.close();
    throw error;
  }
  return { bitmap, full: [bitmap.width, bitmap.height] };
}

/** An open picture to be sent to Python, and what that must know of it. */
export async function toPicture(
  { name, file }: Source,
  { bitmap, full, facts, mosaic }: DecodedPicture,
  number: number,
  size: Size,
): Promise<Picture> {
  const [width, height] = typeof size === "number" ? sizeWithin(bitmap, size) : size;
  return {
    number,
    name,
    bitmap,
    width,
    height,
    full_width: full[0],
    full_height: full[1],
    head: new Uint8Array(await file.slice(0, HEAD).arrayBuffer()),
    facts,
    mosaic,
  };
}

/** Whether only the middle of a picture is shown, as its shape is another. */
export function isCropped({ width, height, full_width, full_height }: Picture) {
  return Math.abs(Math.log((full_width * height) / (full_height * width))) > UNSEEN_CROP;
}

/** A small JPEG of an open picture. */
export async function thumbnailOf(bitmap: ImageBitmap): Promise<Blob> {
  const scale = Math.min(1, THUMBNAIL_PX / Math.max(bitmap.width, bitmap.height));
  const sides = [bitmap.width, bitmap.height].map((side) => Math.max(1, Math.round(side * scale)));
  const canvas = new OffscreenCanvas(sides[0], sides[1]);
  const context = contextOf(canvas);
  if (!context) throw new Error(words("photograph.no_canvas"));
  context.drawImage(bitmap, 0, 0, sides[0], sides[1]);
  return await canvas.convertToBlob({ type: "image/jpeg", quality: 0.8 });
}

/**
 * The size that a file states before its pixels, which may be far more than its bytes; null where the
 * browser finds none. An image that is not shown is not decoded.
 */
async function statedSize(file: Blob) {
  const image = new Image();
  image.src = URL.createObjectURL(file);
  await new Promise((resolve) => {
    image.onload = image.onerror = resolve;
  });
  URL.revokeObjectURL(image.src);
  const { naturalWidth: width, naturalHeight: height } = image;
  return width && height ? { width, height } : null;
}

/** The same of a PNG, also of one that browsers refuse for its size. */
async function sizeOfPng(file: Blob) {
  const head = new DataView(await file.slice(0, 24).arrayBuffer());
  const isPng = head.byteLength === 24 && head.getBigUint64(0) === 0x89504e470d0a1a0an;
  return isPng ? { width: head.getUint32(16), height: head.getUint32(20) } : null;
}

/** Chunks of a PNG that say which light its codes mean (third edition, section 11.3.2). */
const COLOURS = ["cHRM", "cICP", "gAMA", "iCCP", "sRGB"];

/** Most bytes and chunks before the pixels of a PNG. */
const MOST_BEFORE_PIXELS = 8 * 1024 * 1024;
const MOST_CHUNKS = 1000;

/**
 * A PNG whose codes arrive as they are: WebKit converts them even if asked not to. Null where more
 * than the limits stands before the pixels.
 */
async function withoutColours(file: Blob) {
  const head = new DataView(await file.slice(0, MOST_BEFORE_PIXELS).arrayBuffer());
  const parts = [file.slice(0, 8)];
  let at = 8;
  for (let chunk = 0; chunk < MOST_CHUNKS && at + 8 <= head.byteLength; chunk += 1) {
    const kind = String.fromCharCode(...new Uint8Array(head.buffer, at + 4, 4));
    const end = kind === "IDAT" ? file.size : at + 12 + head.getUint32(at);
    if (!COLOURS.includes(kind)) parts.push(file.slice(at, end));
    if (kind === "IDAT") return new Blob(parts, { type: "image/png" });
    at = end;
  }
  return null;
}

function refuseSize(name: string, { width, height }: { width: number; height: number }) {
  const size = { file: name, width, height };
  if (Math.min(width, height) < SMALLEST_PX) {
    throw new Error(words("photograph.small", { ...size, least: SMALLEST_PX }));
  }
  if (width * height > LARGEST_MEGAPIXELS * 1e6) {
    throw new Error(words("photograph.huge", { ...size, most: LARGEST_MEGAPIXELS }));
  }
}

/** The picture's own size, unless that is too many pixels. */
function sizeWithin({ width, height }: ImageBitmap, most: number) {
  const scale = Math.min(1, Math.sqrt((most * 1e6) / (width * height)));
  return [Math.max(1, Math.floor(width * scale)), Math.max(1, Math.floor(height * scale))];
}
