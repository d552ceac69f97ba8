/**
 * A reader's own picture: decoded in the page, cut to the size that a scene computes with, and
 * handed to Python. It is kept nowhere and sent nowhere.
 *
 * @typedef {{number: number, pixels: Uint8ClampedArray, width: number, height: number}} Photograph
 */

/** Larger files, and pictures of more pixels, are refused before they fill the memory. */
const LARGEST_MB = 60;
const LARGEST_MEGAPIXELS = 120;
/** A side of fewer pixels shows nothing worth a lens. */
const SMALLEST_PX = 16;

let pictures = 0;

/**
 * The middle of a picture, in the shape of `width` × `height`, scaled to that size.
 *
 * @param {File} file
 * @param {number} width
 * @param {number} height
 * @returns {Promise<Photograph>}
 * @throws {Error} With words for the reader: what is wrong, and what would do.
 */
export async function decode(file, width, height) {
  const mb = file.size / 1e6;
  if (mb > LARGEST_MB) {
    throw new Error(`“${file.name}” has ${mb.toFixed(0)} MB; up to ${LARGEST_MB} MB will do.`);
  }
  const bitmap = await createImageBitmap(file).catch(() => {
    throw new Error(`“${file.name}” is no picture that this browser can read; try JPEG or PNG.`);
  });
  try {
    refuseSize(file.name, bitmap);
    return { number: ++pictures, pixels: cut(bitmap, width, height), width, height };
  } finally {
    bitmap.close();
  }
}

/**
 * @param {string} name
 * @param {ImageBitmap} bitmap
 */
function refuseSize(name, { width, height }) {
  const size = `“${name}” has ${width} × ${height} pixels`;
  if (Math.min(width, height) < SMALLEST_PX) {
    throw new Error(`${size}; at least ${SMALLEST_PX} each way are needed.`);
  }
  if (width * height > LARGEST_MEGAPIXELS * 1e6) {
    throw new Error(`${size}; up to ${LARGEST_MEGAPIXELS} million will do.`);
  }
}

/**
 * @param {ImageBitmap} bitmap
 * @param {number} width
 * @param {number} height
 */
function cut(bitmap, width, height) {
  const canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext("2d");
  if (!context) throw new Error("This browser offers no canvas to read the picture from.");
  const scale = Math.max(width / bitmap.width, height / bitmap.height);
  const [across, down] = [bitmap.width * scale, bitmap.height * scale];
  context.imageSmoothingQuality = "high";
  context.drawImage(bitmap, (width - across) / 2, (height - down) / 2, across, down);
  return context.getImageData(0, 0, width, height).data;
}
