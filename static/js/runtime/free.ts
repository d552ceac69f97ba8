/** Give the memory of an array back at once, and not with a garbage collection some time later. */
export function free({ buffer }: ArrayBufferView<ArrayBuffer>) {
  buffer.transfer?.(0); // older browsers lack it
}
