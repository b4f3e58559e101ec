/** The one line that is always there: certified or why not, length, clearance, time. */

import { h, setText } from "./dom";
import { meters, seconds } from "./format";
import { icon, type IconName } from "./icons";
import { slotsOf } from "./state";
import type { PlanState, SlotState, State, Store } from "./store";
import type { Answer } from "./protocol";

type Kind = "good" | "bad" | "busy" | "idle";

export interface Verdict {
  kind: Kind;
  word: string;
  parts: string[];
}

/** Screen readers hear a change after this long without another. */
const CALM_MS = 700;

const WORDS: Record<Answer["status"], string> = {
  found: "Not certified",
  no_path: "No path",
  infeasible: "Not drivable",
  budget_exhausted: "Budget exhausted",
  timed_out: "Timed out",
  cancelled: "Cancelled",
  invalid_request: "Cannot plan",
};

const ICONS: Record<Kind, IconName> = { good: "check", bad: "alert", busy: "dice", idle: "map" };

/** Says of a slot how its plan stands. */
export function verdictOf(slot: SlotState): Verdict {
  const { plan } = slot;
  if (plan === null) return { kind: "idle", word: "Ready", parts: [] };
  if (plan.end === null) return underWay(plan);
  const { answer } = plan.end;
  if (answer.status === "found" && answer.certificate?.valid === true) return certified(answer);
  const time = `after ${seconds(answer.timing.query_s)}`;
  return { kind: "bad", word: WORDS[answer.status], parts: [reasonOf(answer), time] };
}

export function showStatus(host: HTMLElement, store: Store): void {
  const spoken = h("p", { class: "sr-only", role: "status", "aria-live": "polite" });
  const lines = h("div", { class: "status-lines" });
  host.append(lines, spoken);
  const shown = new Map<string, Line>();
  let timer = 0;

  store.watch(["slots", "isConnected", "catalog"], (state) => {
    const present = slotsOf(state);
    for (const key of shown.keys()) {
      if (!present.some(([slot]) => slot === key)) forget(shown, key);
    }
    for (const [key, slot] of present) {
      const line = shown.get(key) ?? add(shown, lines, key);
      line.show(verdict(state, slot), present.length > 1 ? slotTitle(key, slot) : "");
    }
    clearTimeout(timer);
    timer = window.setTimeout(
      () => setText(spoken, [...shown.values()].map((line) => line.words).join(". ")),
      CALM_MS,
    );
  });
}

class Line {
  readonly element: HTMLElement;
  private readonly slot = h("b", { class: "status-slot" });
  private readonly badge = h("span", { class: "badge" });
  private readonly word = h("span", {});
  private readonly rest = h("span", { class: "status-rest" });
  private kind: Kind | null = null;

  constructor() {
    this.element = h("p", { class: "status-line" }, this.slot, this.badge, this.rest);
  }

  /** As it is read out. */
  get words(): string {
    const parts = [this.slot, this.word, this.rest].map((part) => part.textContent ?? "");
    return parts
      .filter((part) => part !== "")
      .join(", ")
      .replace(/ \u00b7 /g, ", ");
  }

  show({ kind, word, parts }: Verdict, title: string): void {
    if (kind !== this.kind) {
      this.kind = kind;
      this.element.dataset.kind = kind;
      this.badge.replaceChildren(
        kind === "busy" ? h("span", { class: "pulse" }) : icon(ICONS[kind]),
        this.word,
      );
    }
    setText(this.slot, title);
    setText(this.word, word);
    const text = parts.join(" \u00b7 ");
    setText(this.rest, text);
    if (this.rest.title !== text) this.rest.title = text;
  }
}

function verdict(state: Readonly<State>, slot: SlotState): Verdict {
  if (!state.isConnected) {
    const parts =
      state.catalog === null ? [] : ["it opens again by itself once the server is back"];
    return { kind: "busy", word: state.catalog === null ? "Connecting" : "No connection", parts };
  }
  return verdictOf(slot);
}

function underWay(plan: PlanState): Verdict {
  const { improved } = plan;
  if (improved === null) return { kind: "busy", word: "Searching", parts: [] };
  const parts = [meters(improved.length_m), `after ${seconds(improved.at_ms / 1000)}`];
  return { kind: "busy", word: "Improving", parts };
}

function certified(answer: Answer): Verdict {
  const { metrics, timing } = answer;
  const parts = [meters(metrics?.length_m), `clearance ${meters(metrics?.min_clearance_m)}`];
  const cusps = metrics?.n_cusps ?? 0;
  if (cusps > 0) parts.push(`${cusps} gear ${cusps === 1 ? "change" : "changes"}`);
  const first = timing.first_feasible_s;
  if (first !== null && first < 0.9 * timing.query_s) parts.push(`first path ${seconds(first)}`);
  parts.push(`done ${seconds(timing.query_s)}`);
  return { kind: "good", word: "Certified", parts };
}

function reasonOf(answer: Answer): string {
  if (answer.reason) return answer.reason;
  const violations = answer.certificate?.violations as { message?: string }[] | undefined;
  return violations?.[0]?.message ?? answer.code;
}

function slotTitle(key: string, slot: SlotState): string {
  return `${key.toUpperCase()} ${slot.config.planner}`;
}

function add(shown: Map<string, Line>, host: HTMLElement, key: string): Line {
  const line = new Line();
  shown.set(key, line);
  host.append(line.element);
  return line;
}

function forget(shown: Map<string, Line>, key: string): void {
  shown.get(key)?.element.remove();
  shown.delete(key);
}
