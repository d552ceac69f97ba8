/**
 * A reader's own picture: decoded in the page, cut to the size that a scene computes with, and
 * handed to Python. It is kept nowhere and sent nowhere.
 */

import { words } from "../page/words.ts";

export interface Photograph {
  number: number;
  pixels: Uint8ClampedArray;
  width: number;
  height: number;
  /** Whether only its middle is shown, as its shape is another. */
  cropped: boolean;
}

/** Larger files, and pictures of more pixels, are refused before they fill the memory. */
const LARGEST_MB = 60;
const LARGEST_MEGAPIXELS = 120;
/** How much of a side may be cut off without a word. */
const UNSEEN = 0.01;
/** A side of fewer pixels shows nothing worth a lens. */
const SMALLEST_PX = 16;

let pictures = 0;

/**
 * The middle of a picture, in the shape of `width` × `height`, scaled to that size.
 *
 * @throws {Error} With words for the reader: what is wrong, and what would do.
 */
export async function decode(file: File, width: number, height: number): Promise<Photograph> {
  const mb = file.size / 1e6;
  if (mb > LARGEST_MB) {
    const sizes = { size: mb.toFixed(0), most: LARGEST_MB };
    throw new Error(words("photograph.large", { file: file.name, ...sizes }));
  }
  const bitmap = await createImageBitmap(file).catch(() => {
    throw new Error(words("photograph.unreadable", { file: file.name }));
  });
  try {
    refuseSize(file.name, bitmap);
    const shapes = (bitmap.width * height) / (bitmap.height * width);
    const cropped = Math.abs(Math.log(shapes)) > UNSEEN;
    return { number: ++pictures, pixels: cut(bitmap, width, height), width, height, cropped };
  } finally {
    bitmap.close();
  }
}

function refuseSize(name: string, { width, height }: ImageBitmap) {
  const size = { file: name, width, height };
  if (Math.min(width, height) < SMALLEST_PX) {
    throw new Error(words("photograph.small", { ...size, least: SMALLEST_PX }));
  }
  if (width * height > LARGEST_MEGAPIXELS * 1e6) {
    throw new Error(words("photograph.huge", { ...size, most: LARGEST_MEGAPIXELS }));
  }
}

function cut(bitmap: ImageBitmap, width: number, height: number) {
  const canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext("2d");
  if (!context) throw new Error(words("photograph.no_canvas"));
  const scale = Math.max(width / bitmap.width, height / bitmap.height);
  const [across, down] = [bitmap.width * scale, bitmap.height * scale];
  context.imageSmoothingQuality = "high";
  context.drawImage(bitmap, (width - across) / 2, (height - down) / 2, across, down);
  return context.getImageData(0, 0, width, height).data;
}
