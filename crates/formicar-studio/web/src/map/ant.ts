/** Ants as small bodies that look where they go. */

import type { Sheet } from "./sheet";

/** Collects ants and draws them in one go; in the coordinates of the sheet. */
export class Ants {
  private readonly bodies = new Path2D();

  constructor(private readonly sheet: Sheet) {}

  /** An ant at a place that walks along a direction. */
  add(x: number, y: number, dx: number, dy: number, size = 1): void {
    const length = Math.hypot(dx, dy);
    const [u, v] = length > 0 ? [dx / length, dy / length] : [1, 0];
    const px = size * this.sheet.px(1);
    this.part(x - 2.1 * px * u, y - 2.1 * px * v, 1.9 * px);
    this.part(x + 0.6 * px * u, y + 0.6 * px * v, 1.2 * px);
    this.part(x + 2.6 * px * u, y + 2.6 * px * v, 1.4 * px);
  }

  draw(color: string): void {
    const { ctx, colors } = this.sheet;
    this.sheet.pen(colors.page, 1.6);
    ctx.stroke(this.bodies);
    ctx.fillStyle = color;
    ctx.fill(this.bodies);
  }

  private part(x: number, y: number, radius: number): void {
    this.bodies.moveTo(x + radius, y);
    this.bodies.arc(x, y, radius, 0, 2 * Math.PI);
  }
}
