// A picture of the map that reaches beyond the view: while the map is moved it is shifted, turned or stretched, which takes a
// fraction of painting it; it is painted again where it ends, and once the map rests.
import { Camera } from "./camera";

const MARGIN_PX = 192;
// Stretched further it is a blur.
const MOST_STRETCH = 2;

type Pen = CanvasRenderingContext2D;

export class Layer {
  paintedAtMs = -Infinity;
  private readonly pen: Pen;
  private readonly painted = new Camera();
  private scale = 0;
  /// What it shows besides a place: other words, and it is void.
  private content = "";

  constructor(private readonly isOpaque: boolean) {
    this.pen = document.createElement("canvas").getContext("2d", { alpha: !isOpaque })!;
  }

  /// `draw` gets a pen in CSS pixels, and the camera of the whole picture.
  paint(camera: Camera, scale: number, content: string, draw: (pen: Pen, camera: Camera) => void): void {
    const { pen, painted } = this, { canvas } = pen;
    const margin = Math.round(MARGIN_PX * scale);
    const width = Math.round(camera.width * scale) + 2 * margin, height = Math.round(camera.height * scale) + 2 * margin;
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    Object.assign(painted, camera, { width: camera.width + (2 * margin) / scale, height: camera.height + (2 * margin) / scale });
    this.scale = scale;
    this.content = content;
    this.paintedAtMs = performance.now();
    pen.setTransform(scale, 0, 0, scale, 0, 0);
    if (!this.isOpaque) pen.clearRect(0, 0, painted.width, painted.height);
    draw(pen, painted);
  }

  /// It shows this, and all of what the camera sees.
  holds(content: string, camera: Camera): boolean {
    if (content !== this.content) return false;
    const stretch = camera.pixelsPerM / this.painted.pixelsPerM;
    if (stretch > MOST_STRETCH || stretch < 1 / MOST_STRETCH) return false;
    return [[0, 0], [camera.width, 0], [0, camera.height], [camera.width, camera.height]].every(([px, py]) => {
      const [x, y] = this.painted.toScreen(...camera.toMap(px!, py!));
      return x >= 0 && y >= 0 && x <= this.painted.width && y <= this.painted.height;
    });
  }

  /// It is only to be shifted.
  isUpright(camera: Camera): boolean {
    return camera.pixelsPerM === this.painted.pixelsPerM && camera.turnRad === this.painted.turnRad;
  }

  /// It was painted for just this place.
  isExact(camera: Camera): boolean {
    return this.isUpright(camera) && camera.x === this.painted.x && camera.y === this.painted.y;
  }

  show(on: Pen, camera: Camera): void {
    const { painted, scale } = this;
    const [e, f] = this.place(camera, 0, 0);
    if (this.isUpright(camera)) {
      on.setTransform(1, 0, 0, 1, 0, 0);
      on.drawImage(this.pen.canvas, Math.round(e * scale), Math.round(f * scale));
    } else {
      const [ax, ay] = this.place(camera, painted.width, 0), [bx, by] = this.place(camera, 0, painted.height);
      const { width, height } = this.pen.canvas;
      on.setTransform(((ax - e) * scale) / width, ((ay - f) * scale) / width, ((bx - e) * scale) / height, ((by - f) * scale) / height, e * scale, f * scale);
      on.imageSmoothingEnabled = true;
      on.drawImage(this.pen.canvas, 0, 0);
    }
    on.setTransform(scale, 0, 0, scale, 0, 0);
  }

  /// Where a point of the picture lies in the view, both in CSS pixels.
  private place(camera: Camera, px: number, py: number): [number, number] {
    return camera.toScreen(...this.painted.toMap(px, py));
  }
}
