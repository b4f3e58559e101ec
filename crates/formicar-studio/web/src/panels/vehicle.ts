/** The vehicle: presets, its measures as numbers, and a drawing whose handles can be dragged. */

import type { Actions } from "../actions";
import { h, setText } from "../dom";
import { degrees, meters } from "../format";
import type { Catalog, JsonSchema, VehicleMessage, VehicleParameters } from "../protocol";
import type { Store } from "../store";
import { Fields } from "./forms/fields";
import { HelpLine } from "./forms/form";
import type { Context } from "./forms/row";
import { row, section } from "./widgets";
import { VehicleDrawing } from "./vehicle_drawing";

const OWN = "own";
const BODY = [
  "wheelbase_m",
  "front_overhang_m",
  "rear_overhang_m",
  "width_m",
  "track_width_m",
  "safety_margin_m",
];
/** Exactly one of them sets the limit; the others are left out. */
const STEERING = ["max_steer_deg", "max_steer_rad", "min_turning_radius_m"];
const MOTION = ["speed_mps", "max_steer_rate_rad_per_s"];
const RARE = ["footprint"];

export function vehiclePanel(host: HTMLElement, store: Store, actions: Actions): void {
  let panel: Panel | null = null;
  // An error leaves the old vehicle: the fields go back to it.
  store.watch(["catalog", "vehicle", "error"], ({ catalog, vehicle }) => {
    if (catalog === null || vehicle === null) return;
    panel ??= new Panel(host, catalog, store, actions);
    panel.show(vehicle);
  });
}

class Panel {
  private readonly select: HTMLSelectElement;
  private readonly drawing: VehicleDrawing;
  private readonly figures = h("dl", { class: "facts" });
  private readonly help = new HelpLine();
  private readonly groups: { fields: Fields; element: HTMLElement }[];
  /** The preset that was shown last; changes are marked against it. */
  private base: VehicleParameters | null = null;
  private readonly note = h(
    "p",
    { class: "about" },
    "A holonomic point: only the path itself must be free.",
  );

  constructor(
    host: HTMLElement,
    private readonly catalog: Catalog,
    private readonly store: Store,
    private readonly actions: Actions,
  ) {
    this.select = vehicleSelect(catalog, (preset) => actions.setVehicle({ preset }));
    this.drawing = new VehicleDrawing((values) => this.set(values));
    this.groups = [
      this.group("Body", BODY),
      this.group("Steering limit", STEERING),
      this.group("Motion", MOTION),
      this.group("Custom footprint", RARE),
    ];
    host.append(
      h("div", { class: "section" }, row("Vehicle", this.select), this.note),
      this.drawing.element,
      this.figures,
      ...this.groups.map(({ element }) => element),
      this.help.element,
    );
  }

  show(vehicle: VehicleMessage): void {
    const isPoint = vehicle.motion === "point";
    const preset = this.presetOf(vehicle);
    this.base = preset ?? this.base;
    this.select.value = preset === null ? OWN : vehicle.name;
    this.note.hidden = !isPoint;
    this.drawing.element.toggleAttribute("hidden", isPoint);
    if (!isPoint) this.drawing.show(vehicle);
    for (const { fields, element } of this.groups) {
      element.hidden = isPoint;
      fields.show(
        withoutLeftOut(vehicle.parameters),
        withoutLeftOut(this.base ?? vehicle.parameters),
      );
      fields.hint(derivedOf(vehicle));
    }
    this.figures.replaceChildren(...factsOf(vehicle));
  }

  private presetOf(vehicle: VehicleMessage): VehicleParameters | null {
    return this.catalog.vehicles.find(({ name }) => name === vehicle.name)?.parameters ?? null;
  }

  private group(title: string, keys: string[]): { fields: Fields; element: HTMLElement } {
    const root = this.catalog.vehicle_schema;
    const context: Context = { root, point: (help) => this.help.show(help) };
    const entries = keys.flatMap((key): [string, JsonSchema][] => {
      const schema = root.properties?.[key];
      return schema ? [[key, schema]] : [];
    });
    const fields = new Fields(entries, "", context, null, (values) => this.set(values));
    return { fields, element: section(title, null, ...fields.elements) };
  }

  /** Takes over measures; of the steering limits only the one that changed. */
  private set(values: VehicleParameters): void {
    const old = this.store.state.vehicle?.parameters ?? {};
    const changed = Object.keys(values).filter((key) => values[key] !== (old[key] ?? null));
    const limit = changed.find((key) => STEERING.includes(key) && values[key] !== null);
    const parameters = withoutLeftOut({ ...old, ...values });
    if (limit !== undefined) {
      for (const key of STEERING) if (key !== limit) delete parameters[key];
    }
    if (changed.length > 0) this.actions.setVehicle({ parameters });
  }
}

function vehicleSelect(catalog: Catalog, choose: (preset: string) => void): HTMLSelectElement {
  const select = h(
    "select",
    {},
    ...catalog.vehicles.map(({ name }) => h("option", { value: name }, name)),
    h("option", { value: OWN, disabled: true, hidden: true }, "your own"),
  );
  select.addEventListener("change", () => choose(select.value));
  return select;
}

function withoutLeftOut(parameters: VehicleParameters): VehicleParameters {
  return Object.fromEntries(Object.entries(parameters).filter(([, value]) => value !== null));
}

/** The value of a measure that is left out. */
function derivedOf(vehicle: VehicleMessage): Record<string, number | null> {
  const { max_steer_rad: steer } = vehicle;
  return {
    track_width_m: vehicle.track_width_m,
    safety_margin_m: 0,
    max_steer_rad: steer,
    max_steer_deg: steer === null ? null : (steer * 180) / Math.PI,
    min_turning_radius_m: vehicle.min_turning_radius_m,
  };
}

function factsOf(vehicle: VehicleMessage): HTMLElement[] {
  const along = vehicle.footprint.map(([x]) => x);
  const across = vehicle.footprint.map(([, y]) => y);
  const extent = (values: number[]): number => Math.max(...values) - Math.min(...values);
  const facts: [string, string][] = [];
  if (vehicle.footprint.length > 0) {
    facts.push([
      "Length \u00d7 width",
      `${meters(extent(along))} \u00d7 ${meters(extent(across))}`,
    ]);
  }
  if (vehicle.min_turning_radius_m !== null)
    facts.push(["Turning radius", meters(vehicle.min_turning_radius_m)]);
  if (vehicle.max_steer_rad !== null)
    facts.push(["Greatest steering angle", degrees(vehicle.max_steer_rad)]);
  return facts.map(([term, value]) => {
    const text = h("dd", {});
    setText(text, value);
    return h("div", {}, h("dt", {}, term), text);
  });
}
