// The bytes that the BBC Micro Bot makes of posts: it has jsbeeb's tokeniser, which is the ROM's.
//
//   node tokens.mjs PATH-OF-THE-PACKAGE POST.txt ...
//
// The answer, a list of hex texts, goes to standard output as JSON.

import path from "node:path";
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const root = path.resolve(process.argv[2]);
const load = (file) => import(pathToFileURL(path.join(root, file)).href);
// The emulator tells what it loads; standard output is for results alone.
console.log = (...words) => console.error(...words);
const { setNodeBasePath } = await load("src/utils.js");
setNodeBasePath(root);
const { create } = await load("src/basic-tokenise.js");
const { tokenise } = await create();
const made = process.argv.slice(3).map((file) => tokenise(readFileSync(file, "utf8")));
process.stdout.write(JSON.stringify(made.map((text) => Buffer.from(text, "latin1").toString("hex"))));
