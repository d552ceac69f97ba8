/**
 * Leaves a worker nothing that reaches the network, the storage of the browser, other workers or the
 * page: Python's `js` is the worker's global scope, and a reader may run any Python. What the worker's
 * own modules need of these they have taken before, where no Python finds it.
 *
 * Where a reader's Python runs, the objects of JavaScript itself are frozen as well, as `lockdown` of
 * SES does it, so that no Python takes part in what those modules do: a replaced
 * `Array.prototype[Symbol.iterator]` would.
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

/** Objects whose prototypes, which are JavaScript's own, are found under no name. */
const UNNAMED: object[] = [
  Uint8Array.prototype,
  ...[[], new Map(), new Set(), ""].map((each) => each[Symbol.iterator]()),
  "".matchAll(/(?:)/g),
  (function* () {})(),
  (async function* () {})(),
];

/** Whether the worker runs a reader's Python, under the policy of its page. */
export const isConfined = self.location.protocol === "blob:";

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
  if (!isConfined) return;
  if (left.length > 0) throw new Error(`the worker keeps ${left.join(", ")}`);
  freezeIntrinsics();
}

/** Freeze all objects that the names of the global scope lead to, and these names. */
function freezeIntrinsics() {
  const names = Object.getOwnPropertyNames(globalThis);
  const objects: Set<any> = new Set();
  const queue: any[] = [Object.getPrototypeOf(globalThis), ...FUNCTIONS, ...UNNAMED];
  for (const name of names) queue.push(Reflect.get(globalThis, name));
  for (const found of queue) {
    if (Object(found) !== found || found === globalThis || objects.has(found)) continue;
    objects.add(found);
    queue.push(Object.getPrototypeOf(found));
    for (const key of Reflect.ownKeys(found)) {
      const { value, get, set } = Object.getOwnPropertyDescriptor(found, key) ?? {};
      queue.push(value, get, set);
    }
  }
  for (const found of objects) {
    const isInherited = [Object, Function, Error].some(({ prototype }) => found === prototype);
    if (isInherited || found instanceof Error) allowOverrides(found);
    if (found !== Error) Object.freeze(found);
  }
  // All of `Error`, but for a number that the interpreter raises before it reports its own end.
  for (const key of Reflect.ownKeys(Error)) {
    if (key === "stackTraceLimit") continue;
    Object.defineProperty(Error, key, { configurable: false, writable: false });
  }
  Object.preventExtensions(Error);
  for (const name of names) {
    const { get, configurable } = Object.getOwnPropertyDescriptor(globalThis, name) ?? {};
    const fixed = get ? { configurable: false } : { configurable: false, writable: false };
    if (configurable) Object.defineProperty(globalThis, name, fixed);
  }
}

/**
 * Let assignments give objects that inherit from `owner` properties of the same names, which a frozen
 * prototype would refuse: Python's interpreter sets names and messages of its errors so.
 */
function allowOverrides(owner: object) {
  for (const key of Reflect.ownKeys(owner)) {
    const { value, configurable, enumerable } = Object.getOwnPropertyDescriptor(owner, key) ?? {};
    if (!configurable || value === undefined) continue;
    const set = function (this: object, other: unknown) {
      if (this === owner) throw new TypeError(`${String(key)} is frozen`);
      const free = { writable: true, enumerable: true, configurable: true };
      Object.defineProperty(this, key, { value: other, ...free });
    };
    Object.defineProperty(owner, key, { get: () => value, set, enumerable, configurable });
  }
}
