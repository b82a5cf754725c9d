// Maps, tile by tile: decoded, classified (Eq. 6 of the paper) and painted into canvases of 8 x 8 tiles.
import { decompress } from "fzstd";
import type { Tiles } from "./dashboard_pb";

export const SIDE = 64;
const CELLS = SIDE * SIDE;
const CHUNK = 8;
export const CHUNK_CELLS = CHUNK * SIDE;
export const UNKNOWN = 0;
export const FREE = 1;
export const WALL = 2;

export interface Palette {
  free: [number, number, number];
  wall: [number, number, number];
}
interface Tile {
  x: number;
  y: number;
  tsd: Int8Array;
  weight: Uint8Array;
  known: number;
}
export interface Chunk {
  x: number;
  y: number;
  pen: CanvasRenderingContext2D;
  /// The same at a quarter of the size, for when the map is seen from afar: walls win over free, free over unknown.
  smallPen: CanvasRenderingContext2D;
}
export const SMALLER = 4;
const SMALL_SIDE = SIDE / SMALLER;

function penOf(side: number): CanvasRenderingContext2D {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = side;
  return canvas.getContext("2d")!;
}

/// A pixel's four octets, in memory's order.
function pixel([r, g, b]: [number, number, number]): number {
  return new Uint32Array(new Uint8Array([r, g, b, 255]).buffer)[0]!;
}

// One number for each tile: indices are within +-512.
const keyOf = (x: number, y: number) => (x + 4096) * 8192 + (y + 4096);

export class TileMap {
  readonly tiles = new Map<number, Tile>();
  readonly chunks = new Map<number, Chunk>();
  isComplete = false;
  changes = 0;
  private readonly dirty = new Set<number>();
  private readonly image = new ImageData(SIDE, SIDE);
  private readonly pixels = new Uint32Array(this.image.data.buffer);
  private readonly smallImage = new ImageData(SMALL_SIDE, SMALL_SIDE);
  private readonly smallPixels = new Uint32Array(this.smallImage.data.buffer);

  take(frame: Tiles): void {
    if (frame.fromStart) this.clear();
    for (const sent of frame.tiles) {
      const key = keyOf(sent.x, sent.y);
      if (sent.cells.length === 0) {
        this.tiles.delete(key);
      } else {
        const planes = decompress(sent.cells, new Uint8Array(2 * CELLS));
        const tsd = new Int8Array(planes.buffer, planes.byteOffset, CELLS);
        const weight = planes.subarray(CELLS, 2 * CELLS);
        this.tiles.set(key, { x: sent.x, y: sent.y, tsd, weight, known: 0 });
      }
      // A cell's class hangs on its neighbours, which may be in the next tile.
      for (const [dx, dy] of [[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]] as const)
        this.dirty.add(keyOf(sent.x + dx, sent.y + dy));
    }
    this.isComplete = frame.isComplete;
    this.changes++;
  }

  clear(): void {
    this.tiles.clear();
    this.chunks.clear();
    this.dirty.clear();
    this.changes++;
  }

  repaint(): void {
    this.chunks.clear();
    for (const key of this.tiles.keys()) this.dirty.add(key);
  }

  /// Paints what changed, for at most `budgetMs`, or longer while a whole map is to be painted. False: nothing was to do.
  paint(palette: Palette, budgetMs: number): boolean {
    if (this.dirty.size === 0) return false;
    const end = performance.now() + (this.dirty.size > 500 ? 8 * budgetMs : budgetMs);
    for (const key of this.dirty) {
      this.dirty.delete(key);
      this.paintTile(key, palette);
      if (performance.now() > end) break;
    }
    return true;
  }

  /// What is known of a cell, by its index in the whole map.
  at(x: number, y: number): number {
    const tile = this.tiles.get(keyOf(x >> 6, y >> 6));
    return tile ? this.classify(tile, x & 63, y & 63) : UNKNOWN;
  }

  isPainted(): boolean {
    return this.dirty.size === 0;
  }

  knownCells(): number {
    let known = 0;
    for (const tile of this.tiles.values()) known += tile.known;
    return known;
  }

  /// Lowest and highest cell; null where there is nothing.
  extent(): { x0: number; y0: number; x1: number; y1: number } | null {
    let x0 = Infinity, y0 = Infinity, x1 = -Infinity, y1 = -Infinity;
    for (const tile of this.tiles.values()) {
      x0 = Math.min(x0, tile.x * SIDE);
      y0 = Math.min(y0, tile.y * SIDE);
      x1 = Math.max(x1, (tile.x + 1) * SIDE);
      y1 = Math.max(y1, (tile.y + 1) * SIDE);
    }
    return x0 === Infinity ? null : { x0, y0, x1, y1 };
  }

  /// As the coordinator hashes its common map: tiles by x, then y; index (8 octets each), then tsd and weight of each cell.
  async sha256(): Promise<string> {
    const tiles = [...this.tiles.values()].sort((a, b) => a.x - b.x || a.y - b.y);
    const bytes = new Uint8Array(tiles.length * (16 + 2 * CELLS));
    const view = new DataView(bytes.buffer);
    let at = 0;
    for (const tile of tiles) {
      view.setBigUint64(at, BigInt(tile.x >>> 0), true);
      view.setBigUint64(at + 8, BigInt(tile.y >>> 0), true);
      at += 16;
      for (let i = 0; i < CELLS; i++) {
        view.setInt8(at++, tile.tsd[i]!);
        bytes[at++] = tile.weight[i]!;
      }
    }
    const hash = new Uint8Array(await crypto.subtle.digest("SHA-256", bytes));
    return [...hash].map((octet) => octet.toString(16).padStart(2, "0")).join("");
  }

  private neighbour(tile: Tile, x: number, y: number): number {
    if (x >= 0 && y >= 0 && x < SIDE && y < SIDE) {
      const i = y * SIDE + x;
      return tile.weight[i] ? tile.tsd[i]! : 0;
    }
    const other = this.tiles.get(keyOf(tile.x + (x >> 6), tile.y + (y >> 6)));
    if (!other) return 0;
    const i = (y & 63) * SIDE + (x & 63);
    return other.weight[i] ? other.tsd[i]! : 0;
  }

  private classify(tile: Tile, x: number, y: number): number {
    const i = y * SIDE + x;
    if (!tile.weight[i]) return UNKNOWN;
    const tsd = tile.tsd[i]!;
    if (
      tsd === 0 ||
      tsd * this.neighbour(tile, x + 1, y) < 0 ||
      tsd * this.neighbour(tile, x - 1, y) < 0 ||
      tsd * this.neighbour(tile, x, y + 1) < 0 ||
      tsd * this.neighbour(tile, x, y - 1) < 0
    )
      return WALL;
    return tsd > 0 ? FREE : UNKNOWN;
  }

  private paintTile(key: number, palette: Palette): void {
    const tile = this.tiles.get(key);
    const tx = tile ? tile.x : Math.floor(key / 8192) - 4096;
    const ty = tile ? tile.y : (key % 8192) - 4096;
    const cx = Math.floor(tx / CHUNK), cy = Math.floor(ty / CHUNK);
    let chunk = this.chunks.get(keyOf(cx, cy));
    if (!chunk) {
      if (!tile) return;
      chunk = { x: cx, y: cy, pen: penOf(CHUNK_CELLS), smallPen: penOf(CHUNK_CELLS / SMALLER) };
      this.chunks.set(keyOf(cx, cy), chunk);
    }
    this.pixels.fill(0);
    if (tile) this.paintCells(tile, pixel(palette.free), pixel(palette.wall));
    const left = (tx - cx * CHUNK) * SIDE, top = (CHUNK - 1 - (ty - cy * CHUNK)) * SIDE;
    chunk.pen.putImageData(this.image, left, top);
    this.shrink(pixel(palette.wall));
    chunk.smallPen.putImageData(this.smallImage, left / SMALLER, top / SMALLER);
  }

  private shrink(wall: number): void {
    for (let y = 0; y < SMALL_SIDE; y++) {
      for (let x = 0; x < SMALL_SIDE; x++) {
        let best = 0;
        for (let i = 0; i < SMALLER * SMALLER && best !== wall; i++)
          best = this.pixels[(y * SMALLER + (i >> 2)) * SIDE + x * SMALLER + (i & 3)]! || best;
        this.smallPixels[y * SMALL_SIDE + x] = best;
      }
    }
  }

  // As classify(), without a call for each cell inside. Where nothing is known, tsd is 0.
  private paintCells(tile: Tile, free: number, wall: number): void {
    const { tsd, weight } = tile;
    tile.known = 0;
    for (let y = 0, i = 0; y < SIDE; y++) {
      for (let x = 0; x < SIDE; x++, i++) {
        if (weight[i] === 0) continue;
        const t = tsd[i]!;
        const left = x > 0 ? tsd[i - 1]! : this.neighbour(tile, -1, y);
        const right = x < SIDE - 1 ? tsd[i + 1]! : this.neighbour(tile, SIDE, y);
        const below = y > 0 ? tsd[i - SIDE]! : this.neighbour(tile, x, -1);
        const above = y < SIDE - 1 ? tsd[i + SIDE]! : this.neighbour(tile, x, SIDE);
        const isWall = t === 0 || t * left < 0 || t * right < 0 || t * below < 0 || t * above < 0;
        if (!isWall && t < 0) continue;
        tile.known++;
        this.pixels[(SIDE - 1 - y) * SIDE + x] = isWall ? wall : free; // rows go up, a picture's go down
      }
    }
  }
}

export class TileMaps {
  private readonly maps = new Map<string, TileMap>();

  take(frame: Tiles): void {
    this.get(frame.map).take(frame);
  }
  get(map: string): TileMap {
    let found = this.maps.get(map);
    if (!found) this.maps.set(map, (found = new TileMap()));
    return found;
  }
  /// Only these are watched: the others' tiles are no longer true.
  keep(watched: string[]): void {
    for (const name of this.maps.keys()) if (!watched.includes(name)) this.maps.delete(name);
  }
  repaint(): void {
    for (const map of this.maps.values()) map.repaint();
  }
}
