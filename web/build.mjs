// Bundles the editor into ../src/live/page/editor.js, with the notices of what is in it in
// ../src/live/page/editor.licences.txt: `npm install`, then `npm run editor`.

import { build } from "esbuild";
import { readFileSync, writeFileSync, existsSync } from "node:fs";
import path from "node:path";

const page = "../src/live/page";

const result = await build({
  entryPoints: ["src/editor.js"],
  bundle: true,
  minify: true,
  format: "esm",
  target: "es2022",
  outfile: `${page}/editor.js`,
  legalComments: "none",
  metafile: true,
  banner: { js: "// Built from web/ by `npm run build`. Notices: editor.licences.txt" },
});

const packages = new Set();
for (const file of Object.keys(result.metafile.inputs)) {
  const found = file.match(/node_modules\/((?:@[^/]+\/)?[^/]+)\//);
  if (found) packages.add(found[1]);
}
const notices = [...packages].sort().map((name) => {
  const folder = path.join("node_modules", name);
  const about = JSON.parse(readFileSync(path.join(folder, "package.json"), "utf8"));
  const licence = ["LICENSE", "LICENSE.md", "LICENCE"].map((n) => path.join(folder, n)).find(existsSync);
  if (!licence) throw new Error(`${name} has no notice`);
  return `${name} ${about.version} (${about.license})\n\n${readFileSync(licence, "utf8").trim()}\n`;
});
writeFileSync(`${page}/editor.licences.txt`, notices.join("\n---\n\n"));
console.log(`${packages.size} packages`);
