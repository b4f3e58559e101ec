/** Opening maps and scenes: the parts of a scene are set when its map arrives. */

import { opens, vehicleChoice } from "./choices";
import type { Connection } from "./connection";
import { firstRequest } from "./first_request";
import { decode, defaultConfig, type Scene } from "./link";
import type { Config, MapChoice, MapMessage } from "./protocol";
import type { MapState, SlotState, Store } from "./store";
import type { Strokes } from "./strokes";
import { filesOf, uploadMap } from "./uploading";

/** A scene whole, or a map with its own vehicle and one of its requests. */
export type Wanted = { map: MapChoice; requestId?: string } & Partial<Scene>;

/** The first scene: a path at once, then ants and hybrid A* that go on searching. */
const FIRST: Wanted = { map: { builtin: "neighborhood" }, requestId: "into-alley" };
const FIRST_PLANNER = "formicar";
/** Planners for cars, and the one for points, which moves over cells. */
const DRIVING_PLANNERS = ["formicar", "hybrid-astar"];
const WALKING_PLANNER = "ant-system";
/** The brush begins at this share of the map's width, and not below a cell. */
const BRUSH_SHARE = 0.012;

export class Opening {
  private wanted: Wanted | null = null;
  /** Why what was wanted first could not be opened. */
  private why: string | null = null;
  private current: MapChoice = FIRST.map;
  /** Whether the current map is opened again, and whether the page sent it to the server. */
  private reopening: "asked" | "restored" | null = null;
  /** The planner that cannot plan for a point, kept for the next car. */
  private drivingConfig: Config | null = null;

  constructor(
    private readonly store: Store,
    private readonly connection: Connection,
    private readonly strokes: Strokes,
  ) {}

  /** Whether a map is expected. */
  get isAwaited(): boolean {
    return this.wanted !== null || this.reopening !== null;
  }

  /** The choice that opens the current map. */
  get choice(): MapChoice {
    return this.current;
  }

  /** Whether a map is the one that was asked for last, and not one that was overtaken. */
  isOf(message: MapMessage): boolean {
    return opens(this.wanted?.map ?? this.current, message);
  }

  open(wanted: Wanted): void {
    this.wanted = wanted;
    this.reopening = null;
    this.connection.send({ type: "open_map", map: wanted.map });
  }

  openFirst(): void {
    this.open(FIRST);
  }

  /** Opens the scene of a link; false if the link holds none. */
  async openLink(hash: string): Promise<boolean> {
    const { catalog } = this.store.state;
    const scene = catalog === null ? null : await decode(hash, catalog);
    if (scene !== null) this.open(scene);
    return scene !== null;
  }

  /** The line stands again. The server has forgotten all that the page has not. */
  reopen(): void {
    if (this.wanted !== null) this.open(this.wanted);
    else if (this.store.state.map !== null) this.askAgain("asked");
  }

  /** Takes a map from the server; false if it is open already, as after a reconnection. */
  came(message: MapMessage, payload: Uint8Array): boolean {
    const { wanted } = this;
    const { map: here, vehicle } = this.store.state;
    if (wanted === null && here !== null) {
      this.reopening = null;
      if (here.isEdited) this.strokes.sendAll(here);
      if (vehicle !== null) {
        this.connection.send({ type: "set_vehicle", vehicle: vehicleChoice(vehicle) });
      }
      return false;
    }
    this.reopening = null;
    this.wanted = null;
    this.current = wanted?.map ?? FIRST.map;
    const values = new Int8Array(payload.slice().buffer);
    const map: MapState = { ...message, values, isEdited: false, version: 0 };
    const brushM = Math.max(map.resolution_m, BRUSH_SHARE * map.resolution_m * map.n_cols);
    this.store.set({ map, brushM, error: this.why, driveS: null });
    this.why = null;
    this.store.set({ hoverM: null, step: null, frame: null, isPlaying: false });
    this.place(map, wanted ?? FIRST);
    return true;
  }

  /** A map could not be opened. One that the server has forgotten it gets from the page; without
   * any the first one is opened, and why is said. */
  async failed(why: string): Promise<void> {
    const { map } = this.store.state;
    const mayRestore = this.reopening === "asked";
    this.reopening = null;
    if (mayRestore && map !== null) {
      await this.restore(map);
      return;
    }
    const wasFirst = JSON.stringify(this.wanted?.map) === JSON.stringify(FIRST.map);
    this.wanted = null;
    if (map !== null || wasFirst) throw new Error(why);
    this.why = why;
    this.openFirst();
  }

  private async restore(map: MapState): Promise<void> {
    this.reopening = "restored";
    try {
      const hash = await uploadMap(filesOf(map));
      // Meanwhile another one may have been opened.
      if (this.wanted !== null || this.store.state.map !== map) return;
      this.current = { hash };
      this.askAgain("restored");
    } catch (error) {
      this.reopening = null;
      throw error;
    }
  }

  private askAgain(how: "asked" | "restored"): void {
    this.reopening = how;
    this.connection.send({ type: "open_map", map: this.current });
  }

  /** Puts vehicle, request and planners of a scene in place. */
  private place(map: MapState, wanted: Wanted): void {
    const { slots, shown, vehicle } = this.store.state;
    // A built-in map comes with its vehicle; on others the one at hand is planned for.
    const atHand = map.vehicle === null && vehicle !== null ? vehicleChoice(vehicle) : null;
    const choice = wanted.vehicle ?? atHand;
    if (choice !== null) this.connection.send({ type: "set_vehicle", vehicle: choice });
    const preset = choice !== null && "preset" in choice ? choice.preset : map.vehicle;
    const first = map.requests.find(({ id }) => id === wanted.requestId) ?? map.requests[0];
    const own = first ? { start: first.start, goal: first.goal } : firstRequest(map, vehicle);
    const [a, b] = wanted.slots ?? [
      { ...slots.a, config: this.configFor(slots.a.config, preset === "point") },
      slots.b,
    ];
    this.store.set({
      request: wanted.request ?? own,
      slots: { a: fresh(a ?? slots.a), b: b ? fresh(b) : null },
      shown: wanted.shown ?? (b ? shown : "a"),
    });
  }

  /** A configuration, or one that can plan for a point where that is asked. */
  private configFor(config: Config, isPoint: boolean): Config {
    const { catalog } = this.store.state;
    if (catalog === null) return config;
    const isKnown = catalog.planners.some(({ name }) => name === config.planner);
    const current = isKnown ? config : defaultConfig(catalog, FIRST_PLANNER);
    if (isPoint && DRIVING_PLANNERS.includes(current.planner)) {
      this.drivingConfig = current;
      return defaultConfig(catalog, WALKING_PLANNER);
    }
    const { drivingConfig } = this;
    if (isPoint || drivingConfig === null) return current;
    this.drivingConfig = null;
    return current.planner === WALKING_PLANNER ? drivingConfig : current;
  }
}

/** A side that has planned nothing yet. */
function fresh({ config, seed }: { config: Config; seed: number }): SlotState {
  return { config, seed, plan: null, driven: null };
}
