// The map: the ground is painted when it changes or moves, what lives on it above.
import { Camera } from "./camera";
import { drawFind, drawMark, colourOf } from "./marks";
import { drawCross, drawLabel, drawLine, hatching, type Stroke } from "./pen";
import { length, type Point } from "./route";
import type { State } from "./state";
import { colours } from "./theme";
import { CHUNK_CELLS, SMALLER, type TileMap, type TileMaps } from "./tiles";
import { decimals, duration, say } from "./words";

const PAINT_MS = 6;
// Where nobody moves the map, what is new on it may wait so long; what lives on it as long as poses come.
const GROUND_MS = 250;
const OVERLAY_MS = 200;
// A person who is not heard may have gone this fast since.
const WALK_M_S = 1.0;

export class MapView {
  readonly camera = new Camera();
  measure: Point[] = [];
  route: { points: Point[]; isFree: boolean } | null = null;
  isPicking = false;
  frames = 0;
  private readonly ground: CanvasRenderingContext2D;
  private readonly overlay: CanvasRenderingContext2D;
  private drawn = "";
  private painted = false;
  private groundAtMs = 0;
  private overlayAtMs = 0;
  private overlaid = "";
  private trailsDrawn = -1;
  private isSketched = false;
  private scale = 1;
  private unit = 1; // how much larger than on a small screen marks and letters are
  private readonly numberOf = (name: string) => this.state.numberOf(name);

  constructor(
    private readonly box: HTMLElement,
    private readonly state: State,
    private readonly maps: TileMaps,
  ) {
    this.ground = (box.querySelector("#ground") as HTMLCanvasElement).getContext("2d", { alpha: false })!;
    this.overlay = (box.querySelector("#overlay") as HTMLCanvasElement).getContext("2d")!;
    new ResizeObserver(() => this.resize()).observe(box);
    this.resize();
  }

  get map(): TileMap {
    return this.maps.get(this.state.map);
  }
  cellM(): number {
    return (this.state.hello?.cellSizeUm ?? 50000) / 1e6;
  }

  fit(): void {
    const extent = this.map.extent();
    const m = this.cellM();
    if (extent) this.camera.fit(extent.x0 * m, extent.y0 * m, extent.x1 * m, extent.y1 * m);
    this.camera.isHeld = false;
  }

  /// All that was decoded stands on the screen.
  isShown(): boolean {
    return this.map.isPainted() && !this.painted;
  }

  redraw(): void {
    this.drawn = this.overlaid = "";
  }

  draw(): void {
    this.frames++;
    this.painted = this.map.paint(colours(), PAINT_MS) || this.painted;
    if (!this.camera.isHeld) this.fit();
    const c = this.camera, ms = performance.now();
    const seen = [c.x, c.y, c.pixelsPerM, c.turnRad, c.width, c.height, this.state.map].join();
    const { search } = this.state, ground = [seen, this.state.selected, search.isTinted && search.heard].join();
    const isOld = ms - this.groundAtMs > GROUND_MS;
    const isMoved = ground !== this.drawn;
    if (isMoved || (isOld && (this.painted || this.isSketched || this.trailsDrawn !== this.state.trailsHeard))) {
      // While it moves, ways are sketched: fine ones take longer than all the rest.
      this.isSketched = isMoved && !isOld;
      this.drawn = ground;
      this.groundAtMs = ms;
      this.painted = false;
      this.trailsDrawn = this.state.trailsHeard;
      this.drawGround();
      this.drawTrails();
    }
    const overlay = [seen, this.state.posesHeard, this.state.selected, search.isShown && search.heard].join();
    if (overlay !== this.overlaid || ms - this.overlayAtMs > OVERLAY_MS) {
      this.overlaid = overlay;
      this.overlayAtMs = ms;
      this.drawOverlay();
    }
  }

  private resize(): void {
    this.scale = Math.min(2, devicePixelRatio || 1);
    this.unit = Math.max(1, parseFloat(getComputedStyle(document.documentElement).fontSize) / 16);
    this.camera.width = this.box.clientWidth || 1;
    this.camera.height = this.box.clientHeight || 1;
    for (const { canvas } of [this.ground, this.overlay]) {
      canvas.width = Math.round(this.camera.width * this.scale);
      canvas.height = Math.round(this.camera.height * this.scale);
    }
    this.redraw();
  }

  private drawGround(): void {
    const { ground, scale, camera } = this;
    const paint = colours();
    ground.setTransform(scale, 0, 0, scale, 0, 0);
    // Unknown is hatched, whatever the colours: it never looks free.
    ground.fillStyle = hatching(ground, paint.unknown, paint.hatch);
    ground.fillRect(0, 0, camera.width, camera.height);
    const m = this.cellM(), side = CHUNK_CELLS * m;
    ground.imageSmoothingEnabled = m * camera.pixelsPerM * scale < 1;
    const isFar = m * camera.pixelsPerM * scale * SMALLER < 1.5;
    for (const chunk of this.map.chunks.values()) {
      const [px, py] = camera.toScreen((chunk.x + 0.5) * side, (chunk.y + 0.5) * side);
      const reach = 0.71 * side * camera.pixelsPerM;
      if (px < -reach || py < -reach || px > camera.width + reach || py > camera.height + reach) continue;
      const t = camera.imageTransform(chunk.x * side, (chunk.y + 1) * side, isFar ? m * SMALLER : m);
      ground.setTransform(t.a! * scale, t.b! * scale, t.c! * scale, t.d! * scale, t.e! * scale, t.f! * scale);
      ground.drawImage((isFar ? chunk.smallPen : chunk.pen).canvas, 0, 0);
    }
    ground.setTransform(scale, 0, 0, scale, 0, 0);
    if (this.state.map === "" && this.state.search.isTinted) this.state.search.drawTint(ground, camera, m, scale, this.unit, this.numberOf);
  }

  private drawOverlay(): void {
    const { overlay, scale, camera } = this;
    overlay.setTransform(scale, 0, 0, scale, 0, 0);
    overlay.clearRect(0, 0, camera.width, camera.height);
    const search = this.state.map === "" && this.state.search.isShown ? this.state.search : null;
    search?.drawFrontiers(overlay, camera, this.unit);
    if (this.route) this.line(overlay, this.route.points, { colour: "#009E73", width: 6, dash: this.route.isFree ? [] : [10, 8] });
    this.drawExit();
    search?.drawSuggestions(overlay, camera, this.unit, this.numberOf);
    this.drawFinds();
    this.drawHelmets();
    this.drawMeasure();
    this.drawScale();
    if (this.isPicking) drawCross(overlay, camera.width / 2, camera.height / 2, colours());
  }

  private line(on: CanvasRenderingContext2D, points: Point[], stroke: Stroke): void {
    drawLine(on, points.map((p) => this.camera.toScreen(p.x, p.y)), stroke);
  }
  private label(text: string, x: number, y: number): void {
    drawLabel(this.overlay, text, x, y, this.unit, colours());
  }

  trailOf(agentId: string): Point[] {
    const points = this.state.trails.filter((way) => way.agentId === agentId && way.map === this.state.map).flatMap((way) => way.points);
    const pose = this.state.poses.get(agentId);
    if (pose && pose.map === this.state.map) points.push({ x: pose.xM, y: pose.yM });
    return points;
  }

  private drawTrails(): void {
    for (const { agent } of this.state.helmets()) {
      const points = this.trailOf(agent.agentId);
      if (points.length < 2) continue;
      const isSelected = agent.agentId === this.state.selected;
      this.ground.globalAlpha = isSelected ? 1 : 0.7;
      this.line(this.ground, points, { colour: colourOf(agent.number), width: isSelected ? 4 * this.unit : this.isSketched ? 1 : 2 * this.unit, hasEdge: isSelected });
      this.ground.globalAlpha = 1;
    }
  }

  private drawHelmets(): void {
    const { overlay, camera, state } = this, now = state.now();
    const alarmed = new Set(state.openAlerts().filter((alert) => alert.kind === 0).map((alert) => alert.subjectId || alert.issuerId));
    for (const { agent, pose } of state.helmets()) {
      if (!pose || pose.map !== state.map) continue;
      const [x, y] = camera.toScreen(pose.xM, pose.yM);
      const age = Math.max(0, now - pose.heardAtS);
      const unsure = 2 * pose.sigmaM + (age > 1 ? WALK_M_S * age : 0);
      overlay.save();
      overlay.translate(x, y);
      if (unsure * camera.pixelsPerM > 16 * this.unit) {
        overlay.beginPath();
        overlay.arc(0, 0, Math.min(4000, unsure * camera.pixelsPerM), 0, 2 * Math.PI);
        overlay.setLineDash([6, 5]);
        overlay.lineWidth = 2;
        overlay.strokeStyle = colours().ink;
        overlay.stroke();
        overlay.setLineDash([]);
      }
      const isLost = pose.trustPercent === 0 || agent.state === 3;
      drawMark(overlay, {
        number: agent.number,
        r: 13 * this.unit,
        headingRad: isLost ? null : -(pose.yawRad + camera.turnRad),
        isDim: age > 2,
        isSelected: agent.agentId === state.selected,
        isAlarmed: alarmed.has(agent.agentId),
      });
      overlay.restore();
      this.label(agent.agentId + (age > 2 ? `  ${duration(age)}` : ""), x + 30 * this.unit, y);
    }
  }

  private drawFinds(): void {
    const { overlay, camera, state } = this;
    for (const find of state.finds) {
      if (find.map !== state.map) continue;
      const [x, y] = camera.toScreen(find.xM, find.yM);
      overlay.save();
      overlay.translate(x, y);
      drawFind(overlay, find.state, find.kind, 11 * this.unit);
      overlay.restore();
    }
  }

  private drawExit(): void {
    const [x, y] = this.camera.toScreen(this.state.exit.x, this.state.exit.y);
    const { overlay } = this;
    overlay.fillStyle = "#009E73";
    overlay.strokeStyle = "#fff";
    overlay.lineWidth = 2;
    const r = 9 * this.unit;
    overlay.fillRect(x - r, y - r, 2 * r, 2 * r);
    overlay.strokeRect(x - r, y - r, 2 * r, 2 * r);
    this.label(say("exit"), x + 14 * this.unit, y);
  }

  private drawMeasure(): void {
    if (this.measure.length === 0) return;
    this.line(this.overlay, this.measure, { colour: colours().ink, width: 2, dash: [4, 4] });
    for (const p of this.measure) drawCross(this.overlay, ...this.camera.toScreen(p.x, p.y), colours());
    if (this.measure.length < 2) return;
    const [a, b] = this.measure as [Point, Point];
    const [x, y] = this.camera.toScreen((a.x + b.x) / 2, (a.y + b.y) / 2);
    this.label(`${decimals(length(this.measure), 2)} m`, x + 8, y - 12);
  }

  private drawScale(): void {
    const { overlay, camera } = this;
    const metres = [1, 2, 5, 10, 20, 50, 100, 200].find((m) => m * camera.pixelsPerM > 70 * this.unit) ?? 500;
    const y = camera.height - 18;
    overlay.fillStyle = colours().paper;
    overlay.fillRect(12, y - 3, metres * camera.pixelsPerM + 4, 8);
    overlay.fillStyle = colours().ink;
    overlay.fillRect(14, y - 1, metres * camera.pixelsPerM, 4);
    this.label(`${metres} m`, 14, y - 14 * this.unit);
  }
}
