/** Start and goal as numbers, and what is asked of the path. */

import type { Actions } from "../actions";
import { h } from "../dom";
import type { Pose, Request } from "../protocol";
import type { Store } from "../store";
import { iconButton, NumberInput, row, Select } from "./widgets";

const DEGREE = Math.PI / 180;
const DEFAULT_TOLERANCE = { xy: 0.01, yaw: 0.01 };

/** Something that shows a part of the request. */
interface Part {
  element: HTMLElement;
  show(request: Readonly<Request>): void;
}

export function requestForm(store: Store, actions: Actions): HTMLElement {
  const set = (part: Partial<Request>): void => actions.setRequest(part);
  const common = [modeRow(set), goalHeadingRow(set)];
  const rare = [
    startHeadingRow(set),
    curvatureRow(set),
    ...toleranceRows(store, set),
    limitRow("Deadline", "ms", "deadline_ms", set),
    limitRow("Budget", "steps", "budget_steps", set),
  ];
  const poses = [poseRow("Start", "start", store, set), poseRow("Goal", "goal", store, set)];
  const parts = [...poses, ...common, ...rare];
  store.watch(["request"], ({ request }) => {
    for (const part of parts) part.show(request);
  });
  const swap = iconButton("swap", "Swap start and goal", () => {
    const { start, goal } = store.state.request;
    set({ start: goal, goal: start });
  });
  return h(
    "div",
    { class: "request" },
    h(
      "div",
      { class: "pose-head" },
      h("span", {}, "x m"),
      h("span", {}, "y m"),
      h("span", {}, "heading \u00b0"),
      swap,
    ),
    ...poses.map(({ element }) => element),
    ...common.map(({ element }) => element),
    h(
      "details",
      { class: "more" },
      h("summary", {}, "Tolerances and limits"),
      ...rare.map(({ element }) => element),
    ),
  );
}

type SetPart = (part: Partial<Request>) => void;

function poseRow(label: string, which: "start" | "goal", store: Store, set: SetPart): Part {
  const change = (index: number, value: number | null): void => {
    if (value === null) return;
    const pose: Pose = [...store.state.request[which]];
    pose[index] = index === 2 ? value * DEGREE : value;
    set({ [which]: pose });
  };
  const names = ["x in meters", "y in meters", "heading in degrees"];
  const inputs = names.map(
    (name, i) =>
      new NumberInput({ label: `${label}: ${name}`, step: i === 2 ? 5 : 0.1 }, (value) =>
        change(i, value),
      ),
  );
  const element = h(
    "div",
    { class: "pose", role: "group", "aria-label": label },
    h("span", { class: `pose-name ${which}` }, label),
    ...inputs.map((input) => input.element),
  );
  const show = (request: Readonly<Request>): void => {
    const [x, y, heading] = request[which];
    [rounded(x, 3), rounded(y, 3), rounded(heading / DEGREE, 2)].forEach((value, i) =>
      inputs[i]?.show(value),
    );
  };
  return { element, show };
}

function modeRow(set: SetPart): Part {
  const select = new Select(
    [
      ["reverse", "forward and reverse"],
      ["forward", "forward only"],
    ] as const,
    (motion) => set({ motion }),
  );
  return {
    element: row("Gears", select.element),
    show: ({ motion }) => select.show(motion ?? "reverse"),
  };
}

function goalHeadingRow(set: SetPart): Part {
  const select = new Select(
    [
      ["exact", "as drawn"],
      ["bidirectional", "as drawn or opposite"],
      ["any", "any"],
    ] as const,
    (goal_heading) => set({ goal_heading }),
  );
  return {
    element: row("Goal heading", select.element),
    show: (request) => select.show(request.goal_heading ?? "exact"),
  };
}

function startHeadingRow(set: SetPart): Part {
  const select = new Select(
    [
      ["exact", "as drawn"],
      ["any", "any"],
    ] as const,
    (start_heading) => set({ start_heading }),
  );
  return {
    element: row("Start heading", select.element),
    show: (request) => select.show(request.start_heading ?? "exact"),
  };
}

function curvatureRow(set: SetPart): Part {
  const rate = new NumberInput(
    {
      label: "Greatest rate of curvature",
      min: 0,
      step: 0.05,
      isOptional: true,
      placeholder: "vehicle",
    },
    (value) => set({ curvature: continuous(value) }),
  );
  const select = new Select(
    [
      ["arcs", "may jump"],
      ["continuous", "continuous"],
    ] as const,
    (mode) => set({ curvature: mode === "arcs" ? undefined : continuous(null) }),
  );
  const rateRow = row("At most", rate.element, "1/m\u00b2");
  const element = h("div", {}, row("Curvature", select.element), rateRow);
  const show = ({ curvature }: Readonly<Request>): void => {
    const isSmooth = typeof curvature === "object" && curvature !== null;
    select.show(isSmooth ? "continuous" : "arcs");
    rateRow.hidden = !isSmooth;
    rate.show(rateIn(curvature));
  };
  return { element, show };
}

function continuous(rate: number | null): unknown {
  return { continuous: rate === null ? {} : { max_rate_per_m2: rate } };
}

function rateIn(curvature: unknown): number | null {
  const inner = (curvature as { continuous?: { max_rate_per_m2?: number | null } } | undefined)
    ?.continuous;
  return inner?.max_rate_per_m2 ?? null;
}

function toleranceRows(store: Store, set: SetPart): Part[] {
  const now = () => store.state.request.goal_tolerance ?? DEFAULT_TOLERANCE;
  const place = new NumberInput({ min: 0, step: 0.01 }, (value) => {
    if (value !== null) set({ goal_tolerance: { ...now(), xy: value } });
  });
  const heading = new NumberInput({ min: 0, max: 180, step: 0.5 }, (value) => {
    if (value !== null) set({ goal_tolerance: { ...now(), yaw: value * DEGREE } });
  });
  return [
    { element: row("Goal tolerance", place.element, "m"), show: () => place.show(now().xy) },
    {
      element: row("and turned by", heading.element, "\u00b0"),
      show: () => heading.show(rounded(now().yaw / DEGREE, 3)),
    },
  ];
}

function limitRow(
  label: string,
  unit: string,
  key: "deadline_ms" | "budget_steps",
  set: SetPart,
): Part {
  const input = new NumberInput(
    { min: 1, step: key === "deadline_ms" ? 10 : 1000, isOptional: true, placeholder: "none" },
    (value) =>
      set({
        [key]: value === null ? undefined : key === "budget_steps" ? Math.round(value) : value,
      }),
  );
  return { element: row(label, input.element, unit), show: (request) => input.show(request[key]) };
}

function rounded(value: number, digits: number): number {
  return Number(value.toFixed(digits));
}
