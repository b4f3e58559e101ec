/** What the user can do, and what follows from what the server says. */

import { rounded } from "./cells";
import type { Connection } from "./connection";
import { Driving } from "./driving";
import { firstRequest } from "./first_request";
import { decode, defaultConfig, encode, type Scene } from "./link";
import { Planning, type Wish } from "./planning";
import type {
  AnswerMessage,
  Catalog,
  Config,
  DriveLaw,
  MapChoice,
  MapMessage,
  Pose,
  Request,
  ServerMessage,
  Slot,
  UploadAnswer,
  VehicleChoice,
  VehicleMessage,
} from "./protocol";
import { saveFile } from "./save";
import { expose, stats } from "./stats";
import type { MapState, Store } from "./store";
import { Strokes } from "./strokes";
import { Past } from "./undo";
import { pageUrl, withToken } from "./urls";

const FIRST_MAP: MapChoice = { builtin: "neighborhood" };
const FIRST_PLANNER = "formicar";
/** Planners that drive, and what walks over cells where a point is to be planned for. */
const DRIVING_PLANNERS = ["formicar", "hybrid-astar"];
const WALKING_PLANNER = "ant-system";

/** The brush begins at this share of the map's width, and not below a cell. */
const BRUSH_SHARE = 0.012;

/** What is to be opened: a scene whole, or a map with its own vehicle and request. */
type Opening = { map: MapChoice } & Partial<Scene>;
type ErrorMessage = Extract<ServerMessage, { type: "error" }>;

export class Actions {
  private readonly past: Past;
  private readonly planning: Planning;
  private readonly driving: Driving;
  private readonly strokes: Strokes;
  /** What is being opened; what belongs to it is put in place when the map comes. */
  private opening: Opening | null = null;
  private choice: MapChoice = FIRST_MAP;
  private requestBefore: Request | null = null;
  /** What a point cannot be planned with, kept for the next car. */
  private drivingConfig: Config | null = null;
  private isVehicleAwaited = false;
  private kept: { version: number; hash: string } | null = null;
  private keepers: { done: (hash: string) => void; failed: (why: Error) => void }[] = [];

  constructor(
    private readonly store: Store,
    private readonly connection: Connection,
  ) {
    this.past = new Past((past) => store.set({ past }));
    this.planning = new Planning(store, connection, (message) => this.answered(message));
    this.driving = new Driving(store, connection);
    this.strokes = new Strokes(store, connection);
    expose(store);
  }

  // --- From the server -----------------------------------------------------------------------

  /** Takes in a message. */
  receive(message: ServerMessage, payload: Uint8Array): void {
    stats.nMessages += 1;
    switch (message.type) {
      case "hello":
      // Whoever overtook it is under way already.
      case "dropped":
        break;
      case "map":
        this.mapCame(message, payload);
        break;
      case "vehicle":
        this.vehicleCame(message);
        break;
      case "iteration":
        this.planning.frame({ ...message, pheromone: payload });
        break;
      case "generation":
      case "drive":
      case "expanded":
        this.planning.frame(message);
        break;
      case "improved":
        this.planning.improved(message);
        break;
      case "answer":
        this.planning.answer(message);
        break;
      case "driven":
        this.driving.driven(message);
        break;
      case "picture":
        saveFile(this.fileStem(message.slot), message.format, payload);
        break;
      case "kept":
        this.keptCame(message.hash);
        break;
      case "error":
        this.errorCame(message);
        break;
    }
  }

  /** The line to the server stands or broke; when it stands again, all is opened there anew. */
  connected(isOpen: boolean): void {
    this.store.set({ isConnected: isOpen });
    for (const slot of ["a", "b"] as const) this.planning.forget(slot);
    if (!isOpen) {
      this.refuseKeepers("the line to the server broke");
      return;
    }
    this.isVehicleAwaited = false;
    if (this.opening !== null) this.open(this.opening);
    else if (this.store.state.map !== null) this.reopen(this.store.state.map);
  }

  /** Fetches the catalog and opens the scene of the link, or the first one. */
  async start(): Promise<void> {
    addEventListener("hashchange", () => void this.openLink(location.hash));
    try {
      const response = await fetch(withToken("api/catalog"));
      if (!response.ok) throw new Error(`${response.status} ${response.statusText}`);
      this.store.set({ catalog: (await response.json()) as Catalog });
    } catch (error) {
      this.store.set({ error: `catalog: ${reason(error)}; hint: reload the page` });
      return;
    }
    if (!(await this.openLink(location.hash))) this.open({ map: FIRST_MAP });
  }

  // --- Map and vehicle -----------------------------------------------------------------------

  /** Opens a map with its vehicle and first request. */
  openMap(choice: MapChoice): void {
    this.open({ map: choice });
  }

  chooseRequest(id: string): void {
    const request = this.store.state.map?.requests.find((one) => one.id === id);
    if (request === undefined) return;
    const { start, goal } = request;
    const { goals: _, via: __, ...modes } = this.store.state.request;
    this.changeRequest({ ...modes, start, goal }, "replay");
  }

  /** Uploads files that make up a map, and opens it. */
  async upload(files: File[], resolutionM?: number): Promise<void> {
    const form = new FormData();
    for (const file of files) form.append("files", file, file.name);
    if (resolutionM !== undefined) form.append("resolution_m", String(resolutionM));
    try {
      const response = await fetch(withToken("api/maps"), { method: "POST", body: form });
      const answer = (await response.json()) as UploadAnswer;
      if ("error" in answer) throw new Error(answer.error);
      this.openMap({ hash: answer.hash });
    } catch (error) {
      this.store.set({ error: reason(error) });
    }
  }

  setVehicle(choice: VehicleChoice): void {
    this.stopDriving();
    this.isVehicleAwaited = this.connection.send({ type: "set_vehicle", vehicle: choice });
  }

  // --- Request -------------------------------------------------------------------------------

  /** Changes parts of the request, and plans. */
  setRequest(part: Partial<Request>): void {
    const request = { ...this.store.state.request, ...part };
    this.changeRequest(request, "settle");
  }

  /** Moves start or goal; while dragging the path follows. */
  moveEnd(which: "start" | "goal", pose: Pose, isDragging: boolean): void {
    const atMs = performance.now();
    const { request } = this.store.state;
    if (which === "start") this.stopDriving();
    this.requestBefore ??= request;
    const moved = { ...request, [which]: rounded(pose) };
    if (which === "goal") delete moved.goals;
    this.store.set({ request: moved });
    this.planAll(isDragging ? "follow" : "settle", atMs);
    if (isDragging) return;
    this.past.push({ kind: "request", before: this.requestBefore, after: moved });
    this.requestBefore = null;
  }

  // --- Painting and undoing ------------------------------------------------------------------

  /** Goes on with a stroke: puts a value into cells; the path goes along. */
  paint(cells: Iterable<number>, value: number): void {
    const atMs = performance.now();
    if (this.strokes.paint(cells, value)) this.planAll("follow", atMs);
  }

  /** Ends a stroke. */
  endStroke(): void {
    const atMs = performance.now();
    const deed = this.strokes.end();
    if (deed === null) return;
    this.past.push(deed);
    this.planAll("settle", atMs);
  }

  /** Takes back the stroke under way, as if it had never been. */
  dropStroke(): void {
    const deed = this.strokes.end();
    if (deed === null) return;
    this.strokes.put(deed.cells, deed.before);
    this.planAll("settle", performance.now());
  }

  undo(): void {
    const deed = this.past.undo();
    if (deed?.kind === "stroke") this.strokes.put(deed.cells, deed.before);
    if (deed?.kind === "request") this.store.set({ request: deed.before });
    if (deed !== null) this.planAll("settle", performance.now());
  }

  redo(): void {
    const deed = this.past.redo();
    if (deed?.kind === "stroke") this.strokes.put(deed.cells, deed.after);
    if (deed?.kind === "request") this.store.set({ request: deed.after });
    if (deed !== null) this.planAll("settle", performance.now());
  }

  // --- Planning ------------------------------------------------------------------------------

  setConfig(slot: Slot, config: Config): void {
    const side = this.store.state.slots[slot];
    if (side === null) return;
    const isOther = side.config.planner !== config.planner;
    side.config = config;
    this.store.touch("slots");
    this.planSlot(slot, isOther ? "replay" : "settle", performance.now());
  }

  setSeed(slot: Slot, seed: number): void {
    const side = this.store.state.slots[slot];
    if (side === null) return;
    side.seed = seed;
    this.store.touch("slots");
    this.planSlot(slot, "settle", performance.now());
  }

  /** Plans and shows the run from its beginning; both slots where none is named. */
  plan(slot?: Slot): void {
    if (slot === undefined) this.planAll("replay", performance.now());
    else this.planSlot(slot, "replay", performance.now());
  }

  cancel(): void {
    for (const slot of ["a", "b"] as const) this.planning.cancel(slot);
  }

  /** Puts another planner beside the first, or takes it away. */
  compare(config: Config | null): void {
    const { slots } = this.store.state;
    this.planning.cancel("b");
    this.planning.forget("b");
    if (config === null) {
      this.store.set({ slots: { ...slots, b: null }, shown: "a", frame: null, isPlaying: false });
      return;
    }
    const seed = slots.b?.seed ?? slots.a.seed;
    this.store.set({ slots: { ...slots, b: { config, seed, plan: null, driven: null } } });
    this.planSlot("b", "replay", performance.now());
    // Both are seen from their beginning.
    if (!isCalm()) this.store.set({ frame: 0, frameShare: 0, isPlaying: true, step: null });
  }

  // --- Driving -------------------------------------------------------------------------------

  drive(slot: Slot, law: DriveLaw): void {
    this.driving.start(slot, law);
  }

  stopDriving(): void {
    for (const slot of ["a", "b"] as const) this.driving.stop(slot);
  }

  // --- Taking away ---------------------------------------------------------------------------

  picture(slot: Slot, format: "svg" | "png"): void {
    this.connection.send({ type: "picture", slot, format });
  }

  /** An address that restores all that is shown; it also becomes the page's own. */
  async link(): Promise<string> {
    const { catalog, map, vehicle, request, slots, shown } = this.store.state;
    if (catalog === null || map === null || vehicle === null) throw new Error("there is no map yet");
    const sides = slots.b === null ? [slots.a] : [slots.a, slots.b];
    const scene: Scene = {
      map: map.isEdited ? { hash: await this.keepMap(map) } : this.choice,
      vehicle: vehicleChoice(vehicle),
      request,
      slots: sides.map(({ config, seed }) => ({ config, seed })),
      shown,
    };
    const url = pageUrl(await encode(scene, catalog));
    history.replaceState(null, "", url);
    return url;
  }

  // --- Opening -------------------------------------------------------------------------------

  private async openLink(hash: string): Promise<boolean> {
    const { catalog } = this.store.state;
    const scene = catalog === null ? null : await decode(hash, catalog);
    if (scene === null) return false;
    this.open(scene);
    return true;
  }

  private open(opening: Opening): void {
    this.opening = opening;
    this.stopDriving();
    for (const slot of ["a", "b"] as const) this.planning.cancel(slot);
    this.connection.send({ type: "open_map", map: opening.map });
  }

  /** The server has forgotten everything; the page has not. */
  private reopen(map: MapState): void {
    const { vehicle, request, slots, shown } = this.store.state;
    this.connection.send({ type: "open_map", map: this.choice });
    if (map.isEdited) this.strokes.sendAll(map);
    if (vehicle !== null) {
      this.connection.send({ type: "set_vehicle", vehicle: vehicleChoice(vehicle) });
    }
    this.store.set({ request, slots, shown });
    this.planAll("settle", performance.now());
  }

  private mapCame(message: MapMessage, payload: Uint8Array): void {
    const { opening } = this;
    // After a broken line the map is here already, perhaps painted on.
    if (opening === null && this.store.state.map !== null) return;
    this.opening = null;
    this.choice = opening?.map ?? FIRST_MAP;
    this.kept = null;
    this.past.clear();
    this.requestBefore = null;
    const values = new Int8Array(payload.slice().buffer);
    const map: MapState = { ...message, values, isEdited: false, version: 0 };
    const brushM = Math.max(map.resolution_m, BRUSH_SHARE * map.resolution_m * map.n_cols);
    this.store.set({ map, brushM, error: null });
    this.store.set({ hoverM: null, step: null, frame: null, isPlaying: false });
    this.placeScene(map, opening ?? { map: this.choice });
  }

  /** Puts vehicle, request and planners of a scene in place, and plans. */
  private placeScene(map: MapState, opening: Opening): void {
    const { slots, vehicle } = this.store.state;
    // A built-in map comes with its vehicle; on others the one at hand is planned for.
    const own = map.vehicle === null && vehicle !== null ? vehicleChoice(vehicle) : null;
    const choice = opening.vehicle ?? own;
    if (choice !== null) this.connection.send({ type: "set_vehicle", vehicle: choice });
    const preset = choice !== null && "preset" in choice ? choice.preset : map.vehicle;
    const isPoint = preset === "point";
    const first = map.requests[0];
    const request =
      opening.request ??
      (first ? { start: first.start, goal: first.goal } : firstRequest(map, vehicle));
    const fresh = (side: { config: Config; seed: number }) => ({ ...side, plan: null, driven: null });
    const [a, b] = opening.slots ?? [slots.a, slots.b];
    const config = opening.slots ? a?.config : this.configFor(isPoint);
    const sideA = fresh({ config: config ?? slots.a.config, seed: a?.seed ?? 0 });
    const shown = opening.shown ?? (b ? this.store.state.shown : "a");
    const sides = { a: sideA, b: b ? fresh({ config: b.config, seed: b.seed }) : null };
    this.store.set({ request, slots: sides, shown, driveS: null });
    this.planAll("replay", performance.now());
  }

  /** The first slot's configuration, or one that can plan for a point. */
  private configFor(isPoint: boolean): Config | undefined {
    const { catalog, slots } = this.store.state;
    if (catalog === null) return undefined;
    const known = catalog.planners.some(({ name }) => name === slots.a.config.planner);
    const current = known ? slots.a.config : defaultConfig(catalog, FIRST_PLANNER);
    if (isPoint && DRIVING_PLANNERS.includes(current.planner)) {
      this.drivingConfig = current;
      return defaultConfig(catalog, WALKING_PLANNER);
    }
    const former = isPoint ? null : this.drivingConfig;
    if (former !== null) this.drivingConfig = null;
    return former !== null && current.planner === WALKING_PLANNER ? former : current;
  }

  private vehicleCame(vehicle: VehicleMessage): void {
    this.store.set({ vehicle });
    if (!this.isVehicleAwaited) return;
    this.isVehicleAwaited = false;
    this.planAll("settle", performance.now());
  }

  // --- Planning within -----------------------------------------------------------------------

  private changeRequest(request: Request, manner: Wish["manner"]): void {
    const before = this.store.state.request;
    if (JSON.stringify(before) === JSON.stringify(request)) return;
    this.past.push({ kind: "request", before, after: request });
    this.store.set({ request });
    this.planAll(manner, performance.now());
  }

  private planAll(manner: Wish["manner"], atMs: number): void {
    for (const slot of ["a", "b"] as const) this.planSlot(slot, manner, atMs);
  }

  private planSlot(slot: Slot, manner: Wish["manner"], atMs: number): void {
    const { request, slots } = this.store.state;
    if (slots[slot] === null || this.opening !== null) return;
    const asked = isCalm() && manner === "replay" ? "settle" : manner;
    const onTheWay = manner === "replay" ? null : this.driving.onTheWay(slot, request);
    if (onTheWay === null) {
      this.driving.stop(slot);
      this.planning.ask(slot, { request, manner: asked, atMs });
      return;
    }
    this.planning.ask(slot, { request: onTheWay, manner: asked, isOnTheWay: true, atMs });
  }

  private answered(message: AnswerMessage): void {
    const plan = this.store.state.slots[message.slot]?.plan;
    if (plan && this.driving.isOnTheWay(plan.request)) this.driving.replanned(message.slot, message);
  }

  // --- Keeping and errors --------------------------------------------------------------------

  private keepMap(map: MapState): Promise<string> {
    if (this.kept?.version === map.version) return Promise.resolve(this.kept.hash);
    return new Promise((done, failed) => {
      const { version } = map;
      const keeper = (hash: string) => {
        this.kept = { version, hash };
        done(hash);
      };
      this.keepers.push({ done: keeper, failed });
      if (!this.connection.send({ type: "keep_map" })) this.refuseKeepers("the server is not there");
    });
  }

  private keptCame(hash: string): void {
    this.keepers.shift()?.done(hash);
  }

  private refuseKeepers(why: string): void {
    for (const { failed } of this.keepers.splice(0)) failed(new Error(`map not kept: ${why}`));
  }

  private errorCame({ about, message, plan }: ErrorMessage): void {
    // A plan that could not be begun says so where its answer would stand.
    if (plan !== undefined && this.planning.refused(plan, message)) return;
    this.store.set({ error: message });
    if (about === "vehicle") this.isVehicleAwaited = false;
    if (about !== "map") return;
    if (this.opening === null) {
      this.refuseKeepers(message);
      return;
    }
    const isFirst = JSON.stringify(this.opening.map) === JSON.stringify(FIRST_MAP);
    this.opening = null;
    if (this.store.state.map === null && !isFirst) this.open({ map: FIRST_MAP });
  }

  private fileStem(slot: Slot): string {
    const { map, slots } = this.store.state;
    return `${map?.name ?? "map"}-${slots[slot]?.config.planner ?? "plan"}`;
  }
}

function vehicleChoice(vehicle: VehicleMessage): VehicleChoice {
  return vehicle.name === "own" ? { parameters: vehicle.parameters } : { preset: vehicle.name };
}

/** Whether nothing should move by itself. */
function isCalm(): boolean {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}

function reason(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
