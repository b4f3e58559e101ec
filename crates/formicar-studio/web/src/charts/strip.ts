/** One quantity along the path: its name and value to the left, its curve to the right. */

import type uPlot from "uplot";
import { h, setText } from "../dom";
import { fixed } from "../format";
import type { PoseRecord, VehicleMessage } from "../protocol";
import { color } from "../theme";
import { axis, frame, Plot, type Options } from "./plot";

interface Quantity {
  name: string;
  unit: string;
  of: (pose: PoseRecord) => number | null;
  limit: (vehicle: VehicleMessage | null) => number | null;
  text: (value: number) => string;
  /** Whether it has both signs, and its limit too. */
  isSigned: boolean;
}

export const QUANTITIES: readonly Quantity[] = [
  {
    name: "Curvature",
    unit: "1/m",
    of: ({ curvature }) => curvature,
    limit: (vehicle) => (vehicle?.min_turning_radius_m ? 1 / vehicle.min_turning_radius_m : null),
    text: (value) => fixed(value, 3),
    isSigned: true,
  },
  {
    name: "Steering",
    unit: "\u00b0",
    of: ({ steer }) => (steer === null ? null : (steer * 180) / Math.PI),
    limit: (vehicle) => (vehicle?.max_steer_rad ? (vehicle.max_steer_rad * 180) / Math.PI : null),
    text: (value) => fixed(value, 1),
    isSigned: true,
  },
  {
    name: "Clearance",
    unit: "m",
    of: ({ clearance }) => clearance,
    limit: () => 0,
    text: (value) => fixed(value, value < 0.1 ? 3 : 2),
    isSigned: false,
  },
];

export class Strip {
  readonly element: HTMLElement;
  readonly plot: Plot;
  private readonly value = h("output", { class: "strip-value" });
  private poses: PoseRecord[] = [];
  private vehicle: VehicleMessage | null = null;
  private extreme = "";

  constructor(
    private readonly quantity: Quantity,
    private readonly hasAxis: boolean,
    point: (at: number | null) => void,
  ) {
    const host = h("div", { class: "strip-plot" });
    const name = h("span", { class: "strip-name" }, quantity.name);
    const words = h(
      "div",
      { class: "strip-words" },
      name,
      this.value,
      h("span", { class: "unit" }, quantity.unit),
    );
    this.element = h("div", { class: hasAxis ? "strip last" : "strip" }, words, host);
    this.plot = new Plot(host, () => this.options(), point);
  }

  show(poses: PoseRecord[], vehicle: VehicleMessage | null): void {
    const values = poses.map(this.quantity.of);
    this.element.hidden = values.every((value) => value === null);
    const isOther = vehicle !== this.vehicle;
    [this.poses, this.vehicle] = [poses, vehicle];
    this.extreme = this.extremeOf(values);
    setText(this.value, this.extreme);
    const data: uPlot.AlignedData = [poses.map(({ s }) => s), values];
    if (isOther) this.plot.renew(data);
    else this.plot.show(data);
  }

  hover(at: number | null, pose: PoseRecord | null): void {
    this.plot.mark("hover", at);
    const value = pose && this.quantity.of(pose);
    setText(this.value, value === null ? this.extreme : this.quantity.text(value));
    this.element.toggleAttribute("data-hover", value !== null);
  }

  /** The value for the whole path: the greatest magnitude, or the least clearance. */
  private extremeOf(values: (number | null)[]): string {
    const known = values.filter((value) => value !== null);
    if (known.length === 0) return "";
    if (!this.quantity.isSigned)
      return `\u2265 ${this.quantity.text(known.reduce((a, b) => Math.min(a, b)))}`;
    return `\u2264 ${this.quantity.text(known.reduce((a, b) => Math.max(a, Math.abs(b)), 0))}`;
  }

  private options(): Options {
    return {
      ...frame(),
      scales: {
        x: {
          time: false,
          range: (_: uPlot, min: number, max: number): [number, number] => [min, max],
        },
        y: { range: () => this.range() },
      },
      axes: [
        axis({
          show: this.hasAxis,
          size: 20,
          values: (_: uPlot, ticks: number[]) => ticks.map((tick) => `${tick} m`),
        }),
        axis({
          size: 44,
          space: 18,
          splits: () => this.splits(),
          values: (_: uPlot, ticks: number[]) => ticks.map((tick) => short(tick)),
        }),
      ],
      series: [{}, { stroke: color("ink"), width: 1.4, points: { show: false } }],
      hooks: {
        drawClear: [(chart: uPlot) => this.underlay(chart)],
        draw: [(chart: uPlot) => this.overlay(chart)],
      },
    };
  }

  private range(): [number, number] {
    const limit = this.quantity.limit(this.vehicle) ?? 0;
    const values = this.poses.map((pose) => this.quantity.of(pose) ?? 0);
    const most = values.reduce((a, b) => Math.max(a, Math.abs(b)), Math.abs(limit)) || 1;
    return this.quantity.isSigned ? [-1.18 * most, 1.18 * most] : [-0.08 * most, 1.08 * most];
  }

  private splits(): number[] {
    const [, top] = this.range();
    const limit = this.quantity.limit(this.vehicle);
    if (this.quantity.isSigned) return limit === null ? [0] : [-limit, 0, limit];
    return [0, rounded(top / 2)];
  }

  /** Ground shaded where the vehicle reverses. */
  private underlay(chart: uPlot): void {
    const { ctx, bbox } = chart;
    ctx.save();
    ctx.globalAlpha = 0.16;
    ctx.fillStyle = color("reverse");
    for (const [from, to] of reversed(this.poses)) {
      const [left, right] = [chart.valToPos(from, "x", true), chart.valToPos(to, "x", true)];
      ctx.fillRect(left, bbox.top, right - left, bbox.height);
    }
    ctx.restore();
  }

  /** Limits as dashed lines; of the clearance the tightest place, ringed. */
  private overlay(chart: uPlot): void {
    const limit = this.quantity.limit(this.vehicle);
    const { ctx, bbox } = chart;
    const ratio = devicePixelRatio;
    ctx.save();
    ctx.strokeStyle = color("limit");
    ctx.lineWidth = ratio;
    if (limit !== null) {
      ctx.setLineDash([4 * ratio, 3 * ratio]);
      for (const value of this.quantity.isSigned ? [-limit, limit] : [limit]) {
        const y = Math.round(chart.valToPos(value, "y", true)) + 0.5;
        ctx.beginPath();
        ctx.moveTo(bbox.left, y);
        ctx.lineTo(bbox.left + bbox.width, y);
        ctx.stroke();
      }
    }
    if (!this.quantity.isSigned) this.ring(chart);
    ctx.restore();
  }

  private ring(chart: uPlot): void {
    const [first] = this.poses;
    if (!first) return;
    const { ctx } = chart;
    const tightest = this.poses.reduce((a, b) => (b.clearance < a.clearance ? b : a), first);
    ctx.setLineDash([]);
    ctx.lineWidth = 1.5 * devicePixelRatio;
    ctx.beginPath();
    ctx.arc(
      chart.valToPos(tightest.s, "x", true),
      chart.valToPos(tightest.clearance, "y", true),
      3.5 * devicePixelRatio,
      0,
      2 * Math.PI,
    );
    ctx.stroke();
  }
}

/** Stretches that are driven in reverse, from and to. */
function reversed(poses: readonly PoseRecord[]): [number, number][] {
  const stretches: [number, number][] = [];
  let from: number | null = null;
  for (const { s, direction } of poses) {
    if (direction === -1 && from === null) from = s;
    if (direction === 1 && from !== null) {
      stretches.push([from, s]);
      from = null;
    }
  }
  const end = poses[poses.length - 1];
  if (from !== null && end) stretches.push([from, end.s]);
  return stretches;
}

function short(value: number): string {
  return fixed(value, Math.abs(value) >= 10 || value === 0 ? 0 : Math.abs(value) >= 1 ? 1 : 2);
}

function rounded(value: number): number {
  return Number(value.toPrecision(1));
}
