// The scene language's colours: a stream of tokens, as compiler/syntax/src/token.rs cuts them.

import { StreamLanguage, HighlightStyle, syntaxHighlighting } from "@codemirror/language";
import { tags } from "@lezer/highlight";

const items = /^(?:image|param|state|const|fn|effect|shape|scene|record|map|dither|draw|use)\b/;
const words = /^(?:if|let|then|else|loop|next|spread|each|and|or|not|div|mod|true|false|none|is|in|where)\b/;

const scene = StreamLanguage.define({
  name: "scene",
  token(stream) {
    if (stream.eatSpace()) return null;
    if (stream.match(/^\/\/.*/)) return "comment";
    if (stream.match(items)) return "definitionKeyword";
    if (stream.match(words)) return "keyword";
    if (stream.match(/^[0-9]+(?:\.[0-9]+)?(?:deg|turn|rad)?/)) return "number";
    if (stream.match(/^#[0-9A-Za-z_]*/)) return "color";
    if (stream.match(/^"[^"]*"?/) || stream.match(/^'[^']*'?/)) return "string";
    if (stream.match(/^[A-Za-z_][A-Za-z0-9_]*(?=\s*\()/)) return "function";
    if (stream.match(/^[A-Za-z_][A-Za-z0-9_]*/)) return "name";
    stream.next();
    return null;
  },
  tokenTable: { function: tags.function(tags.variableName), name: tags.variableName },
  languageData: { commentTokens: { line: "//" }, closeBrackets: { brackets: ["(", "[", "{"] } },
});

// The page's own colours, so that both schemes have theirs.
const style = HighlightStyle.define([
  { tag: tags.comment, color: "var(--code-comment)", fontStyle: "italic" },
  { tag: tags.definitionKeyword, color: "var(--code-item)", fontWeight: "600" },
  { tag: tags.keyword, color: "var(--code-word)" },
  { tag: tags.number, color: "var(--code-number)" },
  { tag: tags.color, color: "var(--code-number)" },
  { tag: tags.string, color: "var(--code-string)" },
  { tag: tags.function(tags.variableName), color: "var(--code-call)" },
]);

export const sceneLanguage = [scene, syntaxHighlighting(style)];
