/** Two planners on the same request: which, and a table of how their answers differ. */

import type { Actions } from "../actions";
import { h, setText } from "../dom";
import { degrees, fixed, meters, seconds } from "../format";
import type { Answer, Catalog, Config, Slot } from "../protocol";
import { answerOf, presetOf } from "../state";
import type { SlotState, State, Store } from "../store";
import { verdictOf } from "../status";
import { plannerSelect } from "./planner";
import { button, row } from "./widgets";

/** A figure of an answer, and which of two is better. */
interface Figure {
  name: string;
  of: (answer: Answer) => number | null | undefined;
  text: (value: number) => string;
  better: "less" | "more" | null;
}

const FIGURES: readonly Figure[] = [
  { name: "Length", of: metric("length_m"), text: meters, better: "less" },
  { name: "Least clearance", of: metric("min_clearance_m"), text: meters, better: "more" },
  { name: "Mean clearance", of: metric("mean_clearance_m"), text: meters, better: "more" },
  { name: "Gear changes", of: metric("n_cusps"), text: whole, better: "less" },
  { name: "In reverse", of: metric("reverse_length_m"), text: meters, better: "less" },
  {
    name: "Total turning",
    of: metric("total_turning_rad"),
    text: (value) => degrees(value, 0),
    better: "less",
  },
  { name: "Greatest curvature", of: metric("max_curvature_per_m"), text: perMeter, better: "less" },
  { name: "Curvature jumps", of: metric("n_curvature_jumps"), text: whole, better: "less" },
  {
    name: "First path",
    of: ({ timing }) => timing.first_feasible_s,
    text: seconds,
    better: "less",
  },
  { name: "Done", of: ({ timing }) => timing.query_s, text: seconds, better: "less" },
];

const MAX_CHANGES = 24;

export function comparePanel(host: HTMLElement, store: Store, actions: Actions): void {
  let panel: Panel | null = null;
  store.watch(["catalog", "slots"], (state) => {
    if (state.catalog === null) return;
    panel ??= new Panel(host, state.catalog, store, actions);
    panel.show(state);
  });
}

class Panel {
  private readonly choices: Record<Slot, HTMLSelectElement>;
  private readonly second: HTMLElement;
  private readonly offer: HTMLElement;
  private readonly results: HTMLElement;
  private readonly table = new DifferenceTable();
  private readonly changes = h("dl", { class: "changes" });

  constructor(host: HTMLElement, catalog: Catalog, store: Store, actions: Actions) {
    const preset = (name: string): Config => presetOf(store.state, name);
    this.choices = {
      a: plannerSelect(catalog, (name) => actions.setConfig("a", preset(name))),
      b: plannerSelect(catalog, (name) => actions.compare(preset(name))),
    };
    const stop = (): void => {
      store.set({ shown: "a" });
      actions.compare(null);
    };
    this.second = row("Plan B", this.choices.b);
    const rival = () => rivalOf(store.state);
    this.offer = h(
      "div",
      {},
      h(
        "p",
        { class: "about" },
        "Runs a second planner on the same map, vehicle and request, side by side.",
      ),
      h(
        "div",
        { class: "buttons" },
        button("Compare", () => actions.compare(rival()), { icon: "columns", class: "primary" }),
      ),
    );
    this.results = h(
      "div",
      {},
      h("div", { class: "buttons" }, button("Stop comparing", stop, { icon: "close" })),
      this.table.element,
      this.changes,
    );
    host.append(
      h("div", { class: "section" }, row("Plan A", this.choices.a), this.second),
      this.offer,
      this.results,
    );
  }

  show({ slots }: Readonly<State>): void {
    const { a, b } = slots;
    this.second.hidden = this.results.hidden = b === null;
    this.offer.hidden = b !== null;
    this.choices.a.value = a.config.planner;
    if (b === null) return;
    this.choices.b.value = b.config.planner;
    this.table.show(a, b);
    this.changes.replaceChildren(...changedParameters(a.config, b.config));
  }
}

/** Figures of both, and the difference from A to B. */
class DifferenceTable {
  readonly element: HTMLElement;
  private readonly heads = [h("th", { scope: "col" }), h("th", { scope: "col" })] as const;
  private readonly verdicts = [h("td", {}), h("td", {}), h("td", {})] as const;
  private readonly rows = FIGURES.map((figure) => ({
    figure,
    cells: [h("td", {}), h("td", {}), h("td", {})] as const,
  }));

  constructor() {
    this.element = h(
      "table",
      { class: "differences" },
      h("caption", { class: "sr-only" }, "Both answers, and how plan B differs from plan A"),
      h(
        "thead",
        {},
        h("tr", {}, h("td", {}), ...this.heads, h("th", { scope: "col" }, "B \u2212 A")),
      ),
      h(
        "tbody",
        {},
        h("tr", {}, h("th", { scope: "row" }, "Verdict"), ...this.verdicts),
        ...this.rows.map(({ figure, cells }) =>
          h("tr", {}, h("th", { scope: "row" }, figure.name), ...cells),
        ),
      ),
    );
  }

  show(a: SlotState, b: SlotState): void {
    [a, b].forEach((slot, i) => {
      const verdict = verdictOf(slot);
      const [head, cell] = [this.heads[i], this.verdicts[i]];
      if (head) setText(head, `${i === 0 ? "A" : "B"} ${slot.config.planner}`);
      if (!cell) return;
      setText(cell, verdict.word);
      cell.dataset.kind = verdict.kind;
      cell.title = verdict.parts.join(", ");
    });
    for (const { figure, cells } of this.rows)
      showFigure(figure, cells, valueIn(a, figure), valueIn(b, figure));
  }
}

type Cells = readonly [HTMLElement, HTMLElement, HTMLElement];

function showFigure(
  { text, better }: Figure,
  cells: Cells,
  a: number | null,
  b: number | null,
): void {
  setText(cells[0], a === null ? "\u2013" : text(a));
  setText(cells[1], b === null ? "\u2013" : text(b));
  const isBoth = a !== null && b !== null;
  const isSame = isBoth && text(a) === text(b);
  setText(cells[2], !isBoth ? "" : isSame ? "=" : signed(b - a, text) + ratio(a, b));
  const isLess = isBoth && !isSame && better !== null && (better === "less" ? a < b : a > b);
  const isMore = isBoth && !isSame && better !== null && !isLess;
  mark(cells[0], isLess);
  mark(cells[1], isMore);
}

function mark(cell: HTMLElement, isBetter: boolean): void {
  cell.toggleAttribute("data-better", isBetter);
  cell.title = isBetter ? "the better of the two" : "";
}

function signed(value: number, text: (value: number) => string): string {
  return value > 0 ? `+${text(value)}` : `\u2212${text(-value)}`;
}

function ratio(a: number, b: number): string {
  if (a <= 0 || b <= 0) return "";
  const percent = (100 * (b - a)) / a;
  return Math.abs(percent) < 100
    ? ` (${percent > 0 ? "+" : ""}${fixed(percent, 1)}\u00a0%)`
    : ` (\u00d7${fixed(b / a, 1)})`;
}

function metric(name: string): Figure["of"] {
  return ({ metrics }) => metrics?.[name];
}

function valueIn(slot: SlotState, figure: Figure): number | null {
  const answer = answerOf(slot);
  return (answer && figure.of(answer)) ?? null;
}

function whole(value: number): string {
  return fixed(value, 0);
}

function perMeter(value: number): string {
  return `${fixed(value, 3)} 1/m`;
}

/** The planner that a comparison begins with: hybrid A*, or formicar where that is plan A. */
function rivalOf(state: Readonly<State>): Config {
  return presetOf(
    state,
    state.slots.a.config.planner === "hybrid-astar" ? "formicar" : "hybrid-astar",
  );
}

/** Parameters in which two configurations of one planner differ. */
function changedParameters(a: Config, b: Config): HTMLElement[] {
  if (a.planner !== b.planner) return [];
  const [left, right] = [flat(a), flat(b)];
  const paths = [...new Set([...left.keys(), ...right.keys()])].filter(
    (path) => left.get(path) !== right.get(path),
  );
  return paths
    .slice(0, MAX_CHANGES)
    .map((path) =>
      h(
        "div",
        {},
        h("dt", {}, path),
        h("dd", {}, `${left.get(path) ?? "\u2013"} \u2192 ${right.get(path) ?? "\u2013"}`),
      ),
    );
}

function flat(value: unknown, path = "", into = new Map<string, string>()): Map<string, string> {
  if (typeof value === "object" && value !== null && !Array.isArray(value)) {
    for (const [key, inner] of Object.entries(value))
      flat(inner, path === "" ? key : `${path}.${key}`, into);
  } else {
    into.set(path, JSON.stringify(value));
  }
  return into;
}
