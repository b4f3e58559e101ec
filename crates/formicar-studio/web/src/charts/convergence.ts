/** The convergence of a search: costs and evaporation over iterations, or lengths over time. */

import uPlot from "uplot";
import { h, setText } from "../dom";
import { fixed, seconds } from "../format";
import type { IterationRecord } from "../protocol";
import { shownSlot } from "../state";
import type { Frame, PlanState, State, Store } from "../store";
import { color } from "../theme";
import { axis, frame, Plot, type Options } from "./plot";

type Kind = "iterations" | "improvements";

interface Curves {
  kind: Kind;
  data: (number | null)[][];
  /** Changes whenever there is something new to draw. */
  key: string;
}

const CALM_MS = 100;
const TITLES: Record<Kind, string> = { iterations: "Cost", improvements: "Length, m" };

export function showConvergence(host: HTMLElement, store: Store): void {
  new Convergence(host, store);
}

class Convergence {
  private readonly title = h("span", { class: "strip-name" });
  private readonly keys = h("span", { class: "keys-of-chart" });
  private readonly plot: Plot;
  private kind: Kind | null = null;
  private key = "";
  private timer = 0;

  constructor(
    private readonly host: HTMLElement,
    private readonly store: Store,
  ) {
    const place = h("div", { class: "convergence-plot" });
    host.append(h("div", { class: "chart-head" }, this.title, this.keys), place);
    this.plot = new Plot(
      place,
      () => this.options(),
      (at, isPressed) => this.point(at, isPressed),
    );
    store.watch(["slots", "shown"], () => this.soon());
    store.watch(["frame", "slots", "shown"], (state) =>
      this.plot.mark("frame", this.placeOf(state)),
    );
  }

  private soon(): void {
    if (this.timer === 0)
      this.timer = window.setTimeout(() => this.show(this.store.state), CALM_MS);
  }

  private show(state: Readonly<State>): void {
    this.timer = 0;
    const { plan } = shownSlot(state);
    const curves = plan === null ? null : curvesOf(plan);
    this.host.hidden = curves === null;
    if (curves === null || curves.key === this.key) return;
    this.key = curves.key;
    const data = curves.data as uPlot.AlignedData;
    if (curves.kind === this.kind) this.plot.show(data);
    else this.renew(curves.kind, data);
    this.plot.mark("frame", this.placeOf(state));
  }

  private renew(kind: Kind, data: uPlot.AlignedData): void {
    this.kind = kind;
    setText(this.title, TITLES[kind]);
    const key = (name: string, text: string): HTMLElement =>
      h("span", { class: `key ${name}` }, text);
    this.keys.replaceChildren(
      ...(kind === "iterations"
        ? [
            key("best", "best so far"),
            key("each", "best"),
            key("mean", "mean"),
            key("rho", "\u03c1"),
          ]
        : [key("best", "certified path")]),
    );
    this.plot.renew(data);
  }

  /** The position of the shown frame on the horizontal axis. */
  private placeOf(state: Readonly<State>): number | null {
    const frames = shownSlot(state).plan?.frames ?? [];
    const shown = state.frame === null ? null : frames[state.frame];
    return shown ? placeOfFrame(shown, this.kind) : null;
  }

  /** Takes playback to the frame that is pointed at. */
  private point(at: number | null, isPressed: boolean): void {
    if (at === null || !isPressed) return;
    const frames = shownSlot(this.store.state).plan?.frames ?? [];
    const distance = (one: Frame): number =>
      Math.abs((placeOfFrame(one, this.kind) ?? Infinity) - at);
    let best = 0;
    frames.forEach((one, i) => {
      const old = frames[best];
      if (old && distance(one) < distance(old)) best = i;
    });
    if (frames.length > 0) this.store.set({ frame: best, isPlaying: false });
  }

  private options(): Options {
    return this.kind === "improvements" ? improvementOptions() : iterationOptions();
  }
}

function placeOfFrame(one: Frame, kind: Kind | null): number | null {
  if (kind === "improvements") return one.type === "improved" ? one.at_ms / 1000 : null;
  return one.type === "iteration" || one.type === "generation" ? one.record.iteration : null;
}

/** The data of a plan to draw; null if it neither iterates nor improves. */
function curvesOf(plan: PlanState): Curves | null {
  const records = recordsOf(plan);
  if (records.length > 1) return iterations(plan.plan, records);
  const improved = plan.frames.flatMap((one) => (one.type === "improved" ? [one] : []));
  if (improved.length < 2) return null;
  const [times, lengths] = [
    improved.map((one) => one.at_ms / 1000),
    improved.map((one) => one.length_m),
  ];
  const end = plan.end?.answer.timing.query_s;
  if (end !== undefined && end > (times[times.length - 1] ?? 0)) {
    times.push(end);
    lengths.push(lengths[lengths.length - 1] ?? 0);
  }
  return {
    kind: "improvements",
    data: [times, lengths],
    key: `${plan.plan} ${times.length} improvements`,
  };
}

/** All records at the end, meanwhile those of the frames. */
function recordsOf(plan: PlanState): IterationRecord[] {
  if (plan.end && plan.end.history.length > 0) return plan.end.history;
  return plan.frames.flatMap((one) =>
    one.type === "iteration" || one.type === "generation" ? [one.record] : [],
  );
}

function iterations(plan: number, records: readonly IterationRecord[]): Curves {
  const data = [
    records.map(({ iteration }) => iteration),
    records.map(({ mean_cost }) => mean_cost),
    records.map(({ best_cost }) => best_cost),
    records.map(({ best_so_far_cost }) => best_so_far_cost),
    records.map(({ rho }) => rho),
  ];
  return { kind: "iterations", data, key: `${plan} ${records.length} iterations` };
}

function iterationOptions(): Options {
  return {
    ...frame(),
    scales: { x: { time: false }, rho: { range: (): [number, number] => [0, 1] } },
    axes: [
      axis({ size: 20, incrs: [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 5000, 10000] }),
      axis({ size: 46, space: 28 }),
      axis({
        scale: "rho",
        side: 1,
        size: 30,
        space: 40,
        grid: { show: false },
        values: (_: uPlot, ticks: number[]) => ticks.map((tick) => fixed(tick, 1)),
      }),
    ],
    series: [
      {},
      { stroke: color("waypoints"), width: 1.2, points: { show: false } },
      { stroke: color("swept"), width: 1, points: { show: false } },
      { stroke: color("forward"), width: 2, points: { show: false } },
      { scale: "rho", stroke: color("goal"), width: 1.2, dash: [4, 3], points: { show: false } },
    ],
  };
}

function improvementOptions(): Options {
  return {
    ...frame(),
    padding: [7, 22, 2, 0],
    scales: { x: { time: false } },
    axes: [
      axis({
        size: 20,
        space: 60,
        values: (_: uPlot, ticks: number[]) =>
          ticks.map((tick) => (tick === 0 ? "0" : seconds(tick))),
      }),
      axis({ size: 46, space: 28 }),
    ],
    series: [
      {},
      {
        stroke: color("forward"),
        width: 2,
        paths: steps(),
        points: { show: true, size: 4, fill: color("forward") },
      },
    ],
  };
}

/** A path stays as long as it is until a better one comes. */
function steps(): uPlot.Series.PathBuilder | undefined {
  return uPlot.paths.stepped?.({ align: 1 });
}
