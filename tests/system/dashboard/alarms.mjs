// Calls for help, roll calls, and who answers.
import assert from "node:assert/strict";
import { until } from "./mission.mjs";

export async function aMaydayComesToTheFront(page, voice) {
  const said = Date.now();
  voice.say("mayday no air");
  const band = page.locator("#alarms .band.kind-0");
  await band.waitFor({ timeout: 20_000 });
  console.log(`          mayday on the page after ${Date.now() - said} ms`);
  assert.match(await band.innerText(), /MAYDAY: zulu[^]*no air[^]*waits for you/);
  const box = await band.boundingBox();
  assert.ok(box.y < 5, "over everything else");
  assert.ok(!voice.output.includes("answered by coordinator"), "nobody has acknowledged it yet");
  await page.locator("#map").focus();
  await page.keyboard.press("a");
  await voice.prints("alert zulu answered by coordinator", 20);
  await until("the band goes", async () => (await band.count()) === 0);
  assert.match(await page.locator("#panel-log").textContent(), /acknowledged/);
}

export async function aRollCallTakesTwoPresses(page) {
  await page.locator("#order-2").click();
  await page.getByRole("button", { name: /Press again/ }).click();
  const band = page.locator("#alarms .band.kind-2");
  await band.waitFor();
  assert.match(await band.innerText(), /0 of \d answered[^]*missing: [^]*alpha/);
  await band.getByRole("button", { name: "End it" }).click();
  await until("it is over", async () => (await band.count()) === 0);
}

/// A real helmet, by its one button.
export async function aHelmetCallsForHelpAndAnswers(page, button) {
  button.write("1");
  const mayday = page.locator("#alarms .band.kind-0", { hasText: "MAYDAY: bravo" });
  await mayday.waitFor({ timeout: 20_000 });
  button.write("0");
  await page.locator("#order-2").click();
  await page.getByRole("button", { name: /Press again/ }).click();
  const call = page.locator("#alarms .band.kind-2");
  // Each press answers what waits for an answer longest.
  await until("bravo is not missing", async () => {
    button.write("10");
    await page.waitForTimeout(300);
    return /missing: (?![^]*bravo)/.test(await call.innerText());
  });
  await call.getByRole("button", { name: "End it" }).click();
  button.write("1");
  await until("all is well again", async () => (await mayday.count()) === 0);
  button.write("0");
}
