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
const counts = { native: 0, machine: 0, costs: 0, built: 0 };
const heard = [];
let costs = null;
let ready = 0;
let tasks = [];
let rest = 0;
let patience = 0;

const shown = about.blank;
shown.file.saved = true;
const wish = { serial: 1, name: "", text: "", set: {}, target: about.machines[0].name, format: null, mode: null };
shown.text = { revision: 1, by: "link" };

function scene(name) {
  return { ...about.gallery.find((s) => s.name === name), set: {} };
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

// Takes what a link or the gallery has.
function begin({ name, text, target, format, mode, set }) {
  const machine = about.machines.find((m) => m.name === target || m.name.split(":")[0] === target);
  Object.assign(wish, { name: (name || "scene").slice(0, 80), text, set });
  if (machine) {
    wish.target = machine.name;
    wish.format = machine.formats.includes(format) ? format : null;
    wish.mode = machine.modes.some((m) => m.name === mode) ? mode : null;
  }
  shown.file.name = wish.name + ".scn";
  shown.text = { revision: shown.text.revision + 1, by: "link" };
  wished();
}

// A wish has come: what is done for older ones is in vain.
function wished() {
  wish.serial += 1;
  const { serial, target, format, mode, set } = wish;
  shown.chosen = { serial, target, format, mode, set: { ...set } };
  tasks = ["run"];
  if (running.doing) running.stop();
  clearTimeout(rest);
  clearTimeout(patience);
  if (drawing.doing) patience = setTimeout(overtake, PATIENCE);
  else draw();
  rest = setTimeout(rested, REST);
  link();
  tell();
}

function asked() {
  return { ...wish, name: shown.file.name };
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
  const task = tasks.shift();
  if (task === "build") files.clear();
  running.does(task, asked(), shown.machine.stage);
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
    if (native.stage === "wrong") shown.machine.stage = "idle";
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
  if (said.file) {
    files.set(said.file, said.bytes);
  } else if (said.name === "costs") {
    costs = JSON.parse(new TextDecoder().decode(said.bytes));
    counts.costs += 1;
  } else if (said.bytes) {
    keep(said.name, said.bytes);
    if (said.name === "machine.png") counts.machine += 1;
  } else if (said.shown) {
    const { machine, costs: cost, built } = said.shown;
    Object.assign(shown, { machine: { ...figured(machine, of), picture: counts.machine }, costs: { ...cost, count: counts.costs } });
    if (of?.task === "build" && built) shown.built = { ...built, count: counts.built + 1 };
  } else {
    const serial = of?.serial ?? wish.serial;
    if (said.broken) Object.assign(shown.machine, { serial, stage: "wrong", wrong: broken(said.broken), at_work: 0 });
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
    for (const each of heard) each({ ...shown });
  });
}

function hash() {
  const { name, text, target, format, mode, set } = wish;
  return pack({ name, text, target, format, mode, set });
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

export async function want(change) {
  const { text, set, target, format, mode } = change;
  // What was wrong with a link has been read by who goes on.
  shown.file.wrong = null;
  if (text !== undefined && text !== wish.text) {
    wish.text = text;
    shown.text = { revision: shown.text.revision + 1, by: me };
  }
  if (set !== undefined) wish.set = set;
  if (target !== undefined) Object.assign(wish, { target, format: null, mode: null });
  if (format !== undefined) wish.format = format;
  if (mode !== undefined) wish.mode = mode;
  wished();
}

export async function post(path, body = {}) {
  if (path === "save") download(shown.file.name, body.text);
  if (path === "run") wished();
  if (path === "stop") stop();
  if (path === "costs" || path === "build") ask(path);
  tell();
  return { ok: true, status: 200, said: {} };
}

// A run's figures stay while its lines are counted or its program is written: a worker that
// stood up since does not know them.
function figured(machine, of) {
  const known = shown.machine;
  if (!of || of.task === "run" || known.serial !== machine.serial) return machine;
  const { stage, at_work, plan } = machine;
  const ended = !["planning", "counting", "building"].includes(stage);
  return { ...known, stage: ended ? of.before : stage, at_work, plan: plan ?? known.plan };
}

function ask(task) {
  const now = running.doing;
  if (!tasks.includes(task) && !(now?.task === task && now.serial === wish.serial)) tasks.push(task);
  work();
}

function stop() {
  tasks = [];
  if (drawing.doing) {
    drawing.stop();
    shown.native.stage = "stopped";
  }
  if (running.doing) running.stop();
  if (!["done", "wrong"].includes(shown.machine.stage)) Object.assign(shown.machine, { stage: "stopped", at_work: 0 });
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
