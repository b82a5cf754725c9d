// Two helmets' walls, the second laid on the first as their match found it.
import type { Merge } from "./dashboard_pb";
import { SIDE, WALL, type TileMap } from "./tiles";
import { colours } from "./theme";

interface Dot {
  x: number;
  y: number;
}

function walls(map: TileMap, cell: number): Dot[] {
  const dots: Dot[] = [];
  for (const tile of map.tiles.values()) {
    for (let y = tile.y * SIDE; y < (tile.y + 1) * SIDE; y++)
      for (let x = tile.x * SIDE; x < (tile.x + 1) * SIDE; x++)
        if (map.at(x, y) === WALL) dots.push({ x: (x + 0.5) * cell, y: (y + 0.5) * cell });
  }
  return dots;
}

export function drawPair(canvas: HTMLCanvasElement, merge: Merge, a: TileMap, b: TileMap, cell: number): void {
  const context = canvas.getContext("2d")!;
  const c = Math.cos(merge.yawRad), s = Math.sin(merge.yawRad);
  const first = walls(a, cell);
  const second = walls(b, cell).map((p) => ({ x: merge.xM + c * p.x - s * p.y, y: merge.yM + s * p.x + c * p.y }));
  const all = [...first, ...second];
  context.fillStyle = colours().unknown;
  context.fillRect(0, 0, canvas.width, canvas.height);
  if (all.length === 0) return;
  let x0 = Infinity, y0 = Infinity, x1 = -Infinity, y1 = -Infinity;
  for (const p of all) {
    x0 = Math.min(x0, p.x);
    y0 = Math.min(y0, p.y);
    x1 = Math.max(x1, p.x);
    y1 = Math.max(y1, p.y);
  }
  const scale = 0.94 * Math.min(canvas.width / (x1 - x0 + cell), canvas.height / (y1 - y0 + cell));
  const size = Math.max(1.5, cell * scale);
  const draw = (dots: Dot[], colour: string) => {
    context.fillStyle = colour;
    for (const p of dots)
      context.fillRect(canvas.width / 2 + (p.x - (x0 + x1) / 2) * scale, canvas.height / 2 - (p.y - (y0 + y1) / 2) * scale, size, size);
  };
  draw(first, document.documentElement.dataset["theme"] === "day" ? "#004f7c" : "#56B4E9");
  context.globalAlpha = 0.75;
  draw(second, document.documentElement.dataset["theme"] === "day" ? "#a04000" : "#E69F00");
  context.globalAlpha = 1;
}
