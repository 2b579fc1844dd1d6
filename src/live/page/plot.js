// Ways to draw a scene as a plot: the machine's time against the error, both logarithmic. The
// table beside it has the same in words, so that who does not see it misses nothing.

// Times that people know, in seconds.
const TIMES = [0.001, 0.01, 0.1, 1, 3, 10, 30, 60, 180, 600, 1800, 3600, 10800, 36000, 86400, 259200, 864000, 2592000];
// Room around the axes, and below them for pictures without error, which a logarithm has no
// place for.
const [LEFT, RIGHT, TOP, BOTTOM, NOTHING] = [66, 16, 12, 42, 26];

function element(name, attributes, text) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
}

// A logarithmic axis from a place to a place.
function axis(values, from, to) {
  const logs = values.filter((v) => v > 0).map(Math.log10);
  let [low, high] = [Math.min(...logs), Math.max(...logs)];
  if (!logs.length) [low, high] = [-1, 0];
  const air = Math.max(0.1, 0.04 * (high - low));
  [low, high] = [low - air, high + air];
  const at = (value) => from + (Math.log10(value) - low) / (high - low) * (to - from);
  const inside = (value) => low <= Math.log10(value) && Math.log10(value) <= high;
  const marks = (factors) => {
    const out = [];
    for (let k = Math.floor(low); k <= Math.ceil(high); k++) out.push(...factors.map((f) => f * 10 ** k).filter(inside));
    return out;
  };
  const enough = [[1], [1, 2, 5], [1, 2, 3, 4, 5, 6, 7, 8, 9]].map(marks).find((all) => all.length > 3);
  return { at, inside, marks: enough ?? marks([1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9]) };
}

// A mark's time, in one unit.
function time(seconds) {
  const units = [[86400, "d"], [3600, "h"], [60, "min"], [1, "s"], [1e-3, "ms"], [1e-6, "us"]];
  const [size, unit] = units.find(([size]) => seconds >= 0.999 * size) ?? units[5];
  return Number((seconds / size).toPrecision(3)) + " " + unit;
}

// An error as a share with three digits that count.
export const share = (error) => Number((100 * error).toPrecision(3)) + "%";

// The plot, so many pixels wide. `points` are [{ seconds, error, said }], from the quickest;
// `taken` is the number of the one that is chosen, and `take` is told another.
export function plot(width, points, taken, take) {
  const height = Math.round(Math.max(200, Math.min(320, width * 0.55)));
  const svg = element("svg", { width, height, viewBox: `0 0 ${width} ${height}`, "aria-hidden": "true" });
  const exact = points.some((p) => p.error === 0);
  const [floor, end] = [height - BOTTOM - (exact ? NOTHING : 0), width - RIGHT];
  const x = axis(points.map((p) => p.seconds), LEFT, end);
  const y = axis(points.map((p) => p.error), floor, TOP);
  const down = (error) => (error > 0 ? y.at(error) : height - BOTTOM - NOTHING / 2);
  const known = TIMES.filter(x.inside);
  // As many as there is room for, with their words.
  let free = -Infinity;
  for (const value of known.length > 1 ? known : x.marks) {
    const at = x.at(value);
    svg.append(element("path", { class: "grid", d: `M${at} ${TOP}V${height - BOTTOM}` }));
    if (at - 20 < free) continue;
    free = at + 22;
    svg.append(element("text", { x: at, y: height - BOTTOM + 15, "text-anchor": "middle" }, time(value)));
  }
  const errors = [...y.marks.map((e) => [y.at(e), share(e)]), ...(exact ? [[down(0), "0%"]] : [])];
  free = Infinity;
  for (const [at, words] of errors) {
    svg.append(element("path", { class: "grid", d: `M${LEFT} ${at}H${end}` }));
    if (at + 12 > free && words !== "0%") continue;
    free = at;
    svg.append(element("text", { x: LEFT - 6, y: at + 4, "text-anchor": "end" }, words));
  }
  svg.append(element("path", { class: "axes", d: `M${LEFT} ${TOP}V${height - BOTTOM}H${end}` }));
  svg.append(element("text", { x: (LEFT + end) / 2, y: height - 6, "text-anchor": "middle" }, "the machine’s time"));
  const middle = (TOP + height - BOTTOM) / 2;
  svg.append(element("text", { transform: `translate(11 ${middle}) rotate(-90)`, "text-anchor": "middle" }, "pixels in another ink"));
  const places = points.map((p) => [x.at(p.seconds), down(p.error)]);
  // A step: between two points nothing better is to be had than the quicker one.
  const line = places.map(([px, py], k) => (k ? `H${px}V${py}` : `M${px} ${py}`)).join("");
  svg.append(element("path", { class: "steps", d: line || "M0 0" }));
  places.forEach(([cx, cy], k) => {
    const group = element("g", { class: k === taken ? "point taken" : "point", "data-point": k });
    // A finger is wider than a dot.
    group.append(element("circle", { cx, cy, r: 13, class: "reach" }), element("circle", { cx, cy, r: 6 }));
    group.append(element("title", {}, points[k].said));
    group.addEventListener("click", () => take(k));
    svg.append(group);
  });
  return svg;
}
