/** The vehicle from above with its measures; handles change them. */

import { s } from "../dom";
import { degrees, meters } from "../format";
import type { VehicleMessage, VehicleParameters } from "../protocol";
import {
  ackermann,
  asParameters,
  bounds,
  measuresOf,
  moved,
  previewOf,
  rectangleOf,
  type Handle,
  type Measures,
} from "./vehicle_measures";

/** Field of the drawing. */
const WIDTH = 280;
const HEIGHT = 176;
const MARGIN = 34;
const WHEEL_LENGTH = 0.22;

const HANDLES: Record<Handle, string> = {
  front: "front overhang",
  rear: "rear overhang",
  axle: "wheelbase",
  side: "width",
  steer: "greatest steering angle",
};

export class VehicleDrawing {
  readonly element: SVGSVGElement;
  private vehicle: VehicleMessage | null = null;
  /** Measures while a handle is dragged. */
  private preview: VehicleParameters | null = null;
  private scale = 1;
  private center: [number, number] = [0, 0];

  /** `change` gets the measures when a handle is released. */
  constructor(private readonly change: (values: VehicleParameters) => void) {
    this.element = s("svg", {
      class: "vehicle-drawing",
      viewBox: `0 0 ${WIDTH} ${HEIGHT}`,
      role: "img",
      "aria-label": "Top view of the vehicle; the fields below hold the same measures",
    });
  }

  show(vehicle: VehicleMessage): void {
    this.vehicle = vehicle;
    if (this.preview === null) this.draw();
  }

  private draw(): void {
    if (this.vehicle === null) return;
    const measures = this.preview === null ? measuresOf(this.vehicle) : previewOf(this.preview);
    if (this.preview === null) this.fit(measures);
    this.element.replaceChildren(
      this.turning(measures),
      s("polygon", {
        class: "body",
        points: measures.corners.map((corner) => this.at(corner).join()).join(" "),
      }),
      ...this.wheels(measures),
      ...this.dimensions(measures),
      ...this.handles(measures),
    );
  }

  private fit({ corners }: Measures): void {
    const [x0, x1, y0, y1] = bounds(corners);
    this.scale = Math.min((WIDTH - 2 * MARGIN) / (x1 - x0), (HEIGHT - 2 * MARGIN) / (y1 - y0));
    this.center = [(x0 + x1) / 2, (y0 + y1) / 2];
  }

  /** Forward is to the right. */
  private at([x, y]: readonly [number, number]): [number, number] {
    const place = (value: number): number => Math.round(10 * value) / 10;
    return [
      place(WIDTH / 2 + (x - this.center[0]) * this.scale),
      place(HEIGHT / 2 - (y - this.center[1]) * this.scale),
    ];
  }

  /** The way of the rear axle's center with the wheels turned to the left, as far as there is room. */
  private turning({ radius }: Measures): SVGElement {
    const r = radius === null ? 0 : radius * this.scale;
    const [x, y] = this.at([0, radius ?? 0]);
    return s("circle", { class: "turning", cx: x, cy: y, r });
  }

  private wheels({ wheelbase, track, steer, corners }: Measures): SVGElement[] {
    if (wheelbase === null) return [];
    const [, , y0, y1] = bounds(corners);
    const half = (track ?? 0.8 * (y1 - y0)) / 2;
    const length = Math.max(WHEEL_LENGTH * wheelbase * this.scale, 6);
    const front = steer === null ? [0, 0] : ackermann(steer, wheelbase, half);
    const wheel = (x: number, y: number, angle: number): SVGElement => {
      const [cx, cy] = this.at([x, y]);
      const turn = `rotate(${-(angle * 180) / Math.PI} ${cx} ${cy})`;
      const [width, height] = [length, length * 0.36];
      return s("rect", {
        class: "wheel",
        x: cx - width / 2,
        y: cy - height / 2,
        width,
        height,
        rx: 1.5,
        transform: turn,
      });
    };
    const axle = (x: number): SVGElement => line("axle", this.at([x, -half]), this.at([x, half]));
    return [
      axle(0),
      axle(wheelbase),
      wheel(0, half, 0),
      wheel(0, -half, 0),
      wheel(wheelbase, half, front[0] ?? 0),
      wheel(wheelbase, -half, front[1] ?? 0),
    ];
  }

  private dimensions({ corners, wheelbase, steer }: Measures): SVGElement[] {
    const [x0, x1, y0, y1] = bounds(corners);
    const below = this.at([0, y0])[1] + 13;
    const marks: [number, number][] =
      wheelbase === null
        ? [[x0, x1]]
        : [
            [x0, 0],
            [0, wheelbase],
            [wheelbase, x1],
          ];
    const along = marks.flatMap(([a, b]) => {
      const [left, right] = [this.at([a, 0])[0], this.at([b, 0])[0]];
      return measure([left, below], [right, below], meters(b - a));
    });
    const aside = this.at([x0, 0])[0] - 12;
    const across = measure(
      [aside, this.at([0, y1])[1]],
      [aside, this.at([0, y0])[1]],
      meters(y1 - y0),
    );
    const angle = steer === null ? [] : [label([WIDTH - 6, 14], `\u00b1${degrees(steer)}`, "end")];
    return [...along, ...across, ...angle];
  }

  private handles({ corners, wheelbase, steer }: Measures): SVGElement[] {
    if (wheelbase === null || this.vehicle?.parameters.footprint) return [];
    const [x0, x1, , y1] = bounds(corners);
    const places: Record<Handle, [number, number] | null> = {
      front: [x1, 0],
      rear: [x0, 0],
      axle: [wheelbase, 0],
      side: [wheelbase / 2, y1],
      steer: steer === null ? null : this.steerHandle(wheelbase, steer),
    };
    return (Object.keys(places) as Handle[]).flatMap((which) => {
      const place = places[which];
      return place ? [this.handle(which, this.at(place))] : [];
    });
  }

  private steerHandle(wheelbase: number, steer: number): [number, number] {
    const reach = 30 / this.scale;
    return [wheelbase + reach * Math.cos(steer), reach * Math.sin(steer)];
  }

  private handle(which: Handle, [cx, cy]: [number, number]): SVGElement {
    const dot = s(
      "circle",
      { class: `handle ${which}`, cx, cy, r: 4.5 },
      s("title", {}, `Drag: ${HANDLES[which]}`),
    );
    dot.addEventListener("pointerdown", (event) => this.grab(which, event));
    return dot;
  }

  private grab(which: Handle, event: PointerEvent): void {
    const { element, vehicle } = this;
    if (vehicle === null) return;
    event.preventDefault();
    const start = rectangleOf(vehicle);
    element.setPointerCapture(event.pointerId);
    const move = (to: PointerEvent): void => {
      this.preview = { ...start, ...moved(which, start, this.world(to)) };
      this.draw();
    };
    const end = (): void => {
      element.removeEventListener("pointermove", move);
      const values = this.preview;
      this.preview = null;
      if (values) this.change(asParameters(which, values, vehicle));
    };
    element.addEventListener("pointermove", move);
    element.addEventListener("pointerup", end, { once: true });
    element.addEventListener("pointercancel", end, { once: true });
  }

  /** The position of the pointer, meters. */
  private world(event: PointerEvent): [number, number] {
    const box = this.element.getBoundingClientRect();
    const ratio = Math.max(WIDTH / box.width, HEIGHT / box.height);
    const x = (event.clientX - box.left - box.width / 2) * ratio;
    const y = (event.clientY - box.top - box.height / 2) * ratio;
    return [x / this.scale + this.center[0], -y / this.scale + this.center[1]];
  }
}

function line(
  name: string,
  [x1, y1]: readonly [number, number],
  [x2, y2]: readonly [number, number],
): SVGElement {
  return s("line", { class: name, x1, y1, x2, y2 });
}

function label([x, y]: readonly [number, number], text: string, anchor: string): SVGElement {
  return s("text", { x, y, "text-anchor": anchor }, text);
}

/** A dimension line with ticks at its ends; its text goes below, or to its left upright. */
function measure(a: [number, number], b: [number, number], text: string): SVGElement[] {
  const isUpright = a[0] === b[0];
  const tick = ([x, y]: [number, number]): SVGElement =>
    isUpright
      ? line("dimension", [x - 3, y], [x + 3, y])
      : line("dimension", [x, y - 3], [x, y + 3]);
  const [x, y] = [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
  const words = isUpright
    ? s(
        "text",
        { x: x - 4, y, "text-anchor": "middle", transform: `rotate(-90 ${x - 4} ${y})` },
        text,
      )
    : label([x, y + 12], text, "middle");
  return [line("dimension", a, b), tick(a), tick(b), words];
}
