// What the page looks like: on every screen, in every theme.
import assert from "node:assert/strict";
import { join } from "node:path";
import { until } from "./mission.mjs";

const look = (page, of) => page.evaluate(of);

export async function noThemeIsHardToRead(page, axe, artefacts) {
  await page.setViewportSize({ width: 2560, height: 1440 }); // all panels at once
  for (const theme of ["night", "day", "contrast"]) {
    await until(theme, async () => {
      if ((await page.locator("html").getAttribute("data-theme")) === theme) return true;
      await page.locator("#theme").click();
      return false;
    });
    await page.evaluate(axe);
    const found = await look(page, async () => (await window.axe.run(document)).violations
      .filter(({ impact }) => impact === "serious" || impact === "critical")
      .map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html.slice(0, 120)).join(" | ")}`));
    assert.deepEqual(found, [], theme);
    await page.screenshot({ path: join(artefacts, `${theme}.png`) });
  }
}

export async function fitsEveryScreen(openPage, artefacts) {
  for (const [width, height] of [[360, 740], [1280, 800], [3840, 2160]]) {
    const page = await openPage("", { width, height });
    await until("it is painted", () => look(page, () => window.lifeline.tiles() > 0 && window.lifeline.isShown() && window.lifeline.frames() > 5));
    const wide = await look(page, () => document.documentElement.scrollWidth - document.documentElement.clientWidth);
    assert.ok(wide <= 0, `${width} px: ${wide} px too wide`);
    await page.screenshot({ path: join(artefacts, `${width}.png`), fullPage: width < 800 });
    await page.close();
  }
}
