// Builds the page by itself, a static site: `npm run build` writes ../target/site, and
// `npm run build -- DIR` another folder. ../docs/live.md says what it needs.

import { build } from "esbuild";
import { execFileSync } from "node:child_process";
import { cpSync, existsSync, mkdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import path from "node:path";

const page = "../src/live/page";
const target = process.env.CARGO_TARGET_DIR ?? path.resolve("../target");
const site = path.resolve(process.env.INIT_CWD ?? ".", process.argv[2] ?? path.join(target, "site"));
const triple = "wasm32-unknown-unknown";
const run = (program, args, env = {}) =>
  execFileSync(program, args, { cwd: "..", env: { ...process.env, ...env }, stdio: ["ignore", "pipe", "inherit"] }).toString().trim();

// The compiler and the machines; where the toolchain has no library for WebAssembly, with one
// that is built from its source.
const library = path.join(run("rustc", ["--print", "sysroot"]), "lib/rustlib", triple, "lib");
const cargo = ["build", "--quiet", "--profile", "web", "--target", triple, "-p", "slowlight-web"];
if (existsSync(library)) {
  run("cargo", cargo);
} else {
  const source = run("web/rust-std", []);
  run("cargo", [...cargo, "-Zbuild-std=std,panic_abort"], { RUSTC_BOOTSTRAP: "1", __CARGO_TESTS_ONLY_SRC_ROOT: source });
}

// wasm-bindgen of just the version that the crate has.
const version = run("cargo", ["pkgid", "wasm-bindgen"]).match(/@([0-9.]+)$/)[1];
const tools = path.join(target, "tools");
const own = path.join(tools, "bin/wasm-bindgen");
const is = (program) => {
  try {
    return execFileSync(program, ["--version"], { stdio: ["ignore", "pipe", "ignore"] }).toString().trim().endsWith(" " + version);
  } catch {
    return false;
  }
};
if (!is("wasm-bindgen") && !is(own)) {
  run("cargo", ["install", "--quiet", "--root", tools, "--no-default-features", "--bin", "wasm-bindgen", "wasm-bindgen-cli@" + version],
    { CARGO_TARGET_DIR: path.join(target, "tools/build") });
}
mkdirSync(site, { recursive: true });
const made = path.join(target, triple, "web/slowlight_web.wasm");
run(is("wasm-bindgen") ? "wasm-bindgen" : own,
  ["--target", "web", "--no-typescript", "--remove-name-section", "--remove-producers-section", "--out-dir", path.join(target, "tools/bound"), "--out-name", "slowlight", made]);
cpSync(path.join(target, "tools/bound/slowlight_bg.wasm"), path.join(site, "slowlight.wasm"));
cpSync(path.join(target, "tools/bound/slowlight.js"), path.join(site, "slowlight.js"));

// The page's own files, with another desk and a policy of its own: a file server may send none.
for (const name of ["page.css", "page.js", "pictures.js", "panel.js", "frontier.js", "plot.js", "params.js", "lines.js", "editor.js", "editor.licences.txt"]) {
  cpSync(path.join(page, name), path.join(site, name));
}
const policy = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; connect-src 'self'; " +
  "style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; base-uri 'none'; form-action 'none'";
const html = readFileSync(path.join(page, "index.html"), "utf8");
const meta = `<meta http-equiv="Content-Security-Policy" content="${policy}">\n<meta name="referrer" content="no-referrer">\n`;
writeFileSync(path.join(site, "index.html"), html.replace("<title>", meta + "<title>"));
await build({
  entryPoints: { desk: "src/alone.js", worker: "src/worker.js" },
  bundle: true,
  minify: true,
  format: "esm",
  target: "es2022",
  external: ["./slowlight.js"],
  outdir: site,
  legalComments: "none",
  banner: { js: "// Built from web/ by `npm run build`. fflate's notice: desk.licences.txt" },
});
const notice = readFileSync("node_modules/fflate/LICENSE", "utf8");
writeFileSync(path.join(site, "desk.licences.txt"), "fflate " + JSON.parse(readFileSync("node_modules/fflate/package.json", "utf8")).version + " (MIT)\n\n" + notice);
console.log(`${site}: slowlight.wasm of ${statSync(path.join(site, "slowlight.wasm")).size} bytes`);
