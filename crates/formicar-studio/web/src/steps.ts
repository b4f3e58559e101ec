/** The steps of a plan, as the papers present them, with a sentence each. */

import { meters, plural } from "./format";
import type { MapState, PlanState } from "./store";

export type StepName = "map" | "expanded" | "closed" | "cells" | "nodes" | "arcs" | "judged";

export interface Step {
  name: StepName;
  title: string;
  sentence: string;
}

/** The steps of a plan; empty until it has an answer. */
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
        ? "No obstacle needs to grow here."
        : `Obstacles grow by ${plural(n, "cell")}, so that the vehicle can be planned for as a point.`,
    ),
    step("closed", "U-shapes closed", stages.closed, (n) =>
      n === 0
        ? "The map has no U-shape that would trap ants."
        : `${plural(n, "cell")} of dead ends are closed, so that no U-shape traps ants.`,
    ),
    step(
      "cells",
      "The path over cells",
      stages.grid_path,
      (n) => `The path of the best ant has ${plural(n, "cell")}.`,
    ),
    step(
      "nodes",
      "Nodes removed",
      stages.nodes,
      (n) => `${plural(n, "node")} remain; the straight lines between them are free.`,
    ),
    arcs(plan),
    judged(plan),
  ];
  const known = steps.filter((one) => one !== null);
  // A map and a verdict alone need no steps.
  return answer.path === null && known.length < 3 ? [] : known;
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
  const sentence = `Arcs and straight lines that the vehicle can drive are fitted: ${plural(n, "segment")}${gears}.`;
  return { name: "arcs", title: "Arcs fitted", sentence };
}

function judged(plan: PlanState): Step | null {
  const end = plan.end;
  if (!end) return null;
  const { answer } = end;
  if (answer.certificate?.valid === true && answer.metrics) {
    const { length_m, min_clearance_m } = answer.metrics;
    const sentence =
      `The judge drives the footprint along the path and certifies it: ${meters(length_m)}, ` +
      `clearance ${meters(min_clearance_m)}.`;
    return { name: "judged", title: "Judged", sentence };
  }
  return {
    name: "judged",
    title: "Judged",
    sentence: answer.reason ?? "There is no certified path.",
  };
}
