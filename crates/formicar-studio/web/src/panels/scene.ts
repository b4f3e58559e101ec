/** The map, built in or one's own, and which request is planned on it. */

import type { Actions } from "../actions";
import { chooseFiles } from "../dialogs";
import { h, setText } from "../dom";
import { count, fixed } from "../format";
import type { Catalog, MapChoice } from "../protocol";
import type { MapState, State, Store } from "../store";
import { requestForm } from "./request";
import { button, section } from "./widgets";

const KINDS: Record<string, string> = {
  scene: "Scenes",
  narrow: "Narrow passages",
  grid_problem: "Grid problems",
};

export function scenePanel(host: HTMLElement, store: Store, actions: Actions): void {
  const maps = new MapChooser(actions);
  const facts = h("p", { class: "about" });
  const figures = h("p", { class: "figures" });
  const restore = button("Restore", () => reopen(store, actions), {
    icon: "reset",
    class: "quiet",
  });
  const open = button("Open a file", () => chooseFiles(store, actions), { icon: "open" });
  const requests = h("div", {
    class: "chips",
    role: "group",
    "aria-label": "Requests of this map",
  });
  host.append(
    section("Map", restore, maps.select, facts, figures, h("div", { class: "buttons" }, open)),
    section("Request", null, requests, requestForm(store, actions)),
  );
  store.watch(["catalog", "map"], (state) => {
    maps.show(state);
    restore.hidden = state.map?.isEdited !== true;
    const builtin = state.catalog?.maps.find(({ name }) => name === state.map?.name);
    setText(
      facts,
      state.map?.hash === null ? (builtin?.about ?? "") : "Your own map. It stays on this machine.",
    );
    setText(figures, state.map ? measures(state.map) : "");
  });
  store.watch(["map", "request"], (state) => showRequests(requests, state, actions));
}

/** All built-in maps by their kind, and those that were uploaded since the page was opened. */
class MapChooser {
  readonly select = h("select", { "aria-label": "Map" });
  private readonly own = new Map<string, string>();
  private builtFor = "";

  constructor(actions: Actions) {
    this.select.addEventListener("change", () =>
      actions.openMap(JSON.parse(this.select.value) as MapChoice),
    );
  }

  show({ catalog, map }: Readonly<State>): void {
    if (catalog === null) return;
    if (map?.hash && !map.isEdited) this.own.set(map.hash, map.name);
    const key = [...this.own.keys()].join();
    if (this.select.childElementCount === 0 || key !== this.builtFor) this.build(catalog);
    this.builtFor = key;
    if (map) this.select.value = JSON.stringify(choiceOf(map));
  }

  private build(catalog: Catalog): void {
    const kinds = [...new Set([...Object.keys(KINDS), ...catalog.maps.map(({ kind }) => kind)])];
    const groups = kinds.map((kind) =>
      group(
        KINDS[kind] ?? kind,
        catalog.maps
          .filter((map) => map.kind === kind)
          .map(({ name }) => [{ builtin: name }, name]),
      ),
    );
    const own = [...this.own].map(([hash, name]): [MapChoice, string] => [{ hash }, name]);
    this.select.replaceChildren(...groups, ...(own.length > 0 ? [group("Your own", own)] : []));
  }
}

function group(label: string, choices: [MapChoice, string][]): HTMLElement {
  const options = choices.map(([choice, name]) =>
    h("option", { value: JSON.stringify(choice) }, name),
  );
  return h("optgroup", { label }, ...options);
}

function choiceOf({ hash, name }: MapState): MapChoice {
  return hash === null ? { builtin: name } : { hash };
}

function reopen(store: Store, actions: Actions): void {
  const { map } = store.state;
  if (map) actions.openMap(choiceOf(map));
}

function measures({ n_cols, n_rows, resolution_m, isEdited }: MapState): string {
  const side = (n: number): string => fixed(n * resolution_m, n * resolution_m < 100 ? 1 : 0);
  const size = `${side(n_cols)} \u00d7 ${side(n_rows)} m`;
  const cells = `${count(n_cols)} \u00d7 ${count(n_rows)} cells of ${resolution_m} m`;
  return `${size}, ${cells}${isEdited ? ", edited" : ""}`;
}

function showRequests(
  host: HTMLElement,
  { map, request }: Readonly<State>,
  actions: Actions,
): void {
  const all = map?.requests ?? [];
  const isPressed = (pose: number[], other: number[]): boolean =>
    pose.every((value, i) => value === other[i]);
  const shown = [...host.children].map((child) => child.textContent);
  if (shown.join() !== all.map(({ id }) => id).join()) {
    host.replaceChildren(
      ...all.map(({ id }) =>
        h(
          "button",
          { type: "button", class: "chip", onclick: () => actions.chooseRequest(id) },
          id,
        ),
      ),
    );
  }
  all.forEach(({ start, goal }, i) => {
    const isOn = isPressed(start, request.start) && isPressed(goal, request.goal);
    host.children[i]?.setAttribute("aria-pressed", String(isOn));
  });
}
