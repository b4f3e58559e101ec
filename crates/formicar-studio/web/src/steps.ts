/** The steps in which a plan can be told, as the papers tell it: one sentence each. */

import { metres, plural } from "./format";
import type { MapState, PlanState } from "./store";

export type StepName = "map" | "expanded" | "closed" | "cells" | "nodes" | "arcs" | "judged";

export interface Step {
  name: StepName;
  title: string;
  sentence: string;
}

/** What of a plan can be told; empty until it has an answer. */
export function stepsOf(plan: PlanState | null, map: MapState | null): Step[] {
  const end = plan?.end;
  if (!end || map === null) return [];
  const { stages, answer } = end;
  const steps: (Step | null)[] = [
    {
      name: "map",
      title: "The map",
      sentence: `${plural(map.n_cols * map.n_rows, "cell")} of ${map.resolution_m} m, start and goal.`,
    },
    step("expanded", "Obstacles expanded", stages.expanded, (n) =>
      n === 0
        ? "Obstacles need not grow here."
        : `Obstacles grow by ${plural(n, "cell")}, so that the vehicle may be planned for as a point.`,
    ),
    step("closed", "U-shapes closed", stages.closed, (n) =>
      n === 0
        ? "There is no U-shape in which ants would get lost."
        : `${plural(n, "cell")} of dead ends are closed: no ant gets lost in a U-shape.`,
    ),
    step(
      "cells",
      "The way over cells",
      stages.grid_path,
      (n) => `The best ant's way goes over ${plural(n, "cell")}.`,
    ),
    step(
      "nodes",
      "Nodes removed",
      stages.nodes,
      (n) => `${plural(n, "node")} remain where straight lines between them stay free.`,
    ),
    arcs(plan),
    judged(plan),
  ];
  const told = steps.filter((one) => one !== null);
  // A map and a verdict alone are no story.
  return answer.path === null && told.length < 3 ? [] : told;
}

function step(
  name: StepName,
  title: string,
  cells: readonly number[] | undefined,
  sentence: (n: number) => string,
): Step | null {
  if (cells === undefined) return null;
  return { name, title, sentence: sentence(cells.length >> 1) };
}

function arcs(plan: PlanState): Step | null {
  const answer = plan.end?.answer;
  if (!answer?.path) return null;
  const n = answer.path.segments.length;
  const cusps = answer.metrics?.n_cusps ?? 0;
  const gears = cusps > 0 ? `, with ${plural(cusps, "change")} of gear` : "";
  const sentence = `Arcs and straight lines are fitted that the vehicle can drive: ${plural(n, "segment")}${gears}.`;
  return { name: "arcs", title: "Arcs fitted", sentence };
}

function judged(plan: PlanState): Step | null {
  const end = plan.end;
  if (!end) return null;
  const { answer } = end;
  if (answer.certificate?.valid === true && answer.metrics) {
    const { length_m, min_clearance_m } = answer.metrics;
    const sentence =
      `The judge drives the footprint along the path and certifies it: ${metres(length_m)}, ` +
      `${metres(min_clearance_m)} clear at the tightest place.`;
    return { name: "judged", title: "Judged", sentence };
  }
  return {
    name: "judged",
    title: "Judged",
    sentence: answer.reason ?? "There is no certified path.",
  };
}
