/**
 * The reader's photographs in an instrument, and what of them stays on this device when their page is
 * left: the photographs in IndexedDB, by scene, and the settings that they are measured with.
 */

import { STORAGE } from "../book.js";
import { isAddressed, moveControls, readValues, type Value } from "../figure/controls.ts";
import { KINDS } from "../figure/control_kinds.js";
import type { SimulationFigure } from "../figure/element.ts";
import { settingsOf } from "../figure/permalink.ts";
import type { Source } from "../figure/photograph.ts";
import { loadItem, saveItem } from "../page/storage.ts";

/** `ready`: decoded, and read where the scene reads; `refused`: for the reason in `message`. */
export type State = "waiting" | "reading" | "ready" | "refused";

export interface Photo extends Source {
  /** In storage. */
  id: string;
  /** In Python. */
  number: number;
  state: State;
  message: string;
  thumbnail: Blob | null;
  /** The result of its scene's `read`. */
  data: unknown;
  /** Whether it is simulated; its file is made when it is read, and not stored. */
  isSample?: boolean;
}

/** Key of the settings of a scene's figure whose photographs are stored. */
export function sessionKey(scene: string) {
  return `instrument:${scene}`;
}

const STORE = "photographs";
/** Key of `false` where photographs are not to be stored; phones end pages in the background. */
export const KEEP_KEY = "instruments-keep";

/** `order` in which they were added; `sources` of the Python that read it. */
type StoredPhoto = Omit<Photo, "number"> & { scene: string; order: number; sources: string };

/**
 * Those of a scene, in order. What was not yet read when the page was left, or by another version of
 * its Python, is to be read again.
 */
export async function loadPhotos(scene: string): Promise<Omit<Photo, "number">[]> {
  const stored: StoredPhoto[] = await requestInStore("readonly", (store) =>
    store.index("scene").getAll(scene),
  );
  const current = document.body.dataset.sources ?? "";
  return stored
    .toSorted((one, other) => one.order - other.order)
    .map(({ order: _order, scene: _scene, sources, ...photo }) =>
      sources === current && photo.state !== "reading"
        ? photo
        : { ...photo, state: "waiting", message: "", data: null },
    );
}

/** Store photographs as they are now, each at its place among all. */
export async function savePhotos(scene: string, photos: Photo[], all: Photo[]) {
  const sources = document.body.dataset.sources ?? "";
  await requestInStore("readwrite", (store) => {
    for (const { number: _number, ...photo } of photos) {
      const order = all.findIndex(({ id }) => id === photo.id);
      store.put({ ...photo, scene, order, sources });
    }
    return store.count();
  });
}

/**
 * @param photos To delete; all of the scene, other tabs' included, where they are left out.
 * @returns How many of the scene are left.
 */
export async function deletePhotos(scene: string, photos?: Photo[]): Promise<number> {
  const all = await requestInStore("readonly", (store) => store.index("scene").getAllKeys(scene));
  return await requestInStore("readwrite", (store) => {
    for (const id of photos?.map(({ id }) => id) ?? all) store.delete(id);
    return store.index("scene").count(scene);
  });
}

/** @throws Where the browser denies storage, or has no room. */
async function requestInStore<T>(
  mode: IDBTransactionMode,
  act: (store: IDBObjectStore) => IDBRequest<T>,
): Promise<T> {
  const database = await openDatabase();
  try {
    const transaction = database.transaction(STORE, mode);
    const request = act(transaction.objectStore(STORE));
    await new Promise((resolve, reject) => {
      transaction.oncomplete = resolve;
      transaction.onabort = () => reject(transaction.error);
    });
    return request.result;
  } finally {
    database.close();
  }
}

function openDatabase(): Promise<IDBDatabase> {
  return new Promise((resolve, reject) => {
    const request = indexedDB.open(`${STORAGE}${STORE}`, 1);
    request.onupgradeneeded = () => {
      request.result.createObjectStore(STORE, { keyPath: "id" }).createIndex("scene", "scene");
    };
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}

/** The values of each figure that were stored last. */
const saved: WeakMap<SimulationFigure, Record<string, Value>> = new WeakMap();

/** Store the settings of a figure; of those that it has not changed, another tab's stay. */
export function saveSession(scene: string, figure: SimulationFigure) {
  const { form, controls, start } = settingsOf(figure);
  const values = readValues(form, controls);
  const before = saved.get(figure) ?? start;
  const changed = Object.entries(values).filter(([name, value]) => value !== before[name]);
  saveItem(sessionKey(scene), {
    ...values,
    ...loadItem(sessionKey(scene)),
    ...Object.fromEntries(changed),
  });
  saved.set(figure, values);
}

/** Set a figure to its stored settings, unless the address of its page has some. */
export function restoreSession(scene: string, figure: SimulationFigure) {
  const { form, controls } = settingsOf(figure);
  const kept = loadItem(sessionKey(scene));
  if (kept === null || isAddressed(figure)) return;
  const values = controls.map((control) => {
    return [control.name, KINDS[control.kind].parse(control, String(kept[control.name]))];
  });
  const legal = Object.fromEntries(values.filter(([, value]) => value !== undefined));
  moveControls(form, controls, legal, "change");
  saved.set(figure, readValues(form, controls));
}
