/**
 * Leaves a worker nothing that reaches the network, the storage of the browser, other workers or the
 * page: Python's `js` is the worker's global scope, and a reader may run any Python. What the worker's
 * own modules need of these they have taken before, where no Python finds it.
 */

/** Names that stay: those of ECMAScript, and of what only computes. */
const ALLOWED = new Set(
  `globalThis self Infinity NaN undefined Object Boolean Symbol Number BigInt Math Date String RegExp
  Array Map Set WeakMap WeakSet WeakRef FinalizationRegistry Iterator Promise Proxy Reflect JSON Intl
  Error AggregateError EvalError RangeError ReferenceError SyntaxError TypeError URIError DOMException
  ArrayBuffer SharedArrayBuffer DataView Atomics Int8Array Uint8Array Uint8ClampedArray Int16Array
  Uint16Array Int32Array Uint32Array BigInt64Array BigUint64Array Float16Array Float32Array
  Float64Array parseFloat parseInt isFinite isNaN decodeURI decodeURIComponent encodeURI
  encodeURIComponent WebAssembly console crypto performance TextDecoder TextEncoder OffscreenCanvas
  ImageData queueMicrotask structuredClone`.split(/\s+/),
);

/** Functions whose constructors compile text, which may import a script from anywhere. */
const FUNCTIONS = [() => {}, async () => {}, function* () {}, async function* () {}];

/** In place of `Function`, which Pyodide needs for `instanceof`. */
function Uncallable() {
  throw new TypeError("text is not compiled here");
}
Uncallable.prototype = Function.prototype;

/** Whether the worker runs a reader's Python, under the policy of its page. */
const isConfined = self.location.protocol === "blob:";

/** @throws {Error} Where something stays that should not, and a reader's Python would run. */
export function isolate() {
  const left: string[] = [];
  let scope: object | null = globalThis;
  for (; scope && scope !== Object.prototype; scope = Object.getPrototypeOf(scope)) {
    for (const name of Object.getOwnPropertyNames(scope)) {
      const { get, value } = Object.getOwnPropertyDescriptor(scope, name) ?? {};
      const isConstant = !get && Object(value) !== value;
      if (ALLOWED.has(name) || isConstant) continue;
      if (!Reflect.deleteProperty(scope, name)) left.push(name);
    }
  }
  for (const made of FUNCTIONS) {
    const kind = Object.getPrototypeOf(made);
    if (!Reflect.deleteProperty(kind, "constructor")) left.push("constructor");
  }
  Object.assign(globalThis, { Function: Uncallable });
  if (isConfined && left.length > 0) throw new Error(`the worker keeps ${left.join(", ")}`);
}
