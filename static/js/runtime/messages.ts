/**
 * The calls of the worker, each a row of one table, which the page and the worker share.
 * A request is `{id, call, ...}`; its answer `{id, ok: true, ...}` or `{id, ok: false, error, fatal,
 * loadError}`. Before that the worker sends `{id, waits}` when the request has arrived, and each second
 * in which it waits for a file, with the file's name. A worker that may fetch nothing itself sends
 * `{id, wants}` with the name of a chunk, and gets `{chunk, archive}` or `{chunk, loadError}`.
 */

import { copyArray, copyEdited, copyFrame } from "./transfer.ts";

/** A frame: of which figure and scene, at which control values (as JSON), by which tier. */
export type FrameRequest = { figure: string; scene: string; values: string; tier: string };

/** `meta`: the frame as JSON; `rasters`: the pixels of its panels, and `sound`: samples, transferred. */
export type FrameReply = {
  meta: string;
  rasters: ArrayBuffer[];
  sound?: ArrayBuffer;
  computeMs: number;
};

/** What the interpreter starts from. */
export interface StartRequest {
  /** Absolute address of the runtime folder. */
  url: string;
  /** Hash of `runtime.json`. */
  table?: string;
  /** Their chunks are fetched meanwhile. */
  scenes: string[];
  /** Whether the browser may hold copies of the files. */
  cached?: boolean;
  /** Whether these may be damaged. */
  fresh?: boolean;
  /** Whether to start without the snapshot. */
  plain?: boolean;
}

export type Readout = { name: string; label: string; text: string; unit: string; role: string };

/** A picture of the reader's, on its way to Python. */
export interface Picture {
  number: number;
  /** Name of its file. */
  name: string;
  /** Transferred; the worker draws and closes it. */
  bitmap: ImageBitmap;
  /** At which Python gets it. */
  width: number;
  height: number;
  /** Before it was scaled down. */
  full_width: number;
  full_height: number;
  /** First bytes of the file, where a camera says how it took the picture. */
  head: Uint8Array;
  /** JSON of the same facts in a raw file, in place of its head. */
  facts?: string;
  mosaic?: Mosaic;
}

/** The codes of a raw file, row by row. */
export interface Mosaic {
  codes: Uint16Array<ArrayBuffer>;
  width: number;
  height: number;
  /** JSON of the `colours` and levels of `black` of a quad's cells, and the level of `white`. */
  about: string;
}

/** The result of a scene's `read` for a photograph. */
export type Reading = { number: number; name: string; data: unknown };

/** A function of `simulations.browser`. */
interface Call<Request, Reply> {
  /** Its arguments, in this order, by their names in the request. */
  parameters: (keyof Request & string)[];
  /** Makes the reply of its result. */
  reply: (result: any) => Reply;
  /** What the page checks of the values in a reply. */
  values: Record<string, Check>;
  /** Longest silence of the worker on a slow machine, in milliseconds. */
  limit: number;
  /** For its type alone. */
  request?: Request;
}

function call<Request, Reply>(
  parameters: (keyof Request & string)[],
  reply: (result: any) => Reply,
  values: Record<string, Check> = {},
  limit = 60_000,
): Call<Request, Reply> {
  return { parameters, reply, values, limit };
}

const FRAME: (keyof FrameRequest)[] = ["figure", "scene", "values", "tier"];

/** Whether a value in a reply has the shape, the size and the range that the page can use. */
type Check = (value: any) => boolean;

const isText: Check = (value) => typeof value === "string" && value.length <= 20_000_000;
const isNumber: Check = Number.isFinite;
const isObject: Check = (value) => typeof value === "object" && value !== null;
const isOptional =
  (check: Check): Check =>
  (value) =>
    value == null || check(value);
const isListOf =
  (check: Check, most: number): Check =>
  (value) =>
    Array.isArray(value) && value.length <= most && value.every(check);
const isBuffer: Check = (value) => value instanceof ArrayBuffer;
const isScalar: Check = (value) => isNumber(value) || isText(value) || typeof value === "boolean";
const isMessage: Check = (value) => isText(value) || (isObject(value) && isText(value.key));
const isProblem: Check = ({ message, definition, line }) =>
  isMessage(message) && isText(definition) && Number.isInteger(line);

const isMiss: Check = ({ fault, call, got, expected, recognised, pictures }) =>
  [fault, call, got, expected].every(isText) &&
  Number.isInteger(recognised) &&
  isListOf(isObject, 2)(pictures);

const FRAME_VALUES = {
  meta: isText,
  rasters: isListOf(isBuffer, 100),
  sound: isOptional(isBuffer),
  computeMs: isNumber,
};

export const CALLS = {
  /** Start the interpreter, unless it is starting. */
  start: call<StartRequest, {}>([], () => ({})),
  /** Import a scene; answers the hash of the sources. */
  prepare: call<{ figure?: string; scene: string }, { sources: string }>(
    ["scene"],
    (sources) => ({ sources }),
    { sources: isOptional(isText) },
  ),
  render: call<FrameRequest, FrameReply>(FRAME, copyFrame, FRAME_VALUES),
  /** The same by edited code. */
  render_edited: call<
    FrameRequest & { edits: string },
    FrameReply & { problem: any; printed: string }
  >([...FRAME, "edits"], copyEdited, {
    ...FRAME_VALUES,
    problem: isOptional(isProblem),
    printed: isText,
  }),
  /** What a stage of an exercise finds in the reader's text. */
  exercise: call<
    { program: string; edits: string; stage: string; ladder: string },
    Record<string, unknown>
  >(["program", "edits", "stage"], JSON.parse, {
    printed: isText,
    problem: isOptional(({ message, line }) => isMessage(message) && Number.isInteger(line)),
    miss: isOptional(isMiss),
    yours: isOptional(isObject),
    tiers: isOptional(isListOf(isObject, 100)),
    trials: isOptional(isListOf(isObject, 1000)),
  }),
  /** The control values that bring a handle to a place of its panel. */
  pull: call<
    FrameRequest & { handle: string; x: number; y: number },
    { values: Record<string, number | string | boolean> }
  >([...FRAME, "handle", "x", "y"], (values) => ({ values: JSON.parse(values) }), {
    values: (values) => isObject(values) && Object.values(values).every(isScalar),
  }),
  /** The next estimate of a frame's error, if any. */
  error: call<
    FrameRequest & { edits?: string },
    { estimate: Pick<Readout, "name" | "label" | "text" | "unit"> | null }
  >([...FRAME, "edits"], (estimate) => ({ estimate: JSON.parse(estimate) }), {
    estimate: isOptional(({ name, label, text, unit }) => [name, label, text, unit].every(isText)),
  }),
  /** Index of the first condition that holds. */
  judge: call<FrameRequest & { conditions: string[] }, { met: number | null }>(
    [...FRAME, "conditions"],
    (met) => ({ met: met ?? null }),
    { met: isOptional(Number.isInteger) },
  ),
  /** A script that prints what a frame shows, with `notes`, JSON of paragraphs, at its top. */
  script: call<{ scene: string; values: string; tier: string; notes: string }, { script: string }>(
    ["scene", "values", "tier", "notes"],
    (script) => ({ script }),
    { script: isText },
  ),
  /** The reader's picture for a figure; null for the picture of the book. */
  photograph: call<{ figure: string; picture: Picture | null }, {}>(
    ["figure", "picture"],
    () => ({}),
  ),
  /** What was read of the reader's pictures, for a figure; none for the pictures of the book. */
  readings: call<{ figure: string; readings: Reading[] }, {}>(["figure", "readings"], () => ({})),
  /** What a scene finds in a photograph, or a sentence on why it cannot be used. */
  read: call<{ scene: string; picture: Picture }, { data?: unknown; unfit?: string }>(
    ["scene", "picture"],
    JSON.parse,
    { unfit: isOptional(isText) },
  ),
  /** PNG of one of a scene's samples. */
  sample: call<{ scene: string; name: string }, { rasters: ArrayBuffer[] }>(
    ["scene", "name"],
    (file) => ({ rasters: [copyArray(file)] }),
    { rasters: isListOf(isBuffer, 1) },
  ),
  /** The text of one of a scene's files. */
  export: call<FrameRequest & { name: string }, { text: string }>(
    [...FRAME, "name"],
    (text) => ({ text }),
    { text: isText },
  ),
  /** A photograph made anew at the settings of a figure: pixels of a canvas, transferred. */
  develop: call<FrameRequest & { picture: Picture }, { rasters: ArrayBuffer[] }>(
    [...FRAME, "picture"],
    (raster) => ({ rasters: [copyArray(raster)] }),
    { rasters: isListOf(isBuffer, 1) },
    120_000,
  ),
  /** The lines of the data sheet; `measured`: numbers of the photographs they are of, null for all. */
  sheet: call<FrameRequest, { lines: Readout[]; measured: number[] | null }>(FRAME, JSON.parse, {
    lines: isListOf(isObject, 1000),
    measured: isOptional(isListOf(isNumber, 10_000)),
  }),
  /** Drop what is cached for a figure. */
  forget: call<{ figure: string }, {}>(["figure"], () => ({})),
  /** JSON of the time and error of a tier. */
  measure: call<{ ladder: string; tier: string; budget: number }, { result: string }>(
    ["ladder", "tier", "budget"],
    (result) => ({ result }),
    { result: isText },
    120_000,
  ),
};

export type CallName = keyof typeof CALLS;

/** What the worker sends, once it is checked. */
type Signal =
  | { id: number; waits: string }
  | { id: number; wants: string }
  | { id: number; ok: true }
  | { id: number; ok: false; error: string; fatal: boolean; loadError?: any };

/** Whether data from a worker are a message of the protocol; `isReply` checks what a reply holds. */
export function isSignal(data: any): data is Signal {
  if (!isObject(data) || !Number.isInteger(data.id)) return false;
  const name = data.waits ?? data.wants;
  if (name !== undefined) return isText(name) && name.length <= 200;
  return data.ok === true || (data.ok === false && isText(data.error));
}

/** Whether a reply to a call has the values that the page takes from it. */
export function isReply(name: CallName, reply: Record<string, unknown>) {
  const values: Record<string, Check> = CALLS[name].values;
  return Object.entries(values).every(([key, check]) => check(reply[key]));
}

/** The request of each call. */
export type Requests = {
  [Name in CallName]: (typeof CALLS)[Name] extends Call<infer Request, any> ? Request : never;
};

/** The reply of each call. */
export type Replies = { [Name in CallName]: ReturnType<(typeof CALLS)[Name]["reply"]> };

/** Longest time of a frame by edited code: milliseconds, or a multiple of the book's time. */
export const EDITED_LIMIT = { ms: 5000, times: 10 };
