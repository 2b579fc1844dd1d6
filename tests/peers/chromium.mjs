// Opens a page from the disk in headless Chromium and clicks its points.
//
//   node chromium.mjs PATH-OF-PUPPETEER-CORE PAGE.html SCREENSHOT.png
//
// The answer, on standard output as JSON:
//   "errors"    what the console said as an error, and what was thrown
//   "asked"     what the page asked for beside itself and its own data
//   "before", "clicked"   for the picture and the difference: {"shown", "width", "height", "data"}
//   "words"     what the page says of the point that was clicked
//   "points"    how many points there are

import path from "node:path";
import { execFileSync } from "node:child_process";
import { pathToFileURL } from "node:url";
import { createRequire } from "node:module";

const [root, page_file, screenshot] = process.argv.slice(2);
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
  await page.setViewport({ width: 1000, height: 1700 });
  const url = pathToFileURL(path.resolve(page_file)).href;
  const errors = [];
  const asked = [];
  page.on("pageerror", (error) => errors.push(String(error)));
  page.on("console", (said) => { if (said.type() === "error") errors.push(said.text()); });
  page.on("request", (request) => {
    const to = request.url();
    if (to !== url && !to.startsWith("data:")) asked.push(to);
  });
  await page.goto(url, { waitUntil: "load" });
  const look = () => page.evaluate(() => ["picture", "difference"].map((id) => {
    const image = document.getElementById(id);
    const box = image.getBoundingClientRect();
    return { shown: box.width > 0 && !image.hidden, width: image.naturalWidth, height: image.naturalHeight, data: image.src };
  }));
  const before = await look();
  const points = await page.$$eval("circle.point", (all) => all.length);
  // The last in the document is drawn above all others. Points may have one picture: the
  // first that has another than what is shown will do.
  const changed = (old) => page.waitForFunction((old) => {
    const image = document.getElementById("picture");
    return image.src !== old && image.complete && image.naturalWidth > 0;
  }, { timeout: 2000 }, old).then(() => true, () => false);
  let other = false;
  for (const circle of (await page.$$("circle.point")).reverse()) {
    await circle.click();
    other = await changed(before[0].data);
    if (other) break;
  }
  if (!other) throw new Error("no point has another picture");
  const clicked = await look();
  const words = await page.$$eval("#words li, #spent li, #facts tr", (all) => all.map((e) => e.textContent));
  await page.screenshot({ path: screenshot });
  process.stdout.write(JSON.stringify({ errors, asked, before, clicked, words, points }));
} finally {
  await browser.close();
}
