/** The cells of a Bayer mosaic: their codes, colours, and levels of black and white. */

import type { Mosaic } from "../runtime/messages.ts";
import type { Cells, Developed, Metadata } from "./libraw.ts";

/**
 * LibRaw's settings for developing a mosaic so that its levels can be measured: each quad one pixel of four
 * colours, black subtracted and nothing else done.
 */
export const LINEAR = {
  halfSize: 1,
  fourColorRgb: 1,
  noAutoScale: 1,
  noAutoBright: 1,
  adjustMaximumThr: 0,
  outputColor: 0,
  outputBps: 16,
  gamm: [1, 1, 0, 0, 0, 0],
  userFlip: 0,
};
/** Quads sampled for the level of black. */
const SAMPLES = 1000;
/** Longer side of the picture that stands for the mosaic. */
const PICTURE_PX = 1200;

/** Whether colours repeat every two rows and two columns. */
export function isBayer({ filters }: Metadata) {
  return filters > 255 && filters === ((filters & 255) * 0x01010101) >>> 0;
}

/** Index of the colour of a cell in `cdesc` (dcraw's `FC`). */
function colourOf({ filters }: Metadata, row: number, column: number) {
  return (filters >>> (((row & 7) * 2 + (column & 1)) * 2)) & 3;
}

/**
 * The sensor's mosaic, however the camera was held.
 *
 * @param about As before developing.
 * @param linear Developed by `LINEAR`.
 */
export function mosaicOf(about: Metadata, cells: Cells, linear: Developed): Mosaic {
  const { cdesc, color_data } = about;
  const [width, height] = sensorSize(about);
  const codes = visible(cells, width, height);
  const quad = [0, 1, 2, 3].map((k) => [k >> 1, k & 1] as const);
  const colours = quad.map(([row, column]) => colourOf(about, row, column));
  const black = quad.map(([row, column], k) => {
    const place = (i: number, j: number) => (2 * i + row) * width + 2 * j + column;
    return levelOf(linear, colours[k], (i, j) => codes[place(i, j)]);
  });
  const levels = {
    colours: colours.map((k) => cdesc[k]).join(""),
    black,
    white: color_data.maximum,
  };
  return { codes, width, height, about: JSON.stringify(levels) };
}

function sensorSize({ width, height, flip }: Metadata) {
  return flip >= 5 ? [height, width] : [width, height];
}

/**
 * Whether the last row was not in the file: decoders fill it with one code for each of its two
 * colours. A code near white may be light.
 */
export function isCutOff(about: Metadata, { data, raw_width, top_margin, left_margin }: Cells) {
  const [width, height] = sensorSize(about);
  const first = (top_margin + height - 1) * raw_width + left_margin;
  const [even, odd] = data.slice(first, first + 2);
  const row = data.subarray(first, first + width);
  if (!row.every((code, at) => code === (at % 2 ? odd : even))) return false;
  const share = Math.max(even, odd) / about.color_data.maximum;
  return share < 0.5 || share > 1.5;
}

/** Without the margins of the sensor. */
function visible(
  { data, raw_width, top_margin, left_margin }: Cells,
  width: number,
  height: number,
) {
  const codes = new Uint16Array(width * height);
  for (let row = 0; row < height; row++) {
    const from = (row + top_margin) * raw_width + left_margin;
    codes.set(data.subarray(from, from + width), row * width);
  }
  return codes;
}

/**
 * What was subtracted of one of four colours: the median over quads where anything was left. LibRaw
 * puts the mean of neighbours in place of the zero of a bad cell.
 */
function levelOf(
  linear: Developed,
  colour: number,
  code: (i: number, j: number) => number | undefined,
) {
  const { width, height, colors, data } = linear;
  const step = Math.max(1, Math.floor((width * height) / SAMPLES));
  const levels: number[] = [];
  for (let quad = 0; quad < width * height; quad += step) {
    const left = data[colors * quad + colour];
    const whole = code(Math.floor(quad / width), quad % width);
    if (left > 0 && whole && whole >= left) levels.push(whole - left);
  }
  return levels.sort((one, other) => one - other)[levels.length >> 1] ?? 0;
}

/** A small picture of the mosaic, in the camera's colours with its balance. */
export function pictureOf({ color_data }: Metadata, linear: Developed): ImageData {
  const step = Math.max(1, Math.ceil(Math.max(linear.width, linear.height) / PICTURE_PX));
  const [width, height] = [linear.width, linear.height].map((side) => Math.floor(side / step));
  const { cam_mul, maximum } = color_data;
  const gains = [0, 1, 2].map((k) => (cam_mul[k] && cam_mul[1] ? cam_mul[k] / cam_mul[1] : 1));
  const picture = new ImageData(width, height);
  for (let to = 0; to < width * height; to++) {
    const from = step * (Math.floor(to / width) * linear.width + (to % width));
    gains.forEach((gain, k) => {
      const light = (gain * linear.data[linear.colors * from + k]) / maximum;
      picture.data[4 * to + k] = 255 * Math.min(light, 1) ** (1 / 2.2);
    });
    picture.data[4 * to + 3] = 255;
  }
  return picture;
}
