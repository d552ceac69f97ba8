/** A figure to be set: the Python that draws it judges its present state. */

import { SimulationFigure } from "../../../../static/js/figure/element.ts";
import { words } from "../../../../static/js/page/words.ts";
import type { Kind, Question } from "../../../../static/js/question/question.ts";

interface Task extends Question {
  conditions: string[];
}

export const kind: Kind<Task, number> = {
  async read(form, { conditions }) {
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

  fits: ({ options }, given) => Number.isInteger(given) && given in options,

  judge({ options }, given) {
    const reply = options[given];
    const verdict = words(reply.correct ? "question.right" : "question.not_yet");
    return { right: reply.correct, words: verdict, replies: [reply] };
  },
};
