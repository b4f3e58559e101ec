/** A chart that fits its host, follows the theme, and carries upright marks. */

import uPlot from "uplot";
import { h } from "../dom";
import { color, onThemeChange } from "../theme";

export type Options = Omit<uPlot.Options, "width" | "height">;

const FONT =
  '11px Inter, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, system-ui, sans-serif';

export class Plot {
  private chart: uPlot | null = null;
  private data: uPlot.AlignedData = [[]];
  private readonly marks = new Map<string, HTMLElement>();
  private readonly places = new Map<string, number | null>();

  /** `options` is asked again whenever colors change; `point` hears the place of the pointer on
   * the horizontal axis, null where it leaves. */
  constructor(
    private readonly host: HTMLElement,
    private readonly options: () => Options,
    private readonly point: (at: number | null, isPressed: boolean) => void,
  ) {
    new ResizeObserver(() => this.resize()).observe(host);
    onThemeChange(() => this.build());
  }

  show(data: uPlot.AlignedData): void {
    this.data = data;
    if (this.chart === null) this.build();
    else this.chart.setData(data);
    this.placeMarks();
  }

  /** Shows data that ask for other options: the chart is built anew. */
  renew(data: uPlot.AlignedData): void {
    this.data = data;
    this.build();
  }

  /** Puts an upright line somewhere, or takes it away. */
  mark(name: string, at: number | null): void {
    this.places.set(name, at);
    this.placeMark(name, at);
  }

  private build(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    this.chart?.destroy();
    this.chart = null;
    this.marks.clear();
    // Without a size it is built as soon as it has one.
    if (width === 0 || height === 0 || this.data.length < 2) return;
    this.chart = new uPlot({ ...this.options(), width, height }, this.data, this.host);
    this.listen(this.chart);
    this.placeMarks();
  }

  private listen(chart: uPlot): void {
    const tell = (event: PointerEvent, isPressed: boolean): void => {
      const left = event.clientX - chart.over.getBoundingClientRect().left;
      this.point(chart.posToVal(left, "x"), isPressed);
    };
    chart.over.addEventListener("pointerdown", (event) => tell(event, true));
    chart.over.addEventListener("pointermove", (event) => tell(event, event.buttons > 0));
    chart.over.addEventListener("pointerleave", () => this.point(null, false));
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (width === 0 || height === 0) return;
    if (this.chart === null) this.build();
    else this.chart.setSize({ width, height });
    this.placeMarks();
  }

  private placeMarks(): void {
    for (const [name, at] of this.places) this.placeMark(name, at);
  }

  private placeMark(name: string, at: number | null): void {
    const { chart } = this;
    if (chart === null) return;
    const { min, max } = chart.scales.x ?? {};
    const isInside = at !== null && min != null && max != null && at >= min && at <= max;
    const mark = this.marks.get(name) ?? this.addMark(chart, name);
    mark.hidden = !isInside;
    if (isInside) mark.style.transform = `translateX(${chart.valToPos(at, "x")}px)`;
  }

  private addMark(chart: uPlot, name: string): HTMLElement {
    const mark = h("div", { class: `mark ${name}` });
    chart.over.append(mark);
    this.marks.set(name, mark);
    return mark;
  }
}

/** An axis as all charts have it. */
export function axis(more: uPlot.Axis): uPlot.Axis {
  return {
    stroke: color("muted"),
    font: FONT,
    gap: 4,
    grid: { stroke: color("hairline"), width: 1 },
    ticks: { show: false },
    ...more,
  };
}

/** The options of all charts: no legend, no cursor of their own. */
export function frame(): Pick<uPlot.Options, "legend" | "cursor" | "padding"> {
  return { legend: { show: false }, cursor: { show: false }, padding: [7, 16, 2, 0] };
}
