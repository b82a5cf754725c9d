// Strokes and letters that can be read on any ground.
import type { MapColours } from "./theme";

type Pen = CanvasRenderingContext2D;

/// Diagonal lines, 16 pixels apart.
export function hatching(pen: CanvasRenderingContext2D, ground: string, line: string): CanvasPattern {
  const tile = document.createElement("canvas");
  tile.width = tile.height = 16;
  const at = tile.getContext("2d")!;
  at.fillStyle = ground;
  at.fillRect(0, 0, 16, 16);
  at.strokeStyle = line;
  at.lineWidth = 2;
  for (const shift of [-16, 0, 16]) {
    at.moveTo(shift - 2, 18);
    at.lineTo(shift + 18, -2);
  }
  at.stroke();
  return pen.createPattern(tile, "repeat")!;
}

export interface Stroke {
  colour: string;
  width: number;
  dash?: number[];
  hasEdge?: boolean;
}

/// Along points of the screen.
export function drawLine(pen: Pen, points: [number, number][], { colour, width, dash = [], hasEdge = true }: Stroke): void {
  // Steps that nobody sees are left out.
  const step = width <= 1 ? 6 : 2;
  let lastX = Infinity, lastY = Infinity;
  pen.beginPath();
  points.forEach(([x, y], i) => {
    if (i < points.length - 1 && Math.abs(x - lastX) + Math.abs(y - lastY) < step) return;
    pen.lineTo((lastX = x), (lastY = y));
  });
  pen.setLineDash(dash);
  if (hasEdge) {
    pen.strokeStyle = "#000";
    pen.lineWidth = width + 2;
    pen.stroke();
  }
  pen.strokeStyle = colour;
  pen.lineWidth = width;
  pen.stroke();
  pen.setLineDash([]);
}

export function drawLabel(pen: Pen, text: string, x: number, y: number, unit: number, paint: MapColours): void {
  pen.font = `bold ${14 * unit}px sans-serif`;
  pen.textAlign = "left";
  pen.textBaseline = "middle";
  pen.lineWidth = 4;
  pen.strokeStyle = paint.paper;
  pen.strokeText(text, x, y);
  pen.fillStyle = paint.ink;
  pen.fillText(text, x, y);
}

export function drawCross(pen: Pen, x: number, y: number, paint: MapColours): void {
  pen.beginPath();
  pen.moveTo(x - 14, y);
  pen.lineTo(x + 14, y);
  pen.moveTo(x, y - 14);
  pen.lineTo(x, y + 14);
  pen.strokeStyle = paint.paper;
  pen.lineWidth = 5;
  pen.stroke();
  pen.strokeStyle = paint.ink;
  pen.lineWidth = 2;
  pen.stroke();
}
