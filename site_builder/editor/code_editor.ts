/**
 * An editor for pieces of Python: CodeMirror, cut down to what a figure needs. Bundled into one file
 * when the book is built; nothing else of the book knows CodeMirror.
 */

import {
  autocompletion,
  type CompletionContext,
  type CompletionResult,
  closeCompletion,
  completionKeymap,
} from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import { pythonLanguage } from "@codemirror/lang-python";
import {
  bracketMatching,
  indentOnInput,
  indentUnit,
  syntaxHighlighting,
  syntaxTree,
} from "@codemirror/language";
import { EditorState, StateEffect, StateField } from "@codemirror/state";
import {
  Decoration,
  drawSelection,
  EditorView,
  highlightActiveLine,
  highlightActiveLineGutter,
  keymap,
  lineNumbers,
} from "@codemirror/view";
import { classHighlighter } from "@lezer/highlight";
import { StyleModule } from "style-mod";

/** Milliseconds after Escape in which Tab moves on instead of indenting. */
const WAY_OUT = 5000;

interface Piece {
  /** Pieces of one key are one: it keeps what can be undone. */
  key: string;
  text: string;
  /** Number of its first line, from 1. */
  firstLine: number;
  /** What a screen reader calls it. */
  label: string;
}

/** What a command of CodeMirror returns where it has been carried out. */
const done = (_result: unknown) => true;

/** The line with a mistake: its number in the text from 1, or 0 for none. */
const setProblem = StateEffect.define() as import("@codemirror/state").StateEffectType<number>;

const problemLine = StateField.define({
  create: () => Decoration.none,
  update(marks, { effects, changes, state }) {
    const told = effects.findLast((effect) => effect.is(setProblem));
    if (!told) return marks.map(changes);
    if (told.value < 1 || told.value > state.doc.lines) return Decoration.none;
    const mark = Decoration.line({ class: "cm-problem" });
    return Decoration.set(mark.range(state.doc.line(told.value).from));
  },
  provide: (field) => EditorView.decorations.from(field),
});

const theme = EditorView.theme({
  "&": { color: "var(--ink)", backgroundColor: "var(--sunken)", fontSize: "0.78rem" },
  "&.cm-focused": { outline: "2px solid var(--accent)", outlineOffset: "1px" },
  ".cm-scroller": { fontFamily: "var(--mono)", lineHeight: "1.5", maxHeight: "inherit" },
  ".cm-content": { caretColor: "var(--ink)", paddingBlock: "0.5rem" },
  ".cm-cursor": { borderLeftColor: "var(--ink)", borderLeftWidth: "2px" },
  ".cm-gutters": { color: "var(--muted)", backgroundColor: "var(--sunken)", border: "0" },
  ".cm-activeLine, .cm-activeLineGutter": { backgroundColor: "var(--accent-wash)" },
  ".cm-problem, .cm-problem.cm-activeLine": {
    backgroundColor: "color-mix(in srgb, var(--error) 16%, transparent)",
    boxShadow: "inset 3px 0 var(--error)",
  },
  "&.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground, .cm-selectionBackground":
    { background: "color-mix(in srgb, var(--accent) 30%, transparent)" },
  ".cm-tooltip": { color: "var(--ink)", background: "var(--raised)", borderColor: "var(--rule)" },
  ".cm-tooltip.cm-tooltip-autocomplete > ul": { fontFamily: "var(--mono)" },
  ".cm-tooltip.cm-tooltip-autocomplete > ul > li[aria-selected]": {
    color: "var(--paper)",
    background: "var(--accent)",
  },
  "&.cm-focused .cm-matchingBracket": {
    backgroundColor: "var(--accent-wash)",
    outline: "1px solid var(--accent)",
  },
});

/** Where a text names something: arguments of a function, loops, and what is assigned. */
const NAMED = [/\bdef \w+\(([^)]*)\)/g, /\bfor ([\w, ]+) in\b/g, /^ *([\w, ]+?) *[-+*/@]?=(?!=)/gm];

/** Names of the text that begin with what stands before the cursor, or `members` after `np.`. */
function completed(context: CompletionContext, members: string[]): CompletionResult | null {
  const { state, pos } = context;
  const word = context.matchBefore(/(np\.)?\w+$|np\.$/);
  if (!word || /String|Comment/.test(syntaxTree(state).resolveInner(pos, -1).name)) return null;
  const after = word.text.startsWith("np.");
  const from = after ? word.from + 3 : word.from;
  if (!after && state.sliceDoc(from - 1, from) === ".") return null;
  const text = state.sliceDoc(0, from) + state.sliceDoc(pos);
  const named = NAMED.flatMap((pattern) => [...text.matchAll(pattern)]).flatMap(([, names]) =>
    names.split(",").map((name) => name.replace(/[:=*].*| /g, "")),
  );
  const used = [...text.matchAll(/\bnp\.([\w.]*\w)/g)].map(([, member]) => member);
  const labels = new Set(after ? [...members, ...used] : named.filter((name) => name.length > 1));
  return { from, options: [...labels].map((label) => ({ label })), validFor: /^\w*$/ };
}

/**
 * Have CodeMirror adopt its styles as a sheet of the document's. Left to itself it does so only in
 * shadow trees, and elsewhere writes a style element, which the page's policy refuses. What it has
 * mounted it finds again on the root under a symbol of its own.
 */
function adoptStyles() {
  const root = { ownerDocument: document, adoptedStyleSheets: document.adoptedStyleSheets };
  StyleModule.mount(root as any, []);
  for (const key of Object.getOwnPropertySymbols(root)) {
    Object.defineProperty(document, key, { value: Reflect.get(root, key) });
  }
}

adoptStyles();

export class CodeEditor {
  #states: Map<string, EditorState> = new Map();
  #key = "";

  readonly hint: string;
  readonly members: string[];
  readonly run: () => void;
  readonly changed: () => void;
  readonly view: EditorView;

  /**
   * @param options.hint Id of the element that tells how to use the keyboard.
   * @param options.members What is offered after `np.`.
   * @param options.changed Called after each change of the text.
   * @param options.run Called when the reader presses Ctrl or ⌘ and Enter.
   */
  constructor(
    parent: HTMLElement,
    {
      hint,
      members = [],
      changed,
      run,
    }: { hint: string; members?: string[]; changed: () => void; run: () => void },
  ) {
    this.hint = hint;
    this.members = members;
    this.run = run;
    this.changed = changed;
    this.view = new EditorView({ parent });
  }

  /** Show a piece, in the state in which it was left if its text is still the same. */
  open(piece: Piece) {
    if (this.#key) this.#states.set(this.#key, this.view.state);
    const left = this.#states.get(piece.key);
    const kept = left?.doc.toString() === piece.text ? left : null;
    this.#key = piece.key;
    this.view.setState(kept ?? this.#fresh(piece));
    this.mark(0);
  }

  get text() {
    return this.view.state.doc.toString();
  }

  /** Another text for the piece that is shown, as one step that can be undone. */
  replace(text: string) {
    const { length } = this.view.state.doc;
    this.view.dispatch({ changes: { from: 0, to: length, insert: text } });
  }

  /**
   * Mark the line with a mistake.
   *
   * @param line From 1 in the text; 0 for none.
   */
  mark(line: number) {
    this.view.dispatch({ effects: setProblem.of(line) });
  }

  /**
   * Put the cursor at the start of a line, and show it.
   *
   * @param line From 1 in the text.
   */
  goTo(line: number) {
    const { doc } = this.view.state;
    const at = doc.line(Math.min(Math.max(line, 1), doc.lines));
    const anchor = at.from + at.text.length - at.text.trimStart().length;
    this.view.dispatch({ selection: { anchor }, scrollIntoView: true });
    this.view.focus();
  }

  destroy() {
    this.view.destroy();
  }

  #fresh({ text, firstLine, label }: Piece): EditorState {
    return EditorState.create({
      doc: text,
      extensions: [
        keymap.of([
          { key: "Mod-Enter", run: () => done(this.run()) },
          {
            key: "Escape",
            run: (view) => done([closeCompletion(view), view.setTabFocusMode(WAY_OUT)]),
          },
          ...completionKeymap.filter(({ key }) => key !== "Escape"),
          indentWithTab,
          ...defaultKeymap,
          ...historyKeymap,
        ]),
        lineNumbers({ formatNumber: (line) => String(line + firstLine - 1) }),
        history(),
        indentOnInput(),
        indentUnit.of("    "),
        bracketMatching(),
        drawSelection(),
        highlightActiveLine(),
        highlightActiveLineGutter(),
        autocompletion({
          override: [(context) => completed(context, this.members)],
          defaultKeymap: false, // its Escape would have to be pressed twice
          selectOnOpen: false, // Enter begins a line until one is chosen
          interactionDelay: 0,
          icons: false,
        }),
        pythonLanguage,
        syntaxHighlighting(classHighlighter),
        problemLine,
        theme,
        EditorView.contentAttributes.of({ "aria-label": label, "aria-describedby": this.hint }),
        EditorView.updateListener.of((update) => {
          if (update.docChanged) this.changed();
        }),
      ],
    });
  }
}
