/** A figure to be set: the Python that draws it judges its present state. */

import { SimulationFigure } from "../figure/element.js";
import { words } from "../page/words.js";
import type { Kind } from "./questions.js";

export const figure: Kind = {
  missing: "",

  prepare() {},

  async read(form, question) {
    const conditions = question.conditions ?? [];
    const place = document.getElementById(form.dataset.figure ?? "");
    const shown = place?.querySelector("simulation-figure");
    if (!(shown instanceof SimulationFigure)) throw new Error(words("question.no_figure"));
    form.setAttribute("aria-busy", "true");
    try {
      return (await shown.judge(conditions)) ?? conditions.length;
    } finally {
      form.removeAttribute("aria-busy");
    }
  },

  fits(question, given) {
    return Number.isInteger(given) && given in question.options;
  },

  put() {},

  judge(question, given) {
    const option = question.options[given];
    const told = words(option.correct ? "question.right" : "question.not_yet");
    return { right: option.correct, words: told, replies: [option] };
  },

  mark() {},
};
