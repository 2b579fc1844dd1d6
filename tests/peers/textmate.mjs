// Scenes as Visual Studio Code colours them: textmate.mjs WORDS FILE..., where WORDS are the
// reserved words with commas between. Prints what is not coloured as what it is.
import fs from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";

const root = path.resolve(import.meta.dirname ?? path.dirname(process.argv[1]), "../..");
const require = createRequire(path.join(root, "target/peers/"));
const oniguruma = require("vscode-oniguruma");
const textmate = require("vscode-textmate");

const [words, ...files] = process.argv.slice(2);
const reserved = new Set(words.split(","));
const wasm = fs.readFileSync(require.resolve("vscode-oniguruma/release/onig.wasm"));
await oniguruma.loadWASM(wasm.buffer.slice(wasm.byteOffset, wasm.byteOffset + wasm.length));
const at = path.join(root, "editors/vscode/syntaxes/slowlight.tmLanguage.json");
const registry = new textmate.Registry({
  onigLib: Promise.resolve({
    createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
    createOnigString: (text) => new oniguruma.OnigString(text),
  }),
  loadGrammar: async () => textmate.parseRawGrammar(fs.readFileSync(at, "utf8"), at),
});
const grammar = await registry.loadGrammar("source.slowlight");

const wrong = [];
let seen = 0;
for (const file of files) {
  let stack = textmate.INITIAL;
  for (const [number, line] of fs.readFileSync(file, "utf8").split("\n").entries()) {
    const found = grammar.tokenizeLine(line, stack);
    stack = found.ruleStack;
    for (const token of found.tokens) {
      const text = line.slice(token.startIndex, token.endIndex).trim();
      const scope = token.scopes.at(-1);
      const kind = scope.split(".")[0];
      if (text === "" || ["comment", "string"].includes(kind)) {
        continue;
      }
      seen += 1;
      const keyword = /^(keyword|storage|constant\.language)/.test(scope);
      const number_ = /^[0-9]/.test(text);
      const word = /^[A-Za-z_]/.test(text);
      const right = reserved.has(text)
        ? keyword
        : number_
          ? scope.startsWith("constant.numeric")
          : !word || scope !== "source.slowlight";
      if (!right) {
        wrong.push(`${path.basename(file)}:${number + 1}: ${text} is ${scope}`);
      }
    }
  }
}
console.log(JSON.stringify({ seen, wrong }));
