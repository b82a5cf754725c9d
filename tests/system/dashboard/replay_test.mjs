// `lifeline-coordinator replay --dashboard` end to end: replay_test.mjs BIN SOURCE PACKAGES CHROMIUM ARTEFACTS.
import assert from "node:assert/strict";
import { mkdirSync, readdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { freePort, Mission, until } from "./mission.mjs";

const [, , bin, source, packages, chromium, artefacts] = process.argv;
const require = createRequire(join(packages, "package.json"));
const playwright = require("playwright-core");
const axe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");
mkdirSync(artefacts, { recursive: true });

const mission = new Mission(bin, source);
const look = (page, of) => page.evaluate(of);
const timeline = (page) => look(page, () => ({ ...window.lifeline.state.timeline }));
let browser;

/// Two helmets and a coordinator that records them, from start to end.
async function record() {
  const records = join(mission.folder, "records");
  const coordinator = mission.start("lifeline-coordinator", mission.joined("run", "--dashboard", "off", "--record", records,
    "--report", join(mission.folder, "report"), "--expect", "2", "--until-settled", "--time-limit", "200"));
  const walk = "walkers=2&duration=60&rate=max&beams=400&seed=1";
  for (const [walker, id] of ["alpha", "bravo"].entries()) mission.helmet(id, `sim:office?walker=${walker}&${walk}`);
  assert.equal(await coordinator.ended, 0, coordinator.output);
  const { common_map_sha256 } = JSON.parse(readFileSync(join(mission.folder, "report/coordinator.json"), "utf8"));
  return { bag: join(records, readdirSync(records)[0]), hash: common_map_sha256 };
}

async function step(name, run) {
  const began = Date.now();
  await run();
  console.log(`ok   ${((Date.now() - began) / 1000).toFixed(1).padStart(5)} s  ${name}`);
}

const holds = (page, hash) =>
  until("the page holds the mission's common map", () => look(page, async () =>
    window.lifeline.state.map === "" && window.lifeline.isComplete() && window.lifeline.tiles() > 0 && (await window.lifeline.hash())).then((held) => held === hash));

async function itPlaysToTheEnd(page, replay, hash) {
  await page.locator("#speed").selectOption("0");
  await until("the end", async () => { const { atS, lengthS } = await timeline(page); return atS > 0 && atS >= lengthS - 0.01; });
  await holds(page, hash);
  await replay.prints(`common map: ${hash}`, 20);
  assert.match(await page.locator("#looking-back").innerText(), /LOOKING BACK: \d\d:\d\d:\d\d on .*NOT LIVE/);
  assert.equal(await page.locator("#connection").innerText().then((text) => /RECORDING/.test(text) && !/LIVE/.test(text)), true);
  assert.equal(await page.locator("#order-1").count(), 0, "nobody is ordered about in a recording");
  assert.equal(await page.getByRole("button", { name: "Withdraw" }).count(), 0);
  assert.doesNotMatch(await page.locator("#facts").innerText(), /standby/);
}

async function itGoesBack(page) {
  await page.locator("#map").focus();
  await page.keyboard.press("p");
  await until("it stands still", async () => (await timeline(page)).isPaused);
  await page.locator("#seek").evaluate((slider) => { slider.value = "0"; slider.dispatchEvent(new Event("input")); });
  await until("the beginning, and no map", async () => (await timeline(page)).atS < 1 && (await look(page, () => window.lifeline.tiles())) === 0);
  const { atS } = await timeline(page);
  assert.equal((await timeline(page)).isPaused, true, "still");
  const clockThen = await look(page, () => window.lifeline.state.now());
  const beat = (await timeline(page)).beat;
  await until("ten frames later", async () => (await timeline(page)).beat > beat + 10);
  assert.equal((await timeline(page)).atS, atS, "time stands still");
  assert.equal(await look(page, () => window.lifeline.state.now()), clockThen, "and nobody grows old");
}

async function keysMoveOn(page, hash) {
  await page.locator("#map").focus();
  const { lengthS } = await timeline(page);
  for (let at = 0; at <= lengthS; at += 10) {
    const before = (await timeline(page)).atS;
    await page.keyboard.press(".");
    await until("ten seconds on", async () => { const { atS, isSeeking } = await timeline(page); return !isSeeking && (atS > before + 5 || atS >= lengthS - 0.01); });
  }
  await holds(page, hash);
  await page.keyboard.press(",");
  await until("ten seconds back", async () => { const { atS, isSeeking } = await timeline(page); return !isSeeking && atS < lengthS - 1; });
}

async function itIsMeantForEverybody(page) {
  await page.evaluate(axe);
  const found = await look(page, async () => (await window.axe.run(document)).violations
    .filter(({ impact }) => impact === "serious" || impact === "critical").map(({ id, nodes }) => `${id}: ${nodes[0].html.slice(0, 120)}`));
  assert.deepEqual(found, []);
  await page.screenshot({ path: join(artefacts, "replay.png") });
  await page.keyboard.press("l");
  assert.match(await page.locator("#looking-back").innerText(), /RÜCKSCHAU.*NICHT LIVE/);
  await page.setViewportSize({ width: 360, height: 740 });
  const wide = await look(page, () => document.documentElement.scrollWidth - document.documentElement.clientWidth);
  assert.ok(wide <= 0, `${wide} px too wide`);
  await page.screenshot({ path: join(artefacts, "replay-360.png"), fullPage: true });
}

try {
  const { bag, hash } = await record();
  const port = await freePort();
  const replay = mission.start("lifeline-coordinator", ["replay", bag, "--speed", "1", "--dashboard", `127.0.0.1:${port}`]);
  await replay.prints(`http://127.0.0.1:${port}/`, 20);
  browser = await playwright.chromium.launch({ executablePath: chromium, args: ["--no-sandbox"] });
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, reducedMotion: "reduce" });
  await page.goto(`http://127.0.0.1:${port}/`);
  await until("the band", async () => page.locator("#timeline").isVisible());
  await step("a recording plays to its end and is the mission's map, cell for cell", () => itPlaysToTheEnd(page, replay, hash));
  await step("it goes back to the beginning and stands still there", () => itGoesBack(page));
  await step("keys move on and back", () => keysMoveOn(page, hash));
  await step("the band is readable, in both languages, on a small screen too", () => itIsMeantForEverybody(page));
  assert.equal(await replay.stop("SIGINT"), 0, replay.output);
} catch (error) {
  console.error(error);
  for (const program of mission.programs) console.error("----", program.child.spawnargs.slice(0, 5).join(" "), "\n", program.output.slice(-1500));
  process.exitCode = 1;
} finally {
  await browser?.close();
  await mission.end();
}
