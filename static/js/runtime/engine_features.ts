/** What an engine of WebAssembly does, as far as the snapshot depends on it. */

/** `(module (func (export "f")) (table (export "t") 1 funcref) (elem (i32.const 0) 0))` */
const SAME_FUNCTION = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 4, 1, 96, 0, 0, 3, 2, 1, 0, 4, 4, 1, 112, 0, 1, 7, 9, 2, 1, 102,
  0, 0, 1, 116, 1, 0, 9, 7, 1, 0, 65, 0, 11, 1, 0, 10, 4, 1, 2, 0, 11,
]);

/**
 * Whether a function is one object as export of a module and in its table. In WebKit it is two: the
 * linker of libraries then gives functions further places, and those in a snapshot are others.
 */
export function hasOneObjectPerFunction(): boolean {
  const { f, t } = new WebAssembly.Instance(new WebAssembly.Module(SAME_FUNCTION)).exports;
  return f === (t as WebAssembly.Table).get(0);
}
