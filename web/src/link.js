// A scene as the part of an address behind the #, and back: JSON, deflated, in base 64.

import { deflateSync, Inflate, strFromU8, strToU8 } from "fflate";

// No scene is longer, whoever made the link, nor is a link.
const MOST = 4 << 20;
// So much of a link is inflated at a time: deflate makes at most a thousandth of what it was.
const PIECE = 1 << 10;
const MARK = "#s=";

export function pack(scene) {
  const bytes = deflateSync(strToU8(JSON.stringify(scene)), { level: 9 });
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return MARK + btoa(text).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

// Inflates piece by piece, so that a link that would become gigabytes ends at the first too much.
function inflated(bytes) {
  const parts = [];
  let length = 0;
  let whole = false;
  const stream = new Inflate((part, last) => {
    length += part.length;
    if (length > MOST) throw new Error("too long");
    parts.push(part);
    whole = last;
  });
  for (let at = 0; at < bytes.length; at += PIECE) {
    stream.push(bytes.subarray(at, at + PIECE), at + PIECE >= bytes.length);
  }
  if (!whole) throw new Error("cut off");
  const all = new Uint8Array(length);
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

// A half of a pair, alone, is no character: who reads JSON may refuse it. (`toWellFormed` does
// the same in newer browsers.)
const wellFormed = (text) => text.replace(/[\uD800-\uDFFF]/gu, "\uFFFD");

// The scene of an address; `null` where it has none, and an error where it is no scene.
export function unpack(hash) {
  if (!hash.startsWith(MARK)) return null;
  if (hash.length > MOST) throw new Error("too long");
  const text = atob(hash.slice(MARK.length).replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = Uint8Array.from(text, (c) => c.charCodeAt(0));
  const found = JSON.parse(strFromU8(inflated(bytes)));
  const word = (value) => (typeof value === "string" ? wellFormed(value) : null);
  const scene = word(found?.text);
  if (scene === null) throw new Error("no text");
  const set = {};
  for (const [name, values] of Object.entries(found.set ?? {})) {
    if (Array.isArray(values) && values.length <= 4 && values.every(Number.isFinite)) set[name] = values;
  }
  // Links of before there were two machines have the one beside the text.
  const runs = (Array.isArray(found.runs) ? found.runs : [found]).slice(0, 2).map((run) => (
    { target: word(run?.target), format: word(run?.format), mode: word(run?.mode), options: word(run?.options) ?? "" }));
  return { name: word(found.name), text: scene, runs, set };
}
