// Opens a page from the disk in headless Chromium as on a telephone, in the dark, and by
// the keyboard alone.
//
//   node pages.mjs PATH-OF-PUPPETEER-CORE PAGE.html SCREENSHOT-STEM
//
// The answer, on standard output as JSON:
//   "errors"     what the console said as an error, and what was thrown
//   "width"      how wide the page is where the window has 390 pixels
//   "small"      the smallest letters of a plot there, in pixels; null without one
//   "light", "dark"   of the page, {"paper", "ink"}: luma of background and text, 0 to 255;
//                and "faint", the texts whose contrast (WCAG 2) is below 3, with that
//   "backticks"  texts outside of code and scripts that have one
//   "unexplained"  heads of tables that no term of a list explains
//   "keys"       by the keyboard: what has the focus after each key, and what was chosen

import path from "node:path";
import { execFileSync } from "node:child_process";
import { pathToFileURL } from "node:url";
import { createRequire } from "node:module";

const [root, page_file, stem] = process.argv.slice(2);
const require = createRequire(path.join(path.resolve(root), "package.json"));
const puppeteer = require("puppeteer-core");

const browser = await puppeteer.launch({
  executablePath: execFileSync("which", ["chromium"]).toString().trim(),
  headless: true,
  // As root, as in a container, Chromium has no sandbox.
  args: ["--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"],
});
try {
  const page = await browser.newPage();
  const errors = [];
  page.on("pageerror", (error) => errors.push(String(error)));
  page.on("console", (said) => { if (said.type() === "error") errors.push(said.text()); });
  const open = async (width, scheme) => {
    await page.setViewport({ width, height: 900 });
    await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: scheme }]);
    await page.goto(pathToFileURL(path.resolve(page_file)).href, { waitUntil: "load" });
  };
  const colours = () => page.evaluate(() => {
    const numbers = (text) => (text.match(/[\d.]+/g) ?? []).map(Number);
    const luma = ([r, g, b]) => 0.299 * r + 0.587 * g + 0.114 * b;
    const linear = (c) => c / 255 <= 0.04045 ? c / 255 / 12.92 : ((c / 255 + 0.055) / 1.055) ** 2.4;
    const light = ([r, g, b]) => 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
    const under = (e) => {
      for (let at = e; at !== null; at = at.parentElement) {
        const [r, g, b, a = 1] = numbers(getComputedStyle(at).backgroundColor);
        if (a === 1) return [r, g, b];
      }
      return [255, 255, 255];
    };
    const body = getComputedStyle(document.body);
    const faint = [];
    for (const e of document.body.querySelectorAll("*")) {
      const own = Array.from(e.childNodes).some((n) => n.nodeType === 3 && n.textContent.trim() !== "");
      if (!own || e.getClientRects().length === 0 || ["SCRIPT", "STYLE", "title"].includes(e.tagName)) continue;
      const style = getComputedStyle(e);
      const drawn = e.namespaceURI.endsWith("svg");
      const sheet = drawn ? e.closest("svg").querySelector("rect") : null;
      const paper = sheet === null ? under(e) : numbers(getComputedStyle(sheet).fill);
      const [a, b] = [light(numbers(drawn ? style.fill : style.color)), light(paper)];
      const contrast = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
      if (contrast < 3) faint.push([e.textContent.trim().slice(0, 40), contrast]);
    }
    return { paper: luma(under(document.body)), ink: luma(numbers(body.color)), faint };
  });

  await open(390, "light");
  // What is chosen or opened must fit, too.
  await page.keyboard.press("Tab");
  await page.keyboard.press("Enter");
  await page.screenshot({ path: `${stem}-390.png`, fullPage: true });
  const width = await page.evaluate(() => document.documentElement.scrollWidth);
  const small = await page.evaluate(() => {
    const texts = Array.from(document.querySelectorAll("svg text"));
    const shown = texts.filter((t) => t.getClientRects().length > 0);
    const sizes = shown.map((t) => parseFloat(getComputedStyle(t).fontSize) * t.getScreenCTM().d);
    return sizes.length === 0 ? null : Math.min(...sizes.map(Math.abs).filter((s) => s > 0));
  });
  const light = await colours();
  await open(1000, "dark");
  await page.screenshot({ path: `${stem}-dark.png`, fullPage: true });
  const dark = await colours();
  const backticks = await page.evaluate(() => {
    const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    const found = [];
    while (walk.nextNode()) {
      const inside = walk.currentNode.parentElement.closest("script, style, code, pre, td.code");
      if (inside === null && walk.currentNode.textContent.includes("`")) found.push(walk.currentNode.textContent);
    }
    return found;
  });
  const unexplained = await page.evaluate(() => {
    const terms = Array.from(document.querySelectorAll("dt")).map((e) => e.textContent);
    const heads = Array.from(document.querySelectorAll("th")).map((e) => e.textContent.trim());
    return heads.filter((head) => !terms.includes(head));
  });

  const focus = () => page.evaluate(() => {
    const e = document.activeElement;
    const chosen = document.querySelector("circle.chosen");
    return {
      on: e.tagName.toLowerCase(),
      point: e.getAttribute("data-point"),
      chosen: chosen === null ? null : chosen.getAttribute("data-point"),
      open: document.querySelectorAll("details[open]").length,
    };
  });
  const keys = [];
  for (const key of ["Tab", "Enter", "ArrowRight", "ArrowRight", "ArrowLeft", "End", "Tab", "Enter"]) {
    await page.keyboard.press(key);
    keys.push([key, await focus()]);
  }
  process.stdout.write(JSON.stringify({ errors, width, small, light, dark, backticks, unexplained, keys }));
} finally {
  await browser.close();
}
