/** The pixels of the reader's pictures, written where Python wants them. */

import { free } from "./free.ts";
import type { Picture } from "./messages.ts";

/** Rows that are drawn at a time: phones have no canvas as large as their photographs. */
const BAND = 512;

/** A picture that is drawn into an array of Python's: there is no room for it twice. */
export function drawable({ bitmap, ...about }: Picture) {
  return {
    ...about,
    draw(array: any) {
      const view = array.getBuffer("u8");
      try {
        draw(bitmap, view.data, about.width, about.height);
      } finally {
        view.release();
        bitmap.close();
      }
    },
  };
}

/**
 * Draw the middle of a picture, in the shape of `width` × `height`, scaled to that size, on white.
 *
 * @param pixels Filled, three bytes each, row by row.
 */
export function draw(bitmap: ImageBitmap, pixels: Uint8Array, width: number, height: number) {
  const canvas = new OffscreenCanvas(width, Math.min(height, BAND));
  const context = contextOf(canvas);
  if (!context) throw new Error("no canvas");
  const scale = Math.max(width / bitmap.width, height / bitmap.height);
  const [across, down] = [bitmap.width * scale, bitmap.height * scale];
  for (let first = 0; first < height; first += BAND) {
    const rows = Math.min(BAND, height - first);
    context.fillRect(0, 0, width, rows);
    context.drawImage(bitmap, (width - across) / 2, (height - down) / 2 - first, across, down);
    const { data } = context.getImageData(0, 0, width, rows);
    for (let from = 0, to = 3 * width * first; from < data.length; from += 4) {
      pixels[to++] = data[from];
      pixels[to++] = data[from + 1];
      pixels[to++] = data[from + 2];
    }
    free(data);
  }
  canvas.width = 0; // which frees it
}

/** White, and smooth where it is smaller than what is drawn. */
export function contextOf(canvas: OffscreenCanvas) {
  const context = canvas.getContext("2d", { alpha: false, willReadFrequently: true });
  if (!context) return null;
  context.imageSmoothingQuality = "high";
  context.fillStyle = "white";
  return context;
}
