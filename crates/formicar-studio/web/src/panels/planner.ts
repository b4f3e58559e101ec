/** The choice of a planner, its seed, and a form of all its parameters. */

import type { Actions } from "../actions";
import { h, setText } from "../dom";
import type { Catalog, Config, Slot } from "../protocol";
import { isPlanning, presetOf, shownSlot } from "../state";
import type { State, Store } from "../store";
import { Form } from "./forms/form";
import { isSame } from "./forms/same";
import { SlotChoice } from "./slot";
import { button, iconButton, NumberInput, row } from "./widgets";

const MAX_SEED = 2 ** 32 - 1;

export function plannerPanel(host: HTMLElement, store: Store, actions: Actions): void {
  let panel: Panel | null = null;
  store.watch(["catalog", "slots", "shown"], (state) => {
    if (state.catalog === null) return;
    panel ??= new Panel(host, state.catalog, store, actions);
    panel.show(state);
  });
}

class Panel {
  private readonly select: HTMLSelectElement;
  private readonly about = h("p", { class: "about" });
  private readonly slots: SlotChoice;
  private readonly seed: NumberInput;
  private readonly run: HTMLButtonElement;
  private readonly cancel: HTMLButtonElement;
  private readonly form: Form;
  private readonly reset: HTMLButtonElement;
  private shown: Config | null = null;

  constructor(
    host: HTMLElement,
    catalog: Catalog,
    private readonly store: Store,
    private readonly actions: Actions,
  ) {
    this.slots = new SlotChoice(store);
    this.select = plannerSelect(catalog, (name) => this.choose(name));
    this.seed = new NumberInput({ min: 0, max: MAX_SEED, step: 1 }, (value) => {
      if (value !== null) actions.setSeed(this.slot, Math.round(value));
    });
    const roll = iconButton("dice", "Another seed", () => actions.setSeed(this.slot, randomSeed()));
    this.run = button("Plan", () => actions.plan(this.slot), { icon: "play", class: "primary" });
    this.cancel = button("Cancel", () => actions.cancel(), { icon: "stop" });
    this.form = new Form(catalog.config_schema, (value) =>
      actions.setConfig(this.slot, value as Config),
    );
    this.reset = button("Reset all", () => this.choose(this.select.value), {
      icon: "reset",
      class: "quiet",
    });
    const seedRow = row("Seed", this.seed.element);
    seedRow.querySelector(".control")?.append(roll);
    host.append(
      this.slots.element,
      h("div", { class: "section" }, row("Planner", this.select), this.about, seedRow),
      h("div", { class: "buttons" }, this.run, this.cancel),
      this.filters(),
      this.form.element,
      this.form.help.element,
    );
  }

  show(state: Readonly<State>): void {
    this.slots.show(state);
    const slot = shownSlot(state);
    const isBusy = isPlanning(slot.plan);
    this.cancel.disabled = !isBusy;
    this.seed.show(slot.seed);
    if (slot.config === this.shown) return;
    this.shown = slot.config;
    const preset = presetOf(state, slot.config.planner);
    this.select.value = slot.config.planner;
    setText(
      this.about,
      state.catalog?.planners.find(({ name }) => name === slot.config.planner)?.about ?? "",
    );
    this.form.show(slot.config, preset);
    this.reset.disabled = isSame(slot.config, preset);
  }

  private get slot(): Slot {
    return this.store.state.shown;
  }

  private choose(planner: string): void {
    this.actions.setConfig(this.slot, presetOf(this.store.state, planner));
  }

  private filters(): HTMLElement {
    const word = h("input", {
      type: "search",
      placeholder: "Find a parameter",
      "aria-label": "Find a parameter",
    });
    const only = h("input", { type: "checkbox" });
    const filter = (): void => this.form.filter(only.checked, word.value);
    word.addEventListener("input", filter);
    only.addEventListener("change", filter);
    return h(
      "div",
      { class: "filters" },
      h("div", { class: "section-head" }, h("h2", {}, "Parameters"), this.reset),
      word,
      h("label", { class: "check" }, only, "Changed only"),
    );
  }
}

/** Kinds of planners by the sections of their configuration; the first match counts. */
const KINDS: readonly (readonly [string, readonly string[]])[] = [
  ["Drive", ["hybrid_astar"]],
  ["Ant colonies", ["colony", "chords"]],
  ["Genetic algorithms", ["evolution"]],
  ["Shortest paths over cells", []],
];

/** A choice of planners, by kind. */
export function plannerSelect(catalog: Catalog, choose: (name: string) => void): HTMLSelectElement {
  const groups = KINDS.map(([label, sections]) =>
    h(
      "optgroup",
      { label },
      ...catalog.planners
        .filter(({ config }) => kindOf(config) === sections)
        .map(({ name }) => h("option", { value: name }, name)),
    ),
  );
  const select = h("select", {}, ...groups);
  select.addEventListener("change", () => choose(select.value));
  return select;
}

function kindOf(config: Config): readonly string[] | undefined {
  const fits = (sections: readonly string[]): boolean =>
    sections.length === 0 || sections.some((key) => key in config);
  return KINDS.find(([, sections]) => fits(sections))?.[1];
}

function randomSeed(): number {
  return crypto.getRandomValues(new Uint32Array(1))[0] ?? 0;
}
