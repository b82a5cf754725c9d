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
  const begin = await page.evaluate(() => ({ frames: window.lifeline.frames(), at: performance.now() }));
  await page.waitForTimeout(1000 * Number(seconds));
  const end = await page.evaluate(() => ({ frames: window.lifeline.frames(), at: performance.now() }));
  const moved = await page.evaluate(async (ms) => {
    const { view, frames } = window.lifeline;
    view.camera.zoom(3);
    const begin = { frames: frames(), at: performance.now() };
    await new Promise((done) => {
      const move = () => {
        const at = performance.now() - begin.at;
        view.camera.pan(6 * Math.cos(at / 500), 6 * Math.sin(at / 500));
        view.camera.turn(0.004);
        if (at > ms) done();
        else requestAnimationFrame(move);
      };
      move();
    });
    return (1000 * (frames() - begin.frames)) / (performance.now() - begin.at);
  }, 1000 * Number(seconds));
  const session = await page.context().newCDPSession(page);
  await session.send("HeapProfiler.collectGarbage");
  const heap = await page.evaluate(() => performance.memory.usedJSHeapSize);
  const painted = await page.evaluate(() => [...window.lifeline.view.map.chunks.values()].reduce((sum, { pen }) => sum + (17 / 16) * 4 * pen.canvas.width * pen.canvas.height, 0));
  const cells = await page.evaluate(() => window.lifeline.tiles() * 8192);
  console.log(JSON.stringify({
    first_tiles_s: (firstTiles - opened) / 1000,
    whole_map_s: (whole - opened) / 1000,
    frames_per_s: (1000 * (end.frames - begin.frames)) / (end.at - begin.at),
    moved_per_s: moved,
    page_mb: (heap + painted + cells) / 1e6,
    helmets: await page.evaluate(() => window.lifeline.state.helmets().length),
  }));
} finally {
  await browser.close();
}
