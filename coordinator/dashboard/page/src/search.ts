// What is left to be searched and who searched what, as the server told it last, and how that looks on the map.
import { decompress } from "fzstd";
import type { Agent, Search } from "./dashboard_pb";
import type { Camera } from "./camera";
import type { Labels } from "./labels";
import { colourOf } from "./marks";
import { drawLabel, drawLine } from "./pen";
import type { Point } from "./route";
import { colours } from "./theme";
import { decimals } from "./words";

/// Squares along one side of a tile, and tiles along one side of a picture.
const SIDE = 8, CHUNK = 8;
const SQUARES = SIDE * SIDE;
const CELLS_A_SQUARE = 8;
const RECORD = 4 + SQUARES;
const TINT = 0.4;

/// Points as they travel: the first, then differences, in centimetres.
export function pointsOf(cm: number[]): Point[] {
  const points = [];
  let x = 0, y = 0;
  for (let i = 0; i + 1 < cm.length; i += 2) points.push({ x: (x += cm[i]! / 100), y: (y += cm[i + 1]! / 100) });
  return points;
}

export interface Suggestion {
  agentId: string;
  distanceM: number;
  way: Point[];
}
interface OwnedTile {
  x: number;
  y: number;
  owners: Uint8Array;
}

export class SearchHelp {
  frontiers: Point[][] = [];
  suggestions: Suggestion[] = [];
  searchedM2 = 0;
  /// By name: what each saw first, and at all.
  shares = new Map<string, { firstM2: number; seenM2: number }>();
  names: string[] = [];
  tiles: OwnedTile[] = [];
  /// Frontiers and suggestions are on show; who searched what is.
  isShown = true;
  isTinted = false;
  heard = 0;
  private painted = "";
  private pictures: { x: number; y: number; canvas: HTMLCanvasElement }[] = [];

  take(search: Search): void {
    this.heard++;
    this.searchedM2 = search.searchedM2;
    this.frontiers = search.frontiers.map((line) => pointsOf(line.pointsCm));
    this.suggestions = search.suggestions.map(({ agentId, distanceM, wayCm }) => ({ agentId, distanceM, way: pointsOf(wayCm) }));
    this.shares = new Map(search.shares.map((share) => [share.agentId, share]));
    this.names = search.shares.map((share) => share.agentId);
    this.tiles = [];
    const plain = search.owners.length > 0 ? decompress(search.owners) : new Uint8Array();
    const view = new DataView(plain.buffer, plain.byteOffset, plain.byteLength);
    for (let at = 0; at + RECORD <= plain.length; at += RECORD)
      this.tiles.push({ x: view.getInt16(at, true), y: view.getInt16(at + 2, true), owners: plain.subarray(at + 4, at + RECORD) });
  }
  forget(): void {
    this.frontiers = [];
    this.suggestions = [];
    this.tiles = [];
    this.shares.clear();
    this.heard++;
  }

  /// In each helmet's colour, and its label here and there: never a colour alone. `agentOf` by name.
  drawTint(pen: CanvasRenderingContext2D, camera: Camera, cellM: number, scale: number, unit: number, agentOf: (name: string) => Agent | undefined): void {
    const agents = this.names.map(agentOf);
    this.paint(agents.map((agent) => agent?.number ?? 0));
    const squareM = cellM * CELLS_A_SQUARE, tileM = squareM * SIDE;
    pen.imageSmoothingEnabled = false;
    pen.globalAlpha = TINT;
    for (const { x, y, canvas } of this.pictures) {
      const t = camera.imageTransform(x * CHUNK * tileM, (y + 1) * CHUNK * tileM, squareM);
      pen.setTransform(t.a! * scale, t.b! * scale, t.c! * scale, t.d! * scale, t.e! * scale, t.f! * scale);
      pen.drawImage(canvas, 0, 0);
    }
    pen.globalAlpha = 1;
    pen.setTransform(scale, 0, 0, scale, 0, 0);
    if (tileM * camera.pixelsPerM < 20 * unit) return;
    for (const { x, y, owners } of this.tiles) {
      const owner = owners[(SIDE / 2) * SIDE + SIDE / 2]!;
      if (owner === 0 || (x & 1) !== 0 || (y & 1) !== 0 || !agents[owner - 1]) continue;
      const [px, py] = camera.toScreen((x + 0.5) * tileM, (y + 0.5) * tileM);
      drawLabel(pen, agents[owner - 1]!.label, px, py, unit, colours());
    }
  }

  drawFrontiers(pen: CanvasRenderingContext2D, camera: Camera, unit: number): void {
    for (const line of this.frontiers)
      drawLine(pen, line.map((p) => camera.toScreen(p.x, p.y)), { colour: colours().ink, width: 3 * unit, dash: [7 * unit, 5 * unit] });
  }

  drawSuggestions(pen: CanvasRenderingContext2D, camera: Camera, unit: number, labels: Labels, agentOf: (name: string) => Agent | undefined): void {
    for (const { agentId, distanceM, way } of this.suggestions) {
      const end = way.at(-1);
      if (!end) continue;
      const colour = colourOf(agentOf(agentId)?.number || 1);
      drawLine(pen, way.map((p) => camera.toScreen(p.x, p.y)), { colour, width: 3 * unit, dash: [2 * unit, 7 * unit] });
      const [x, y] = camera.toScreen(end.x, end.y);
      for (const [ink, width] of [["#000", 6], [colour, 3]] as const) {
        pen.beginPath();
        pen.arc(x, y, 10 * unit, 0, 2 * Math.PI);
        pen.strokeStyle = ink;
        pen.lineWidth = width * unit;
        pen.stroke();
      }
      labels.keepClear(x, y, 11 * unit);
      labels.add(`${agentId}?`, `${agentOf(agentId)?.label ?? ""}?  ${decimals(distanceM, 0)} m`, x, y, 16 * unit);
    }
  }

  private paint(numbers: number[]): void {
    const key = `${this.heard} ${numbers.join()}`;
    if (key === this.painted) return;
    this.painted = key;
    const chunks = new Map<string, OwnedTile[]>();
    for (const tile of this.tiles) {
      const name = `${Math.floor(tile.x / CHUNK)},${Math.floor(tile.y / CHUNK)}`;
      chunks.set(name, [...(chunks.get(name) ?? []), tile]);
    }
    this.pictures = [...chunks].map(([name, tiles]) => {
      const [x, y] = name.split(",").map(Number) as [number, number];
      const canvas = document.createElement("canvas");
      canvas.width = canvas.height = SIDE * CHUNK;
      const pen = canvas.getContext("2d")!;
      for (const tile of tiles) {
        const left = (tile.x - x * CHUNK) * SIDE, top = (CHUNK - 1 - (tile.y - y * CHUNK)) * SIDE;
        tile.owners.forEach((owner, i) => {
          const number = owner > 0 ? numbers[owner - 1] : 0;
          if (!number) return;
          pen.fillStyle = colourOf(number);
          pen.fillRect(left + (i % SIDE), top + SIDE - 1 - Math.floor(i / SIDE), 1, 1);
        });
      }
      return { x, y, canvas };
    });
  }
}
