/** The worker that runs the Python interpreter; `messages.ts` lists its calls. Every call is answered. */

import { printable, fullErrorText } from "../errors.ts";
import { SOURCES, type Chunks } from "./chunks.ts";
import { free } from "./free.ts";
import { startInterpreter } from "./interpreter.ts";
import { isConfined, isolate } from "./isolation.ts";
import { LoadError, pendingFiles, trackArrival } from "./load_error.ts";
import { CALLS, type CallName, type FrameReply, type StartRequest } from "./messages.ts";
import { drawable } from "./pixels.ts";

/** Taken before Python runs, which finds none of them. */
const send = self.postMessage.bind(self);
const repeat = self.setInterval.bind(self);
const stop = self.clearInterval.bind(self);

/** Milliseconds between two signs of life while a call waits for files. */
const HEARTBEAT_MS = 1000;

/** The functions of `simulations.browser`, one proxy of each for good. */
let python: Record<string, any> | null = null;
let chunks: Chunks | null = null;
let starting: ReturnType<typeof startInterpreter> | null = null;

async function start(request: StartRequest) {
  starting ??= startInterpreter(request);
  const { python: module, ...started } = await starting;
  chunks = started.chunks;
  if (python) return;
  python = Object.fromEntries(Object.keys(CALLS).map((name) => [name, module[name]]));
  isolate();
  if (isConfined) chunks.fetchByPage = fetchByPage;
}

type Archive = { resolve: (archive: ArrayBuffer) => void; reject: (error: LoadError) => void };

/** Chunks that the page fetches. */
const requested: Map<string, Archive> = new Map();
/** The call that is answered. */
let current = 0;

function fetchByPage(chunk: string): Promise<ArrayBuffer> {
  const arriving = new Promise<ArrayBuffer>((resolve, reject) => {
    requested.set(chunk, { resolve, reject });
    send({ id: current, wants: chunk });
  });
  return trackArrival(`${chunk}.zip`, arriving);
}

/** A chunk from the page. */
function receive({ chunk, archive, loadError }: any) {
  const { resolve, reject } = requested.get(chunk) ?? {};
  requested.delete(chunk);
  if (archive) resolve?.(archive);
  else reject?.(new LoadError(loadError.kind, loadError.file, loadError.detail));
}

/** Import a scene. */
async function prepare(scene: string) {
  const { table } = requireChunks();
  try {
    python?.prepare(scene);
  } catch (error) {
    // A snapshot has modules without their files; what the scene imports may be one of these.
    const names = requireChunks().chunksToRun(table.scenes[scene] ?? []);
    if (!requireChunks().isMissingAny(names)) throw error;
    await requireChunks().provide(names);
    python?.prepare(scene);
  }
  return table.integrity[`${SOURCES}.zip`];
}

/** The reply of any call; of another attempt where an import lacked a chunk that the page fetches. */
async function attemptCall(name: CallName, request: any): Promise<any> {
  for (;;) {
    const [reply] = await Promise.allSettled([runCall(name, request)]);
    const lacking = chunks?.lacking.splice(0) ?? [];
    if (lacking.length > 0) await chunks?.provide(lacking);
    else if (reply.status === "fulfilled") return reply.value;
    else throw reply.reason;
  }
}

/** The reply of a call by what has been fetched. */
async function runCall(name: CallName, request: any) {
  const { parameters, reply } = CALLS[name];
  if (name === "start") return await start(request);
  if (name === "prepare") return reply(await prepare(request.scene));
  requireChunks();
  const begun = performance.now();
  const taken = reply(python?.[name](...parameters.map((argument) => toPython(request[argument]))));
  if (name === "render") requireChunks().prefetch(requireChunks().later.splice(0));
  return "meta" in taken ? { ...taken, computeMs: performance.now() - begun } : taken;
}

/** An argument as Python takes it: pictures are drawn there, objects are JSON. */
function toPython(value: any) {
  if (value === undefined) return "";
  if (value === null) return undefined; // which is None
  if (typeof value !== "object") return value;
  return value.bitmap ? drawable(value) : JSON.stringify(value);
}

self.onmessage = async ({ data }) => {
  if ("chunk" in data) {
    receive(data);
    return;
  }
  const { id } = data;
  current = id;
  const beat = () => send({ id, waits: [...pendingFiles][0] ?? "" });
  beat();
  const beats = repeat(beat, HEARTBEAT_MS);
  try {
    if (chunks && data.call !== "start") await provideFor(data, chunks);
    const reply: Partial<FrameReply> = (await attemptCall(data.call, data)) ?? {};
    const transfer = (reply.rasters ?? []).concat(reply.sound ?? []);
    send({ id, ok: true, ...reply }, { transfer });
  } catch (error) {
    send({ id, ok: false, ...failureOf(error, data.call) });
  } finally {
    stop(beats);
    if (data.picture?.mosaic) free(data.picture.mosaic.codes);
  }
};

function requireChunks(): Chunks {
  if (!chunks) throw new Error("the interpreter has not started");
  return chunks;
}

/** Fetch what a call's scene or ladder imports. */
async function provideFor(
  { call, scene = "", ladder = "", edits }: Record<string, string | undefined>,
  chunks: Chunks,
) {
  chunks.missed = null;
  const { scenes, ladders } = chunks.table;
  const imported = scenes[scene] ?? ladders[ladder] ?? [];
  const wanted = edits === undefined ? imported : [...imported, SOURCES];
  await chunks.provide(
    call === "prepare" ? chunks.chunksToImport(scene) : chunks.chunksToRun(wanted),
  );
}

/** An exception whose message is a sentence for the reader. */
const UNFIT = /^simulations\.engine\.reading\.UnfitError: /;

/** Calls that return a reader's exceptions: where they raise one, the interpreter is damaged. */
const RETURNS_EXCEPTIONS: CallName[] = ["render_edited", "exercise"];

/**
 * A Python exception leaves the interpreter intact, and so does a file that does not arrive; anything
 * else does not, and exhausted memory needs a new interpreter.
 */
function failureOf(error: unknown, call: CallName) {
  const raised = error instanceof Error && error.name === "PythonError";
  const missed = raised ? chunks?.missed : error;
  const text = fullErrorText(error).trim();
  if (missed instanceof LoadError) {
    return { error: printable(text), loadError: missed.data, fatal: false };
  }
  const last = raised ? lastException(text) : text;
  if (/MemoryError\b|^Array buffer allocation failed/.test(last)) {
    return { error: printable(last), loadError: { kind: "memory" }, fatal: true };
  }
  const fatal = !raised || RETURNS_EXCEPTIONS.includes(call);
  return { error: printable(last.replace(UNFIT, "")), fatal };
}

/** The line of a traceback that names the exception, with what follows it. */
function lastException(traceback: string) {
  const named = traceback.split("\n").filter((line) => /^[\w.]+(:|$)/.test(line));
  return named.at(-1) ?? traceback;
}
