// The map: ground and trails, and what lives on it above. Each is a picture that reaches beyond the view, so that moving the map
// paints next to nothing.
import { Camera } from "./camera";
import { Labels } from "./labels";
import { Layer } from "./layer";
import { drawScale, drawTrail, Overlay } from "./overlay";
import { drawCross, hatching } from "./pen";
import type { Point } from "./route";
import type { State } from "./state";
import { colours, currentTheme } from "./theme";
import { CHUNK_CELLS, SMALLER, type TileMap, type TileMaps } from "./tiles";

const PAINT_MS = 6;
// What is new on the map may wait so long, longer while somebody moves it; what lives on it as long as poses come.
const GROUND_MS = 250;
const MOVED_GROUND_MS = 600;
const OVERLAY_MS = 200;
// Nobody has moved it since: it rests, and is painted for just this place.
const REST_MS = 120;

export class MapView {
  readonly camera = new Camera();
  measure: Point[] = [];
  route: { points: Point[]; isFree: boolean } | null = null;
  isPicking = false;
  frames = 0;
  private readonly pen: CanvasRenderingContext2D;
  private readonly overlayPen: CanvasRenderingContext2D;
  private readonly ground = new Layer(true);
  private readonly trails = new Layer(false);
  private readonly overlay = new Layer(false);
  private readonly labels = new Labels();
  private seen = "";
  private movedAtMs = -Infinity;
  /// Tiles were painted since the ground was.
  private isGroundOld = false;
  private trailsDrawn = -1;
  private changes = 0;
  private scale = 1;
  private unit = 1;
  private readonly agentOf = (name: string) => this.state.agentOf(name);

  constructor(
    private readonly box: HTMLElement,
    private readonly state: State,
    private readonly maps: TileMaps,
  ) {
    this.pen = (box.querySelector("#ground") as HTMLCanvasElement).getContext("2d", { alpha: false })!;
    this.overlayPen = (box.querySelector("#overlay") as HTMLCanvasElement).getContext("2d")!;
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

  /// All that was decoded stands on the screen, painted for just this place.
  isShown(): boolean {
    return this.map.isPainted() && !this.isGroundOld && this.ground.isExact(this.camera);
  }

  redraw(): void {
    this.changes++;
  }

  draw(): void {
    this.frames++;
    this.isGroundOld = this.map.paint(colours(), PAINT_MS) || this.isGroundOld;
    if (!this.camera.isHeld) this.fit();
    const c = this.camera, ms = performance.now();
    const seen = [c.x, c.y, c.pixelsPerM, c.turnRad, c.width, c.height].join();
    const isMoved = seen !== this.seen;
    if (isMoved) {
      this.seen = seen;
      this.movedAtMs = ms;
    }
    if (this.refreshGround(ms) || isMoved) {
      this.ground.show(this.pen, c);
      this.trails.show(this.pen, c);
    }
    this.refreshOverlay(ms, isMoved);
  }

  private resize(): void {
    this.scale = Math.min(2, devicePixelRatio || 1);
    this.unit = Math.max(1, parseFloat(getComputedStyle(document.documentElement).fontSize) / 16);
    this.camera.width = this.box.clientWidth || 1;
    this.camera.height = this.box.clientHeight || 1;
    for (const { canvas } of [this.pen, this.overlayPen]) {
      canvas.width = Math.round(this.camera.width * this.scale);
      canvas.height = Math.round(this.camera.height * this.scale);
    }
    this.redraw();
  }

  /// What a picture of the map hangs on besides where it is looked at.
  private content(...more: unknown[]): string {
    const { camera, state } = this;
    return [this.changes, camera.width, camera.height, state.map, state.selected, currentTheme(), ...more].join();
  }

  /// False: ground and trails are as they were.
  private refreshGround(ms: number): boolean {
    const { camera, state, scale } = this, { search } = state;
    const isMoving = ms - this.movedAtMs < REST_MS;
    const mayWait = isMoving ? MOVED_GROUND_MS : GROUND_MS;
    const isDue = (layer: Layer, content: string, isOld: boolean) =>
      !layer.holds(content, camera) || (!isMoving && !layer.isExact(camera)) || (isOld && ms - layer.paintedAtMs > mayWait);
    const ground = this.content(search.isTinted && search.heard), trails = this.content();
    const isGroundDue = isDue(this.ground, ground, this.isGroundOld);
    const areTrailsDue = isDue(this.trails, trails, this.trailsDrawn !== state.trailsHeard);
    if (isGroundDue) {
      this.isGroundOld = false;
      this.ground.paint(camera, scale, ground, (pen, at) => this.drawGround(pen, at));
    }
    if (areTrailsDue) {
      this.trailsDrawn = state.trailsHeard;
      this.trails.paint(camera, scale, trails, (pen, at) => this.drawTrails(pen, at));
    }
    return isGroundDue || areTrailsDue;
  }

  private refreshOverlay(ms: number, isMoved: boolean): void {
    const { camera, overlay, overlayPen, scale, state, measure, route, unit } = this, { search } = state;
    const drawn = { state, measure, route, unit, labels: this.labels };
    const isUpright = overlay.isUpright(camera);
    const content = this.content(state.posesHeard, search.isShown && search.heard);
    const isDue = !isUpright || !overlay.holds(content, camera) || ms - overlay.paintedAtMs > OVERLAY_MS;
    if (!isDue && !isMoved) return;
    overlayPen.setTransform(scale, 0, 0, scale, 0, 0);
    overlayPen.clearRect(0, 0, camera.width, camera.height);
    if (isMoved && !isUpright) {
      // Letters stay upright while the map is turned: there is nothing to be shifted.
      new Overlay(overlayPen, camera, drawn).draw();
    } else {
      if (isDue) overlay.paint(camera, scale, content, (pen, at) => new Overlay(pen, at, drawn).draw());
      overlay.show(overlayPen, camera);
    }
    drawScale(overlayPen, camera, unit);
    if (this.isPicking) drawCross(overlayPen, camera.width / 2, camera.height / 2, colours());
  }

  private drawGround(ground: CanvasRenderingContext2D, camera: Camera): void {
    const { scale } = this;
    const paint = colours();
    // Unknown is hatched, whatever the colours: it never looks free. The hatching keeps to the map.
    const hatch = hatching(ground, paint.unknown, paint.hatch);
    const [x, y] = camera.toScreen(0, 0);
    hatch.setTransform(new DOMMatrix([1, 0, 0, 1, Math.round(x * scale) / scale, Math.round(y * scale) / scale]));
    ground.fillStyle = hatch;
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
    if (this.state.map === "" && this.state.search.isTinted) this.state.search.drawTint(ground, camera, m, scale, this.unit, this.agentOf);
  }

  trailOf(agentId: string): Point[] {
    const points = this.state.trailOf(agentId);
    const pose = this.state.poses.get(agentId);
    return pose && pose.map === this.state.map ? [...points, { x: pose.xM, y: pose.yM }] : points;
  }

  /// From where a trail ends to where its helmet is, the overlay draws: that is newer.
  private drawTrails(pen: CanvasRenderingContext2D, camera: Camera): void {
    for (const { agent } of this.state.helmets()) {
      const points = this.state.trailOf(agent.agentId);
      if (points.length > 1) drawTrail(pen, camera, points, agent.number, agent.agentId === this.state.selected, this.unit);
    }
  }
}
