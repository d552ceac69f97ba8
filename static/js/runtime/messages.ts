/**
 * The calls of the worker, each a row of one table, which the page and the worker share.
 * A request is `{id, call, ...}`; its answer `{id, ok: true, ...}` or `{id, ok: false, error, fatal,
 * loadError}`. While the worker waits for a download it sends `{id, fetching: true}`, then `false`.
 */

import { takeArray, takeEdited, takeFrame } from "./transfer.ts";

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
  /** JSON of what a raw file says of that, in place of its head. */
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

/** What is kept of a photograph: what its scene's `read` found. */
export type Reading = { number: number; name: string; data: unknown };

/** A function of `simulations.browser`. */
interface Call<Request, Reply> {
  /** Its arguments, in this order, by their names in the request. */
  takes: (keyof Request & string)[];
  /** Makes the reply of its result. */
  reply: (result: any) => Reply;
  /** Longest wait for an answer on a slow machine, in milliseconds. */
  limit: number;
  /** For its type alone. */
  request?: Request;
}

function call<Request, Reply>(
  takes: (keyof Request & string)[],
  reply: (result: any) => Reply,
  limit = 60_000,
): Call<Request, Reply> {
  return { takes, reply, limit };
}

const FRAME: (keyof FrameRequest)[] = ["figure", "scene", "values", "tier"];

export const CALLS = {
  /** Start the interpreter, unless it is starting. Downloads count as starting. */
  start: call<StartRequest, {}>([], () => ({}), 300_000),
  /** Import a scene; answers the hash of the sources. */
  prepare: call<{ figure?: string; scene: string }, { sources: string }>(["scene"], (sources) => ({
    sources,
  })),
  render: call<FrameRequest, FrameReply>(FRAME, takeFrame),
  /** The same by the reader's own code. */
  render_edited: call<
    FrameRequest & { edits: string },
    FrameReply & { problem: any; printed: string }
  >([...FRAME, "edits"], takeEdited),
  /** The control values that bring a handle to a place of its panel. */
  pull: call<
    FrameRequest & { handle: string; x: number; y: number },
    { values: Record<string, number | string | boolean> }
  >([...FRAME, "handle", "x", "y"], (values) => ({ values: JSON.parse(values) })),
  /** The next estimate of a frame's error, if any. */
  error: call<
    FrameRequest & { edits?: string },
    { estimate: { label: string; text: string; unit: string } | null }
  >([...FRAME, "edits"], (estimate) => ({ estimate: JSON.parse(estimate) })),
  /** Index of the first condition that holds. */
  judge: call<FrameRequest & { conditions: string[] }, { met: number | null }>(
    [...FRAME, "conditions"],
    (met) => ({ met: met ?? null }),
  ),
  /** A script that prints what a frame shows, with `notes`, JSON of paragraphs, at its top. */
  script: call<{ scene: string; values: string; tier: string; notes: string }, { script: string }>(
    ["scene", "values", "tier", "notes"],
    (script) => ({ script }),
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
  ),
  /** The text of one of a scene's files. */
  export: call<FrameRequest & { name: string }, { text: string }>([...FRAME, "name"], (text) => ({
    text,
  })),
  /** A photograph made anew at the settings of a figure: pixels of a canvas, transferred. */
  develop: call<FrameRequest & { picture: Picture }, { rasters: ArrayBuffer[] }>(
    [...FRAME, "picture"],
    (raster) => ({ rasters: [takeArray(raster)] }),
    120_000,
  ),
  /** The lines of the data sheet; `measured`: numbers of the photographs they are of, null for all. */
  sheet: call<FrameRequest, { lines: Readout[]; measured: number[] | null }>(FRAME, JSON.parse),
  /** Drop what is cached for a figure. */
  forget: call<{ figure: string }, {}>(["figure"], () => ({})),
  /** JSON of the time and error of a tier. */
  measure: call<{ ladder: string; tier: string; budget: number }, { result: string }>(
    ["ladder", "tier", "budget"],
    (result) => ({ result }),
    120_000,
  ),
};

export type CallName = keyof typeof CALLS;

/** What each call takes. */
export type Requests = {
  [Name in CallName]: (typeof CALLS)[Name] extends Call<infer Request, any> ? Request : never;
};

/** What each call answers. */
export type Replies = { [Name in CallName]: ReturnType<(typeof CALLS)[Name]["reply"]> };

/** Longest that a frame by a reader's own code may take: milliseconds, or times the book's own. */
export const EDITED = { ms: 5000, times: 10 };
