// The editor: TOML with expressions, diagnostics at their places, completion of names and keys, words about names.

import { autocompletion, completionKeymap, type CompletionContext, type CompletionResult } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import { HighlightStyle, StreamLanguage, bracketMatching, indentOnInput, syntaxHighlighting } from "@codemirror/language";
import { toml } from "@codemirror/legacy-modes/mode/toml";
import { forEachDiagnostic, lintGutter, lintKeymap, setDiagnostics, type Diagnostic } from "@codemirror/lint";
import { highlightSelectionMatches, searchKeymap } from "@codemirror/search";
import { EditorState, Transaction } from "@codemirror/state";
import { EditorView, drawSelection, highlightActiveLine, hoverTooltip, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";

/** A problem of the text, as the module tells it. */
export interface Problem {
  severity: "error" | "warning" | "note";
  message: string;
  label: string;
  hints: string[];
  file: string;
  line: number;
  from: number;
  to: number;
  fix: Fix | null;
}

export interface Fix { from: number; to: number; replacement: string }

/** A name of the model with what there is to say of it. */
export interface Name { name: string; kind: string; said: string; about: string }

const FUNCTIONS = "sin cos tan cot sec csc asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp log sqrt abs sign sum pi".split(" ");

/** What stands at the beginning of a line: the keys and sections of docs/model-file.md. */
const KEYS = ("name description source history coordinates assumptions parameters define lagrangian kinetic potential forces constraints " +
  "quasi_velocities controls initial simulation integrals expect drawing steady events masses particles frames bodies joints contacts sensors gravity include " +
  "t_end tolerance output method step value unit range view kind at color shape mass radius length inertia center parent child type axis body").split(" ");

const colors = HighlightStyle.define([
  { tag: tags.comment, color: "var(--soft)", fontStyle: "italic" },
  { tag: [tags.propertyName, tags.atom], color: "var(--blue)" },
  { tag: tags.string, color: "var(--green)" },
  { tag: [tags.number, tags.bool], color: "var(--amber)" },
  { tag: [tags.heading, tags.bracket, tags.labelName], color: "var(--violet)", fontWeight: "600" },
]);

const theme = EditorView.theme({
  "&": { height: "100%", fontSize: "0.86rem", backgroundColor: "var(--raised)", color: "var(--ink)" },
  ".cm-scroller": { fontFamily: "var(--mono)", lineHeight: "1.55" },
  ".cm-content": { caretColor: "var(--ink)" },
  "&.cm-focused": { outline: "2px solid var(--link)", outlineOffset: "-2px" },
  ".cm-gutters": { backgroundColor: "var(--sunken)", color: "var(--soft)", border: "0" },
  ".cm-activeLine, .cm-activeLineGutter": { backgroundColor: "color-mix(in srgb, var(--link) 7%, transparent)" },
  ".cm-cursor": { borderLeftColor: "var(--ink)" },
  "&.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground, .cm-selectionBackground": {
    backgroundColor: "color-mix(in srgb, var(--link) 25%, transparent)",
  },
  ".cm-tooltip": { backgroundColor: "var(--raised)", color: "var(--ink)", border: "1px solid var(--rule)", borderRadius: "6px", maxWidth: "32rem" },
  ".cm-tooltip-autocomplete > ul > li[aria-selected]": { backgroundColor: "var(--link)", color: "var(--paper)" },
  ".cm-diagnosticAction": { backgroundColor: "var(--link)", color: "var(--paper)", borderRadius: "4px", padding: "0.15rem 0.5rem" },
  ".cm-word": { padding: "0.3rem 0.6rem", font: "0.85rem/1.45 var(--sans)" },
  ".cm-panels": { backgroundColor: "var(--sunken)", color: "var(--ink)" },
  ".cm-lintPoint:after": { borderBottomColor: "var(--red)" },
});

export class Editor {
  readonly view: EditorView;
  private names: Name[] = [];
  private claims: string[] = [];
  private problems: Problem[] = [];

  constructor(parent: HTMLElement, text: string, changed: (byPerson: boolean) => void) {
    const listen = EditorView.updateListener.of((update) => {
      if (!update.docChanged) return;
      changed(update.transactions.some((one) => one.annotation(Transaction.userEvent) !== undefined));
    });
    this.view = new EditorView({
      parent,
      state: EditorState.create({
        doc: text,
        extensions: [
          lineNumbers(), lintGutter(), history(), drawSelection(), indentOnInput(), bracketMatching(), highlightActiveLine(),
          highlightSelectionMatches(), EditorView.lineWrapping, StreamLanguage.define(toml), syntaxHighlighting(colors), theme,
          autocompletion({ override: [(context) => this.complete(context)] }),
          hoverTooltip((view, position) => this.hover(view, position)),
          EditorView.contentAttributes.of({ "aria-label": "Model", tabindex: "0", spellcheck: "false", autocapitalize: "off" }),
          keymap.of([
            { key: "Mod-.", run: () => this.fixNear() },
            { key: "Alt-Enter", run: () => this.fixNear() },
            // Escape and then Tab leaves the editor, as everywhere in CodeMirror.
            ...completionKeymap, ...lintKeymap, ...searchKeymap, ...historyKeymap, ...defaultKeymap, indentWithTab,
          ]),
          listen,
        ],
      }),
    });
  }

  get text(): string { return this.view.state.doc.toString(); }

  /** Another text in the place of the whole; it can be undone. */
  replace(text: string) {
    this.view.dispatch({ changes: { from: 0, to: this.view.state.doc.length, insert: text }, selection: { anchor: 0 }, scrollIntoView: true });
  }

  change(from: number, to: number, insert: string) {
    this.view.dispatch({ changes: { from, to, insert } });
  }

  focus() { this.view.focus(); }

  /** What completion and hovering know. */
  know(names: Name[] | null, claims: string[]) {
    if (names) this.names = names;
    this.claims = claims;
  }

  show(problems: Problem[], path: string) {
    this.problems = problems.filter((problem) => problem.file === path);
    const end = this.view.state.doc.length;
    const list = this.problems.map((problem): Diagnostic => {
      const from = Math.min(problem.from, end);
      const { fix } = problem;
      return {
        from,
        to: Math.min(Math.max(problem.to, from), end),
        severity: problem.severity === "note" ? "info" : problem.severity,
        message: [problem.message, ...problem.hints].join("\n"),
        actions: fix ? [{ name: fixName(fix), apply: () => this.apply(fix) }] : [],
      };
    });
    this.view.dispatch(setDiagnostics(this.view.state, list));
  }

  apply(fix: Fix) {
    this.view.dispatch({
      changes: { from: fix.from, to: fix.to, insert: fix.replacement },
      selection: { anchor: fix.from + fix.replacement.length },
      scrollIntoView: true,
      userEvent: "input.fix",
    });
    this.view.focus();
  }

  go(position: number) {
    this.view.dispatch({ selection: { anchor: Math.min(position, this.view.state.doc.length) }, scrollIntoView: true });
    this.view.focus();
  }

  /** Applies the fix of the problem next to the cursor. */
  private fixNear(): boolean {
    const at = this.view.state.selection.main.head;
    const distance = (p: Problem) => (at < p.from ? p.from - at : at > p.to ? at - p.to : 0);
    const fixable = this.problems.filter((problem) => problem.fix).sort((a, b) => distance(a) - distance(b));
    let isCurrent = false;
    forEachDiagnostic(this.view.state, () => { isCurrent = true; });
    if (!fixable.length || !isCurrent) return false;
    this.apply(fixable[0].fix as Fix);
    return true;
  }

  private complete(context: CompletionContext): CompletionResult | null {
    const word = context.matchBefore(/[\p{L}_][\p{L}\p{N}_.#-]*/u);
    if (!word && !context.explicit) return null;
    const line = context.state.doc.lineAt(context.pos);
    const before = line.text.slice(0, (word?.from ?? context.pos) - line.from);
    const inQuotes = (before.match(/"/g)?.length ?? 0) % 2 === 1;
    const own = this.names.map((n) => ({ label: n.name, type: "variable", detail: n.said.slice(0, 40), info: n.about || undefined }));
    const functions = FUNCTIONS.map((label) => ({ label, type: "function" }));
    const claims = this.claims.map((label) => ({ label, type: "constant" }));
    const keys = KEYS.map((label) => ({ label, type: "keyword" }));
    const options = inQuotes ? (/^\s*"$/.test(before) ? [...claims, ...own] : [...own, ...functions]) : keys;
    return { from: word?.from ?? context.pos, options, validFor: /^[\p{L}\p{N}_.#-]*$/u };
  }

  private hover(view: EditorView, position: number) {
    const line = view.state.doc.lineAt(position);
    for (const found of line.text.matchAll(/[\p{L}_][\p{L}\p{N}_]*/gu)) {
      const [from, to] = [line.from + found.index, line.from + found.index + found[0].length];
      if (position < from || position > to) continue;
      const known = this.names.find((name) => name.name === found[0]);
      if (!known) return null;
      return { pos: from, end: to, above: true, create: () => ({ dom: tooltip(known) }) };
    }
    return null;
  }
}

export const fixName = (fix: Fix) => (fix.replacement === "" ? "Remove it" : `Write ${fix.replacement.length > 40 ? `${fix.replacement.slice(0, 40)}…` : fix.replacement}`);

function tooltip(name: Name): HTMLElement {
  const dom = document.createElement("div");
  dom.className = "cm-word";
  const strong = dom.appendChild(document.createElement("strong"));
  strong.textContent = name.name;
  dom.append(` ${name.said}`);
  if (name.about) dom.appendChild(document.createElement("div")).textContent = name.about;
  return dom;
}
