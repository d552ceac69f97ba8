/** Raw files of cameras, decoded in a separate worker, which is fetched for the first of them. */

import { numeral, words } from "../page/words.ts";
import { free } from "../runtime/free.ts";
import type { Mosaic } from "../runtime/messages.ts";
import type { Developed } from "./libraw.ts";
import type { RawReply, RawRequest } from "./worker.ts";

interface RawPicture {
  bitmap: ImageBitmap;
  /** Width and height of the whole picture: the bitmap may be smaller. */
  full: [number, number];
  /** JSON. */
  facts: string;
  mosaic?: Mosaic;
}

/** Longest wait for a file, in milliseconds. */
const LIMIT = 120_000;
const MOST_MB = 140;
/** Whether the decoder has arrived once: the browser has a copy then. */
let isFetched = false;
/** Rows that are converted at a time: the page goes on answering. */
const BAND = 128;

/**
 * @param report Called with what takes time.
 * @returns null for a file that no decoder of raw files knows.
 * @throws {Error} With words for the reader.
 */
export async function openRaw(
  name: string,
  request: RawRequest,
  report: (text: string) => void,
): Promise<RawPicture | null> {
  const size = request.file.size / 1e6;
  if (size > MOST_MB) {
    throw new Error(
      words("photograph.large", { file: name, size: size.toFixed(0), most: MOST_MB }),
    );
  }
  const reply = await decodeInWorker(request, report, name);
  if ("picture" in reply) return { ...reply, bitmap: await bitmapOf(reply.picture) };
  const { fault, sizes } = reply;
  if (fault === "unknown") return null;
  throw new Error(words(REFUSALS[fault], { file: name, ...sizes }));
}

const REFUSALS = {
  no_decoder: "raw.no_decoder",
  damaged: "raw.damaged",
  huge: "photograph.huge",
};

type Last = Exclude<RawReply, { fetching: number }>;

function decodeInWorker(
  request: RawRequest,
  report: (text: string) => void,
  name: string,
): Promise<Last> {
  const worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
  const answer = new Promise<Last>((resolve, reject) => {
    worker.onmessage = ({ data }: MessageEvent<RawReply>) => {
      if (!("fetching" in data)) resolve(data);
      else if (data.fetching && !isFetched) {
        isFetched = true;
        const size = (data.fetching / 1e6).toFixed(1);
        report(words("raw.fetching", { size: numeral(size) }));
      }
    };
    worker.onerror = () => resolve({ fault: "no_decoder", sizes: {} });
    setTimeout(() => reject(new Error(words("instrument.late", { name }))), LIMIT);
    worker.postMessage(request);
  });
  return answer.finally(() => worker.terminate());
}

async function bitmapOf({ width, height, colors, data }: Developed): Promise<ImageBitmap> {
  const picture = new ImageData(width, height);
  const pixels = picture.data;
  for (let first = 0; first < height; first += BAND) {
    const end = width * Math.min(height, first + BAND);
    for (let pixel = width * first; pixel < end; pixel++) {
      for (let k = 0; k < 3; k++) {
        pixels[4 * pixel + k] = data[colors * pixel + (colors < 3 ? 0 : k)];
      }
      pixels[4 * pixel + 3] = 255;
    }
    await new Promise((resolve) => setTimeout(resolve));
  }
  free(data);
  const bitmap = await createImageBitmap(picture);
  free(pixels);
  return bitmap;
}
