// Opens the page of `slowlight live` in headless Chromium and works with it: by mouse, by
// keyboard, on a telephone, in the dark.
//
//   node live.mjs PATH-OF-PUPPETEER-CORE ADDRESS SCREENSHOT-STEM [SCENE]
//
// With a scene's file the page is one by itself, and a link brings it the scene.
//
// The answer, on standard output as JSON:
//   "errors"      what the console said as an error, and what was thrown
//   "asked"       requests to anywhere but the address and the page's own data
//   "typed"       whether the native picture changed after a number was edited, and in what time
//   "problem"     what is said of a mistake, and where the editor marks it
//   "dragged"     whether the native picture changed while a slider was moved, and what was kept
//   "rows"        the rows at which the machine's picture was seen to grow
//   "frontier"    what is said of a search, its points as dots and rows, and of one that is taken
//   "second"      a second machine's name, cycles and picture, and what was built for it
//   "cost"        what is said of a line after a click beside it
//   "keys"        what has the focus after Escape and Tab in the editor, and what Tab then reaches
//   "width"       the width of the page on a screen of 390 pixels
//   "luma"        of paper and ink, light and dark
//   "serious"     what axe-core finds serious or critical, light, dark and small
// and of a page by itself
//   "files"       the buttons after Build, and the bytes of the last one's file
//   "restored"    whether the page's own address brings text, machine and picture back
//   "gallery"     the scenes to choose from, and what the editor has of one that is chosen
//   "broken"      what is said of a link that holds no scene
//   "planned"     milliseconds from the first wish for a machine to its first cycle
//   "megahertz"   of the machine, by its cycles and the time until its figures stood there

import path from "node:path";
import { mkdtempSync, readFileSync, readdirSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { deflateRawSync } from "node:zlib";
import { execFileSync } from "node:child_process";
import { createRequire } from "node:module";

const [root, address, stem, scene] = process.argv.slice(2);
const require = createRequire(path.join(path.resolve(root), "package.json"));
const puppeteer = require("puppeteer-core");
const axe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");
const pause = (ms) => new Promise((done) => setTimeout(done, ms));

// Whatever hangs, somebody is told.
setTimeout(() => { process.stderr.write("no end in ten minutes\n"); process.exit(3); }, 600000).unref();

const link = (given) => address + "#s=" + deflateRawSync(JSON.stringify(given)).toString("base64url");
const first = scene ? link({ name: path.basename(scene, ".scn"), text: readFileSync(scene, "utf8"), target: "6502" }) : address;

const browser = await puppeteer.launch({
  executablePath: execFileSync("which", ["chromium"]).toString().trim(),
  headless: true,
  // As root, as in a container, Chromium has no sandbox.
  args: ["--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"],
});
try {
  const page = await browser.newPage();
  const [errors, asked, out] = [[], [], { serious: [] }];
  page.on("pageerror", (error) => errors.push(String(error)));
  page.on("console", (said) => { if (said.type() === "error") errors.push(said.text()); });
  page.on("request", (request) => {
    const to = request.url();
    if (!to.startsWith(address) && !to.startsWith("data:") && !to.startsWith("blob:" + new URL(address).origin)) asked.push(to);
  });
  await page.setViewport({ width: 1280, height: 860 });
  await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: "light" }]);
  // When the machine was seen to begin what.
  await page.evaluateOnNewDocument(() => {
    window.times = {};
    document.addEventListener("DOMContentLoaded", () => {
      // The page makes what each machine has.
      const heard = () => {
        const said = document.getElementById("machine-said");
        if (said) window.times[said.textContent.split(",")[0]] ??= performance.now();
      };
      new MutationObserver(heard).observe(document.body, { childList: true, subtree: true, characterData: true });
    });
  });
  await page.goto(first, { waitUntil: "load" });

  const source = (id) => page.$eval("#" + id, (image) => image.getAttribute("src") ?? "");
  const words = (id) => page.$eval("#" + id, (e) => e.textContent);
  const until = (what, holds, ...given) =>
    page.waitForFunction(holds, { timeout: 180000, polling: 20 }, ...given).catch((e) => { throw new Error(what + ": " + e); });
  const native = () => until("a native picture", () => /, in \d+ ms/.test(document.getElementById("native-said").textContent));
  const done = () => until("the machine's figures", () => document.getElementById("figures").textContent.includes("unlike the model"));
  // axe-core is no script of the page's, which allows none but its own.
  const look = async (when) => {
    await page.evaluate(axe + ";0");
    const found = await page.evaluate(async () => (await window.axe.run()).violations
      .filter((v) => v.impact === "serious" || v.impact === "critical")
      .map((v) => v.id + ": " + v.nodes.map((n) => n.target.join(" ")).join(", ")));
    out.serious.push(...found.map((f) => when + ": " + f));
  };

  await native();
  // The machine's picture grows: rows go up while it runs.
  out.rows = [];
  let seen = "";
  for (let k = 0; k < 1500; k++) {
    const said = await words("machine-said");
    const [shot, row] = [await source("machine"), said.match(/row (\d+)/)];
    if (row && shot !== seen) out.rows.push(Number(row[1]));
    if (row && out.rows.length === 3) await page.screenshot({ path: stem + "-grows.png" });
    seen = shot;
    if ((await words("figures")).includes("unlike the model")) break;
    await pause(20);
  }
  await done();
  if (scene) {
    const times = await page.evaluate(() => window.times);
    const cycles = await page.$eval("#figures dd", (e) => Number(e.textContent.replaceAll(",", "")));
    out.planned = times.running - times.planning;
    out.megahertz = cycles / (times["comparing with the model"] - times.running) / 1000;
  }
  await page.screenshot({ path: stem + "-wide.png" });
  await look("light");

  // A number is edited.
  const old = await source("native");
  const place = await page.evaluate(() => {
    const walk = document.createTreeWalker(document.querySelector(".cm-content"), NodeFilter.SHOW_TEXT);
    while (walk.nextNode()) {
      const at = walk.currentNode.data.indexOf("0.8");
      if (at < 0) continue;
      const range = document.createRange();
      range.setStart(walk.currentNode, at);
      range.setEnd(walk.currentNode, at + 3);
      const box = range.getBoundingClientRect();
      return [box.right, box.top + box.height / 2];
    }
    throw new Error("no 0.8");
  });
  await page.mouse.click(...place);
  const begun = Date.now();
  await page.keyboard.press("Backspace");
  await page.keyboard.type("3");
  await until("another picture", (old) => {
    const image = document.getElementById("native");
    return image.getAttribute("src") !== old && image.complete;
  }, old);
  out.typed = { changed: (await source("native")) !== old, ms: Date.now() - begun };
  await native();

  // A mistake, and its end.
  await page.keyboard.type("x");
  await until("a problem", () => document.querySelector("#problems .problem.error") && document.querySelector(".cm-lintRange-error"));
  out.problem = { said: await words("problems"), marked: await page.$eval(".cm-lintRange-error", (e) => e.textContent) };
  await pause(250);
  await page.screenshot({ path: stem + "-problem.png" });
  await page.keyboard.press("Backspace");
  await until("no problem", () => !document.querySelector("#problems .problem"));

  // A slider, by the keyboard; and its value is kept.
  await native();
  const still = await source("native");
  await page.focus("#sliders input[type=range]");
  for (let k = 0; k < 10; k++) await page.keyboard.press("ArrowLeft");
  await until("a dragged picture", (old) => document.getElementById("native").getAttribute("src") !== old, still);
  const value = await page.$eval("#sliders input[type=range]", (e) => e.value);
  await native();
  await until("to keep", () => !document.querySelector("#sliders .param button").disabled);
  await page.click("#sliders .param button");
  await until("kept", () => document.querySelector("#sliders .param button").disabled);
  out.dragged = { value, line: await page.$$eval(".cm-line", (all) => all.map((l) => l.textContent).find((l) => l.startsWith("param"))) };

  // Cycles by line, by a click beside one.
  await done();
  const beside = await page.evaluate(() => {
    const lines = [...document.querySelectorAll(".cm-lineNumbers .cm-gutterElement")];
    const box = lines.find((l) => l.textContent === "5").getBoundingClientRect();
    return [box.left + box.width / 2, box.top + box.height / 2];
  });
  await page.mouse.click(...beside);
  await until("cycles", () => document.getElementById("line-said").textContent.includes("of all"));
  out.cost = { title: await words("line-title"), said: await words("line-said"), gutter: await page.$$eval(".cost", (all) => all.length) };
  await page.screenshot({ path: stem + "-costs.png" });

  const with_page = { until, words, look, done };
  await costs_of_accuracy(page, out, with_page);
  await second_machine(page, out, with_page);

  // The keyboard leaves the editor, and reaches everything.
  await page.focus(".cm-content");
  await page.keyboard.press("Escape");
  await page.keyboard.press("Tab");
  const focus = () => page.evaluate(() => document.activeElement.id || document.activeElement.className || document.activeElement.getAttribute("aria-label"));
  out.keys = [];
  for (let k = 0; k < 8; k++) {
    out.keys.push(await focus());
    await page.keyboard.press("Tab");
  }

  // In the dark, and on a telephone.
  const luma = () => page.evaluate(() => ["backgroundColor", "color"].map((part) => {
    const [r, g, b] = getComputedStyle(document.body)[part].match(/\d+/g).map(Number);
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  }));
  out.luma = { light: await luma() };
  await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: "dark" }]);
  await pause(200);
  out.luma.dark = await luma();
  await page.screenshot({ path: stem + "-dark.png", fullPage: true });
  await look("dark");
  await page.setViewport({ width: 390, height: 844 });
  await pause(300);
  out.width = await page.evaluate(() => document.documentElement.scrollWidth);
  await page.screenshot({ path: stem + "-small.png", fullPage: true });
  await look("small");
  // Another value: what accuracy costs is that of the scene as it was.
  await page.focus("#sliders input[type=range]");
  await page.keyboard.press("ArrowRight");
  await until("an older frontier", () => document.querySelector(".frontier.stale #points input:disabled"));
  out.frontier.older = await words("frontier-said");
  await look("older");
  if (scene) await by_itself(page, out, until, words);
  process.stdout.write(JSON.stringify({ errors, asked, ...out }));
} finally {
  await browser.close();
}

// What accuracy costs, and a point of it, by the keyboard alone: it is taken while the search
// goes on, which is then stopped.
async function costs_of_accuracy(page, out, { until, words, look, done }) {
  const press = async (id) => {
    await page.focus("#" + id);
    await page.keyboard.press("Enter");
  };
  const points = () => page.$$eval("#points tr", (all) => all.length);
  await press("tune");
  await until("a search", () => /Searching/.test(document.getElementById("frontier-said").textContent));
  out.frontier = { busy: await words("tune") };
  await until("points", () => document.querySelectorAll("#points tr").length > 2);
  out.frontier.dots = await page.$$eval("#plot .point", (all) => all.length);
  out.frontier.rows = await points();
  await page.focus("#points input");
  await page.keyboard.press("Space");
  await until("a point's figures", () => document.getElementById("point-said").textContent !== "");
  out.frontier.said = await words("point-said");
  if ((await words("tune")) === "Stop the search") await press("tune");
  await until("its end", () => document.getElementById("tune").textContent === "Search again");
  await until("its run", () => document.getElementById("options").textContent !== "");
  await done();
  out.frontier.options = await words("options");
  out.frontier.cycles = await page.$eval("#figures dd", (e) => e.textContent);
  out.frontier.row = await page.$eval("#points tr.taken td", (e) => e.textContent);
  // Another is taken by a click on its dot.
  out.frontier.clicked = await page.evaluate(() => {
    const other = document.querySelector("#plot .point:not(.taken) .reach");
    other.dispatchEvent(new MouseEvent("click", { bubbles: true }));
    return other.parentNode.dataset.point;
  });
  await until("another point", (k) => document.querySelectorAll("#points tr")[k].classList.contains("taken"), out.frontier.clicked);
  await done();
  await page.focus("#points input:checked");
  await page.screenshot({ path: stem + "-frontier.png" });
  await page.evaluate(() => scrollTo(0, 0));
  await look("frontier");
}

// A second machine, chosen by the keyboard; its program is built.
async function second_machine(page, out, { until, words, look }) {
  await page.focus("#target-2");
  await page.keyboard.type("6502:bbc");
  await page.keyboard.press("Enter");
  await until("a second machine", () => document.getElementById("figures-2").textContent.includes("unlike the model"));
  await page.focus("#build-2");
  await page.keyboard.press("Enter");
  await until("files", () => /ssd/.test(document.getElementById("built").textContent));
  out.second = {
    names: [await words("machine-name"), await words("machine-name-2")],
    cycles: await page.evaluate(() => ["figures", "figures-2"].map((id) => document.querySelector("#" + id + " dd").textContent)),
    built: await words("built"), shown: await page.$eval("#machine-2", (e) => e.naturalWidth),
  };
  await page.screenshot({ path: stem + "-two.png", fullPage: true });
  await look("two");
}

// What only a page by itself has.
async function by_itself(page, out, until, words) {
  const text = () => page.$$eval(".cm-line", (all) => all.map((l) => l.textContent).join("\n"));
  await page.setViewport({ width: 1280, height: 860 });
  await until("figures", () => document.getElementById("figures").textContent.includes("unlike the model"));
  // The disc of the second machine is there to be saved.
  const folder = mkdtempSync(path.join(tmpdir(), "slowlight-"));
  const session = await page.createCDPSession();
  await session.send("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: folder });
  await page.$$eval("#built button", (all) => all[all.length - 1].click());
  const arrived = () => readdirSync(folder).find((name) => !name.endsWith(".crdownload"));
  for (let k = 0; k < 200 && !arrived(); k++) await pause(50);
  out.files = { names: await page.$$eval("#built button", (all) => all.map((b) => b.textContent)), saved: arrived(), bytes: statSync(path.join(folder, arrived())).size };
  rmSync(folder, { recursive: true });
  // Not by a click: the pictures may stand over it.
  await page.focus("#build");
  await page.keyboard.press("Enter");
  await until("the first one's files", () => document.getElementById("built").textContent.startsWith("6502:plain: Save"));
  out.files.first = await page.$$eval("#built button", (all) => all.map((b) => b.textContent));

  // The address has all that was written since; another page is opened there.
  await pause(500);
  const [was, href] = [await text(), page.url()];
  const other = await page.browser().newPage();
  await other.goto(href, { waitUntil: "load" });
  await other.waitForFunction(() => /, in \d+ ms/.test(document.getElementById("native-said").textContent), { timeout: 60000 });
  const again = await other.$$eval(".cm-line", (all) => all.map((l) => l.textContent).join("\n"));
  const machines = (of) => of.evaluate(() => ["target", "format", "target-2"].map((id) => document.getElementById(id).value).join() + document.getElementById("options").textContent);
  out.restored = { text: again === was, length: href.length, target: (await machines(other)) === (await machines(page)) };
  await other.close();

  out.gallery = { names: await page.$$eval("#scene option", (all) => all.map((o) => o.textContent)) };
  await page.select("#scene", out.gallery.names[1]);
  await until("another text", (was) => [...document.querySelectorAll(".cm-line")].map((l) => l.textContent).join("\n") !== was, was);
  out.gallery.name = await words("name");
  await page.evaluate(() => { location.hash = "#s=!"; });
  await until("a word on the link", () => document.getElementById("saved").textContent !== "");
  out.broken = await words("saved");
}
