// Where labels stand: beside what they name, and clear of marks and of each other where one of the four sides has room.
import { drawLabel } from "./pen";
import type { MapColours } from "./theme";

interface Box {
  x0: number;
  y0: number;
  x1: number;
  y1: number;
}

interface Wish {
  key: string;
  text: string;
  x: number;
  y: number;
  gap: number;
}

const SIDES = 4; // right, left, below, above

function overlap(a: Box, b: Box): number {
  const width = Math.min(a.x1, b.x1) - Math.max(a.x0, b.x0), height = Math.min(a.y1, b.y1) - Math.max(a.y0, b.y0);
  return width > 0 && height > 0 ? width * height : 0;
}

/// Those of one picture: marks and wishes are gathered, then draw() writes all labels above all marks. Lives on from picture
/// to picture, so that a label keeps its side as long as there is room.
export class Labels {
  private taken: Box[] = [];
  private wishes: Wish[] = [];
  private sides = new Map<string, number>();

  /// No label over a mark of this radius.
  keepClear(x: number, y: number, radius: number): void {
    this.taken.push({ x0: x - radius, y0: y - radius, x1: x + radius, y1: y + radius });
  }

  /// `gap`: from the mark's middle to the label. `key`: of what is named, the same in the next picture.
  add(key: string, text: string, x: number, y: number, gap: number): void {
    this.wishes.push({ key, text, x, y, gap });
  }

  draw(pen: CanvasRenderingContext2D, unit: number, paint: MapColours): void {
    pen.font = `bold ${14 * unit}px sans-serif`;
    const sides = new Map<string, number>();
    // What is added last, helmets, chooses first.
    const wishes = this.wishes.reverse();
    const places = wishes.map((wish) => {
      const width = pen.measureText(wish.text).width;
      const boxes = Array.from({ length: SIDES }, (_, side) => boxOf(wish, side, width, 16 * unit));
      const side = this.clearest(boxes, this.sides.get(wish.key) ?? 0);
      this.taken.push(boxes[side]!);
      sides.set(wish.key, side);
      return boxes[side]!;
    });
    wishes.forEach(({ text }, i) => drawLabel(pen, text, places[i]!.x0, (places[i]!.y0 + places[i]!.y1) / 2, unit, paint));
    this.sides = sides;
    this.taken = [];
    this.wishes = [];
  }

  private clearest(boxes: Box[], first: number): number {
    const hidden = (side: number) => this.taken.reduce((sum, box) => sum + overlap(box, boxes[side]!), 0);
    const order = [first, ...boxes.keys()].map((side) => ({ side, hidden: hidden(side) }));
    return order.reduce((best, next) => (next.hidden < best.hidden ? next : best)).side;
  }
}

function boxOf({ x, y, gap }: Wish, side: number, width: number, height: number): Box {
  const [middleX, middleY] = [
    [x + gap + width / 2, y],
    [x - gap - width / 2, y],
    [x, y + gap + height / 2],
    [x, y - gap - height / 2],
  ][side] as [number, number];
  return { x0: middleX - width / 2, y0: middleY - height / 2, x1: middleX + width / 2, y1: middleY + height / 2 };
}
