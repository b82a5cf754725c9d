// What a page takes: measure.mjs PACKAGES CHROMIUM ADDRESS TILES SECONDS; one JSON object.
import { createRequire } from "node:module";
import { join } from "node:path";

const [, , packages, chromium, address, tiles, seconds] = process.argv;
const playwright = createRequire(join(packages, "package.json"))("playwright-core");
const browser = await playwright.chromium.launch({ executablePath: chromium, args: ["--no-sandbox", "--enable-precise-memory-info"] });
try {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  const opened = Date.now();
  await page.goto(address, { waitUntil: "commit" });
  await page.waitForFunction(() => window.lifeline?.tiles() > 0 && window.lifeline.frames() > 1, null, { polling: 20 });
  const firstTiles = Date.now();
  await page.waitForFunction((wanted) => window.lifeline.tiles() >= wanted && window.lifeline.isShown(), Number(tiles), { polling: 20, timeout: 120_000 });
  const whole = Date.now();
  // How long each frame takes while the map is left alone, or moved in every one of them.
  const drive = (motion) => page.evaluate(async ([motion, ms]) => {
    const { camera } = window.lifeline.view;
    const moves = {
      rest: () => {},
      pan: (at) => camera.pan(6 * Math.cos(at / 500), 6 * Math.sin(at / 500)),
      turn: () => camera.turn(0.004),
      zoom: (at) => camera.zoom(1 + 0.01 * Math.cos(at / 500)),
    };
    const times = [];
    const begin = performance.now();
    for (let last = begin; last - begin < ms; ) {
      await new Promise(requestAnimationFrame);
      const now = performance.now();
      times.push(now - last);
      last = now;
      moves[motion](now - begin);
    }
    times.sort((a, b) => a - b);
    const sum = times.reduce((a, b) => a + b, 0);
    return { per_s: (1000 * times.length) / sum, median_ms: times[times.length >> 1], p99_ms: times[Math.floor(0.99 * times.length)] };
  }, [motion, 1000 * Number(seconds)]);
  const driven = { rest: await drive("rest"), far_pan: await drive("pan") };
  await page.evaluate(() => window.lifeline.view.camera.zoom(3));
  for (const motion of ["pan", "turn", "zoom"]) driven[motion] = await drive(motion);
  const session = await page.context().newCDPSession(page);
  await session.send("HeapProfiler.collectGarbage");
  const heap = await page.evaluate(() => performance.memory.usedJSHeapSize);
  const painted = await page.evaluate(() => [...window.lifeline.view.map.chunks.values()].reduce((sum, { pen }) => sum + (17 / 16) * 4 * pen.canvas.width * pen.canvas.height, 0));
  const cells = await page.evaluate(() => window.lifeline.tiles() * 8192);
  console.log(JSON.stringify({
    first_tiles_s: (firstTiles - opened) / 1000,
    whole_map_s: (whole - opened) / 1000,
    ...Object.fromEntries(Object.entries(driven).flatMap(([motion, times]) => Object.entries(times).map(([name, value]) => [`${motion}_${name}`, value]))),
    page_mb: (heap + painted + cells) / 1e6,
    helmets: await page.evaluate(() => window.lifeline.state.helmets().length),
  }));
} finally {
  await browser.close();
}
