/** What the workshop is made of, fetched when one opens. */

import type { CodeEditor } from "../../../site_builder/editor/code_editor.ts";
import { find } from "../page/dom.ts";
import { words } from "../page/words.ts";

const SHEET = new URL("../../css/workshop.css", import.meta.url).href;
const MARKUP = new URL("./workshop.html", import.meta.url);

/** A fresh panel, its style sheet in place. */
export async function loadPanel(): Promise<HTMLElement> {
  const [reply] = await Promise.all([fetch(MARKUP), loadSheet()]);
  if (!reply.ok) throw new Error(`${reply.url}: ${reply.status}`);
  const page = new DOMParser().parseFromString(await reply.text(), "text/html");
  return document.adoptNode(find(page, ".workshop", HTMLElement));
}

function loadSheet(): Promise<void> {
  if (document.head.querySelector(`link[href="${SHEET}"]`)) return Promise.resolve();
  const link = document.createElement("link");
  link.rel = "stylesheet";
  link.href = SHEET;
  return new Promise((resolve, reject) => {
    link.onload = () => resolve();
    link.onerror = () => {
      link.remove();
      reject(new Error(words("workshop.no_file", { file: SHEET })));
    };
    document.head.append(link);
  });
}

/** The code editor, or null where the book was built without. */
export async function loadEditor(address: string | undefined): Promise<typeof CodeEditor | null> {
  return address ? (await import(new URL(address, location.href).href)).CodeEditor : null;
}
