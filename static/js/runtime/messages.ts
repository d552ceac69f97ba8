/**
 * The worker's calls: each is named, typed and timed here, for the worker and for those who ask it.
 * A request is `{id, call, ...}`; its answer `{id, ok: true, ...}` or `{id, ok: false, error, fatal,
 * loadError}`. While the worker waits for a download it sends `{id, fetching: true}`, then `false`.
 */

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
  /** Whose chunks are fetched meanwhile. */
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
  /** Of its file. */
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

/** What each call takes. */
export interface Requests {
  /** Start the interpreter, unless it is on its way. */
  start: StartRequest;
  /** Import a scene; answers the hash of the sources. */
  prepare: { figure?: string; scene: string };
  render: FrameRequest;
  /** As `render`, by the reader's own code. */
  renderEdited: FrameRequest & { edits: string };
  /** The control values that bring a handle to a place of its panel. */
  pull: FrameRequest & { handle: string; x: number; y: number };
  /** The next estimate of a frame's error, if any. */
  error: FrameRequest & { edits?: string };
  /** Index of the first condition that holds. */
  judge: FrameRequest & { conditions: string[] };
  /** A script that prints what a frame shows, with `notes`, JSON of paragraphs, at its top. */
  script: { scene: string; values: string; tier: string; notes: string };
  /** The reader's picture for a figure; null: the book's again. */
  photograph: { figure: string; picture: Picture | null };
  /** What was read of the reader's pictures, for a figure; none: the book's again. */
  readings: { figure: string; readings: Reading[] };
  /** Find in a photograph what a scene keeps of it. */
  read: { scene: string; picture: Picture };
  /** The text of one of a scene's files. */
  exportFile: FrameRequest & { name: string };
  /** A photograph made anew at the settings of a figure. */
  develop: FrameRequest & { picture: Picture };
  /** The lines of the data sheet. */
  sheet: FrameRequest;
  /** Drop what is cached for a figure. */
  forget: { figure: string };
  /** Time and error of a tier. */
  measure: { ladder: string; tier: string; budget: number };
}

/** What each call answers. */
export interface Replies {
  start: {};
  prepare: { sources: string };
  render: FrameReply;
  renderEdited: FrameReply & { problem: any; printed: string };
  pull: { values: Record<string, number | string | boolean> };
  error: { estimate: { label: string; text: string; unit: string } | null };
  judge: { met: number | null };
  script: { script: string };
  photograph: {};
  readings: {};
  /** Or, in a sentence, why the photograph cannot be used. */
  read: { data?: unknown; unfit?: string };
  exportFile: { text: string };
  /** Pixels of a canvas, transferred. */
  develop: { rasters: ArrayBuffer[] };
  /** `measured`: numbers of the photographs that the lines are of; null: of all. */
  sheet: { lines: Readout[]; measured: number[] | null };
  forget: {};
  measure: { result: string };
}

export type CallName = keyof Requests;

/**
 * Longest wait for an answer, in milliseconds: on a slow machine, too. Downloads count as starting.
 */
export const TIMEOUTS: Record<CallName, number> = {
  start: 300_000,
  prepare: 60_000,
  render: 60_000,
  renderEdited: 60_000,
  pull: 60_000,
  error: 60_000,
  judge: 60_000,
  script: 60_000,
  photograph: 60_000,
  readings: 60_000,
  read: 60_000,
  exportFile: 60_000,
  develop: 120_000,
  sheet: 60_000,
  forget: 60_000,
  measure: 120_000,
};

/** Longest that a frame by a reader's own code may take: milliseconds, or times the book's own. */
export const EDITED = { ms: 5000, times: 10 };
