/** Things to be put in order: dragged by their grip, or moved by their buttons. */

import { findAll, findOptional, find, closestTo } from "../../../../static/js/page/dom.ts";
import { setText } from "../../../../static/js/page/text.ts";
import { words } from "../../../../static/js/page/words.ts";
import type { Kind, Question } from "../../../../static/js/question/question.ts";
import { shuffled } from "../../../../static/js/question/shuffle.ts";

export const kind: Kind<Question, number[]> = {
  install() {
    document.addEventListener("click", (event) => {
      const button = closestTo(event, ".order [data-move]", HTMLButtonElement);
      if (!button) return;
      step(button);
      button.focus();
    });
    document.addEventListener("pointerdown", (event) => {
      const item = closestTo(event, ".order-item", HTMLElement);
      if (item && closestTo(event, ".grip", Element) && event.button === 0) drag(item, event);
    });
  },

  prepare(form, question) {
    arrange(form, mixed(question.id, question.options.length));
  },

  read: (form) => items(form).map(placeOf),

  fits({ options }, given) {
    if (!Array.isArray(given) || !given.every(Number.isInteger)) return false;
    return String(given.toSorted()) === String([...options.keys()].toSorted());
  },

  put: arrange,

  judge({ options }, given) {
    const wrong = given.findIndex((place, at) => place !== at);
    if (wrong < 0) return { right: true, replies: options };
    const misplaced = words("question.misplaced", { place: wrong + 1 });
    return {
      right: false,
      words: misplaced,
      replies: [{ ...options[given[wrong]], correct: false }],
    };
  },

  mark(form, _question, given) {
    for (const [at, item] of items(form).entries()) {
      item.classList.toggle("correct", given !== null && placeOf(item) === at);
      item.classList.toggle("wrong", given !== null && placeOf(item) !== at);
    }
  },
};

/** The reader's order, which is never the right one. */
function mixed(name: string, count: number) {
  const places = shuffled(name, count);
  const sorted = places.every((place, at) => place === at);
  return sorted ? places.reverse() : places;
}

function arrange(form: HTMLFormElement, places: number[]) {
  const byPlace = new Map(items(form).map((item) => [placeOf(item), item]));
  const sorted = places.flatMap((place) => byPlace.get(place) ?? []);
  find(form, ".order", HTMLElement).append(...sorted);
}

function step(button: HTMLButtonElement) {
  const item = button.closest(".order-item");
  const up = button.dataset.move === "up";
  if (up) item?.previousElementSibling?.before(item);
  else item?.nextElementSibling?.after(item);
  if (item instanceof HTMLElement) announcePlace(item);
}

/** Follow the pointer until it lets go. */
function drag(item: HTMLElement, event: PointerEvent) {
  event.preventDefault();
  const done = new AbortController();
  const { signal } = done;
  item.classList.add("dragged");
  item.setPointerCapture(event.pointerId);
  item.addEventListener("pointermove", ({ clientY }) => follow(item, clientY), { signal });
  for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) {
    item.addEventListener(
      end,
      () => {
        done.abort();
        item.classList.remove("dragged");
        announcePlace(item);
      },
      { signal },
    );
  }
}

/**
 * Past the middle of a neighbour the two change places. It is the neighbour that is moved: what
 * leaves the page for a moment loses the pointer.
 */
function follow(item: HTMLElement, y: number) {
  let [before, after] = [item.previousElementSibling, item.nextElementSibling];
  for (; before && y < middle(before); before = item.previousElementSibling) item.after(before);
  for (; after && y > middle(after); after = item.nextElementSibling) item.before(after);
}

function middle(element: Element) {
  const { top, height } = element.getBoundingClientRect();
  return top + height / 2;
}

function announcePlace(item: HTMLElement) {
  const form = item.closest("form");
  if (!form) return;
  const all = items(form);
  const thing = item.querySelector(".option-text")?.textContent ?? "";
  const place = findOptional(form, ".order-place", HTMLElement);
  const there = { place: all.indexOf(item) + 1, count: all.length };
  setText(place, words("question.place", { thing, ...there }));
}

function items(form: HTMLFormElement) {
  return findAll(form, ".order-item", HTMLElement);
}

function placeOf(item: HTMLElement) {
  return Number(find(item, "input", HTMLInputElement).value);
}
