// Looking back while the mission goes on: one page does, another stays live, and what is urgent comes to both.
import assert from "node:assert/strict";
import { join } from "node:path";
import { until } from "./mission.mjs";

const look = (page, of) => page.evaluate(of);
const timeline = (page) => look(page, () => window.lifeline.state.timeline && { ...window.lifeline.state.timeline });
const press = async (page, key) => {
  await page.locator("#map").focus();
  await page.keyboard.press(key);
};
const rests = (page, atS) => until(`it rests at ${atS} s`, async () => {
  const now = await timeline(page);
  return now && !now.isSeeking && now.isPaused && Math.abs(now.atS - atS) < 1.5 && now;
});
const seek = (page, toS) => page.locator("#seek").evaluate((slider, to) => {
  slider.value = String(to);
  slider.dispatchEvent(new Event("input"));
}, toS);

async function itLooksBack(page, live, artefacts) {
  const now = await look(live, () => window.lifeline.hash());
  await press(page, "b");
  await until("the band", () => page.locator("#timeline").isVisible());
  assert.equal((await timeline(page)).isMissionLive, true);
  await press(page, "p");
  await seek(page, 0);
  await rests(page, 0);
  await until("the beginning, and no map", () => look(page, () => window.lifeline.tiles() === 0));
  assert.match(await page.locator("#looking-back").innerText(), /LOOKING BACK: \d\d:\d\d:\d\d on .*NOT LIVE/);
  assert.match(await page.locator("#connection").innerText(), /NOT LIVE/);
  const { lengthS } = await timeline(page);
  await seek(page, Math.floor(lengthS));
  await rests(page, Math.floor(lengthS));
  await until("the map that the other page holds, cell for cell", () => look(page, () => window.lifeline.hash()).then((hash) => hash === now));
  await page.screenshot({ path: join(artefacts, "look-back.png") });
  assert.equal(await timeline(live), null, "another page stays live");
  assert.match(await live.locator("#connection").innerText(), /^●?\s*LIVE/);
  const before = (await timeline(page)).lengthS;
  await until("the mission goes on meanwhile", async () => (await timeline(page)).lengthS > before + 1);
}

async function nothingIsOrderedFromThePast(page) {
  assert.equal(await page.locator("#order-1").count(), 0);
  await page.getByRole("tab", { name: "Merges" }).click();
  assert.equal(await page.getByRole("button", { name: "Withdraw" }).count(), 0);
  // Whatever a page says, the server knows where it looks.
  const refused = await look(page, async () => {
    const { actions } = window.lifeline;
    return Promise.all([
      actions.link.ask({ case: "raiseAlert", value: { kind: 1, subjectId: "", text: "" } }),
      actions.link.ask({ case: "ruleMerge", value: { mapA: "alpha/1", mapB: "bravo/1", isMerged: false } }),
    ]);
  });
  for (const why of refused) assert.match(why, /looks back: go back to live first/);
}

async function aMaydayComesToTheFrontOfThePast(page, live, voice) {
  voice.say("mayday in the past");
  const band = page.locator("#alarms .band.kind-0");
  await band.waitFor({ timeout: 20_000 });
  assert.match(await band.innerText(), /MAYDAY: zulu[^]*LIVE[^]*in the past[^]*waits for you/);
  assert.ok((await band.boundingBox()).y < 5, "over the band that says NOT LIVE, too");
  assert.ok((await timeline(page)).isMissionLive, "the page is not torn from what it looks at");
  await press(page, "a");
  await until("it is answered, on both pages", async () => (await band.count()) === 0 && (await live.locator("#alarms .band.kind-0").count()) === 0);
}

async function oneKeyGoesBackToLive(page, holdsTheMap) {
  await press(page, "b");
  await until("it is live", async () => (await timeline(page)) === null && !(await page.locator("#timeline").isVisible()));
  await holdsTheMap(page);
  assert.match(await page.locator("#connection").innerText(), /LIVE/);
  assert.equal(await page.locator("#order-1").count(), 1);
  // Ten seconds back from live, and the button.
  await press(page, ",");
  await until("it looks back again", async () => (await timeline(page))?.isMissionLive);
  await page.keyboard.press("l");
  assert.match(await page.locator("#looking-back").innerText(), /RÜCKSCHAU.*NICHT LIVE/);
  assert.equal(await page.locator("#back-to-live").innerText(), "Zurück zu live (B)");
  await page.keyboard.press("l");
  await page.locator("#back-to-live").click();
  await until("it is live again", async () => (await timeline(page)) === null);
  await holdsTheMap(page);
}

async function onlySoManyLookBack(openPage) {
  const pages = [await openPage(), await openPage(), await openPage()];
  for (const page of pages) await page.waitForFunction(() => window.lifeline.state.fleet);
  for (const page of pages.slice(0, 2)) {
    await press(page, "b");
    await until("it looks back", async () => (await timeline(page))?.isMissionLive);
  }
  await press(pages[2], "b");
  await until("the third is told", async () => /others look back already/.test(await pages[2].locator("#map-note").innerText()));
  assert.equal(await timeline(pages[2]), null);
  for (const page of pages) await page.close();
}

/// `step` runs and reports; two pages of a mission that is recorded.
export async function whoLooksBackMissesNothing(step, { page, openPage, voice, holdsTheMap, artefacts }) {
  const live = await openPage();
  await live.waitForFunction(() => window.lifeline.state.fleet);
  await step("a page looks back to the beginning while another stays live", () => itLooksBack(page, live, artefacts));
  await step("nothing is ordered from the past", () => nothingIsOrderedFromThePast(page));
  await step("a mayday comes to the front of the past and is answered there", () => aMaydayComesToTheFrontOfThePast(page, live, voice));
  await step("one key goes back to live, and one button", () => oneKeyGoesBackToLive(page, holdsTheMap));
  await live.close();
  await step("only so many look back at once", () => onlySoManyLookBack(openPage));
}
