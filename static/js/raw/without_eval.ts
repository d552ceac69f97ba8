/**
 * The functions that Embind, which joins C++ to JavaScript, writes as text and has the browser
 * evaluate. The book's content security policy allows no such thing, so they are made here, of what
 * Embind passes to them by name (Emscripten 5.0, `src/lib/libembind_shared.js` and `libemval.js`).
 */

type Parts = Record<string, any>;

/** In place of the browser's `Function`: `new Function(names, body)` is called with a part for each name. */
export function FunctionOfParts(names: string | string[], body: string) {
  const list = String(names).split(",");
  return (...parts: unknown[]) => {
    const byName = Object.fromEntries(list.map((name, place) => [name, parts[place]]));
    return "invoker" in byName ? invoker(byName, body) : methodCaller(byName, body);
  };
}

/** Calls a method of C++. */
function invoker(parts: Parts, body: string) {
  const converters = partsNamed(parts, /^toArg\d+Wire$/);
  const isMethod = body.includes("thisWired =");
  const stacks = body.includes("var destructors");
  const returns = body.includes("return ret");
  return function (this: unknown, ...given: unknown[]) {
    const stack: unknown[] | null = stacks ? [] : null;
    const self = isMethod ? [parts.toClassParamWire(stack, this)] : [];
    const wired = converters.map((convert, place) => convert(stack, given[place]));
    const result = parts.invoker(parts.fn, ...self, ...wired);
    if (stack) parts.runDestructors(stack);
    for (const [place, value] of wired.entries()) parts[`arg${place}Wired_dtor`]?.(value);
    return returns ? parts.fromRetWire(result) : undefined;
  };
}

/** Calls a function of JavaScript for C++, or casts; the arguments lie eight bytes apart. */
function methodCaller(parts: Parts, body: string) {
  const readers = partsNamed(parts, /^argFromPtr\d+$/);
  const call = (handle: number, method: number, given: any[]) => {
    if (!body.includes("toValue(handle)")) return given.at(-1);
    const target = parts.toValue(handle);
    if (parts.getStringOrSymbol) return target[parts.getStringOrSymbol(method)](...given);
    return body.includes("new (") ? new target(...given) : target(...given);
  };
  return (handle: number, method: number, destructors: number, at: number) => {
    const given = readers.map((read, place) => read(at + 8 * place));
    const result = call(handle, method, given);
    return parts.emval_returnValue?.(parts.toReturnWire, destructors, result);
  };
}

function partsNamed(parts: Parts, pattern: RegExp): ((...given: unknown[]) => unknown)[] {
  return Object.keys(parts)
    .filter((name) => pattern.test(name))
    .map((name) => parts[name]);
}
