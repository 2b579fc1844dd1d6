// How fast the page by itself is in headless Chromium: for each scene the milliseconds until
// its native picture, those that planning takes, and the machine's cycles a microsecond.
//
//   node speed.mjs PATH-OF-PUPPETEER-CORE ADDRESS TARGET SCENE...
//   node speed.mjs --tune PATH-OF-PUPPETEER-CORE ADDRESS TARGET SCENE...
//
// A scene is opened three times; the quickest stands, as whatever else runs only slows it. The
// second is for what accuracy costs: the seconds until its first point and its end, once.

import path from "node:path";
import { readFileSync } from "node:fs";
import { execFileSync } from "node:child_process";
import { createRequire } from "node:module";
import { deflateRawSync } from "node:zlib";

const given = process.argv.slice(2);
const tunes = given[0] === "--tune";
const [root, address, target, ...scenes] = given.slice(tunes ? 1 : 0);
const puppeteer = createRequire(path.join(path.resolve(root), "package.json"))("puppeteer-core");

const browser = await puppeteer.launch({
  executablePath: execFileSync("which", ["chromium"]).toString().trim(),
  headless: true,
  // As root, as in a container, Chromium has no sandbox.
  args: ["--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage"],
});

// When the machine was seen to begin what.
function watch() {
  window.times = {};
  document.addEventListener("DOMContentLoaded", () => {
    const heard = () => {
      const said = document.getElementById("machine-said");
      if (said) window.times[said.textContent.split(",")[0]] ??= performance.now();
    };
    new MutationObserver(heard).observe(document.body, { childList: true, subtree: true, characterData: true });
  });
}

// The page with this scene, once the machine has drawn it.
async function opened(scene, use) {
  const page = await browser.newPage();
  try {
    await page.evaluateOnNewDocument(watch);
    const given = { name: path.basename(scene, ".scn"), text: readFileSync(scene, "utf8"), target };
    await page.goto(address + "#s=" + deflateRawSync(JSON.stringify(given)).toString("base64url"));
    await page.waitForFunction(() => document.getElementById("figures")?.textContent.includes("unlike the model"), { timeout: 300000 });
    return await use(page);
  } finally {
    await page.close();
  }
}

const once = (scene) =>
  opened(scene, async (page) => {
    const times = await page.evaluate(() => window.times);
    const words = (id) => page.$eval(id, (e) => e.textContent);
    const cycles = Number((await words("#figures dd")).replaceAll(",", ""));
    const native = Number((await words("#native-said")).match(/in (\d+) ms/)?.[1]);
    // A run that is over before it is seen has no time of its own.
    const ran = (times["comparing with the model"] ?? NaN) - times.running;
    return [native, times.running - times.planning, ran > 500 ? cycles / ran / 1000 : NaN];
  });

const searched = (scene) =>
  opened(scene, async (page) => {
    const begun = performance.now();
    const until = async (what) => {
      await page.waitForFunction(what, { timeout: 600000 });
      return ((performance.now() - begun) / 1000).toFixed(1) + " s";
    };
    await page.click("#tune");
    const first = await until(() => document.querySelector("#points tr"));
    return [first, await until(() => document.getElementById("tune").textContent === "Search again")];
  });

try {
  for (const scene of scenes) {
    if (tunes) {
      const [first, end] = await searched(scene);
      console.log(`${path.basename(scene)}: first point after ${first}, all after ${end}`);
      continue;
    }
    const all = [];
    for (let k = 0; k < 3; k++) all.push(await once(scene));
    const least = (k) => Math.min(...all.map((a) => a[k]));
    const most = Math.max(...all.map((a) => a[2]).filter(Number.isFinite));
    const speed = most < 0 ? "too short a run to tell" : most.toFixed(0) + " MHz";
    console.log(`${path.basename(scene)}: native in ${least(0).toFixed(0)} ms, planned in ${least(1).toFixed(0)} ms, ${speed}`);
  }
} finally {
  await browser.close();
}
