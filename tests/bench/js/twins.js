/**
 * The pictures of three figures in plain JavaScript, as written by hand: one loop over the pixels,
 * from data that Python computed once to the bytes of a canvas.
 */

/**
 * @typedef {{width: number, height: number}} Size
 * @typedef {Size & {marginX: number, marginY: number, focal: number, picture: Float32Array}} Room
 *   The pinhole picture in linear light, wider than the figure's by its margins.
 * @typedef {Size & {centreX: number, centreY: number, radius: number, albedo: number,
 *   backdrop: Uint8Array,
 *   wall: Float32Array}} Ball The wall behind the ball, as bytes and in linear light.
 * @typedef {Size & {cells: Float32Array}} Mosaic The signal of each cell in linear light; red cells
 *   are on even rows and columns, blue ones on odd.
 */

/** @param {number} light */
function encode(light) {
  if (light <= 0) return 0;
  if (light >= 1) return 255;
  return Math.round(255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * light ** (1 / 2.4) - 0.055));
}

/** Linear grey where the lens sends no light. */
const UNSEEN = [0.33, 0.34, 0.36];

/**
 * The room through a lens.
 *
 * @param {Room} room
 * @param {number} k1
 * @param {Uint8ClampedArray} rgba Where the bytes go.
 */
export function distortion({ width, height, marginX, marginY, focal, picture }, k1, rgba) {
  const [columns, rows] = [width + 2 * marginX, height + 2 * marginY];
  const fold = k1 < 0 ? Math.sqrt(-1 / (3 * k1)) : Infinity;
  const limit = k1 < 0 ? fold * (1 + k1 * fold * fold) : Infinity;
  const [middleX, middleY] = [0.5 * (width - 1), 0.5 * (height - 1)];
  for (let y = 0, at = 0; y < height; y += 1) {
    for (let x = 0; x < width; x += 1, at += 4) {
      const [across, down] = [x - middleX, y - middleY];
      const seen = Math.hypot(across, down) / focal;
      const cover = Math.min(Math.max((limit - seen) * focal + 0.5, 0), 1);
      let ideal = Math.min(seen, 0.999 * fold);
      for (let step = 0; step < 8; step += 1) {
        const square = ideal * ideal;
        ideal -= (ideal * (1 + k1 * square) - seen) / (1 + 3 * k1 * square);
        ideal = Math.min(ideal, 0.999999 * fold);
      }
      const scale = ideal / seen;
      const fromX = Math.min(Math.max(marginX + middleX + across * scale, 0), columns - 1.001);
      const fromY = Math.min(Math.max(marginY + middleY + down * scale, 0), rows - 1.001);
      const [left, top] = [Math.floor(fromX), Math.floor(fromY)];
      const [right, below] = [fromX - left, fromY - top];
      const first = 3 * (top * columns + left);
      const next = first + 3 * columns;
      for (let channel = 0; channel < 3; channel += 1) {
        const upper = picture[first + channel] * (1 - right) + picture[first + 3 + channel] * right;
        const lower = picture[next + channel] * (1 - right) + picture[next + 3 + channel] * right;
        const light = upper * (1 - below) + lower * below;
        rgba[at + channel] = encode(UNSEEN[channel] + cover * (light - UNSEEN[channel]));
      }
      rgba[at + 3] = 255;
    }
  }
}

/**
 * A matte ball before a wall.
 *
 * @param {Ball} ball
 * @param {number} angle Of the light, in degrees: 0 from the camera, 90 from the right.
 * @param {Uint8ClampedArray} rgba Where the bytes go.
 */
export function sphere(ball, angle, rgba) {
  const { width, height, centreX, centreY, radius, albedo, backdrop, wall } = ball;
  const [lightX, lightZ] = [Math.sin((angle * Math.PI) / 180), Math.cos((angle * Math.PI) / 180)];
  rgba.set(backdrop);
  for (let y = 0, at = 0; y < height; y += 1) {
    for (let x = 0; x < width; x += 1, at += 4) {
      const [across, up] = [x + 0.5 - centreX, centreY - y - 0.5];
      const distance = Math.hypot(across, up);
      const cover = Math.min(Math.max(radius - distance + 0.5, 0), 1);
      if (cover === 0) continue;
      const outer = Math.max(distance, radius);
      const depth = Math.sqrt(Math.max(radius * radius - distance * distance, 0));
      const light = albedo * Math.max((across * lightX + depth * lightZ) / outer, 0);
      for (let channel = 0; channel < 3; channel += 1) {
        const behind = wall[0.75 * at + channel];
        rgba[at + channel] = encode(cover === 1 ? light : behind + cover * (light - behind));
      }
    }
  }
}

/**
 * The mosaic with its missing colours interpolated, each from the two or four nearest cells that
 * have it. Beyond the border the cells are mirrored about those at the border.
 *
 * @param {Mosaic} mosaic
 * @param {string} method Others than the bilinear one draw nothing.
 * @param {Uint8ClampedArray} rgba Where the bytes go.
 */
export function demosaic({ width, height, cells }, method, rgba) {
  if (method !== "bilinear") return;
  for (let y = 0, at = 0; y < height; y += 1) {
    const row = y * width;
    const above = (y > 0 ? y - 1 : 1) * width;
    const below = (y < height - 1 ? y + 1 : height - 2) * width;
    for (let x = 0; x < width; x += 1, at += 4) {
      const left = x > 0 ? x - 1 : 1;
      const right = x < width - 1 ? x + 1 : width - 2;
      const own = cells[row + x];
      const level = (cells[row + left] + cells[row + right]) / 2;
      const upright = (cells[above + x] + cells[below + x]) / 2;
      const isGreen = (x + y) % 2 === 1;
      const upper = (cells[above + left] + cells[above + right]) / 2;
      const corners = (upper + (cells[below + left] + cells[below + right]) / 2) / 2;
      const inRow = isGreen ? level : own;
      const across = isGreen ? upright : corners;
      rgba[at] = encode(y % 2 === 0 ? inRow : across);
      rgba[at + 1] = encode(isGreen ? own : (level + upright) / 2);
      rgba[at + 2] = encode(y % 2 === 0 ? across : inRow);
      rgba[at + 3] = 255;
    }
  }
}
