/**
 * The worker's calls: each is named, typed and timed here, for the worker and for those who ask it.
 * A request is `{id, call, ...}`; its answer `{id, ok: true, ...}` or `{id, ok: false, error, fatal,
 * loadError}`. While the worker waits for a download it sends `{id, fetching: true}`, then `false`.
 */

/**
 * A frame: of which figure and scene, at which control values (as JSON), by which tier.
 *
 * @typedef {{figure: string, scene: string, values: string, tier: string}} FrameRequest
 * @typedef {{meta: string, rasters: ArrayBuffer[], computeMs: number}} FrameReply `meta`: the frame
 *   as JSON; `rasters`: the pixels of its panels, transferred.
 */

/**
 * What the interpreter starts from.
 *
 * @typedef {object} StartRequest
 * @property {string} url Absolute address of the runtime folder.
 * @property {string} [table] Hash of `runtime.json`.
 * @property {string[]} scenes Whose chunks are fetched meanwhile.
 * @property {boolean} [cached] Whether the browser may hold copies of the files.
 * @property {boolean} [fresh] Whether these may be damaged.
 */

/**
 * What each call takes.
 *
 * @typedef {object} Requests
 * @property {StartRequest} start Start the interpreter, unless it is on its way.
 * @property {{figure?: string, scene: string}} prepare Import a scene; answers the hash of the sources.
 * @property {FrameRequest} render
 * @property {FrameRequest & {edits: string}} renderEdited As `render`, by the reader's own code.
 * @property {FrameRequest & {handle: string, x: number, y: number}} pull The control values that bring
 *   a handle to a place of its panel.
 * @property {FrameRequest & {edits?: string}} error The next estimate of a frame's error, if any.
 * @property {FrameRequest & {conditions: string[]}} judge Index of the first condition that holds.
 * @property {{scene: string, values: string, tier: string, notes: string}} script A script that prints
 *   what a frame shows, with `notes`, JSON of paragraphs, at its top.
 * @property {{figure: string, number: number, pixels?: Uint8ClampedArray, width?: number, height?:
 *   number}} photograph The reader's picture for a figure; without pixels, the book's again.
 * @property {{figure: string}} forget Drop what is cached for a figure.
 * @property {{ladder: string, tier: string, budget: number}} measure Time and error of a tier.
 */

/**
 * What each call answers.
 *
 * @typedef {object} Replies
 * @property {{}} start
 * @property {{sources: string}} prepare
 * @property {FrameReply} render
 * @property {FrameReply & {problem: any, printed: string}} renderEdited
 * @property {{values: Record<string, number | string | boolean>}} pull
 * @property {{estimate: {label: string, text: string, unit: string} | null}} error
 * @property {{met: number | null}} judge
 * @property {{script: string}} script
 * @property {{}} photograph
 * @property {{}} forget
 * @property {{result: string}} measure
 */

/** @typedef {keyof Requests} CallName */

/**
 * Longest wait for an answer, in milliseconds: on a slow machine, too. Downloads count as starting.
 *
 * @type {Record<CallName, number>}
 */
export const TIMEOUTS = {
  start: 300_000,
  prepare: 60_000,
  render: 60_000,
  renderEdited: 60_000,
  pull: 60_000,
  error: 60_000,
  judge: 60_000,
  script: 60_000,
  photograph: 60_000,
  forget: 60_000,
  measure: 120_000,
};

/** Longest that a frame by a reader's own code may take: milliseconds, or times the book's own. */
export const EDITED = { ms: 5000, times: 10 };
