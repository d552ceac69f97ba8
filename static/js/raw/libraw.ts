/** LibRaw in WebAssembly (the package `libraw-wasm`), without threads and without `eval`. */

import { unshare } from "./unshared.ts";
import { FunctionOfParts } from "./without_eval.ts";

/** The part of LibRaw that the book uses. */
export interface LibRaw {
  /** @throws For a file that it does not know. */
  open(file: Uint8Array, settings: Settings): void;
  metadata(full: boolean): Metadata;
  /** @throws For data that cannot be decoded. */
  imageData(): Developed | undefined;
  /** Called after `imageData`. */
  rawImageData(): Cells | undefined;
}

/** Names as in its `libraw_output_params_t`. */
export type Settings = Record<string, number | number[] | boolean>;

export interface Metadata {
  /** Width of the upright picture. */
  width: number;
  height: number;
  /** How it is made upright: from 5 on, width and height are exchanged. */
  flip: number;
  camera_make: string;
  camera_model: string;
  iso_speed: number;
  shutter: number;
  aperture: number;
  focal_len: number;
  /** The colour of each cell of a mosaic, two bits each; 9: of another mosaic; 0: none. */
  filters: number;
  cdesc: string;
  color_data: { maximum: number; cam_mul: number[] };
  lens: { Lens: string; FocalLengthIn35mmFormat: number };
}

export interface Developed {
  width: number;
  height: number;
  colors: number;
  data: Uint8Array<ArrayBuffer> | Uint16Array<ArrayBuffer>;
}

export interface Cells {
  raw_width: number;
  top_margin: number;
  left_margin: number;
  data: Uint16Array<ArrayBuffer>;
}

/** The decoder could not be loaded. */
export class DecoderMissing extends Error {}

/**
 * @param folder Absolute address of its files.
 * @param onSize Called with the bytes of its program that arrive, if the host sends their number.
 * @throws {DecoderMissing}
 */
export async function loadLibRaw(folder: string, onSize: (bytes: number) => void): Promise<LibRaw> {
  try {
    const reply = await fetch(`${folder}/libraw.wasm`);
    if (!reply.ok) throw new Error(`${reply.url}: ${reply.status}`);
    onSize(Number(reply.headers.get("content-length")));
    const [program, script] = await Promise.all([
      reply.arrayBuffer().then((bytes) => new Uint8Array(bytes)),
      import(`${folder}/libraw.js`),
    ]);
    const { LibRaw } = await start(script.default, program);
    return new LibRaw();
  } catch (error) {
    throw new DecoderMissing(String(error));
  }
}

function start(create: (module: object) => Promise<any>, program: Uint8Array<ArrayBuffer>) {
  const scope = globalThis as any;
  scope.Function = FunctionOfParts;
  Reflect.deleteProperty(Atomics, "waitAsync"); // which needs shared memory
  const wasmMemory = unshare(program);
  return new Promise<any>((resolve, reject) => {
    const instantiateWasm = (imports: WebAssembly.Imports, done: (...made: unknown[]) => void) => {
      WebAssembly.instantiate(program, imports).then(
        ({ instance, module }) => done(instance, module),
        reject,
      );
      return {};
    };
    const silent = () => {};
    create({ wasmMemory, instantiateWasm, print: silent, printErr: silent }).then(resolve, reject);
  });
}
