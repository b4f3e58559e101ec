/** A drivable path, and the ground that the vehicle sweeps along it. */

import type { VehicleMessage } from "../protocol";
import type { PathShape } from "./path_shape";
import type { Sheet } from "./sheet";

/** Outlines of vehicles shorter than this are not drawn along the path. */
const MIN_OUTLINE_PX = 9;
/** Swept ground is drawn from footprints at most this share of a length apart; from every sample
 * where vehicles look larger than so much. */
const SWEPT_SPACING = 0.12;
const FINE_FROM_PX = 70;
/** Dashes of a path in reverse. */
const REVERSE_DASH_PX = [7, 5];

interface Drawn {
  runs: { gear: 1 | -1; line: Path2D }[];
  swept: Path2D | null;
  outlines: Path2D | null;
  /** For which vehicle, and for outlines how far apart. */
  footprint: VehicleMessage["footprint"] | null;
  isFine: boolean;
  spacingM: number;
}

const drawn = new WeakMap<PathShape, Drawn>();

/** The path as a line: solid forward, dashed in reverse, a dot at each change of gear. */
export function drawPath(sheet: Sheet, shape: PathShape, isFaint = false): void {
  const { colors } = sheet;
  const ctx = sheet.inWorld();
  const { runs } = linesOf(shape);
  sheet.faint(isFaint ? 0.3 : 1, () => {
    sheet.pen(colors.page, 5.5);
    sheet.faint(0.8, () => runs.forEach(({ line }) => ctx.stroke(line)));
    // Reverse on top: where a way is driven twice, the line below shows between the dashes.
    for (const gear of [1, -1] as const) {
      const color = gear === 1 ? colors.forward : colors.reverse;
      sheet.pen(color, 2.8, gear === 1 ? [] : REVERSE_DASH_PX);
      for (const run of runs) if (run.gear === gear) ctx.stroke(run.line);
    }
    for (const { from } of shape.runs.slice(1)) {
      ctx.beginPath();
      ctx.arc(shape.x[from]!, shape.y[from]!, sheet.px(3.4), 0, 2 * Math.PI);
      ctx.fillStyle = colors.page;
      ctx.fill();
      sheet.pen(colors.ink, 1.6);
      ctx.stroke();
    }
  });
}

/** The swept ground, with the vehicle's outline every so often. */
export function drawSwept(sheet: Sheet, shape: PathShape, vehicle: VehicleMessage): void {
  const lengthM = lengthOf(vehicle);
  const lengthPx = lengthM * sheet.view.pxPerM;
  if (vehicle.motion === "point" || lengthPx < 1) return;
  const ctx = sheet.inWorld();
  const kept = linesOf(shape);
  const isFine = lengthPx >= FINE_FROM_PX;
  if (kept.footprint !== vehicle.footprint || kept.isFine !== isFine) {
    [kept.footprint, kept.isFine] = [vehicle.footprint, isFine];
    kept.swept = footprints(shape, vehicle, isFine ? 0 : SWEPT_SPACING * lengthM);
    kept.outlines = null;
  }
  const spacingM = spacing(lengthM, sheet.view.pxPerM);
  if (kept.outlines === null || kept.spacingM !== spacingM) {
    kept.outlines = footprints(shape, vehicle, spacingM);
    kept.spacingM = spacingM;
  }
  ctx.fillStyle = sheet.colors.swept;
  sheet.faint(0.24, () => ctx.fill(kept.swept ?? new Path2D()));
  if (lengthPx < MIN_OUTLINE_PX) return;
  sheet.pen(sheet.colors.swept, 0.9);
  sheet.faint(0.75, () => ctx.stroke(kept.outlines ?? new Path2D()));
}

/** The outline of the vehicle at a pose, added to a path. */
export function addFootprint(
  path: Path2D | CanvasRenderingContext2D,
  footprint: readonly (readonly [number, number])[],
  x: number,
  y: number,
  heading: number,
): void {
  const [cos, sin] = [Math.cos(heading), Math.sin(heading)];
  footprint.forEach(([u, v], i) => {
    const [px, py] = [x + cos * u - sin * v, y + sin * u + cos * v];
    if (i === 0) path.moveTo(px, py);
    else path.lineTo(px, py);
  });
  path.closePath();
}

/** From bumper to bumper, meters. */
export function lengthOf(vehicle: VehicleMessage): number {
  const xs = vehicle.footprint.map(([x]) => x);
  return xs.length > 0 ? Math.max(...xs) - Math.min(...xs) : 0;
}

/** Outlines about a vehicle and a quarter apart, in steps of powers of two so that zooming does
 * not make them flow. */
function spacing(lengthM: number, pxPerM: number): number {
  const least = Math.max(1.25 * lengthM, 24 / pxPerM);
  return 1.25 * lengthM * 2 ** Math.ceil(Math.log2(least / (1.25 * lengthM)) - 1e-9);
}

function footprints(shape: PathShape, vehicle: VehicleMessage, spacingM: number): Path2D {
  const path = new Path2D();
  const turningPoints = new Set([shape.n - 1, ...shape.runs.map((run) => run.from)]);
  let nextM = 0;
  for (let i = 0; i < shape.n; i += 1) {
    if (shape.s[i]! < nextM && !turningPoints.has(i)) continue;
    addFootprint(path, vehicle.footprint, shape.x[i]!, shape.y[i]!, shape.heading[i]!);
    if (shape.s[i]! >= nextM) nextM = shape.s[i]! + spacingM;
  }
  return path;
}

function linesOf(shape: PathShape): Drawn {
  const known = drawn.get(shape);
  if (known) return known;
  const runs = shape.runs.map(({ from, to, gear }) => {
    const line = new Path2D();
    line.moveTo(shape.x[from]!, shape.y[from]!);
    for (let i = from + 1; i <= to; i += 1) line.lineTo(shape.x[i]!, shape.y[i]!);
    return { gear, line };
  });
  const fresh: Drawn = {
    runs,
    swept: null,
    outlines: null,
    footprint: null,
    isFine: false,
    spacingM: 0,
  };
  drawn.set(shape, fresh);
  return fresh;
}
