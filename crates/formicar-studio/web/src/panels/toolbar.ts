/** Tools over the map: what a pointer does, the brush, undo, what is drawn. */

import type { Actions } from "../actions";
import { h } from "../dom";
import { icon, type IconName } from "../icons";
import { fixed } from "../format";
import type { State, Store, Tool } from "../store";
import { iconButton } from "./widgets";

const TOOLS: readonly (readonly [Tool, IconName, string])[] = [
  ["move", "move", "Move: pan, drag start and goal (M)"],
  ["paint", "brush", "Paint obstacles (P)"],
  ["erase", "erase", "Erase obstacles (E)"],
];

const LAYERS: readonly (readonly [keyof State["layers"], string])[] = [
  ["ants", "Ants and search"],
  ["pheromone", "Pheromone"],
  ["swept", "Swept footprints"],
  ["clearance", "Tightest point"],
];

/** The brush, in cells across, between these. */
const BRUSH_CELLS = [1, 60] as const;

export interface Fit {
  fit(): void;
}

export function toolbar(
  host: HTMLElement,
  store: Store,
  actions: Actions,
  views: () => readonly Fit[],
): void {
  const tools = new Map(
    TOOLS.map(([tool, name, label]) => [tool, iconButton(name, label, () => store.set({ tool }))]),
  );
  const brush = brushSlider(store);
  const undo = iconButton("undo", "Undo (Ctrl Z)", () => actions.undo());
  const redo = iconButton("redo", "Redo (Ctrl Shift Z)", () => actions.redo());
  const fit = iconButton("fit", "Show the whole map (F)", () => {
    for (const view of views()) view.fit();
  });
  host.append(
    h("div", { class: "tools", role: "group", "aria-label": "Tools" }, ...tools.values(), brush),
    h("div", { class: "tools", role: "group", "aria-label": "History" }, undo, redo),
    h("div", { class: "tools", role: "group", "aria-label": "View" }, fit, layerMenu(store)),
  );
  store.watch(["tool"], (state) => {
    for (const [tool, element] of tools)
      element.setAttribute("aria-pressed", String(tool === state.tool));
    brush.hidden = state.tool === "move";
  });
  store.watch(["past"], ({ past }) => {
    undo.disabled = !past.canUndo;
    redo.disabled = !past.canRedo;
  });
}

function brushSlider(store: Store): HTMLElement {
  const text = h("output", {});
  const input = h("input", {
    type: "range",
    min: 0,
    max: 100,
    step: 1,
    "aria-label": "Brush width",
  });
  const [least, most] = BRUSH_CELLS.map(Math.log) as [number, number];
  const cell = (): number => store.state.map?.resolution_m ?? 1;
  input.addEventListener("input", () => {
    store.set({ brushM: cell() * Math.exp(least + (Number(input.value) / 100) * (most - least)) });
  });
  store.watch(["brushM", "map"], ({ brushM }) => {
    const share = (Math.log(brushM / cell()) - least) / (most - least);
    input.value = String(Math.round(100 * share));
    text.textContent = `${fixed(brushM, brushM < 1 ? 2 : 1)} m`;
    input.setAttribute("aria-valuetext", text.textContent);
  });
  return h("label", { class: "brush" }, input, text);
}

function layerMenu(store: Store): HTMLElement {
  const boxes = LAYERS.map(([key, label]) => {
    const box = h("input", { type: "checkbox" });
    box.addEventListener("change", () =>
      store.set({ layers: { ...store.state.layers, [key]: box.checked } }),
    );
    return { key, box, element: h("label", { class: "check" }, box, label) };
  });
  store.watch(["layers"], ({ layers }) => {
    for (const { key, box } of boxes) box.checked = layers[key];
  });
  const menu = h(
    "details",
    { class: "menu" },
    h(
      "summary",
      { class: "icon-button", "aria-label": "Layers", title: "Layers" },
      icon("layers"),
    ),
    h("div", { class: "menu-list" }, ...boxes.map(({ element }) => element)),
  );
  addEventListener("pointerdown", (event) => {
    if (!menu.contains(event.target as Node)) menu.open = false;
  });
  menu.addEventListener("keydown", (event) => {
    if (event.key !== "Escape" || !menu.open) return;
    event.preventDefault();
    menu.open = false;
  });
  return menu;
}
