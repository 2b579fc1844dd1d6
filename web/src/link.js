// A scene as the part of an address behind the #, and back: JSON, deflated, in base 64.

import { deflateSync, inflateSync, strFromU8, strToU8 } from "fflate";

// No scene is longer, whoever made the link.
const MOST = 4 << 20;
const MARK = "#s=";

export function pack(scene) {
  const bytes = deflateSync(strToU8(JSON.stringify(scene)), { level: 9 });
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return MARK + btoa(text).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

// The scene of an address; `null` where it has none, and an error where it is no scene.
export function unpack(hash) {
  if (!hash.startsWith(MARK)) return null;
  const text = atob(hash.slice(MARK.length).replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = Uint8Array.from(text, (c) => c.charCodeAt(0));
  const found = JSON.parse(strFromU8(inflateSync(bytes, { out: new Uint8Array(MOST) })));
  const word = (value) => (typeof value === "string" ? value : null);
  if (word(found?.text) === null) throw new Error("no text");
  const set = {};
  for (const [name, values] of Object.entries(found.set ?? {})) {
    if (Array.isArray(values) && values.length <= 4 && values.every(Number.isFinite)) set[name] = values;
  }
  return { name: word(found.name), text: found.text, target: word(found.target), format: word(found.format), mode: word(found.mode), set };
}
