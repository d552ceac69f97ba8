/** Photographs that stay on this device when their page is left, in IndexedDB, by scene. */

import { STORAGE } from "../book.js";
import type { Photo } from "./photo.ts";

const STORE = "photographs";

/** `order` in which they were added; `sources` of the Python that read it. */
type Kept = Omit<Photo, "number"> & { scene: string; order: number; sources: string };

/**
 * Those of a scene, in order. What was not yet read when the page was left, or by another version of
 * its Python, is to be read again.
 */
export async function keptPhotos(scene: string): Promise<Omit<Photo, "number">[]> {
  const kept: Kept[] = await within("readonly", (store) => store.index("scene").getAll(scene));
  const current = document.body.dataset.sources ?? "";
  return kept
    .toSorted((one, other) => one.order - other.order)
    .map(({ order: _order, scene: _scene, sources, ...photo }) =>
      sources === current && photo.state !== "reading"
        ? photo
        : { ...photo, state: "waiting", said: "", data: null },
    );
}

/** Keep photographs as they are now, each at its place among all. */
export async function keep(scene: string, photos: Photo[], all: Photo[]) {
  const sources = document.body.dataset.sources ?? "";
  await within("readwrite", (store) => {
    for (const { number: _number, ...photo } of photos) {
      const order = all.findIndex(({ id }) => id === photo.id);
      store.put({ ...photo, scene, order, sources });
    }
    return store.count();
  });
}

export async function erase(photos: Photo[]) {
  await within("readwrite", (store) => {
    for (const { id } of photos) store.delete(id);
    return store.count();
  });
}

/** @throws Where the browser denies storage, or has no room. */
async function within<T>(
  mode: IDBTransactionMode,
  act: (store: IDBObjectStore) => IDBRequest<T>,
): Promise<T> {
  const database = await opened();
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

function opened(): Promise<IDBDatabase> {
  return new Promise((resolve, reject) => {
    const request = indexedDB.open(`${STORAGE}${STORE}`, 1);
    request.onupgradeneeded = () => {
      request.result.createObjectStore(STORE, { keyPath: "id" }).createIndex("scene", "scene");
    };
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
}
