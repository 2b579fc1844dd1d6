// Whether tree-sitter's grammar.json is what grammar.js says: grammar.mjs FOLDER. Provides the
// functions that grammar.js is written with, as far as it uses them, and prints the names of the
// rules and settings that differ.
import fs from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { isDeepStrictEqual } from "node:util";

const rule = (value) => {
  if (typeof value === "string") {
    return { type: "STRING", value };
  }
  if (value instanceof RegExp) {
    return { type: "PATTERN", value: value.source, ...(value.flags && { flags: value.flags }) };
  }
  if (typeof value?.type !== "string") {
    throw new Error(`not a rule: ${value}`);
  }
  return value;
};
const many = (type) => (...members) => ({ type, members: members.map(rule) });
const one = (type) => (content) => ({ type, content: rule(content) });
// A rank that is not said is 0.
const ranked = (type) => (...said) => {
  const [content, value = 0] = said.reverse();
  return { type, value, content: rule(content) };
};

const seq = many("SEQ");
const choice = many("CHOICE");
const token = one("TOKEN");
const prec = ranked("PREC");
prec.left = ranked("PREC_LEFT");
prec.right = ranked("PREC_RIGHT");
const field = (name, content) => ({ type: "FIELD", name, content: rule(content) });
const optional = (content) => choice(content, { type: "BLANK" });
const alias = (content, { name }) =>
  ({ type: "ALIAS", content: rule(content), named: true, value: name });
const grammar = ({ name, word, rules, extras, supertypes, ...others }) => {
  if (Object.keys(others).length > 0) {
    throw new Error(`not known here: ${Object.keys(others)}`);
  }
  const symbols = new Proxy({}, {
    get: (_, name) => {
      if (!Object.hasOwn(rules, name)) {
        throw new Error(`no rule ${name}`);
      }
      return { type: "SYMBOL", name };
    },
  });
  const made = Object.entries(rules).map(([name, of]) => [name, rule(of(symbols))]);
  return {
    name,
    word: word(symbols).name,
    rules: Object.fromEntries(made),
    extras: extras(symbols).map(rule),
    conflicts: [],
    precedences: [],
    externals: [],
    inline: [],
    supertypes: supertypes(symbols).map((symbol) => symbol.name),
    reserved: {},
  };
};
Object.assign(globalThis, {
  alias,
  choice,
  field,
  grammar,
  optional,
  prec,
  repeat: one("REPEAT"),
  repeat1: one("REPEAT1"),
  seq,
  token,
});

const folder = path.resolve(process.argv[2]);
const said = createRequire(import.meta.url)(path.join(folder, "grammar.js"));
const kept = JSON.parse(fs.readFileSync(path.join(folder, "src/grammar.json"), "utf8"));
delete kept.$schema;
const differ = (a, b) =>
  [...new Set([...Object.keys(a), ...Object.keys(b)])].filter(
    (name) => !isDeepStrictEqual(a[name], b[name]),
  );
const { rules, ...settings } = said;
const { rules: keptRules, ...keptSettings } = kept;
const wrong = [...differ(settings, keptSettings), ...differ(rules, keptRules)];
// Of two tokens that read the same text, the first rule's is taken.
if (!isDeepStrictEqual(Object.keys(rules), Object.keys(keptRules))) {
  wrong.push("order of rules");
}
console.log(JSON.stringify(wrong));
