/** One of the reader's photographs in an instrument. */

import type { Source } from "../figure/photograph.ts";

/** `ready`: decoded, and read where the scene reads; `refused`: `said` says why. */
export type State = "waiting" | "reading" | "ready" | "refused";

export interface Photo extends Source {
  /** In storage. */
  id: string;
  /** In Python. */
  number: number;
  state: State;
  said: string;
  thumbnail: Blob | null;
  /** What its scene keeps of it. */
  data: unknown;
}

/** Key in storage of the settings of a scene's figure whose photographs are kept. */
export function keyOf(scene: string) {
  return `instrument:${scene}`;
}
