/** The page: head with the status line, panels, maps with playback below, charts. */

import type { Actions } from "./actions";
import { showConvergence } from "./charts/convergence";
import { showStrips } from "./charts/strips";
import { acceptDrops, showKeys } from "./dialogs";
import { h } from "./dom";
import { DriveClock } from "./drive_clock";
import { icon } from "./icons";
import { listenToKeys } from "./keys";
import { MapView } from "./map/view";
import { showNotices } from "./notice";
import { comparePanel } from "./panels/compare";
import { drivePanel } from "./panels/drive";
import { exportPanel } from "./panels/export";
import { plannerPanel } from "./panels/planner";
import { scenePanel } from "./panels/scene";
import { Tabs, type Tab } from "./panels/tabs";
import { toolbar } from "./panels/toolbar";
import { vehiclePanel } from "./panels/vehicle";
import { iconButton } from "./panels/widgets";
import { Playback } from "./playback";
import type { Slot } from "./protocol";
import { showStatus } from "./status";
import type { Store } from "./store";
import { Stepper } from "./stepper";
import { chooseTheme, onThemeChange, themeChoice, type ThemeChoice } from "./theme";

const NEXT_THEME: Record<ThemeChoice, ThemeChoice> = { auto: "light", light: "dark", dark: "auto" };
const THEME_ICONS = { auto: "contrast", light: "sun", dark: "moon" } as const;
const PHONE = "(max-width: 760px)";

/** Builds the page into `root`. */
export function showShell(root: HTMLElement, store: Store, actions: Actions): void {
  const panel = (id: string): HTMLElement => h("section", { class: "panel", id: `panel-${id}` });
  const charts = h("section", { class: "dock", id: "panel-charts", role: "region" });
  const tabs: Tab[] = [
    { id: "scene", label: "Scene", icon: "map", panel: panel("scene") },
    { id: "planner", label: "Planner", icon: "sliders", panel: panel("planner") },
    { id: "vehicle", label: "Vehicle", icon: "car", panel: panel("vehicle") },
    { id: "compare", label: "Compare", icon: "columns", panel: panel("compare") },
    { id: "drive", label: "Drive", icon: "wheel", panel: panel("drive") },
    { id: "export", label: "Export", icon: "export", panel: panel("export") },
    { id: "charts", label: "Charts", icon: "chart", panel: charts },
  ];
  const [scene, planner, vehicle, compare, drive, take] = tabs.map(
    (tab) => tab.panel,
  ) as HTMLElement[];
  if (!scene || !planner || !vehicle || !compare || !drive || !take) return;
  const app = h("div", { class: "app" });
  const bar = new Tabs(app, tabs);
  const stage = new Stage(store, actions);
  const clock = new DriveClock(store);
  app.append(
    head(store, () => toggleCharts(app)),
    h("nav", { class: "rail", "aria-label": "Panels" }, bar.bar),
    h(
      "aside",
      { class: "panels", "aria-label": "Panels" },
      scene,
      planner,
      vehicle,
      compare,
      drive,
      take,
    ),
    stage.element,
    charts,
  );
  root.append(app);
  stage.begin();
  scenePanel(scene, store, actions);
  plannerPanel(planner, store, actions);
  vehiclePanel(vehicle, store, actions);
  comparePanel(compare, store, actions);
  drivePanel(drive, store, actions, clock);
  exportPanel(take, store, actions);
  chartsPanel(charts, store);
  showNotices(root, store);
  acceptDrops(root, store, actions);
  listenToKeys(
    actions,
    bar,
    () => stage.views,
    () => toggleCharts(app),
  );
  suitWindow(app, bar);
}

function head(store: Store, toggle: () => void): HTMLElement {
  const status = h("div", { class: "status" });
  const theme = iconButton("contrast", "", () => chooseTheme(NEXT_THEME[themeChoice()]));
  const charts = iconButton("chart", "Charts (C)", toggle);
  charts.classList.add("charts-button");
  const nameTheme = (): void => {
    const label = `Theme: ${themeChoice() === "auto" ? "as the system" : themeChoice()}`;
    theme.replaceChildren(icon(THEME_ICONS[themeChoice()]));
    theme.setAttribute("aria-label", label);
    theme.title = label;
  };
  onThemeChange(nameTheme);
  nameTheme();
  const name = h(
    "h1",
    { class: "name" },
    logo(),
    h("span", {}, "formicar"),
    h("small", {}, "studio"),
  );
  showStatus(status, store);
  store.watch(["catalog"], ({ catalog }) => {
    name.title = catalog === null ? "" : `formicar ${catalog.version}`;
  });
  return h(
    "header",
    { class: "head" },
    name,
    status,
    h("div", { class: "head-buttons" }, charts, theme, iconButton("help", "Keys (?)", showKeys)),
  );
}

function logo(): HTMLElement {
  return h("span", { class: "logo", "aria-hidden": "true" });
}

/** Maps with their tools, the stepper and playback. */
class Stage {
  readonly element: HTMLElement;
  readonly views: MapView[] = [];
  private readonly maps = h("div", { class: "maps" });
  private readonly tools = h("div", { class: "toolbar" });
  private readonly stepper = h("div", { class: "stepper-host" });
  private readonly playback = h("div", { class: "playback" });
  private second: HTMLElement | null = null;

  constructor(
    private readonly store: Store,
    private readonly actions: Actions,
  ) {
    this.element = h(
      "main",
      { class: "stage", "aria-label": "Map" },
      h("div", { class: "map-area" }, this.maps, this.tools),
      this.stepper,
      this.playback,
    );
  }

  /** Fills the stage once it stands in the page and has a size. */
  begin(): void {
    const { store, actions } = this;
    this.add("a");
    toolbar(this.tools, store, actions, () => this.views);
    new Playback(this.playback, store);
    new Stepper(this.stepper, store);
    store.watch(["slots"], ({ slots }) => {
      if (slots.b && this.second === null) this.second = this.add("b");
      const isPair = slots.b !== null;
      this.maps.toggleAttribute("data-pair", isPair);
      for (const host of this.maps.children as HTMLCollectionOf<HTMLElement>) {
        const slot = host.dataset.slot as Slot;
        host.hidden = slots[slot] === null;
      }
    });
  }

  private add(slot: Slot): HTMLElement {
    const host = h("div", { class: "map-host", "data-slot": slot });
    host.addEventListener("pointerdown", () => this.choose(slot), { capture: true });
    host.addEventListener("focusin", () => this.choose(slot));
    this.maps.append(host);
    this.views.push(new MapView(host, this.store, this.actions, slot));
    return host;
  }

  private choose(slot: Slot): void {
    const { shown, slots } = this.store.state;
    if (shown !== slot && slots[slot] !== null) this.store.set({ shown: slot });
  }
}

function chartsPanel(host: HTMLElement, store: Store): void {
  const strips = h("div", { class: "chart-strips" });
  const convergence = h("div", { class: "chart-convergence", hidden: true });
  host.append(strips, convergence);
  showStrips(strips, store);
  showConvergence(convergence, store);
}

function toggleCharts(app: HTMLElement): void {
  app.toggleAttribute("data-without-charts");
}

/** On a wide page charts are no panel of their own. */
function suitWindow(app: HTMLElement, tabs: Tabs): void {
  const phone = matchMedia(PHONE);
  const suit = (): void => {
    if (!phone.matches && tabs.openId === "charts") tabs.open("scene");
    app.toggleAttribute("data-phone", phone.matches);
  };
  phone.addEventListener("change", suit);
  suit();
}
