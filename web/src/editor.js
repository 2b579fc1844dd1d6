// The editor of a scene, as the page knows it. Built into ../src/live/page/editor.js.

import { EditorState, Transaction, Annotation } from "@codemirror/state";
import {
  EditorView, keymap, lineNumbers, drawSelection, highlightActiveLine, highlightActiveLineGutter,
  highlightSpecialChars,
} from "@codemirror/view";
import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import { bracketMatching, indentUnit } from "@codemirror/language";
import { lintGutter, lintKeymap, setDiagnostics, openLintPanel, nextDiagnostic } from "@codemirror/lint";
import { highlightSelectionMatches, search, searchKeymap } from "@codemirror/search";
import { sceneLanguage } from "./language.js";
import { costs, showCosts } from "./costs.js";

const fromOutside = Annotation.define();

// Makes an editor in `parent`. `told` has `changed(text)`, `save()`, `line(number)` for a click
// beside a line, and `at(number)` where the cursor comes to another line.
export function editor(parent, text, told) {
  let line = 1;
  const heard = EditorView.updateListener.of((update) => {
    const outside = update.transactions.some((t) => t.annotation(fromOutside));
    if (update.docChanged && !outside) told.changed(update.state.doc.toString());
    const now = update.state.doc.lineAt(update.state.selection.main.head).number;
    if (now !== line) told.at((line = now));
  });
  const view = new EditorView({
    parent,
    state: EditorState.create({
      doc: text,
      extensions: [
        costs(told.line),
        lineNumbers({
          domEventHandlers: {
            click(view, block) {
              told.line(view.state.doc.lineAt(block.from).number);
              return true;
            },
          },
        }),
        highlightActiveLineGutter(), highlightSpecialChars(), history(), drawSelection(),
        highlightActiveLine(), bracketMatching(), highlightSelectionMatches(), search({ top: true }),
        lintGutter(), indentUnit.of("  "), EditorState.tabSize.of(2), EditorView.lineWrapping,
        sceneLanguage, heard,
        EditorView.contentAttributes.of({ "aria-label": "Scene", spellcheck: "false" }),
        // Tab leaves the editor, for those who have no mouse, once Escape was pressed.
        keymap.of([
          { key: "Mod-s", preventDefault: true, run: () => (told.save(), true) },
          ...defaultKeymap, ...searchKeymap, ...historyKeymap, ...lintKeymap, indentWithTab,
        ]),
      ],
    }),
  });
  return {
    text: () => view.state.doc.toString(),
    // Another text, from the disk or another page: what differs is replaced, the cursor stays.
    become(text) {
      const old = view.state.doc.toString();
      let from = 0;
      while (from < old.length && from < text.length && old[from] === text[from]) from++;
      let end = 0;
      const least = Math.min(old.length, text.length) - from;
      while (end < least && old[old.length - 1 - end] === text[text.length - 1 - end]) end++;
      view.dispatch({
        changes: { from, to: old.length - end, insert: text.slice(from, text.length - end) },
        annotations: [fromOutside.of(true), Transaction.addToHistory.of(true)],
      });
    },
    // Replaces a range, as the user would.
    replace(from, to, insert) {
      view.dispatch({ changes: { from, to, insert }, scrollIntoView: true });
    },
    // What is wrong: [{ from, to, severity, message }], places in UTF-16.
    problems(all) {
      const length = view.state.doc.length;
      const inside = (at) => Math.max(0, Math.min(length, at));
      const found = all.map((d) => ({ ...d, from: inside(d.from), to: inside(Math.max(d.from, d.to)) }));
      view.dispatch(setDiagnostics(view.state, found));
    },
    go(at) {
      view.dispatch({ selection: { anchor: Math.min(at, view.state.doc.length) }, scrollIntoView: true });
      view.focus();
    },
    line: () => line,
    costs: (lines) => showCosts(view, lines),
    focus: () => view.focus(),
    view, openLintPanel, nextDiagnostic,
  };
}
