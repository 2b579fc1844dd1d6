// What accuracy costs in time on a machine: its ways that are worth choosing, as a plot and as a
// table whose rows are chosen. They come in while the machine's worker searches.

import { count, duration, say, sayOptions } from "./pictures.js";
import { plot, share } from "./plot.js";

const keyOf = (point) => point.format + " " + point.options;
const words = (point, formats) => [formats ? "--format " + point.format : "", point.options].filter(Boolean).join(" ") || "none";

const many = (ways) => ways + (ways === 1 ? " way" : " ways");

// A frontier in its section, whose parts are had by `place`. `told` is the panel's.
export function frontier(section, place, told) {
  const rows = new Map();
  let points = [];
  let known = null;
  let run = null;
  let drawn = "";
  let begun = false;
  const taken = () => points.findIndex((p) => run && p.options === (run.options ?? "") && p.format === run.format);
  const canTake = () => Boolean(known && run && !known.stale);

  place("tune").addEventListener("click", () => (known?.stage === "running" || known?.waits ? told.stop() : begin()));

  function begin() {
    begun = true;
    told.ask("tune");
  }

  function take(k) {
    if (!canTake()) return;
    const { format, options } = points[k];
    told.run({ format, options });
  }

  // A row of the table, made once for each point: who is in it with the keyboard stays there.
  function row(point) {
    const made = document.createElement("tr");
    const radio = Object.assign(document.createElement("input"), { type: "radio", name: section.id || place("points").id, value: keyOf(point) });
    radio.addEventListener("change", () => take(points.findIndex((p) => keyOf(p) === keyOf(point))));
    radio.addEventListener("focus", () => mark(point, true));
    radio.addEventListener("blur", () => mark(point, false));
    const label = document.createElement("label");
    label.append(radio, " " + duration(point.seconds));
    const head = Object.assign(document.createElement("th"), { scope: "row" });
    head.append(label);
    const cell = (text) => Object.assign(document.createElement("td"), { textContent: text });
    const options = cell("");
    options.append(document.createElement("code"));
    sayOptions(options.firstChild, words(point, told.formats() > 1));
    radio.setAttribute("aria-label", figures(point));
    made.append(head, cell(count(point.cycles)), cell(share(point.error)), cell(count(point.memory)), options);
    rows.set(keyOf(point), made);
    return made;
  }

  const mark = (point, on) => {
    const k = points.findIndex((p) => keyOf(p) === keyOf(point));
    place("plot").querySelector(`[data-point="${k}"]`)?.classList.toggle("at", on);
  };

  function table() {
    const body = place("points");
    const wanted = points.map((p) => rows.get(keyOf(p)) ?? row(p));
    let lost = false;
    for (const old of [...body.children]) {
      if (wanted.includes(old)) continue;
      lost ||= old.contains(document.activeElement);
      for (const [key, made] of rows) if (made === old) rows.delete(key);
      old.remove();
    }
    // Those that stay keep their order, so none of them is moved.
    wanted.forEach((made, k) => body.children[k] !== made && body.insertBefore(made, body.children[k] ?? null));
    const at = taken();
    wanted.forEach((made, k) => {
      const radio = made.querySelector("input");
      if (radio.checked !== (k === at)) radio.checked = k === at;
      radio.disabled = !canTake();
      made.classList.toggle("taken", k === at);
    });
    if (lost) body.querySelector("input")?.focus();
  }

  function draw() {
    const where = place("plot");
    const width = Math.floor(where.clientWidth);
    const now = JSON.stringify([width, known?.stale, taken(), points]);
    if (now === drawn || !width) return;
    drawn = now;
    const dots = points.map((p) => ({ ...p, said: figures(p) }));
    where.replaceChildren(plot(width, dots, taken(), take));
  }
  new ResizeObserver(draw).observe(place("plot"));

  const measured = (p) => duration(p.seconds) + ", " + count(p.cycles) + " cycles, " + share(p.error) + " of the pixels (" + count(p.unlike_native) +
    ") in another ink, " + count(p.memory) + " bytes" + (p.mode ? ", mode " + p.mode : "");
  const figures = (p) => measured(p) + ": " + words(p, told.formats() > 1);

  function said() {
    if (known.waits) return "The search begins once the machine has done what it does now.";
    const are = known.points.length === 1 ? " is" : " are";
    const ways = known.points.length + " of " + many(known.tried) + are + " worth choosing";
    if (known.stage === "running") {
      return known.points.length ? "Searching, which may take some minutes: " + many(known.measured) + " measured so far, " + known.points.length + " worth choosing."
        : "Searching, which may take some minutes.";
    }
    if (known.wrong) return known.wrong;
    const stopped = known.stage === "stopped" ? "Stopped: " + known.points.length + " of what was measured until then" + are + " worth choosing." : ways + ": none other is both quicker and nearer to the native picture.";
    return known.stale ? "Of the scene as it was: search again for what it costs now." : stopped;
  }

  return {
    // `name`: the machine's, where there are two.
    show(frontier, wanted, name, shown) {
      [known, run, points] = [frontier, wanted, frontier.points];
      const there = Boolean(run) && (frontier.stage !== "idle" || frontier.waits);
      section.hidden = !there;
      const searches = frontier.stage === "running" || frontier.waits;
      const button = place("tune");
      button.textContent = searches ? "Stop the search" : there ? "Search again" : "What accuracy costs";
      button.title = "Tries formats, blocks and other ways on the machine, which may take some minutes";
      button.disabled = !searches && shown.native.stage !== "done";
      section.classList.toggle("stale", frontier.stale);
      place("plot").hidden = section.querySelector(".points").hidden = !points.length;
      if (!there) return;
      say(place("frontier-title").id, "What accuracy costs" + (name && " on " + name));
      say(place("frontier-said").id, said());
      table();
      draw();
      // Whoever asked for it sees where it will be.
      if (begun) section.scrollIntoView();
      begun = false;
      const at = taken();
      sayOptions(place("point-said"), at < 0 ? "" : measured(points[at]) + ".");
    },
  };
}
