// What part of the map is seen: metres to pixels and back. The map's y goes up, the screen's down.

export class Camera {
  x = 0;
  y = 0;
  pixelsPerM = 20;
  turnRad = 0;
  width = 1;
  height = 1;
  /// A person moved it: it does not follow the map any more.
  isHeld = false;

  toScreen(x: number, y: number): [number, number] {
    const dx = (x - this.x) * this.pixelsPerM, dy = (y - this.y) * this.pixelsPerM;
    const c = Math.cos(this.turnRad), s = Math.sin(this.turnRad);
    return [this.width / 2 + c * dx - s * dy, this.height / 2 - (s * dx + c * dy)];
  }

  toMap(px: number, py: number): [number, number] {
    const u = (px - this.width / 2) / this.pixelsPerM, v = (this.height / 2 - py) / this.pixelsPerM;
    const c = Math.cos(this.turnRad), s = Math.sin(this.turnRad);
    return [this.x + c * u + s * v, this.y - s * u + c * v];
  }

  pan(px: number, py: number): void {
    const [x, y] = this.toMap(this.width / 2 + px, this.height / 2 + py);
    this.x = x;
    this.y = y;
    this.isHeld = true;
  }

  /// Keeps the point under (px, py) where it is.
  zoom(factor: number, px = this.width / 2, py = this.height / 2): void {
    const [x, y] = this.toMap(px, py);
    this.pixelsPerM = Math.min(400, Math.max(0.5, this.pixelsPerM * factor));
    const [nx, ny] = this.toMap(px, py);
    this.x += x - nx;
    this.y += y - ny;
    this.isHeld = true;
  }

  turn(rad: number): void {
    this.turnRad = (this.turnRad + rad) % (2 * Math.PI);
    this.isHeld = true;
  }

  fit(x0: number, y0: number, x1: number, y1: number): void {
    this.x = (x0 + x1) / 2;
    this.y = (y0 + y1) / 2;
    const c = Math.abs(Math.cos(this.turnRad)), s = Math.abs(Math.sin(this.turnRad));
    const w = c * (x1 - x0) + s * (y1 - y0), h = s * (x1 - x0) + c * (y1 - y0);
    this.pixelsPerM = Math.min(60, 0.94 * Math.min(this.width / Math.max(w, 1), this.height / Math.max(h, 1)));
  }

  /// For a context: pictures whose pixel is `cell` metres and whose upper left corner is at (x, y).
  imageTransform(x: number, y: number, cell: number): DOMMatrix2DInit {
    const k = cell * this.pixelsPerM;
    const c = Math.cos(this.turnRad), s = Math.sin(this.turnRad);
    const [e, f] = this.toScreen(x, y);
    return { a: k * c, b: -k * s, c: k * s, d: k * c, e, f };
  }
}
