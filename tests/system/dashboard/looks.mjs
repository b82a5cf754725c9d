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

/// A map that is moved is shifted, not painted: what stands there is what painting it for that place gives.
export async function aMovedMapIsThePaintedOne(page) {
  const { differing, of, moved } = await look(page, async () => {
    const { view, state } = window.lifeline;
    const { canvas } = document.querySelector("#ground").getContext("2d");
    const pixels = () => new Uint32Array(canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.buffer);
    const rest = async () => {
      do await new Promise(requestAnimationFrame);
      while (!view.isShown());
    };
    const differences = (a, b) => a.reduce((sum, pixel, i) => sum + (pixel === b[i] ? 0 : 1), 0);
    const heard = () => `${view.map.changes} ${state.trailsHeard}`;
    for (;;) {
      view.fit();
      view.camera.zoom(2);
      await rest();
      const before = pixels(), known = heard();
      view.camera.pan(60, -40);
      view.draw();
      const shifted = pixels();
      await rest();
      view.redraw();
      await rest();
      // What arrived meanwhile is painted, too.
      if (heard() !== known) continue;
      return { differing: differences(shifted, pixels()), of: shifted.length, moved: differences(before, shifted) };
    }
  });
  assert.ok(moved > 0.01 * of, `${moved} of ${of} pixels changed when it was moved`);
  assert.ok(differing < 0.0005 * of, `${differing} of ${of} pixels differ`);
}
