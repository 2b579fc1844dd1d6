// Pictures that are asked for again and again, the native one, and how figures are written.

import { picture as address } from "./desk.js";

const place = (id) => document.getElementById(id);

// An image that is asked for again only once the last one has come.
export function picture(id) {
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
      if (!src) {
        image.hidden = true;
        image.removeAttribute("src");
      }
      load();
    },
  };
}

const native = picture("native");

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

// Shows a text only where it changed: what is said aloud is said once.
export function say(id, text) {
  const at = place(id);
  if (at.textContent !== text) at.textContent = text;
}

// A machine's name in titles; where both are the same, the second says which it is.
export const machineName = (runs, k) => runs[k].target + (k && runs[0].target === runs[k].target ? ", beside it" : "");

// What something waits for.
export const waitsFor = (shown) => (shown.panels.some((p) => p.frontier.stage === "running") ? "waits for the search" : "waits for the machine");

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

// Options of the command line in an element, none of them broken at its hyphens.
export function sayOptions(at, text) {
  if (at.textContent === text) return;
  at.replaceChildren(...text.split(/ (?=--)/).flatMap((one, k) => {
    const span = Object.assign(document.createElement("span"), { textContent: one });
    return k ? [" ", span] : [span];
  }));
}
