// A way through cells that were seen to be free, and nothing else: never through the unknown, never closer to a wall than a
// person's shoulder. A* on blocks of 4 x 4 cells.
import { FREE, WALL, type TileMap } from "./tiles";

const BLOCK = 4;
const MOST_BLOCKS = 400_000;

export interface Point {
  x: number;
  y: number;
}

/// A binary heap of block numbers by cost.
class Heap {
  private readonly items: [number, number][] = [];
  get size(): number {
    return this.items.length;
  }
  push(cost: number, block: number): void {
    const items = this.items;
    let i = items.push([cost, block]) - 1;
    while (i > 0) {
      const up = (i - 1) >> 1;
      if (items[up]![0] <= items[i]![0]) break;
      [items[up], items[i]] = [items[i]!, items[up]!];
      i = up;
    }
  }
  pop(): number {
    const items = this.items;
    const top = items[0]![1];
    const last = items.pop()!;
    if (items.length > 0) {
      items[0] = last;
      for (let i = 0; ; ) {
        let least = i;
        for (const child of [2 * i + 1, 2 * i + 2])
          if (child < items.length && items[child]![0] < items[least]![0]) least = child;
        if (least === i) break;
        [items[least], items[i]] = [items[i]!, items[least]!];
        i = least;
      }
    }
    return top;
  }
}

const pack = (bx: number, by: number) => (bx + 16384) * 32768 + (by + 16384);
const unpack = (block: number): [number, number] => [Math.floor(block / 32768) - 16384, (block % 32768) - 16384];

/// Where a person fits: the block's own cells all free, and no wall in the cells right around it.
function passable(map: TileMap, bx: number, by: number, known: Map<number, boolean>): boolean {
  const key = pack(bx, by);
  const held = known.get(key);
  if (held !== undefined) return held;
  let fits = true;
  for (let y = by * BLOCK - 2; y < by * BLOCK + BLOCK + 2 && fits; y++) {
    for (let x = bx * BLOCK - 2; x < bx * BLOCK + BLOCK + 2 && fits; x++) {
      const inside = x >= bx * BLOCK && y >= by * BLOCK && x < bx * BLOCK + BLOCK && y < by * BLOCK + BLOCK;
      const kind = map.at(x, y);
      fits = inside ? kind === FREE : kind !== WALL;
    }
  }
  known.set(key, fits);
  return fits;
}

function nearestPassable(map: TileMap, p: Point, cell: number, known: Map<number, boolean>): number | null {
  const bx = Math.floor(p.x / cell / BLOCK), by = Math.floor(p.y / cell / BLOCK);
  for (let reach = 0; reach <= 5; reach++) {
    for (let dy = -reach; dy <= reach; dy++)
      for (let dx = -reach; dx <= reach; dx++)
        if (Math.max(Math.abs(dx), Math.abs(dy)) === reach && passable(map, bx + dx, by + dy, known))
          return pack(bx + dx, by + dy);
  }
  return null;
}

/// Points of the map's frame, metres, from start to goal; null where no free way is known.
export function findRoute(map: TileMap, from: Point, to: Point, cell: number): Point[] | null {
  const known = new Map<number, boolean>();
  const start = nearestPassable(map, from, cell, known);
  const goal = nearestPassable(map, to, cell, known);
  if (start === null || goal === null) return null;
  const [gx, gy] = unpack(goal);
  const guess = (block: number) => {
    const [x, y] = unpack(block);
    return Math.hypot(x - gx, y - gy);
  };
  const cost = new Map<number, number>([[start, 0]]);
  const cameFrom = new Map<number, number>();
  const done = new Set<number>();
  const open = new Heap();
  open.push(guess(start), start);
  while (open.size > 0 && done.size < MOST_BLOCKS) {
    const here = open.pop();
    if (here === goal) return trace(cameFrom, goal, cell, from, to);
    if (done.has(here)) continue;
    done.add(here);
    const [x, y] = unpack(here);
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1], [1, 1], [1, -1], [-1, 1], [-1, -1]] as const) {
      if (!passable(map, x + dx, y + dy, known)) continue;
      // No cutting of corners.
      if (dx && dy && !(passable(map, x + dx, y, known) && passable(map, x, y + dy, known))) continue;
      const next = pack(x + dx, y + dy);
      const total = cost.get(here)! + Math.hypot(dx, dy);
      if (total >= (cost.get(next) ?? Infinity)) continue;
      cost.set(next, total);
      cameFrom.set(next, here);
      open.push(total + guess(next), next);
    }
  }
  return null;
}

function trace(cameFrom: Map<number, number>, goal: number, cell: number, from: Point, to: Point): Point[] {
  const points: Point[] = [to];
  for (let block: number | undefined = goal; block !== undefined; block = cameFrom.get(block)) {
    const [x, y] = unpack(block);
    points.push({ x: (x + 0.5) * BLOCK * cell, y: (y + 0.5) * BLOCK * cell });
  }
  points.push(from);
  return points.reverse();
}

export function length(points: Point[]): number {
  let sum = 0;
  for (let i = 1; i < points.length; i++) sum += Math.hypot(points[i]!.x - points[i - 1]!.x, points[i]!.y - points[i - 1]!.y);
  return sum;
}
