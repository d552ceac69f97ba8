/** The Python of a scene, as the build wrote it down; fetched when a reader first asks for it. */

/** @import { Stage } from "../figure/stage_report.js" */
/**
 * @typedef {object} Definition
 * @property {string} path File of the project.
 * @property {number} line Its first line there.
 * @property {string} text
 * @property {string} hash Of the text.
 * @property {string[]} uses Keys of the definitions that it names.
 */
/**
 * @typedef {object} Sources
 * @property {string} draw Key of the function that draws.
 * @property {{name: string, definition: string}[]} stages
 * @property {Record<string, Definition>} definitions By key, `MODULE:NAME`.
 */

/**
 * @param {string} scene
 * @returns {Promise<Sources>}
 */
export async function fetchSources(scene) {
  const reply = await fetch(new URL(`../../python/${scene}.json`, import.meta.url));
  if (!reply.ok) throw new Error(`${reply.url}: ${reply.status}`);
  return await reply.json();
}

/**
 * The name that a key ends in.
 *
 * @param {string} key
 */
export function nameOf(key) {
  return key.slice(key.indexOf(":") + 1);
}

/**
 * The part to open first: the first stage that was computed for the frame that is shown; else what
 * draws.
 *
 * @param {Sources} sources
 * @param {Stage[]} shown
 */
export function firstPart({ stages, draw }, shown) {
  const done = new Set(shown.filter(({ status }) => status === "computed").map(({ name }) => name));
  return stages.find(({ name, definition }) => definition && done.has(name))?.definition ?? draw;
}
