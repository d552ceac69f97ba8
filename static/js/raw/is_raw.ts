/** Which files are given to the decoder of raw files. */

/** Beginnings of files, as Latin-1. */
const BEGINNINGS = [
  /^II\*\0|^MM\0\*/, // TIFF: DNG, CR2, NEF, ARW, PEF, SRW, …
  /^IIU\0/, // Panasonic RW2
  /^IIR[OS]|^MMOR/, // Olympus ORF
  /^FUJIFILMCCD-RAW/,
  /^....ftypcrx /s, // Canon CR3
  /^II.{4}HEAPCCDR/s, // Canon CRW
  /^FOVb/, // Sigma X3F
  /^\0MRM/, // Minolta MRW
];

/** Judged by content, as names are often wrong. */
export async function isRaw(file: Blob): Promise<boolean> {
  const head = new Uint8Array(await file.slice(0, 16).arrayBuffer());
  const text = String.fromCharCode(...head);
  return BEGINNINGS.some((beginning) => beginning.test(text));
}
