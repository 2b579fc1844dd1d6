// Params as sliders within their ranges. What is dragged is wanted natively at once; "keep"
// writes the value into the text.

const made = new Map();
let shape = "";
let set = {};

// A step of a range in about 200 steps, and the decimals that it needs.
function steps(low, high, whole) {
  if (whole) return { step: 1, decimals: 0 };
  const wide = (high - low) / 200;
  const power = Math.floor(Math.log10(wide));
  const times = [1, 2, 5, 10].find((n) => n * 10 ** power >= wide * 0.999) ?? 10;
  const step = times * 10 ** power;
  return { step, decimals: Math.max(0, Math.min(9, -Math.floor(Math.log10(step) + 1e-9))) };
}

const trimmed = (value, decimals) => {
  const text = value.toFixed(decimals);
  const short = text.includes(".") ? text.replace(/0+$/, "").replace(/\.$/, "") : text;
  return short === "-0" ? "0" : short;
};

// A value as it is written in the language.
function written(param, values) {
  const one = (value, k) => {
    if (param.kind === "bool") return value ? "true" : "false";
    const part = param.parts[k];
    const range = part.range;
    const { decimals } = range ? steps(range[0] / param.scale, range[1] / param.scale, param.kind === "int")
      : { decimals: param.kind === "int" ? 0 : 6 };
    return trimmed(value / param.scale, Math.max(decimals, 0)) + param.unit;
  };
  const all = values.map(one);
  return all.length === 1 ? all[0] : "(" + all.join(", ") + ")";
}

// Shows params; `told` has `want(set)` and `keep(param, text)`.
export function showParams(params, chosen, told) {
  document.getElementById("params").hidden = params.length === 0;
  const form = JSON.stringify(params.map((p) => [p.name, p.kind, p.unit, p.parts.map((q) => [q.name, q.range])]));
  if (form !== shape) {
    shape = form;
    set = { ...chosen };
    made.clear();
    document.getElementById("sliders").replaceChildren(...params.map((p) => control(p, told)));
  }
  // What the server says is older than what a hand holds.
  if (!document.activeElement?.closest?.("#sliders input[type=range]:active")) set = { ...chosen };
  for (const param of params) refresh(param);
}

function refresh(param) {
  const control = made.get(param.name);
  if (!control) return;
  control.param = param;
  const values = set[param.name] ?? param.parts.map((p) => p.value);
  control.inputs.forEach(({ slider, field, decimals }, k) => {
    const value = values[k] / param.scale;
    if (param.kind === "bool") {
      slider.checked = values[k] !== 0;
      return;
    }
    if (slider && document.activeElement !== slider) slider.value = value;
    if (document.activeElement !== field) field.value = trimmed(value, decimals);
    slider?.setAttribute("aria-valuetext", trimmed(value, decimals) + " " + param.unit);
  });
  const changed = param.name in set;
  control.keep.disabled = !changed || !param.place;
  control.back.disabled = !changed;
}

function element(name, properties = {}, ...children) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}

function control(param, told) {
  const box = element("div", { className: "param", role: "group" });
  box.setAttribute("aria-label", param.name);
  const parts = element("div", { className: "parts" });
  const keep = element("button", { type: "button", textContent: "Keep" });
  const back = element("button", { type: "button", textContent: "Reset" });
  keep.setAttribute("aria-label", "Keep " + param.name + ": write it into the scene");
  back.setAttribute("aria-label", "Reset " + param.name + " to what the scene says");
  const mine = { param, inputs: [], keep, back };
  made.set(param.name, mine);
  const values = () => set[param.name] ?? mine.param.parts.map((p) => p.value);
  const put = (k, value) => {
    const next = [...values()];
    next[k] = value;
    set = { ...set, [param.name]: next };
    told.want(set);
    refresh(mine.param);
  };
  param.parts.forEach((part, k) => {
    mine.inputs.push(input(param, part, parts, (value) => put(k, value)));
  });
  const without = () => {
    const { [param.name]: _, ...rest } = set;
    return (set = rest);
  };
  keep.addEventListener("click", () => {
    const text = written(mine.param, values());
    told.keep(mine.param, text, without());
    back.focus();
  });
  back.addEventListener("click", () => {
    told.want(without());
    refresh(mine.param);
  });
  box.append(element("b", { textContent: param.name }), keep, back, parts);
  return box;
}

// The inputs of a part, put into `parts`; `put` is told its value in the language's unit.
function input(param, part, parts, put) {
  const name = param.name + (part.name ? "." + part.name : "");
  const label = element("span", { textContent: part.name || param.unit || "value" });
  label.style.color = "var(--soft)";
  if (param.kind === "bool") {
    const slider = element("input", { type: "checkbox", ariaLabel: name });
    slider.addEventListener("change", () => put(slider.checked ? 1 : 0));
    parts.append(label, slider, element("span"));
    return { slider, decimals: 0 };
  }
  const whole = param.kind === "int";
  const range = part.range?.map((end) => end / param.scale);
  const bounded = range && range.every(Number.isFinite) && range[0] < range[1];
  const { step, decimals } = bounded ? steps(range[0], range[1], whole) : { step: whole ? 1 : "any", decimals: whole ? 0 : 6 };
  const field = element("input", { type: "number", step: "any", ariaLabel: name + (param.unit ? " in " + param.unit : "") });
  let slider = null;
  const take = (value) => {
    if (!Number.isFinite(value)) return;
    const inside = bounded ? Math.min(range[1], Math.max(range[0], value)) : value;
    put((whole ? Math.round(inside) : inside) * param.scale);
  };
  if (bounded) {
    [field.min, field.max] = range;
    slider = element("input", { type: "range", min: range[0], max: range[1], step, ariaLabel: name });
    slider.addEventListener("input", () => {
      field.value = trimmed(slider.valueAsNumber, decimals);
      take(slider.valueAsNumber);
    });
  }
  field.addEventListener("change", () => take(field.valueAsNumber));
  parts.append(label, slider ?? element("span"), field);
  return { slider, field, decimals };
}
