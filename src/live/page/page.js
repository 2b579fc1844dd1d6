// The page: what is chosen and written goes to slowlight, and what it says is shown.

import { editor as makeEditor } from "./editor.js";
import { alone, follow, get, isSending, me, post, want } from "./desk.js";
import { machineName, say, showNative, waitsFor } from "./pictures.js";
import { option, panel } from "./panel.js";
import { showParams } from "./params.js";
import * as lines from "./lines.js";

const place = (id) => document.getElementById(id);

const [start, machines] = await Promise.all([get("scene"), get("machines")]);
let revision = start.revision;
let shown = null;

// A half of a pair of UTF-16, alone, is no character, and JSON that holds it is refused.
// (`toWellFormed` does the same in newer browsers.)
const wellFormed = (text) => text.replace(/[\uD800-\uDFFF]/gu, "\uFFFD");

const editor = makeEditor(place("editor"), start.text, {
  changed: (text) => {
    unsaved();
    want({ text: wellFormed(text) });
  },
  save: () => save(false),
  line: lines.look,
  at: lines.at,
});
lines.begin(editor);

async function save(force) {
  const { ok, said } = await post("save", { page: me, text: wellFormed(editor.text()), force });
  if (!ok) say("saved", "not saved" + (said.wrong ? ": " + said.wrong : ""));
}

function unsaved() {
  if (alone) return;
  say("saved", "not saved yet");
  place("save").disabled = false;
}

// Another text, from the file or from another page.
async function another() {
  const now = await get("scene").catch(() => null);
  // Who does not answer now is asked again with the next news.
  if (!now) return;
  revision = now.revision;
  editor.become(now.text);
}

// The machines that are wanted: what was chosen here, until slowlight has heard of it.
let mine = null;
const runs = () => mine ?? shown.chosen.runs.map(({ target, format, mode, options }) => ({ target, format, mode, options }));
const panels = [0, 1].map((k) => panel(k, machines, {
  run(change) {
    const next = runs();
    next[k] = { ...next[k], ...change };
    mine = next.filter((run) => run.target);
    want({ runs: mine });
  },
  ask: (task) => (task === "costs" ? lines.look(editor.line(), k) : post(task, { panel: k })),
  stop: () => post("stop-search", { panel: k }),
  formats: () => machines.find((m) => m.name === runs()[k]?.target)?.formats.length ?? 0,
}));

function showFile() {
  const file = shown.file;
  say("name", file.name);
  document.title = file.name + " – Slowlight";
  place("elsewhere").hidden = !file.elsewhere;
  // The address of a page by itself has the text.
  if (alone) return say("saved", file.wrong ?? "");
  const saved = file.saved && shown.text.revision === revision && !isSending();
  place("save").disabled = saved;
  say("saved", file.wrong ? file.wrong : saved ? "saved" : "not saved yet");
}

function showProblems() {
  const problems = shown.problems;
  const key = JSON.stringify(problems.list);
  const at = place("problems");
  if (at.dataset.key === key) return;
  at.dataset.key = key;
  const own = problems.list.filter((p) => p.file === null);
  editor.problems(own.map(({ from, to, severity, message }) => ({ from, to, severity, message })));
  at.replaceChildren(...problems.list.map((problem) => {
    const where = (problem.file ? problem.file + ", " : "") + "line " + problem.line;
    const button = Object.assign(document.createElement("button"), { type: "button", className: "problem " + problem.severity });
    const strong = Object.assign(document.createElement("b"), { textContent: where + ": " });
    button.append(strong, problem.message);
    button.addEventListener("click", () => problem.file === null && editor.go(problem.from));
    return button;
  }));
}

// A button that saves a file of the program.
function toSave(name) {
  const button = Object.assign(document.createElement("button"), { type: "button", textContent: name });
  button.addEventListener("click", () => alone.save(name));
  return button;
}

let built = 0;
let buildWaits = false;
function showBuilt() {
  const { runs } = shown.chosen;
  const k = shown.panels.findIndex((panel) => panel.waits.build);
  if (runs[k]) {
    buildWaits = true;
    return say("built", (runs.length > 1 ? machineName(runs, k) + ": " : "") + "Build " + waitsFor(shown));
  }
  if (buildWaits) say("built", "");
  buildWaits = false;
  const now = shown.built;
  if (!now || now.count === built) return;
  built = now.count;
  const of = runs.length > 1 ? now.target + ": " : "";
  if (alone && !now.wrong) return place("built").replaceChildren(of + "Save: ", ...now.files.map(toSave));
  say("built", of + (now.wrong ?? "Written to " + shown.file.directory + ": " + now.files.join(", ")));
}

follow((news) => {
  place("lost").hidden = news !== null;
  if (news === null) return;
  shown = news;
  if (shown.text.revision !== revision) {
    if (shown.text.by === me) revision = shown.text.revision;
    else if (!isSending()) another();
  }
  if (!isSending()) mine = null;
  showFile();
  if (shown.problems.serial === shown.chosen.serial || shown.text.by !== me) showProblems();
  showNative(shown);
  const chosen = mine ? shown.chosen.runs.map((run, k) => ({ ...run, ...mine[k] })) : shown.chosen.runs;
  const two = chosen.length > 1;
  document.body.classList.toggle("two", two);
  const busy = panels.map((panel, k) => panel.show(shown, chosen)).some(Boolean);
  showParams(shown.params, shown.chosen.set, {
    want: (set) => want({ set }),
    keep(param, text, set) {
      // Where the value stands is known of the text that was read last.
      if (shown.text.revision !== revision || shown.problems.serial < shown.chosen.serial) return;
      editor.replace(param.place[0], param.place[1], text);
      want({ set });
    },
  });
  lines.showCosts(shown);
  showBuilt();
  place("stop").disabled = !busy && shown.native.stage !== "coarse";
  place("run").disabled = !["done", "stopped"].includes(shown.native.stage);
});

if (alone) {
  const scene = place("scene");
  scene.append(option("", "choose…"), ...alone.scenes.map((name) => option(name, name)));
  scene.addEventListener("change", () => {
    if (scene.value) alone.open(scene.value);
    scene.value = "";
  });
  place("scenes").hidden = place("link").hidden = false;
  place("link").addEventListener("click", async () => {
    const done = await alone.copy().then(() => true, () => false);
    say("saved", done ? "the link is copied" : "the link is this page's address");
  });
}

place("save").addEventListener("click", () => save(false));
place("force").addEventListener("click", () => save(true));
place("load").addEventListener("click", () => post("reload"));
place("run").addEventListener("click", () => post("run"));
place("stop").addEventListener("click", () => post("stop"));
addEventListener("keydown", (e) => {
  if (e.defaultPrevented) return;
  const control = e.ctrlKey || e.metaKey;
  if (control && e.key === "Enter") post("run");
  else if (control && e.key === ".") post("stop");
  else if (control && e.key === "s") save(false);
  else if (e.altKey && e.key === "l") lines.look(editor.line());
  else return;
  e.preventDefault();
});
addEventListener("beforeunload", (e) => {
  if (!shown?.file.saved) e.preventDefault();
});
