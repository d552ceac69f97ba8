/** Frames and arrays, copied out of the interpreter's memory. */

import type { FrameReply } from "./messages.ts";

/** A frame, copied out of the interpreter's memory and released there; its time is not known here. */
export function copyFrame(frame: any): FrameReply {
  const { meta, rasters, sound } = frame;
  try {
    const indices = Array.from({ length: rasters.length }, (_, index) => index);
    const pixels = indices.map((index) => copyArray(rasters.get(index)));
    const taken = { meta, rasters: pixels, computeMs: 0 };
    return sound ? { ...taken, sound: copyArray(sound) } : taken;
  } finally {
    rasters.destroy();
    frame.destroy();
  }
}

/** A frame by edited code, or the mistake in it; `printed` is its output. */
export function copyEdited(edited: any): FrameReply & { problem: any; printed: string } {
  try {
    const { problem, printed, frame } = edited;
    const taken = frame ? copyFrame(frame) : { meta: "", rasters: [], computeMs: 0 };
    return { ...taken, problem: JSON.parse(problem), printed };
  } finally {
    edited.destroy();
  }
}

/** The bytes of an array. */
export function copyArray(array: any): ArrayBuffer {
  const view = array.getBuffer("u8");
  try {
    return view.data.slice().buffer;
  } finally {
    view.release();
    array.destroy();
  }
}
