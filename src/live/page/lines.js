// What each line of the scene costs on the machine, in the editor's gutter and in words.

import { get, post } from "./desk.js";
import { count, machineName, percent, say, waitsFor } from "./pictures.js";

let editor = null;
let report = null;
let known = 0;
let asked = null;
let state = null;
let panel = 0;

const place = (id) => document.getElementById(id);

// Begins, with the editor.
export function begin(of) {
  editor = of;
}

// Counts on a machine, if it was not done, and then tells of a line; on the last one asked for
// where none is said.
export function look(line, on = panel) {
  asked = line;
  panel = state?.chosen.runs[on] ? on : 0;
  if (!isKnown()) post("costs", { panel });
  tell();
}

// The line that the cursor is in is told of where it is known.
export function at(line) {
  if (asked === null) return;
  asked = line;
  tell();
}

// Whether what was counted is of the text, values, machine and format that are chosen.
const isOfThese = () => state?.costs.panel === panel && state?.costs.serial === state?.chosen.runs[panel]?.serial;
const isKnown = () => report !== null && !state?.costs.wrong && isOfThese();

// Takes the news.
export async function showCosts(shown) {
  state = shown;
  if (shown.costs.count !== known) {
    known = shown.costs.count;
    report = known ? await get("costs").catch(() => null) : null;
    if (isKnown()) editor.costs(own().map(({ line, share }) => ({ line, share })));
  }
  if (!isKnown() && report) {
    report = null;
    editor.costs([]);
  }
  tell();
}

// The lines of the scene's own file.
const own = () => (report?.lines ?? []).filter((line) => line.file === state.file.name);

function tell() {
  const told = place("line");
  told.hidden = asked === null || !state;
  if (told.hidden) return;
  const { runs } = state.chosen;
  say("line-title", "Line " + asked + (runs.length > 1 && runs[panel] ? " on " + machineName(runs, panel) : ""));
  const said = place("line-said");
  const text = words();
  const key = JSON.stringify(text);
  if (said.dataset.key === key) return;
  said.dataset.key = key;
  const list = document.createElement("ul");
  list.append(...text.slice(1).map((t) => Object.assign(document.createElement("li"), { textContent: t })));
  said.replaceChildren(Object.assign(document.createElement("p"), { textContent: text[0] }));
  if (text.length > 1) said.append(list);
}

function words() {
  if (state.costs.wrong && isOfThese()) return [state.costs.wrong];
  if (!isKnown()) {
    const { machine, waits } = state.panels[panel];
    if (waits.costs) return ["Counting " + waitsFor(state) + "."];
    return [machine.stage === "counting" ? "The machine counts what each line takes." : "Press “Cycles by line” to count: nothing is known of what is chosen now."];
  }
  const line = own().find((line) => line.line === asked);
  if (!line) return ["Nothing on the machine comes from this line."];
  const first = percent(line.share) + " of all " + report.unit + ": " + count(line.cycles) + ", begun " + count(line.executions) +
    " times, " + count(line.size) + " " + report.size_unit + ".";
  const error = line.error && Math.abs(line.error.share) >= 0.001
    ? [line.error.share < 0 ? "Its errors cancel others." : percent(line.error.share) + " of the picture’s mean square error goes without its own."]
    : [];
  const part = (kind) => (p) => percent(p.share) + " " + kind + p.name + ", " + count(p.times) + " times";
  return [first, ...error, ...line.parts.slice(0, 5).map(part("")), ...line.library.slice(0, 5).map(part("in the library’s "))];
}
