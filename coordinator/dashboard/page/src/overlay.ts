// What lives on the map: helmets, finds, the exit, ways, what is measured.
import type { Camera } from "./camera";
import type { Labels } from "./labels";
import { colourOf, drawFind, drawMark } from "./marks";
import { drawCross, drawLabel, drawLine, type Stroke } from "./pen";
import { length, type Point } from "./route";
import type { Member, State } from "./state";
import { colours } from "./theme";
import { decimals, duration, say } from "./words";

type Pen = CanvasRenderingContext2D;

// A person who is not heard may have gone this fast since.
const WALK_M_S = 1.0;

export interface Drawn {
  state: State;
  measure: Point[];
  route: { points: Point[]; isFree: boolean } | null;
  /// How much larger than on a small screen marks and letters are.
  unit: number;
  labels: Labels;
}

export class Overlay {
  constructor(private readonly pen: Pen, private readonly camera: Camera, private readonly drawn: Drawn) {}

  draw(): void {
    const { pen, camera, drawn } = this, { state, unit, route, labels } = drawn;
    const search = state.map === "" && state.search.isShown ? state.search : null;
    search?.drawFrontiers(pen, camera, unit);
    if (route) this.line(route.points, { colour: "#009E73", width: 6, dash: route.isFree ? [] : [10, 8] });
    this.drawExit();
    search?.drawSuggestions(pen, camera, unit, labels, (name) => state.agentOf(name));
    this.drawFinds();
    this.drawHelmets();
    labels.draw(pen, unit, colours());
    this.drawMeasure();
  }

  private line(points: Point[], stroke: Stroke): void {
    drawLine(this.pen, points.map((p) => this.camera.toScreen(p.x, p.y)), stroke);
  }
  private drawHelmets(): void {
    const { state } = this.drawn;
    const alarmed = new Set(state.openAlerts().filter((alert) => alert.kind === 0).map((alert) => alert.subjectId || alert.issuerId));
    for (const member of state.helmets()) {
      if (member.pose?.map === state.map) this.drawHelmet(member, alarmed.has(member.agent.agentId));
    }
  }

  private drawHelmet({ agent, pose }: Member, isAlarmed: boolean): void {
    const { pen, camera } = this, { state, unit, labels } = this.drawn;
    const [x, y] = camera.toScreen(pose!.xM, pose!.yM);
    const age = Math.max(0, state.now() - pose!.heardAtS);
    const isSelected = agent.agentId === state.selected;
    const last = state.trailEnd(agent.agentId);
    if (last) drawTrail(pen, camera, [last, { x: pose!.xM, y: pose!.yM }], agent.number, isSelected, unit);
    pen.save();
    pen.translate(x, y);
    this.drawUnsure(2 * pose!.sigmaM + (age > 1 ? WALK_M_S * age : 0));
    const isLost = pose!.trustPercent === 0 || agent.state === 3;
    drawMark(pen, {
      agent,
      r: 13 * unit,
      headingRad: isLost ? null : -(pose!.yawRad + camera.turnRad),
      isDim: age > 2,
      isSelected,
      isAlarmed,
    });
    pen.restore();
    labels.keepClear(x, y, 14 * unit);
    labels.add(agent.agentId, agent.agentId + (age > 2 ? `  ${duration(age)}` : ""), x, y, 30 * unit);
  }

  private drawUnsure(radiusM: number): void {
    const { pen, camera } = this;
    if (radiusM * camera.pixelsPerM <= 16 * this.drawn.unit) return;
    pen.beginPath();
    pen.arc(0, 0, Math.min(4000, radiusM * camera.pixelsPerM), 0, 2 * Math.PI);
    pen.setLineDash([6, 5]);
    pen.lineWidth = 2;
    pen.strokeStyle = colours().ink;
    pen.stroke();
    pen.setLineDash([]);
  }

  private drawFinds(): void {
    const { pen, camera } = this, { state, unit, labels } = this.drawn;
    for (const find of state.finds) {
      if (find.map !== state.map) continue;
      const [x, y] = camera.toScreen(find.xM, find.yM);
      labels.keepClear(x, y, 11 * unit);
      pen.save();
      pen.translate(x, y);
      drawFind(pen, find.state, find.kind, 11 * unit);
      pen.restore();
    }
  }

  private drawExit(): void {
    const { pen } = this, { state, unit, labels } = this.drawn;
    const [x, y] = this.camera.toScreen(state.exit.x, state.exit.y);
    pen.fillStyle = "#009E73";
    pen.strokeStyle = "#fff";
    pen.lineWidth = 2;
    const r = 9 * unit;
    pen.fillRect(x - r, y - r, 2 * r, 2 * r);
    pen.strokeRect(x - r, y - r, 2 * r, 2 * r);
    labels.keepClear(x, y, r);
    labels.add(" exit", say("exit"), x, y, 14 * unit);
  }

  private drawMeasure(): void {
    const { measure } = this.drawn;
    if (measure.length === 0) return;
    this.line(measure, { colour: colours().ink, width: 2, dash: [4, 4] });
    for (const p of measure) drawCross(this.pen, ...this.camera.toScreen(p.x, p.y), colours());
    if (measure.length < 2) return;
    const [a, b] = measure as [Point, Point];
    const [x, y] = this.camera.toScreen((a.x + b.x) / 2, (a.y + b.y) / 2);
    drawLabel(this.pen, `${decimals(length(measure), 2)} m`, x + 8, y - 12, this.drawn.unit, colours());
  }
}

export function drawTrail(pen: Pen, camera: Camera, points: Point[], number: number, isSelected: boolean, unit: number): void {
  pen.globalAlpha = isSelected ? 1 : 0.7;
  const stroke = { colour: colourOf(number), width: isSelected ? 4 * unit : 2 * unit, hasEdge: isSelected };
  drawLine(pen, points.map((p) => camera.toScreen(p.x, p.y)), stroke);
  pen.globalAlpha = 1;
}

/// How long something is on the map; fixed to the view.
export function drawScale(pen: Pen, camera: Camera, unit: number): void {
  const metres = [1, 2, 5, 10, 20, 50, 100, 200].find((m) => m * camera.pixelsPerM > 70 * unit) ?? 500;
  const y = camera.height - 18;
  pen.fillStyle = colours().paper;
  pen.fillRect(12, y - 3, metres * camera.pixelsPerM + 4, 8);
  pen.fillStyle = colours().ink;
  pen.fillRect(14, y - 1, metres * camera.pixelsPerM, 4);
  drawLabel(pen, `${metres} m`, 14, y - 14 * unit, unit, colours());
}
