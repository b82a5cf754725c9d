// What is left to be searched, who searched what, and where each helmet might go, on the page.
import assert from "node:assert/strict";
import { join } from "node:path";
import { until } from "./mission.mjs";

const look = (page, of) => page.evaluate(of);

// Every point in the square of 4 x 4 cells that it is the middle of: is one of them free, is one of the squares beside unknown?
const judge = () => {
  const { state, view } = window.lifeline;
  const { search } = state;
  const square = (p, dx = 0, dy = 0) => {
    const x = 4 * (Math.floor(p.x / 0.2) + dx), y = 4 * (Math.floor(p.y / 0.2) + dy);
    const cells = [];
    for (let i = 0; i < 16; i++) cells.push(view.map.at(x + (i & 3), y + (i >> 2)));
    return cells;
  };
  const isFree = (p) => square(p).filter((cell) => cell === 1).length > 0;
  const borders = (p) => [[1, 0], [-1, 0], [0, 1], [0, -1]].some(([dx, dy]) => square(p, dx, dy).filter((cell) => cell === 0).length >= 8);
  const points = search.frontiers.flat();
  return {
    points: points.length,
    notFree: points.filter((p) => !isFree(p)).length,
    notAtTheEdge: points.filter((p) => !borders(p)).length,
    throughWalls: search.suggestions.flatMap(({ way }) => way).filter((p) => !isFree(p)).length,
    ends: search.suggestions.map(({ way }) => `${way.at(-1).x.toFixed(1)},${way.at(-1).y.toFixed(1)}`),
    atTheHelmet: search.suggestions.every(({ agentId, way }) => {
      const pose = state.poses.get(agentId);
      return Math.hypot(pose.xM - way[0].x, pose.yM - way[0].y) < 1.6;
    }),
    shares: Object.fromEntries([...search.shares].map(([name, { firstM2, seenM2 }]) => [name, { firstM2, seenM2 }])),
    searchedM2: search.searchedM2,
    knownM2: view.map.knownCells() * 0.0025,
  };
};

export async function whatIsUnsearchedIsShown(page, artefacts) {
  await page.keyboard.press("Escape");
  await page.keyboard.press("c");
  const found = await until("edges of the known, all of them free beside the unknown, and a free way for both helmets", async () => {
    const now = await look(page, judge);
    const isWhole = Math.abs(now.searchedM2 - now.knownM2) < 0.1 * now.knownM2;
    // A plan may be a second older than the map that is on show.
    const isNew = now.notFree === 0 && now.notAtTheEdge === 0 && now.throughWalls === 0;
    return now.points > 0 && now.ends.length === 2 && isWhole && isNew && now;
  });
  console.log(`          ${found.points} points of edges; searched ${found.searchedM2.toFixed(0)} m2 of ${found.knownM2.toFixed(0)} m2 known; ${JSON.stringify(found.shares)}`);
  assert.ok(found.atTheHelmet, "ways begin where the helmet is");
  assert.equal(new Set(found.ends).size, 2, "no two helmets are sent to one place");
  const { alpha, bravo } = found.shares;
  assert.ok(alpha.firstM2 > 5 && bravo.firstM2 > 5, "both searched something first");
  assert.ok(alpha.seenM2 >= alpha.firstM2 && bravo.seenM2 >= bravo.firstM2);
  assert.ok(Math.abs(alpha.firstM2 + bravo.firstM2 - found.searchedM2) < 0.1, "every place is somebody's first");
  const team = page.locator("#panel-team");
  await until("the team list says it", async () => /saw \d+ m² first \(\d+ %\)[^]*could search next: \d+ m away/.test(await team.textContent()));
  await page.keyboard.press("s");
  assert.equal(await page.locator("#search-help").getAttribute("aria-pressed"), "false");
  await page.keyboard.press("s");
  assert.match(await page.locator("#map-note").innerText(), /a suggestion and no order/);
  await page.keyboard.press("w");
  assert.equal(await page.locator("#who-searched").getAttribute("aria-pressed"), "true");
  assert.match(await page.locator("#map-note").innerText(), /who saw it first: alpha \d+ m², bravo \d+ m²/);
  await until("it is painted", () => look(page, () => window.lifeline.isShown()));
  await page.screenshot({ path: join(artefacts, "search.png") });
  await page.keyboard.press("l");
  assert.equal(await page.locator("#who-searched").innerText(), "Wer suchte wo");
  await page.keyboard.press("l");
  await page.keyboard.press("w");
}
