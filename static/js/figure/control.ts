/** Controls as Python describes them, and what a kind of them does in the page. */

export type Value = number | string | boolean;

/** What all have; kinds add to it. */
export interface Control {
  kind: string;
  name: string;
  label: string;
  default: Value;
}

/** What one kind of control does. `field` is its native element. */
export interface Kind<C extends Control = any, F extends HTMLElement = any> {
  read: (field: F, control: C) => Value;
  write: (field: F, control: C, value: Value) => void;
  /** The value that a text of an address means; undefined where it means none. */
  parse: (control: C, text: string) => Value | undefined;
}
