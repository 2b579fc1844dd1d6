// The two pictures, and the machine's figures.

import { picture as address } from "./desk.js";

const place = (id) => document.getElementById(id);

// An image that is asked for again only once the last one has come.
function picture(id) {
  const image = place(id);
  let wanted = "";
  let loading = false;
  const load = () => {
    if (loading || !wanted || image.getAttribute("src") === wanted) return;
    loading = true;
    image.src = wanted;
  };
  const came = (good) => {
    loading = false;
    if (good) image.hidden = false;
    sharp();
    load();
  };
  // Enlarged pixels are squares; a picture that is made smaller is smoothed.
  const sharp = () => {
    const ratio = devicePixelRatio * image.clientWidth / Math.max(1, image.naturalWidth);
    image.style.imageRendering = ratio >= 1 && !image.closest(".coarse") ? "pixelated" : "auto";
  };
  addEventListener("resize", sharp);
  image.addEventListener("load", () => came(true));
  image.addEventListener("error", () => came(false));
  return {
    image,
    show(src) {
      wanted = src;
      load();
    },
  };
}

const native = picture("native");
const machine = picture("machine");

const number = new Intl.NumberFormat("en");
export const count = (n) => number.format(n);

// A share of 1 as a percentage.
export function percent(share) {
  const value = 100 * share;
  if (value === 0) return "0%";
  if (value < 0.01) return "under 0.01%";
  return value.toFixed(value < 1 ? 2 : value < 10 ? 1 : 0) + "%";
}

// Seconds in two units at most, as the command line has them.
export function duration(s) {
  if (s < 1e-3) return (s * 1e6).toFixed(0) + " us";
  if (s < 1) return (s * 1e3).toFixed(0) + " ms";
  if (s < 60) return s.toFixed(2) + " s";
  const whole = Math.floor;
  if (s < 3600) return whole(s / 60) + " min " + whole(s % 60) + " s";
  if (s < 86400) return whole(s / 3600) + " h " + whole((s % 3600) / 60) + " min";
  return whole(s / 86400) + " d " + whole((s % 86400) / 3600) + " h";
}

const stages = {
  idle: "", planning: "planning", running: "running", comparing: "comparing with the model",
  counting: "counting cycles by line", building: "writing files", done: "", wrong: "", stopped: "stopped",
};

// Shows a text only where it changed: what is said aloud is said once.
export function say(id, text) {
  const at = place(id);
  if (at.textContent !== text) at.textContent = text;
}

export function showNative(shown) {
  const state = shown.native;
  const frame = place("native-frame");
  const waits = state.serial !== shown.chosen.serial;
  frame.classList.toggle("coarse", state.stage === "coarse");
  frame.classList.toggle("old", state.stage === "wrong");
  if (state.size[0]) frame.style.aspectRatio = state.size.join(" / ");
  if (state.picture) native.show(address("native.png", state.picture));
  native.image.alt = "Native picture, " + state.size.join(" by ") + " pixels";
  const size = state.size.join(" × ");
  const said = {
    coarse: "coarse, the whole one follows", done: size + ", in " + state.whole_ms + " ms",
    wrong: "of the last text that was right", stopped: "stopped",
  };
  say("native-said", (!waits && said[state.stage]) || size);
  const wrong = state.wrong && !waits ? state.wrong : "";
  place("native-said").classList.toggle("wrong", Boolean(wrong));
  if (wrong) say("native-said", wrong);
}

export function showMachine(shown, unlike) {
  const state = shown.machine;
  const frame = place("machine-frame");
  const wrong = shown.native.stage === "wrong";
  const old = state.serial !== shown.chosen.serial || wrong;
  say("machine-name", shown.chosen.target);
  frame.classList.toggle("old", state.picture > 0 && (old || state.stage === "planning" || state.stage === "wrong"));
  if (state.size[0]) frame.style.aspectRatio = state.size.join(" / ");
  const what = unlike && state.difference && !old ? "difference.png" : "machine.png";
  if (state.picture) machine.show(address(what, state.picture));
  machine.image.alt = unlike ? "Where the machine's picture is unlike the native one: darker in red, lighter in blue"
    : "The machine's picture, " + state.size.join(" by ") + " pixels";
  let said = wrong ? "waits for a right scene" : old ? "waits" : stages[state.stage];
  if (state.stage === "running" && !old) said = "running, row " + state.rows + " of " + state.size[1];
  if (state.stage === "done" && !old) said = state.size.join(" × ");
  say("machine-said", said);
  const rows = place("rows");
  rows.hidden = old || !(state.stage === "running" || state.stage === "planning");
  if (state.stage === "running") {
    rows.max = Math.max(1, state.size[1]);
    rows.value = state.rows;
  } else {
    rows.removeAttribute("value");
  }
  const complaint = place("machine-wrong");
  complaint.hidden = old || !state.wrong;
  say("machine-wrong", old ? "" : state.wrong || "");
  place("unlike").disabled = !state.difference || old;
  figures(state, old);
}

function figures(state, old) {
  const list = place("figures");
  const all = old ? [] : facts(state);
  const text = JSON.stringify(all);
  if (list.dataset.text === text) return;
  list.dataset.text = text;
  list.replaceChildren(...all.map(([name, value, more]) => {
    const group = document.createElement("div");
    const term = document.createElement("dt");
    const data = document.createElement("dd");
    term.textContent = name;
    data.textContent = value;
    if (more) data.append(Object.assign(document.createElement("small"), { textContent: more }));
    group.append(term, data);
    return group;
  }));
}

// What is known of the machine's run: name, value, and a word more.
function facts(state) {
  const out = [];
  const [code, tables, ram] = state.bytes;
  if (state.cycles) {
    out.push([state.unit || "cycles", count(state.cycles)]);
    out.push(["machine time", duration(state.seconds)]);
  }
  if (state.unlike_native !== null) {
    const share = percent(state.unlike_native / Math.max(1, state.pixels));
    out.push(["unlike native", count(state.unlike_native) + " pixels", share + " of " + count(state.pixels)]);
  }
  if (code !== null || tables || ram !== null) {
    const parts = [["code", code], ["tables", tables], ["RAM", ram]].filter((p) => p[1] !== null);
    const sum = parts.reduce((all, p) => all + p[1], 0);
    out.push(["memory", count(sum) + " bytes", parts.map((p) => p[0] + " " + count(p[1])).join(", ")]);
  }
  if (state.plan) {
    const mode = state.plan.mode ? "mode " + state.plan.mode + ", " : "";
    out.push(["format", state.plan.format, mode + state.plan.inks + " inks"]);
    if (state.plan.expected !== null) {
      out.push(["expected error", percent(state.plan.expected), "of the pixels; " + percent(state.plan.goal) + " may be"]);
    }
  }
  if (state.unlike_model !== null) {
    const same = state.unlike_model === 0;
    out.push(["unlike the model", same ? "none" : count(state.unlike_model), same ? "in any pixel" : "a fault of slowlight's"]);
  }
  return out;
}
