/** The photographs of an instrument as the reader sees them: thumbnail, name, state. */

import { find } from "../page/dom.ts";
import { setText } from "../page/text.ts";
import { words } from "../page/words.ts";
import type { Photo } from "./photo_store.ts";

export class PhotoList {
  #items: Map<Photo, HTMLElement> = new Map();
  readonly list: HTMLElement;
  readonly template: HTMLTemplateElement;

  /** @param on What a press on a photograph's buttons does. */
  constructor(
    box: HTMLElement,
    readonly on: { choose: (photo: Photo) => void; remove: (photo: Photo) => void },
  ) {
    this.list = find(box, ".intake-list", HTMLElement);
    this.template = find(box, "template", HTMLTemplateElement);
  }

  /** Show a photograph as it is now; `text` of what takes time. */
  show(photo: Photo, text: string = photo.message || stateText(photo)) {
    const item = this.#items.get(photo) ?? this.#add(photo);
    item.dataset.state = photo.state;
    setText(find(item, ".intake-state", HTMLElement), text);
    const image = find(item, "img", HTMLImageElement);
    if (photo.thumbnail && image.hidden) {
      image.src = URL.createObjectURL(photo.thumbnail);
      image.hidden = false;
    }
    find(item, ".intake-look", HTMLButtonElement).disabled = !photo.thumbnail;
  }

  /** Mark the one that is viewed. */
  mark(chosen: Photo | null) {
    for (const [photo, item] of this.#items) {
      const pressed = String(photo === chosen);
      find(item, ".intake-look", HTMLElement).setAttribute("aria-pressed", pressed);
    }
  }

  remove(photo: Photo) {
    const item = this.#items.get(photo);
    if (!item) return;
    const next = item.nextElementSibling ?? item.previousElementSibling;
    const hadFocus = item.contains(document.activeElement);
    URL.revokeObjectURL(find(item, "img", HTMLImageElement).src);
    item.remove();
    this.#items.delete(photo);
    this.list.hidden = this.#items.size === 0;
    if (hadFocus) next?.querySelector<HTMLElement>(".intake-remove")?.focus();
  }

  #add(photo: Photo) {
    const fresh = this.template.content.cloneNode(true) as DocumentFragment;
    const item = find(fresh, "li", HTMLElement);
    const [look, remove] = [".intake-look", ".intake-remove"].map((button) =>
      find(item, button, HTMLButtonElement),
    );
    find(item, ".intake-name", HTMLElement).textContent = photo.name;
    look.setAttribute("aria-label", words("instrument.look", { name: photo.name }));
    remove.setAttribute("aria-label", words("instrument.remove", { name: photo.name }));
    look.addEventListener("click", () => this.on.choose(photo));
    remove.addEventListener("click", () => this.on.remove(photo));
    this.list.append(item);
    this.list.hidden = false;
    this.#items.set(photo, item);
    return item;
  }
}

function stateText({ state }: Photo) {
  if (state === "waiting") return words("instrument.waiting");
  return state === "reading" ? words("instrument.reading") : words("instrument.ready");
}
