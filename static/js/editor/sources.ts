/** The Python of a scene, as written by the build; fetched when a reader first opens it. */

import type { Stage } from "../figure/stage_report.ts";

interface Definition {
  /** File of the project. */
  path: string;
  /** Its first line there. */
  line: number;
  text: string;
  /** Hash of the text. */
  hash: string;
  /** Keys of the definitions that it names. */
  uses: string[];
}

export interface Sources {
  /** Key of the function that draws. */
  draw: string;
  stages: { name: string; definition: string }[];
  /** Key of the function that the figure is about, or empty. */
  formula: string;
  /** By key, `MODULE:NAME`. */
  definitions: Record<string, Definition>;
}

export async function fetchSources(scene: string): Promise<Sources> {
  const reply = await fetch(new URL(`../../python/${scene}.json`, import.meta.url));
  if (!reply.ok) throw new Error(`${reply.url}: ${reply.status}`);
  return await reply.json();
}

/** The name that a key ends in. */
export function nameOf(key: string) {
  return key.slice(key.indexOf(":") + 1);
}

/**
 * The part to open first: the formula; else the first stage that was computed for the frame that is
 * shown; else the function that draws.
 */
export function firstPart({ stages, draw, formula }: Sources, shown: Stage[]) {
  if (formula) return formula;
  const done = new Set(shown.filter(({ status }) => status === "computed").map(({ name }) => name));
  return stages.find(({ name, definition }) => definition && done.has(name))?.definition ?? draw;
}
