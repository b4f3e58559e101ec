/** Rings and words on the map. */

import type { Point } from "./camera";
import type { Box, Sheet } from "./sheet";

const FONT_PX = 13;
const RING_PX = 12;
/** Half the height of a plate, and its padding left and right. */
const HALF_PX = 10;
const PAD_PX = 5;

/** Words beside a place in pixels, on a plate: where other words leave room, within the view. */
export function label(sheet: Sheet, text: string, at: Point, color: string, awayPx = 10): void {
  const ctx = sheet.inPixels();
  ctx.font = `${FONT_PX}px ${fontOf(sheet)}`;
  ctx.textBaseline = "middle";
  const box = place(sheet, at, ctx.measureText(text).width + 2 * PAD_PX, awayPx);
  sheet.words.push(box);
  ctx.beginPath();
  ctx.roundRect(box.left, box.top, box.right - box.left, 2 * HALF_PX, 4);
  ctx.fillStyle = sheet.colors.page;
  sheet.faint(0.86, () => ctx.fill());
  ctx.fillStyle = color;
  ctx.fillText(text, box.left + PAD_PX, box.top + HALF_PX + 0.5);
}

/** Words keep off a place in pixels. */
export function keepOff(sheet: Sheet, [x, y]: Point, radiusPx: number): void {
  sheet.words.push({
    left: x - radiusPx,
    top: y - radiusPx,
    right: x + radiusPx,
    bottom: y + radiusPx,
  });
}

/** The first place around a point that is free, else the first that is within the view. */
function place(sheet: Sheet, [x, y]: Point, width: number, away: number): Box {
  const { widthPx, heightPx } = sheet.view;
  const [right, left, middle] = [x + away, x - away - width, x - width / 2];
  const corners: Point[] = [
    [right, y - 10],
    [right, y + 12],
    [left, y - 10],
    [left, y + 12],
    [middle, y - away - HALF_PX - 4],
    [middle, y + away + HALF_PX + 4],
    [right, y + 34],
    [right, y - 32],
  ];
  const boxes = corners.map(([boxLeft, middleY]): Box => {
    return {
      left: boxLeft,
      top: middleY - HALF_PX,
      right: boxLeft + width,
      bottom: middleY + HALF_PX,
    };
  });
  const isIn = (box: Box) =>
    box.left >= 2 && box.top >= 2 && box.right <= widthPx - 2 && box.bottom <= heightPx - 2;
  const isFree = (box: Box) => sheet.words.every((other) => !overlap(box, other));
  const inside = boxes.filter(isIn);
  return inside.find(isFree) ?? inside[0] ?? boxes[0]!;
}

function overlap(a: Box, b: Box): boolean {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

const fonts = new WeakMap<HTMLCanvasElement, string>();

/** The page's own typeface. */
function fontOf(sheet: Sheet): string {
  const known = fonts.get(sheet.canvas) ?? getComputedStyle(sheet.canvas).fontFamily;
  fonts.set(sheet.canvas, known);
  return known;
}

/** A ring about a place with words beside it; beyond the border it stands at the border. */
export function ring(sheet: Sheet, x: number, y: number, text: string): void {
  const { view, colors } = sheet;
  const [px, py] = view.toPx(x, y);
  const room = RING_PX + 2;
  const at: Point = [
    Math.min(Math.max(px, room), view.widthPx - room),
    Math.min(Math.max(py, room), view.heightPx - room),
  ];
  const ctx = sheet.inPixels();
  ctx.beginPath();
  ctx.arc(at[0], at[1], RING_PX, 0, 2 * Math.PI);
  sheet.pen(colors.page, 5);
  sheet.faint(0.85, () => ctx.stroke());
  sheet.pen(colors.limit, 2.4);
  ctx.stroke();
  label(sheet, text, at, colors.limit, RING_PX + 7);
}

/** A scale bar at the lower left. */
export function scaleBar(sheet: Sheet): void {
  const { view, colors } = sheet;
  const lengthM = roundLength(110 / view.pxPerM);
  const lengthPx = lengthM * view.pxPerM;
  const ctx = sheet.inPixels();
  const [left, y] = [14, view.heightPx - 14];
  const bar = () => {
    ctx.beginPath();
    ctx.moveTo(left, y - 4);
    ctx.lineTo(left, y + 4);
    ctx.moveTo(left, y);
    ctx.lineTo(left + lengthPx, y);
    ctx.moveTo(left + lengthPx, y - 4);
    ctx.lineTo(left + lengthPx, y + 4);
  };
  bar();
  sheet.pen(colors.page, 5);
  sheet.faint(0.85, () => ctx.stroke());
  sheet.pen(colors.ink, 1.6);
  ctx.stroke();
  label(
    sheet,
    `${lengthM < 1 ? lengthM.toFixed(1) : lengthM} m`,
    [left + lengthPx, y + 10],
    colors.ink,
    10,
  );
}

/** The largest 1, 2 or 5 times a power of ten that is not more. */
function roundLength(most: number): number {
  const power = 10 ** Math.floor(Math.log10(most));
  const factor = [5, 2, 1].find((one) => one * power <= most) ?? 1;
  return factor * power;
}
