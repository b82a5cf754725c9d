// The dashboard end to end: dashboard_test.mjs BIN SOURCE PACKAGES CHROMIUM ARTEFACTS.
import assert from "node:assert/strict";
import { mkdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { aHelmetCallsForHelpAndAnswers, aMaydayComesToTheFront, aRollCallTakesTwoPresses } from "./alarms.mjs";
import { whoLooksBackMissesNothing } from "./look_back.mjs";
import { aMovedMapIsThePaintedOne, fitsEveryScreen, noThemeIsHardToRead } from "./looks.mjs";
import { whatIsUnsearchedIsShown } from "./search.mjs";
import { freePort, Mission, until } from "./mission.mjs";

const [, , bin, source, packages, chromium, artefacts] = process.argv;
const require = createRequire(join(packages, "package.json"));
const playwright = require("playwright-core");
const axe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");
mkdirSync(artefacts, { recursive: true });

const mission = new Mission(bin, source);
const port = await freePort();
const address = `http://127.0.0.1:${port}`;
let browser;
const complaints = [];

async function openPage(fragment = "", viewport = { width: 1280, height: 800 }) {
  const page = await browser.newPage({ viewport, reducedMotion: "reduce" });
  page.on("pageerror", (error) => complaints.push(`page error: ${error.message}`));
  page.on("console", (message) => {
    // A server that is away is no fault of the page.
    if (message.type() === "error" && !message.text().includes("WebSocket")) complaints.push(message.text());
  });
  page.on("request", (request) => {
    const url = request.url();
    if (!url.startsWith(`${address}/`) && !url.startsWith("data:")) complaints.push(`asked elsewhere: ${url}`);
  });
  await page.goto(`${address}/${fragment}`);
  return page;
}

const look = (page, of) => page.evaluate(of);
const holdsTheMap = (page) =>
  until("the page holds the coordinator's common map", () =>
    look(page, async () => {
      const { lifeline } = window;
      if (lifeline.state.map !== "" || !lifeline.isComplete() || lifeline.tiles() === 0) return false;
      const hash = await lifeline.hash();
      return hash === lifeline.expectedHash() && hash;
    }));

async function step(name, run) {
  const began = Date.now();
  await run();
  console.log(`ok   ${((Date.now() - began) / 1000).toFixed(1).padStart(5)} s  ${name}`);
}

async function theMapAppears(page) {
  const places = new Set();
  await until("helmets move", async () => {
    const at = await look(page, () => JSON.stringify([...window.lifeline.state.poses.values()].map((p) => [p.agentId, p.xM.toFixed(1), p.yM.toFixed(1)])));
    if (at !== "[]") places.add(at);
    return places.size >= 4;
  });
  await until("both helmets hold one map", () => look(page, () =>
    window.lifeline.state.helmets().filter(({ agent }) => agent.holdsSameMap && agent.state === 4).length === 2));
  await holdsTheMap(page);
  const walls = await look(page, () => window.lifeline.view.map.knownCells());
  assert.ok(walls > 20_000, `${walls} known cells`);
  const labels = await look(page, () => Object.fromEntries(window.lifeline.state.helmets().map(({ agent }) => [agent.agentId, agent.label])));
  assert.deepEqual([labels.alpha, labels.bravo], ["AL", "BR"], "as on the helmets' own displays");
}

async function aFindIsConfirmed(page, voice) {
  voice.say("find");
  await page.getByRole("tab", { name: "Finds" }).click();
  const card = page.locator(".find", { hasText: "seen by zulu" });
  await card.getByRole("button", { name: "Confirm" }).click();
  await voice.prints("find ruled 1", 20);
  await until("it is confirmed", async () => (await card.locator("h3").innerText()) === "Victim: confirmed");
  await card.getByRole("button", { name: "Undo" }).click();
  await until("it is taken back", async () => (await card.locator("h3").innerText()) === "Victim: reported");
}

async function aMergeIsWithdrawn(page) {
  await page.getByRole("tab", { name: "Merges" }).click();
  const card = page.locator('.merge[data-pair="alpha/1 bravo/1"]');
  await card.getByRole("button", { name: "Picture" }).click();
  await until("walls of both are drawn", () => look(page, () => {
    const canvas = document.querySelector("canvas.pair:not([hidden])");
    const pixels = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
    const colours = new Set();
    for (let i = 0; i < pixels.length; i += 4) colours.add(`${pixels[i]},${pixels[i + 1]},${pixels[i + 2]}`);
    return colours.size > 3;
  }));
  await card.getByRole("button", { name: "Withdraw" }).click();
  await until("there is no common map any more", () => look(page, () => {
    const { state } = window.lifeline;
    return state.merges.members.length === 0 && state.fleet.commonMapSha256.length === 0 && state.map !== "";
  }));
  await until("and the card says why", async () => /withdrawn by hand/.test(await card.innerText()));
  await card.getByRole("button", { name: "Accept" }).click();
  await until("it is back", () => look(page, () => window.lifeline.state.merges.members.length === 2));
  await holdsTheMap(page);
  await until("and the card says so", async () => /accepted by hand/.test(await card.innerText()));
}

async function keysMoveTheMap(page) {
  await page.locator("#map").focus();
  const camera = () => look(page, () => ({ ...window.lifeline.view.camera }));
  const before = await camera();
  for (const key of ["ArrowRight", "+", "e"]) await page.keyboard.press(key);
  const after = await camera();
  assert.notEqual(after.x, before.x);
  assert.ok(after.pixelsPerM > before.pixelsPerM);
  assert.notEqual(after.turnRad, before.turnRad);
  await page.keyboard.press("m");
  await page.keyboard.press("Enter");
  await page.keyboard.press("ArrowUp");
  await page.keyboard.press("Enter");
  assert.match(await page.locator("#map-note").innerText(), /Distance: \d+\.\d\d m/);
  await page.keyboard.press("Escape");
  // The exit where helmet 2 stands: its own door may be closed by now, and then no way is known to it.
  for (const key of ["2", "x", "Enter", "1", "r"]) await page.keyboard.press(key);
  assert.match(await page.locator("#map-note").innerText(), /Way out for \w+: \d+ m/);
  const blocked = await look(page, () => {
    const { view } = window.lifeline;
    const cell = view.cellM();
    const inner = view.route.points.slice(1, -1);
    return view.route.isFree ? inner.filter((p) => view.map.at(Math.floor(p.x / cell), Math.floor(p.y / cell)) !== 1).length : -1;
  });
  assert.equal(blocked, 0, "the way leads through free cells alone");
  await page.keyboard.press("l");
  assert.equal(await page.locator("#tab-team").innerText(), "Trupp");
  await page.keyboard.press("l");
  await page.keyboard.press("?");
  await page.keyboard.press("Escape");
  await page.keyboard.press("Escape");
  await page.keyboard.press("f");
}

async function namesStayNames(page, voice) {
  voice.say("hostile");
  await page.getByRole("tab", { name: "Team" }).click();
  await until("the text is shown", async () => (await page.locator("#alarms").innerText()).includes("<script>pwned=1</script>?("));
  const team = page.locator("#panel-team");
  assert.doesNotMatch(await team.innerText(), /img|bad/, "the coordinator takes no such names");
  // And if it did:
  const shown = await look(page, () => {
    const { state, show } = window.lifeline;
    const name = "<img src=x onerror=pwned=1>";
    state.fleet.agents.push({ ...state.fleet.agents.find((agent) => agent.isHelmet), agentId: name, number: 9 });
    state.alerts = [...state.alerts, { ...state.alerts[0], issuerId: name, subjectId: name, alertId: 77 }];
    state.merges.merges.push({ ...state.merges.merges[0], mapA: `${name}/1`, reason: name });
    state.finds.push({ ...state.finds[0], agentId: name, seenBy: [name] });
    show();
    return ["team", "log", "merges", "finds", "links"].filter((tab) => !document.getElementById(`panel-${tab}`).textContent.includes(name));
  });
  assert.deepEqual(shown, [], "shown as text everywhere");
  assert.equal(await look(page, () => typeof window.pwned), "undefined");
  assert.equal(await page.locator("main img, #alarms img, body script").count(), 0);
}

async function whoOnlyLooksHasNoButtons() {
  const page = await openPage("#look");
  await holdsTheMap(page);
  assert.match(await page.locator("#connection").innerText(), /look only/);
  assert.equal(await page.locator("#order-1").count(), 0);
  await page.close();
}

async function aRestartIsSurvived(page, coordinator) {
  await coordinator.stop("SIGKILL");
  await until("the page says so", async () => (await page.locator("#connection").innerText()).includes("NO CONNECTION"));
  const again = mission.coordinator(port, "off");
  await until("it is live again", async () => (await page.locator("#connection").innerText()).includes("LIVE"));
  await until("and knows the helmets", () => look(page, () => window.lifeline.state.helmets().filter(({ agent }) => agent.holdsSameMap).length >= 2));
  const hash = await holdsTheMap(page);
  await page.locator("#look-back").click();
  await until("without a recording it is said how to make one", async () => /--record FOLDER/.test(await page.locator("#map-note").innerText()));
  assert.equal(await again.stop(), 0, again.output);
  const report = JSON.parse(readFileSync(join(mission.folder, "report/coordinator.json"), "utf8"));
  assert.equal(report.common_map_sha256, hash, "cell for cell what the coordinator reports");
}

try {
  const coordinator = mission.coordinator(port);
  await coordinator.prints(`dashboard: ${address}/`, 20);
  browser = await playwright.chromium.launch({ executablePath: chromium, args: ["--no-sandbox"] });
  const page = await openPage();
  await page.waitForFunction(() => window.lifeline.state.hello);
  const voice = mission.voice("zulu");
  // Slow enough to be seen moving, and for a busy machine to drop few scans.
  const walk = "walkers=2&duration=60&rate=x4&beams=400&seed=1";
  mission.helmet("alpha", `sim:office?walker=0&${walk}`);
  const button = mission.button();
  const hud = join(mission.folder, "bravo.png");
  mission.helmet("bravo", `sim:office?walker=1&${walk}`, "--button", button.path, "--hud-png", hud);
  await step("the demo's map appears and is the coordinator's, cell for cell", () => theMapAppears(page));
  await step("a mayday comes to the front and is acknowledged by a key", () => aMaydayComesToTheFront(page, voice));
  await step("a roll call takes two presses and says who is missing", () => aRollCallTakesTwoPresses(page));
  await step("a helmet's button calls for help, answers a roll call, and all is well", () => aHelmetCallsForHelpAndAnswers(page, button));
  await step("its HUD's picture is a PNG", () => until("it is written", () => readFileSync(hud).subarray(1, 4).toString() === "PNG"));
  await step("a find is confirmed, and that is taken back", () => aFindIsConfirmed(page, voice));
  await step("a merge is withdrawn, the map follows, and it is accepted again", () => aMergeIsWithdrawn(page));
  await step("keys move, measure and find the way out", () => keysMoveTheMap(page));
  await step("a moved map is the painted one, to the pixel", () => aMovedMapIsThePaintedOne(page));
  await step("what is unsearched is shown, and who searched what", () => whatIsUnsearchedIsShown(page, artefacts));
  await whoLooksBackMissesNothing(step, { page, openPage, voice, holdsTheMap, artefacts });
  await step("who only looks has no buttons", () => whoOnlyLooksHasNoButtons());
  await step("script in names and texts stays text", () => namesStayNames(page, voice));
  await step("the page fits 360, 1280 and 3840 px", () => fitsEveryScreen(openPage, artefacts));
  await step("no theme has a serious finding of axe", () => noThemeIsHardToRead(page, axe, artefacts));
  await step("a server that is killed and started again is joined again", () => aRestartIsSurvived(page, coordinator));
  assert.deepEqual(complaints, []);
} catch (error) {
  console.error(error);
  for (const program of mission.programs) console.error("----", program.child.spawnargs.slice(0, 5).join(" "), "\n", program.output.slice(-1500));
  console.error("page:", complaints);
  process.exitCode = 1;
} finally {
  await browser?.close();
  await mission.end();
}
