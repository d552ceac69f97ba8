/** On or off: `input[type=checkbox]`. */

import type { Control, Kind } from "../../../../static/js/figure/controls.ts";

export const kind: Kind<Control, HTMLInputElement> = {
  read: (field) => field.checked,

  write(field, _control, value) {
    field.checked = Boolean(value);
  },

  parse: (_control, text) => text === "true" || (text === "false" ? false : undefined),
};
