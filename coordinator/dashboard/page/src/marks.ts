// How helmets and finds look: a shape, a label (both as on the helmets' own displays) and a colour each, never a colour alone
// (Okabe and Ito's, without vermillion, which is for maydays).
import type { Agent } from "./dashboard_pb";

const COLOURS = ["#E69F00", "#56B4E9", "#009E73", "#F0E442", "#5D9CEC", "#CC79A7", "#FFFFFF"];
const SIDES = [0, 4, 3, 5, 6]; // circle, square, triangle, pentagon, hexagon
const LETTERS = [1.15, 1.15, 0.95, 0.72]; // of the radius, for so many characters

export function colourOf(number: number): string {
  return COLOURS[(number - 1 + COLOURS.length) % COLOURS.length]!;
}

function outline(context: CanvasRenderingContext2D, sides: number, r: number): void {
  context.beginPath();
  if (sides === 0) {
    context.arc(0, 0, r, 0, 2 * Math.PI);
    return;
  }
  const turn = sides === 4 ? Math.PI / sides : -Math.PI / 2;
  const grow = sides === 3 ? 1.35 : 1.1;
  for (let i = 0; i < sides; i++) {
    const angle = turn + (2 * Math.PI * i) / sides;
    context.lineTo(grow * r * Math.cos(angle), grow * r * Math.sin(angle));
  }
  context.closePath();
}

export interface Mark {
  agent: Pick<Agent, "label" | "shape" | "number">;
  r: number;
  /// On the screen, clockwise from the right; null where it is not known.
  headingRad: number | null;
  isDim: boolean;
  isSelected: boolean;
  isAlarmed: boolean;
}

/// At the context's origin.
export function drawMark(context: CanvasRenderingContext2D, mark: Mark): void {
  context.globalAlpha = mark.isDim ? 0.55 : 1;
  if (mark.headingRad !== null) {
    context.save();
    context.rotate(mark.headingRad);
    context.beginPath();
    context.moveTo(mark.r * 2.1, 0);
    context.lineTo(mark.r * 1.1, -mark.r * 0.6);
    context.lineTo(mark.r * 1.1, mark.r * 0.6);
    context.closePath();
    context.fillStyle = colourOf(mark.agent.number);
    context.strokeStyle = "#000";
    context.lineWidth = 2;
    context.fill();
    context.stroke();
    context.restore();
  }
  outline(context, SIDES[mark.agent.shape % SIDES.length]!, mark.r);
  context.lineWidth = mark.isSelected ? 7 : 4;
  context.strokeStyle = mark.isSelected ? "#fff" : "#000";
  context.stroke();
  context.lineWidth = 2;
  context.strokeStyle = "#000";
  context.fillStyle = colourOf(mark.agent.number);
  context.fill();
  context.stroke();
  context.fillStyle = "#000";
  const text = mark.headingRad === null ? "?" : mark.agent.label;
  context.font = `bold ${Math.round(mark.r * LETTERS[Math.min(text.length, 3)]!)}px sans-serif`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillText(text, 0, mark.r * 0.07);
  context.globalAlpha = 1;
  if (mark.isAlarmed) {
    context.beginPath();
    context.arc(0, 0, mark.r * 2.4, 0, 2 * Math.PI);
    context.strokeStyle = "#D55E00";
    context.lineWidth = 6;
    context.stroke();
  }
}

/// The same as a picture for lists.
export function markCanvas(agent: Mark["agent"]): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 56;
  canvas.setAttribute("aria-hidden", "true");
  const context = canvas.getContext("2d")!;
  context.translate(28, 28);
  drawMark(context, { agent, r: 17, headingRad: 0.0001, isDim: false, isSelected: false, isAlarmed: false });
  return canvas;
}

/// A find: a cross that is full once confirmed, struck out once dismissed.
export function drawFind(context: CanvasRenderingContext2D, state: number, kind: number, r: number): void {
  context.globalAlpha = state === 2 ? 0.5 : 1;
  context.lineWidth = 6;
  context.strokeStyle = "#000";
  context.fillStyle = state === 1 || state === 3 ? "#F0E442" : "#fff";
  context.beginPath();
  if (kind === 2) {
    context.moveTo(0, -r);
    context.lineTo(r, 0);
    context.lineTo(0, r);
    context.lineTo(-r, 0);
  } else {
    const a = r * 0.36;
    for (const [x, y] of [[-a, -r], [a, -r], [a, -a], [r, -a], [r, a], [a, a], [a, r], [-a, r], [-a, a], [-r, a], [-r, -a], [-a, -a]] as const)
      context.lineTo(x, y);
  }
  context.closePath();
  context.stroke();
  context.fill();
  if (state === 2) {
    context.beginPath();
    context.moveTo(-r * 1.2, r * 1.2);
    context.lineTo(r * 1.2, -r * 1.2);
    context.strokeStyle = "#D55E00";
    context.lineWidth = 4;
    context.stroke();
  }
  context.globalAlpha = 1;
}
