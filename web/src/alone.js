// The desk of a page by itself: what is wanted and what is shown of it, with the names of
// ../src/live/page/desk.js. The address holds the scene, so that nothing is to be saved.

import { Crew } from "./crew.js";
import { pack, unpack } from "./link.js";

export const me = "page";

// How long the text must rest before a machine is put to work, and how long a native picture
// of an older wish may take; in milliseconds.
const [REST, PATIENCE] = [350, 250];

const drawing = new Crew(drawn);
const running = new Crew(ran);

// The machines, the gallery's scenes, and what is shown of nothing.
const about = await new Promise((known, unknown) => {
  drawing.told = ({ done, broken }) => (done ? known(done) : unknown(new Error(broken)));
  drawing.does("about", { serial: 0 });
}).catch((error) => {
  document.getElementById("saved").textContent = "this page cannot begin: " + error.message;
  throw error;
});
drawing.told = drawn;

const urls = new Map();
const files = new Map();
// What each machine's frontier is of, where there is one.
const searched = [null, null];
const counts = { native: 0, machine: 0, costs: 0, built: 0 };
// What is shown of a machine of which nothing is known.
const blank = () => structuredClone(about.blank.panels[0]);
const heard = [];
let costs = null;
let ready = 0;
let tasks = [];
let rest = 0;
let patience = 0;

const shown = structuredClone(about.blank);
shown.file.saved = true;
const wish = { serial: 1, name: "", text: "", set: {}, runs: [] };
// The last number of a wish or a machine's run.
let last = 1;
shown.text = { revision: 1, by: "link" };

function scene(name) {
  return { ...about.gallery.find((s) => s.name === name), set: {}, runs: [] };
}

function fromLink() {
  shown.file.wrong = null;
  try {
    return unpack(location.hash);
  } catch {
    shown.file.wrong = "this link holds no scene";
    return null;
  }
}

// Takes what a link or the gallery has; where it names no machine, those that are there stay,
// without what was taken there of what another scene costs.
function begin({ name, text, runs, set }) {
  Object.assign(wish, { name: (name || "scene").slice(0, 80), text, set });
  const named = runs.map(({ target, format, mode, options }) => {
    const machine = about.machines.find((m) => m.name === target || m.name.split(":")[0] === target);
    return machine && {
      target: machine.name, options,
      format: machine.formats.includes(format) ? format : null,
      mode: machine.modes.some((m) => m.name === mode) ? mode : null,
    };
  }).filter(Boolean);
  const first = { target: about.machines[0].name, format: null, mode: null, options: "" };
  const there = wish.runs.map((run) => (run.options ? { ...run, format: null, options: "" } : run));
  shown.file.name = wish.name + ".scn";
  shown.text = { revision: shown.text.revision + 1, by: "link" };
  wished(named.length ? named : there.length ? there : [first], true, true);
}

const like = (a, b, names) => Boolean(a && b) && names.every((name) => a[name] === b[name]);

// All that the points of a machine's search hang on; a value that is the text's own is none that
// was set.
function hangsOn(panel) {
  const own = (name) => shown.params.find((p) => p.name === name)?.parts.map((part) => part.value);
  const set = Object.entries(wish.set).filter(([name, values]) => String(own(name)) !== String(values)).sort();
  const { target, mode } = wish.runs[panel] ?? {};
  return JSON.stringify([wish.name, wish.text, set, target, mode]);
}

// A wish has come, for all (`whole`) or for those machines that are others than before: what is
// done for older ones is in vain. Where text or values are others (`other`), so is what accuracy
// costs.
function wished(runs, whole, other) {
  last += 1;
  whole ||= shown.native.stage === "stopped";
  const before = wish.runs;
  wish.runs = runs.slice(0, 2).map(({ target, format, mode, options }, panel) => {
    const run = { panel, serial: last, target, format, mode, options };
    const same = !whole && like(run, before[panel], ["target", "format", "mode", "options"]);
    return same ? before[panel] : run;
  });
  for (const panel of [0, 1]) {
    const [now, old] = [wish.runs[panel], before[panel]];
    if (!now) {
      shown.panels[panel] = blank();
      searched[panel] = null;
      noMore(panel, () => true);
    } else if (now !== old) {
      const same = !other && like(now, old, ["target", "mode"]);
      if (!like(now, old, ["target"])) [shown.panels[panel].frontier, searched[panel]] = [blank().frontier, null];
      // A search goes on while others of its points are looked at, and all is run again.
      noMore(panel, (task) => !same || task !== "tune");
      queue("run", panel);
    }
  }
  if (whole) {
    wish.serial = last;
    clearTimeout(patience);
    if (drawing.doing) patience = setTimeout(overtake, PATIENCE);
    else draw();
  }
  shown.chosen = { serial: wish.serial, set: { ...wish.set }, runs: wish.runs };
  clearTimeout(rest);
  rest = setTimeout(rested, REST);
  link();
  tell();
}

// Something is to be done for a machine; whoever asked for more than runs waits for these.
function queue(task, panel) {
  const now = running.doing;
  // A search is of any number, as it goes on only while it would be the same.
  const same = task === "tune" || now?.serial === wish.runs[panel]?.serial;
  const doing = now?.task === task && now.panel === panel && same;
  if (!doing && !tasks.some((t) => t.task === task && t.panel === panel)) tasks.push({ task, panel, target: wish.runs[panel].target });
  tasks.sort((a, b) => (a.task !== "run") - (b.task !== "run"));
}

// Nothing of some kind is done for a machine any more.
function noMore(panel, kind) {
  const ends = (t) => t?.panel === panel && kind(t.task);
  const built = [running.doing, ...tasks].find((t) => ends(t) && t.task === "build");
  if (built) {
    counts.built += 1;
    const wrong = "not built: something else was chosen before its turn came";
    shown.built = { target: built.target, count: counts.built, files: [], wrong };
  }
  tasks = tasks.filter((t) => !ends(t));
  if (ends(running.doing)) halt();
}

// Ends what the machines' worker does.
function halt() {
  const { task, panel } = running.doing;
  running.stop();
  const { machine, frontier } = shown.panels[panel];
  if (task === "tune" && frontier.stage === "running") frontier.stage = "stopped";
  machine.at_work = 0;
}

function asked(run) {
  const { serial, text, set } = wish;
  return { serial, name: shown.file.name, text, set, run };
}

function draw() {
  clearTimeout(patience);
  drawing.does("draw", asked());
}

function overtake() {
  if (drawing.doing) drawing.stop();
  draw();
}

function rested() {
  rest = 0;
  work();
}

// The next thing for a machine, of a wish that has rested and is right.
function work() {
  if (rest || running.doing || ready !== wish.serial || !tasks.length) return;
  const { task, panel } = tasks.shift();
  if (task === "build") files.clear();
  if (task === "tune") {
    shown.panels[panel].frontier = { ...blank().frontier, serial: wish.runs[panel].serial, stage: "running" };
    searched[panel] = hangsOn(panel);
  }
  running.does(task, asked(wish.runs[panel]), shown.panels[panel].machine.stage);
  running.doing.target = wish.runs[panel].target;
}

// What a worker's end was for.
function broken(why) {
  if (/call stack/.test(why)) return "this nests deeper than a browser's stack; the command line has more";
  if (/memory|allocation/.test(why)) return "this takes more memory than a browser gives";
  return "this breaks slowlight, which is no fault of the scene's (" + why + ")";
}

function keep(name, bytes) {
  const old = urls.get(name);
  // Whoever shows the old one may not have loaded it yet.
  if (old) setTimeout(() => URL.revokeObjectURL(old), 5000);
  urls.set(name, URL.createObjectURL(new Blob([bytes], { type: "image/png" })));
}

function drawn(said, of) {
  if (said.bytes) {
    keep(said.name, said.bytes);
    counts.native += 1;
  } else if (said.shown) {
    const { native, problems, params } = said.shown;
    Object.assign(shown, { native: { ...native, picture: counts.native }, problems, params });
    if (native.stage === "wrong") for (const panel of shown.panels) panel.machine.stage = "idle";
  } else {
    const serial = of?.serial ?? wish.serial;
    if (said.broken) Object.assign(shown.native, { serial, stage: "wrong", wrong: broken(said.broken) });
    if (said.done) ready = serial;
    if (serial !== wish.serial) draw();
    else work();
  }
  tell();
}

function ran(said, of) {
  const panel = shown.panels[of?.panel ?? 0];
  if (said.file) {
    files.set(said.file, said.bytes);
  } else if (said.name === "costs") {
    costs = JSON.parse(new TextDecoder().decode(said.bytes));
    counts.costs += 1;
  } else if (said.bytes) {
    keep(said.name, said.bytes);
    counts.machine += 1;
    if (said.name.endsWith("machine.png")) panel.machine.picture = counts.machine;
  } else if (said.shown && of) {
    const { panels, costs: cost, built } = said.shown;
    const { machine, frontier } = panels[of.panel];
    // A search's worker knows nothing of what ran before it, and whoever runs nothing of a search.
    if (of.task === "tune") panel.frontier = frontier;
    else panel.machine = { ...figured(machine, panel.machine, of), picture: panel.machine.picture };
    if (of.task === "costs") shown.costs = { ...cost, count: counts.costs };
    if (of.task === "build" && built) shown.built = { ...built, count: counts.built + 1 };
  } else if (!said.shown) {
    const serial = of?.serial ?? wish.serial;
    if (said.broken && of?.task === "tune") Object.assign(panel.frontier, { stage: "wrong", wrong: broken(said.broken) });
    else if (said.broken) Object.assign(panel.machine, { serial, stage: "wrong", wrong: broken(said.broken), at_work: 0 });
    if (of?.task === "build") counts.built += 1;
    work();
  }
  tell();
}

let telling = false;
function tell() {
  if (telling) return;
  telling = true;
  setTimeout(() => {
    telling = false;
    shown.panels.forEach((panel, k) => {
      const waits = (task) => tasks.some((t) => t.task === task && t.panel === k);
      panel.frontier.waits = waits("tune");
      panel.frontier.stale = searched[k] !== null && searched[k] !== hangsOn(k);
      panel.waits = { costs: waits("costs"), build: waits("build") };
    });
    for (const each of heard) each({ ...shown });
  });
}

function hash() {
  const { name, text, set } = wish;
  const runs = wish.runs.map(({ target, format, mode, options }) => ({ target, format, mode, options }));
  return pack({ name, text, runs, set });
}

let linking = 0;
function link() {
  clearTimeout(linking);
  linking = setTimeout(() => {
    linking = 0;
    history.replaceState(null, "", hash());
  }, 300);
}

addEventListener("hashchange", () => {
  const other = fromLink();
  if (other) begin(other);
  else tell();
});

function download(name, bytes) {
  const url = URL.createObjectURL(new Blob([bytes], { type: "application/octet-stream" }));
  Object.assign(document.createElement("a"), { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 5000);
}

export async function get(path) {
  if (path === "scene") return { text: wish.text, revision: shown.text.revision };
  if (path === "machines") return about.machines;
  if (path === "costs" && costs) return costs;
  throw new Error("there is nothing of that name");
}

export async function want({ text, set, runs }) {
  // What was wrong with a link has been read by who goes on.
  shown.file.wrong = null;
  let other = false;
  if (text !== undefined && text !== wish.text) {
    wish.text = text;
    shown.text = { revision: shown.text.revision + 1, by: me };
    other = true;
  }
  if (set !== undefined) [wish.set, other] = [set, true];
  wished(runs ?? wish.runs, other || !runs, other);
}

export async function post(path, body = {}) {
  if (path === "save") download(shown.file.name, body.text);
  if (path === "run") wished(wish.runs, true, false);
  if (path === "stop") stop();
  if (path === "stop-search") {
    noMore(body.panel, (task) => task === "tune");
    work();
  }
  if (["costs", "build", "tune"].includes(path) && wish.runs[body.panel]) {
    queue(path, body.panel);
    work();
  }
  tell();
  return { ok: true, status: 200, said: {} };
}

// A run's figures stay while its lines are counted or its program is written: a worker that
// stood up since does not know them.
function figured(machine, known, of) {
  if (!of || of.task === "run" || known.serial !== machine.serial) return machine;
  const { stage, at_work, plan } = machine;
  const ended = !["planning", "counting", "building"].includes(stage);
  return { ...known, stage: ended ? of.before : stage, at_work, plan: plan ?? known.plan };
}

function stop() {
  tasks = [];
  if (drawing.doing) {
    drawing.stop();
    shown.native.stage = "stopped";
  }
  if (running.doing) halt();
  for (const { panel, serial } of wish.runs) {
    const { machine } = shown.panels[panel];
    const { picture, size } = machine;
    if (machine.serial !== serial) Object.assign(machine, blank().machine, { serial, picture, size, stage: "stopped" });
    else if (!["done", "wrong"].includes(machine.stage)) Object.assign(machine, { stage: "stopped", at_work: 0 });
  }
}

export const isSending = () => false;

export function follow(told) {
  heard.push(told);
  tell();
}

export const picture = (name) => urls.get(name) ?? "";

export const alone = {
  scenes: about.gallery.map((s) => s.name),
  open(name) {
    shown.file.wrong = null;
    begin(scene(name));
  },
  copy() {
    const address = new URL(hash(), location.href).href;
    return navigator.clipboard.writeText(address);
  },
  save: (name) => files.has(name) && download(name, files.get(name)),
};

begin(fromLink() ?? scene("torus"));
