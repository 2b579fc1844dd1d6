// A machine beside the native picture: its menus, its picture, its figures, and what accuracy
// costs there.

import { picture as address } from "./desk.js";
import { count, duration, machineName, percent, picture, say, sayOptions, waitsFor } from "./pictures.js";
import { frontier } from "./frontier.js";

const stages = {
  idle: "", planning: "planning", running: "running", comparing: "comparing with the model",
  counting: "counting cycles by line", building: "writing files", done: "", wrong: "", stopped: "stopped",
};
const busy = ["planning", "running", "comparing", "counting", "building"];

export const option = (value, text) => Object.assign(document.createElement("option"), { value, textContent: text });

// Machine `k` of `machines`. `told` has `run(change)`, which wants it otherwise, `ask(task)` and
// `stop()`, which ends its search.
export function panel(k, machines, told) {
  const id = (name) => name + (k ? "-" + (k + 1) : "");
  const place = (name) => document.getElementById(id(name));
  const parts = ["menus", "pictures", "facts", "frontiers"].map((where) => {
    const part = document.getElementById("of-" + where).content.firstElementChild.cloneNode(true);
    for (const named of part.querySelectorAll("[data-id]")) named.id = id(named.dataset.id);
    document.getElementById(where).append(part);
    return part;
  });
  const [menus, figure, facts] = parts;
  facts.setAttribute("aria-labelledby", id("facts-title"));
  parts[3].setAttribute("aria-labelledby", id("frontier-title"));
  const image = picture(id("machine"));
  const points = frontier(parts[3], place, told);
  if (k) {
    place("target-label").textContent = "Beside it";
    place("target").append(option("", "none"));
  }
  menus.setAttribute("aria-label", k ? "Second machine" : "Machine");
  place("target").append(...machines.map((m) => option(m.name, m.name)));
  place("target").addEventListener("change", (e) => told.run({ target: e.target.value, format: null, mode: null, options: "" }));
  place("format").addEventListener("change", (e) => told.run({ format: e.target.value || null }));
  place("mode").addEventListener("change", (e) => told.run({ mode: e.target.value || null }));
  place("reset").addEventListener("click", () => {
    told.run({ format: null, options: "" });
    place("format").focus();
  });
  place("costs").addEventListener("click", () => told.ask("costs"));
  place("build").addEventListener("click", () => told.ask("build"));
  let last = null;
  place("unlike").addEventListener("change", () => last && showMachine(...last));

  function showMenus(run) {
    place("formats").hidden = !run;
    if (place("target").value !== run?.target && document.activeElement !== place("target")) place("target").value = run?.target ?? "";
    const machine = machines.find((m) => m.name === run?.target);
    place("target").title = machine?.about ?? "";
    if (!machine) {
      place("modes").hidden = true;
      return;
    }
    if (place("format").dataset.of !== machine.name) {
      place("format").dataset.of = machine.name;
      place("format").replaceChildren(option("", "automatic"), ...machine.formats.map((f) => option(f, f)));
      const mode = (m) => option(m.name, m.name + " (" + m.width + " × " + m.height + ", " + m.inks + " inks)");
      place("mode").replaceChildren(option("", "automatic"), ...machine.modes.map(mode));
    }
    place("modes").hidden = machine.modes.length === 0;
    for (const name of ["format", "mode"]) {
      const value = run[name] ?? "";
      if (place(name).value !== value && document.activeElement !== place(name)) place(name).value = value;
    }
  }

  function showMachine(shown, runs) {
    const [run, two, name] = [runs[k], runs.length > 1, machineName(runs, k)];
    const state = shown.panels[k].machine;
    const frame = place("machine-frame");
    const wrong = shown.native.stage === "wrong";
    const old = state.serial !== run.serial || wrong;
    say(id("machine-name"), name);
    say(id("facts-title"), name);
    place("facts-title").hidden = !two;
    frame.classList.toggle("old", state.picture > 0 && (old || state.stage === "planning" || state.stage === "wrong"));
    if (state.size[0]) frame.style.aspectRatio = state.size.join(" / ");
    else frame.style.removeProperty("aspect-ratio");
    const unlike = place("unlike").checked;
    const what = unlike && state.difference && !old ? "difference.png" : "machine.png";
    if (state.picture) image.show(address(k + 1 + "/" + what, state.picture));
    else image.show("");
    const which = two ? name : "The machine";
    image.image.alt = unlike ? "Where the picture of " + (two ? name : "the machine") + " is unlike the native one: darker in red, lighter in blue"
      : which + "’s picture, " + state.size.join(" by ") + " pixels";
    let said = wrong ? "waits for a right scene" : old ? waitsFor(shown) : stages[state.stage];
    if (state.stage === "running" && !old) said = "running, row " + state.rows + "/" + state.size[1];
    if (state.stage === "done" && !old) said = state.size.join(" × ");
    say(id("machine-said"), said);
    const rows = place("rows");
    rows.hidden = old || !(state.stage === "running" || state.stage === "planning");
    if (state.stage === "running") {
      rows.max = Math.max(1, state.size[1]);
      rows.value = state.rows;
    } else {
      rows.removeAttribute("value");
    }
    place("machine-wrong").hidden = old || !state.wrong;
    say(id("machine-wrong"), old ? "" : state.wrong || "");
    place("unlike").disabled = !state.difference || old;
    place("taken").hidden = !run.options;
    sayOptions(place("options"), run.options);
    figures(place("figures"), old ? [] : factsOf(state));
  }

  return {
    // Shows its run, or that there is none.
    show(shown, runs) {
      const run = runs[k];
      showMenus(run);
      figure.hidden = facts.hidden = !run;
      last = run && [shown, runs];
      if (run) showMachine(...last);
      points.show(shown.panels[k].frontier, run, run && runs.length > 1 ? machineName(runs, k) : "", shown);
      const ready = shown.native.stage === "done";
      for (const name of ["costs", "build"]) place(name).disabled = !ready;
      const { machine, frontier: known, waits } = shown.panels[k];
      return Boolean(run) && (busy.includes(machine.stage) || known.stage === "running" || known.waits || waits.costs || waits.build);
    },
  };
}

function figures(list, all) {
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
function factsOf(state) {
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
      out.push(["expected error", percent(state.plan.expected), "of the pixels; up to " + percent(state.plan.goal) + " allowed"]);
    }
  }
  if (state.unlike_model !== null) {
    const same = state.unlike_model === 0;
    out.push(["unlike the model", same ? "none" : count(state.unlike_model), same ? "in any pixel" : "a fault of slowlight's"]);
  }
  return out;
}
