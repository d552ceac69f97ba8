/**
 * A program compiled for threads that starts none, made to run without them: only pages that are
 * isolated from all others may share memory between threads, and Safari gives none to the rest.
 */

const [IMPORTS, FUNCTION, TABLE, MEMORY, GLOBAL] = [2, 0, 1, 2, 3];
const SHARED = 2;

/**
 * Have a program import a memory that is not shared.
 *
 * @param program WebAssembly, changed in place: one bit (core specification, sections 5.3.4 and 5.5.5,
 *   and its proposal of threads).
 * @returns The memory to be imported.
 * @throws {Error} For a program that imports none.
 */
export function unshare(program: Uint8Array): WebAssembly.Memory {
  const reader = new Reader(program, 8); // after the magic number and the version
  while (reader.at < program.length) {
    const section = reader.byte();
    const end = reader.number() + reader.at;
    if (section === IMPORTS) return takeMemory(reader);
    reader.at = end;
  }
  throw new Error("the program imports no memory");
}

function takeMemory(reader: Reader): WebAssembly.Memory {
  for (let left = reader.number(); left > 0; left--) {
    reader.skip(reader.number());
    reader.skip(reader.number()); // module and name
    const kind = reader.byte();
    if (kind === MEMORY) {
      reader.bytes[reader.at] &= ~SHARED;
      reader.skip(1);
      return new WebAssembly.Memory({ initial: reader.number(), maximum: reader.number() });
    }
    if (kind === FUNCTION) reader.number();
    else if (kind === GLOBAL) reader.skip(2);
    else if (kind === TABLE) {
      reader.skip(1);
      const hasMost = reader.byte() & 1;
      for (let limits = 1 + hasMost; limits > 0; limits--) reader.number();
    } else break;
  }
  throw new Error("the program imports no memory");
}

class Reader {
  constructor(
    readonly bytes: Uint8Array,
    public at: number,
  ) {}

  byte() {
    return this.bytes[this.at++];
  }

  skip(count: number) {
    this.at += count;
  }

  /** LEB128, of 32 bits. */
  number() {
    let [value, shift, byte] = [0, 0, 0];
    do {
      byte = this.byte();
      value |= (byte & 127) << shift;
      shift += 7;
    } while (byte & 128);
    return value >>> 0;
  }
}
