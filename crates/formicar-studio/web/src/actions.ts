/** The actions of the user, and the handling of the server's messages. */

import { rounded } from "./cells";
import { vehicleChoice } from "./choices";
import type { Connection } from "./connection";
import { Driving } from "./driving";
import { MapKeeper } from "./map_keeper";
import { defaultConfig, encode, type Scene } from "./link";
import { Opening } from "./opening";
import { Planning, type Wish } from "./planning";
import type {
  AnswerMessage,
  Catalog,
  Config,
  DriveLaw,
  MapChoice,
  Pose,
  Request,
  ServerMessage,
  Slot,
  VehicleChoice,
  VehicleMessage,
} from "./protocol";
import { saveFile } from "./save";
import { expose, stats } from "./stats";
import type { Store } from "./store";
import { Strokes } from "./strokes";
import { Past } from "./undo";
import { uploadMap } from "./uploading";
import { pageUrl, withToken } from "./urls";

type ErrorMessage = Extract<ServerMessage, { type: "error" }>;

const SLOTS = ["a", "b"] as const;

export class Actions {
  private readonly past: Past;
  private readonly planning: Planning;
  private readonly driving: Driving;
  private readonly strokes: Strokes;
  private readonly opening: Opening;
  private readonly mapKeeper: MapKeeper;
  /** The request before an end was taken hold of. */
  private requestBefore: Request | null = null;
  private isVehicleAwaited = false;

  constructor(
    private readonly store: Store,
    private readonly connection: Connection,
  ) {
    this.past = new Past((past) => store.set({ past }));
    this.planning = new Planning(store, connection, (message) => this.answered(message));
    this.driving = new Driving(store, connection);
    this.strokes = new Strokes(store, connection);
    this.opening = new Opening(store, connection, this.strokes);
    this.mapKeeper = new MapKeeper(connection);
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
        if (!this.opening.isOf(message)) break;
        if (this.opening.came(message, payload)) this.mapOpened();
        else this.planAll("settle", performance.now());
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
        this.mapKeeper.resolve(message.hash);
        break;
      case "error":
        this.errorCame(message);
        break;
    }
  }

  /** The line to the server stands or broke; when it stands again, all is opened there anew. */
  connected(isOpen: boolean): void {
    this.store.set({ isConnected: isOpen });
    for (const slot of SLOTS) this.planning.forget(slot);
    this.isVehicleAwaited = false;
    if (!isOpen) this.mapKeeper.reject("the connection to the server was lost");
    else this.opening.reopen();
  }

  /** Fetches the catalog and opens the scene of the link, or the first one. */
  async start(): Promise<void> {
    addEventListener("hashchange", () => void this.openLink());
    try {
      const response = await fetch(withToken("api/catalog"));
      if (!response.ok) throw new Error(`${response.status} ${response.statusText}`);
      this.catalogCame((await response.json()) as Catalog);
    } catch (error) {
      this.store.set({ error: `catalog: ${reason(error)}; hint: reload the page` });
      return;
    }
    if (!(await this.openLink())) this.opening.openFirst();
  }

  // --- Map and vehicle -----------------------------------------------------------------------

  /** Opens a map with its vehicle and first request. */
  openMap(choice: MapChoice): void {
    this.leave();
    this.opening.open({ map: choice });
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
    try {
      this.openMap({ hash: await uploadMap(files, resolutionM) });
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
    const edit = this.strokes.end();
    if (edit === null) return;
    this.past.push(edit);
    this.planAll("settle", atMs);
  }

  /** Takes back the stroke under way, as if it had never been. */
  dropStroke(): void {
    const edit = this.strokes.end();
    if (edit === null) return;
    this.strokes.put(edit.cells, edit.before);
    this.planAll("settle", performance.now());
  }

  undo(): void {
    const edit = this.past.undo();
    if (edit?.kind === "stroke") this.strokes.put(edit.cells, edit.before);
    if (edit?.kind === "request") this.store.set({ request: edit.before });
    if (edit !== null) this.planAll("settle", performance.now());
  }

  redo(): void {
    const edit = this.past.redo();
    if (edit?.kind === "stroke") this.strokes.put(edit.cells, edit.after);
    if (edit?.kind === "request") this.store.set({ request: edit.after });
    if (edit !== null) this.planAll("settle", performance.now());
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

  /** Plans and shows the run from its beginning; without a slot, in both. */
  plan(slot?: Slot): void {
    if (slot === undefined) this.planAll("replay", performance.now());
    else this.planSlot(slot, "replay", performance.now());
  }

  cancel(): void {
    for (const slot of SLOTS) this.planning.cancel(slot);
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
    for (const slot of SLOTS) this.driving.stop(slot);
  }

  // --- Taking away ---------------------------------------------------------------------------

  picture(slot: Slot, format: "svg" | "png"): void {
    this.connection.send({ type: "picture", slot, format });
  }

  /** An address that restores all that is shown; it also becomes the page's own. */
  async link(): Promise<string> {
    const { catalog, map, vehicle, request, slots, shown } = this.store.state;
    if (catalog === null || map === null || vehicle === null)
      throw new Error("there is no map yet");
    const sides = slots.b === null ? [slots.a] : [slots.a, slots.b];
    const scene: Scene = {
      map: map.isEdited ? { hash: await this.mapKeeper.keep(map) } : this.opening.choice,
      vehicle: vehicleChoice(vehicle),
      request,
      slots: sides.map(({ config, seed }) => ({ config, seed })),
      shown,
    };
    const url = pageUrl(await encode(scene, catalog));
    history.replaceState(null, "", url);
    return url;
  }

  // --- What follows ----------------------------------------------------------------------------

  private catalogCame(catalog: Catalog): void {
    const { slots } = this.store.state;
    const a = { ...slots.a, config: defaultConfig(catalog, slots.a.config.planner) };
    this.store.set({ catalog, slots: { ...slots, a } });
  }

  private async openLink(): Promise<boolean> {
    const isScene = await this.opening.openLink(location.hash);
    if (isScene) this.leave();
    return isScene;
  }

  /** Ends what goes on on the map that is left. */
  private leave(): void {
    this.stopDriving();
    this.cancel();
  }

  private mapOpened(): void {
    this.past.clear();
    this.requestBefore = null;
    this.planAll("replay", performance.now());
  }

  private vehicleCame(vehicle: VehicleMessage): void {
    this.store.set({ vehicle });
    if (!this.isVehicleAwaited) return;
    this.isVehicleAwaited = false;
    this.store.set({ error: null });
    this.planAll("settle", performance.now());
  }

  private changeRequest(request: Request, manner: Wish["manner"]): void {
    const before = this.store.state.request;
    if (JSON.stringify(before) === JSON.stringify(request)) return;
    this.past.push({ kind: "request", before, after: request });
    this.store.set({ request });
    this.planAll(manner, performance.now());
  }

  private planAll(manner: Wish["manner"], atMs: number): void {
    for (const slot of SLOTS) this.planSlot(slot, manner, atMs);
  }

  private planSlot(slot: Slot, manner: Wish["manner"], atMs: number): void {
    const { request, slots } = this.store.state;
    if (slots[slot] === null || this.opening.isAwaited) return;
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
    if (plan && this.driving.isOnTheWay(plan.request))
      this.driving.replanned(message.slot, message);
  }

  private errorCame({ about, message, plan }: ErrorMessage): void {
    // A plan that could not begin shows the reason in place of its answer.
    if (plan !== undefined && this.planning.refused(plan, message)) return;
    if (about === "map" && this.opening.isAwaited) {
      this.opening.failed(message).catch((error) => this.store.set({ error: reason(error) }));
      return;
    }
    this.store.set({ error: message });
    if (about === "vehicle") this.isVehicleAwaited = false;
    if (about === "drive") this.driving.failed();
    if (about === "map") this.mapKeeper.reject(message);
  }

  private fileStem(slot: Slot): string {
    const { map, slots } = this.store.state;
    return `${map?.name ?? "map"}-${slots[slot]?.config.planner ?? "plan"}`;
  }
}

/** Whether the user prefers reduced motion. */
function isCalm(): boolean {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}

function reason(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}
