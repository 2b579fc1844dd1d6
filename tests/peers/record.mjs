// Records the page of `slowlight live` in headless Chromium, as README shows it: the 6502's
// picture grows, a slider moves the eye, and a quicker way is taken from what accuracy costs.
//
//   target/release/slowlight live examples/mirrors.scn --target 6502
//   node tests/peers/record.mjs target/peers/node_modules/puppeteer-core ADDRESS FOLDER
//   python3 tests/peers/film.py FOLDER docs/pictures/live.gif
//
// FOLDER is made for the frames: a PNG each, whose name ends in how long it is shown, in ms.

import path from "node:path";
import { mkdirSync, writeFileSync } from "node:fs";
import { execFileSync } from "node:child_process";
import { createRequire } from "node:module";

const [root, address, folder] = process.argv.slice(2);
const puppeteer = createRequire(path.join(path.resolve(root), "package.json"))("puppeteer-core");
const pause = (ms) => new Promise((done) => setTimeout(done, ms));
mkdirSync(folder);

const browser = await puppeteer.launch({
  executablePath: execFileSync("which", ["chromium"]).toString().trim(),
  headless: true,
  // As root, as in a container, Chromium has no sandbox.
  args: ["--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars"],
});
try {
  const page = await browser.newPage();
  await page.setViewport({ width: 1100, height: 720 });
  await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: "dark" }, { name: "prefers-reduced-motion", value: "reduce" }]);
  await page.goto(address, { waitUntil: "load" });

  let k = 0;
  const shot = async (ms = 200) => {
    const bytes = await page.screenshot();
    writeFileSync(path.join(folder, `${String(k++).padStart(3, "0")}-${ms}.png`), bytes);
  };
  const words = (id) => page.$eval("#" + id, (e) => e.textContent);
  const until = (holds) => page.waitForFunction(holds, { timeout: 120000, polling: 20 });
  // A film of what goes on until something holds, in so many frames at most; that is then waited
  // for, or not.
  const film = async (holds, every, most, waits = true) => {
    for (let n = 0; n < most && !(await page.evaluate(holds)); n++) {
      const begun = Date.now();
      await shot();
      await pause(Math.max(0, every - (Date.now() - begun)));
    }
    if (waits) await until(holds);
  };
  const done = () => document.getElementById("figures").textContent.includes("unlike the model");
  const grows = () => document.getElementById("machine-said").textContent.startsWith("running");

  // Screenshots have no pointer.
  await page.evaluate(() => {
    const dot = Object.assign(document.createElement("div"), { id: "pointer" });
    Object.assign(dot.style, {
      position: "fixed", width: "18px", height: "18px", margin: "-9px", borderRadius: "50%", zIndex: 9, pointerEvents: "none",
      background: "rgba(255, 255, 255, .35)", border: "2px solid white", left: "-30px",
    });
    document.body.append(dot);
    addEventListener("mousemove", (e) => { dot.style.left = e.clientX + "px"; dot.style.top = e.clientY + "px"; });
  });
  const middle = (selector) => page.$eval(selector, (e) => {
    const box = e.getBoundingClientRect();
    return [box.left + box.width / 2, box.top + box.height / 2];
  });
  const click = async (selector) => {
    await page.mouse.move(...(await middle(selector)));
    await shot(500);
    await page.mouse.click(...(await middle(selector)));
  };

  // The quickest format is over before it is seen to grow.
  await until(() => document.querySelector("#format option[value='fixed16.16']") && / in \d+ ms/.test(document.getElementById("native-said").textContent));
  await page.select("#format", "fixed16.16");
  await until(grows);
  await film(done, 300, 30);
  await shot(1200);

  // The eye goes back, by its slider.
  const slider = (await page.$$("#sliders input[type=range]"))[2];
  const box = await slider.boundingBox();
  const at = (part) => [box.x + 8 + part * (box.width - 16), box.y + box.height / 2];
  await page.mouse.move(...at(0.5));
  await page.mouse.down();
  for (let n = 0; n <= 8; n++) {
    await page.mouse.move(...at(0.5 + n / 20));
    await pause(250);
    await shot();
  }
  await page.mouse.up();
  await until(grows);
  await film(done, 300, 30);
  await shot(1200);

  // What accuracy costs: points come in, and one is taken.
  await click("#tune");
  // Among the points it would look like one.
  await page.evaluate(() => { document.getElementById("pointer").style.left = "-30px"; });
  const points = () => document.getElementById("tune").textContent === "Search again";
  await film(points, 2500, 60, false);
  if ((await words("tune")) === "Stop the search") await page.click("#tune");
  await until(() => document.getElementById("tune").textContent === "Search again");
  await shot(1200);
  // The quickest with less than one pixel in a hundred in another ink.
  const good = await page.$$eval("#points tr", (all) => all.findIndex((row) => parseFloat(row.children[2].textContent) < 1));
  await click(`#plot [data-point="${good}"]`);
  await until(() => document.getElementById("options").textContent !== "");
  await film(done, 200, 30);
  await shot(3500);
  console.log(`${k} frames; ${await words("point-said")}`);
} finally {
  await browser.close();
}
