/** The map: what is drawn of a slot, layer by layer, and what hands do to it. */

import "./map.css";

import type { Actions } from "../actions";
import { h, setText } from "../dom";
import type { Slot } from "../protocol";
import { stats } from "../stats";
import type { Store } from "../store";
import { onThemeChange } from "../theme";
import { drawBrush } from "./brush";
import { cameraOf, View } from "./camera";
import { drawEnds } from "./ends";
import { drawFailure, reasonOf } from "./failure";
import { Gestures } from "./gestures";
import { Ground } from "./ground";
import { Handles } from "./handles";
import { Hands } from "./hands";
import { mapKeys, pageKeys } from "./keys";
import { scaleBar } from "./marks";
import { drawDrive, drawHover, drawTightest, keepRoom } from "./overlay";
import { palette } from "./palette";
import { drawPath, drawSwept } from "./path";
import type { PathShape } from "./path_shape";
import { Pheromone } from "./pheromone";
import { drawDrivers, drawNewest, Expanded } from "./race";
import { type Scene, sceneOf } from "./scene";
import { Sheet } from "./sheet";
import { drawStageCells, drawStageWays, isTold } from "./stages";
import { drawGeneration, drawPassages, drawWalkers } from "./traffic";

const KEYS = [
  "map",
  "vehicle",
  "request",
  "slots",
  "shown",
  "tool",
  "brushM",
  "frame",
  "frameShare",
  "step",
  "hoverM",
  "driveS",
  "layers",
] as const;
const MAX_DPR = 2;
const MAX_STEP_MS = 100;
const LABEL =
  "Map. Arrow keys pan, plus and minus zoom, F fits; M moves, P paints, E erases; tab goes to start and goal.";

export class MapView {
  private readonly element: HTMLElement;
  private readonly note = h("p", { class: "map-note", hidden: true });
  private readonly readout = h("p", { class: "map-readout", "aria-hidden": true });
  private readonly view: View;
  private readonly base: Sheet;
  private readonly search: Sheet;
  private readonly ways: Sheet;
  private readonly over: Sheet;
  private readonly ground = new Ground();
  private readonly pheromone = new Pheromone();
  private readonly expanded: Expanded;
  private readonly hands: Hands;
  private readonly handles: Handles;
  /** The inputs of the sheets that are drawn rarely. */
  private readonly drawnFrom = new Map<Sheet, unknown[]>();
  private fitted: Int8Array | null = null;
  private isScheduled = false;
  /** The time that ants on cells have been walking, seconds, and when it was measured. */
  private walkedS = 0;
  private walkedMs = 0;

  constructor(
    host: HTMLElement,
    private readonly store: Store,
    actions: Actions,
    private readonly slot: Slot,
  ) {
    this.element = h("div", { class: "map-view", tabindex: 0, role: "group", "aria-label": LABEL });
    this.element.dataset.slot = slot;
    this.view = new View(cameraOf(store), 1, 1);
    const sheet = (layer: string) => {
      const canvas = h("canvas", { "aria-hidden": true });
      canvas.dataset.layer = layer;
      this.element.append(canvas);
      return new Sheet(canvas, this.view, palette());
    };
    this.base = sheet("base");
    this.search = sheet("search");
    this.ways = sheet("ways");
    this.over = sheet("over");
    this.expanded = new Expanded(this.search);
    const schedule = () => this.schedule();
    this.hands = new Hands(store, actions, slot, this.view, () => this.shape(), schedule);
    this.handles = new Handles(this.element, this.view, actions, () => store.state, slot);
    this.element.append(this.note, this.readout);
    host.append(this.element);
    new Gestures(this.element, this.view, this.hands);
    mapKeys(this.element, this.view, () => this.fit());
    if (slot === "a") pageKeys(store, actions);
    this.element.addEventListener("pointermove", schedule);
    this.view.camera.onChange(schedule);
    onThemeChange(() => this.recolor());
    new ResizeObserver(() => this.resize()).observe(this.element);
    this.resize();
    store.watch(KEYS, () => this.draw());
  }

  /** Shows the whole map. */
  fit(): void {
    const { map } = this.store.state;
    if (map !== null) this.view.camera.fit(map, this.view.widthPx, this.view.heightPx);
  }

  private resize(): void {
    const { width, height } = this.element.getBoundingClientRect();
    if (width < 1 || height < 1) return;
    [this.view.widthPx, this.view.heightPx] = [width, height];
    for (const sheet of this.sheets) sheet.resize(Math.min(devicePixelRatio, MAX_DPR));
    // What was whole stays whole.
    if (this.view.camera.isFitted) this.fit();
    // Drawn at once: a resized canvas is blank.
    this.drawnFrom.clear();
    this.draw();
  }

  private recolor(): void {
    for (const sheet of this.sheets) sheet.colors = palette();
    this.schedule();
  }

  private get sheets(): Sheet[] {
    return [this.base, this.search, this.ways, this.over];
  }

  private schedule(): void {
    if (this.isScheduled) return;
    this.isScheduled = true;
    requestAnimationFrame(() => {
      this.isScheduled = false;
      this.draw();
    });
  }

  private shape(): PathShape | null {
    return this.scene()?.shape ?? null;
  }

  private scene(): Scene | null {
    return sceneOf(this.store.state, this.slot);
  }

  private draw(): void {
    const started = performance.now();
    const scene = this.scene();
    if (scene === null || this.view.widthPx <= 1) return;
    const isUnderWay = scene.state.isPlaying || (scene.plan !== null && scene.plan.end === null);
    if (isUnderWay) this.walkedS += Math.min(started - this.walkedMs, MAX_STEP_MS) / 1000;
    this.walkedMs = started;
    if (this.fitted !== scene.map.values) {
      this.fitted = scene.map.values;
      if (this.slot === "a") this.fit();
    }
    this.drawBase(scene);
    this.drawSearch(scene);
    this.drawWays(scene);
    this.drawOver(scene);
    this.write(scene);
    const { plan } = scene;
    const hasPath = scene.shape !== null;
    if (plan !== null && (hasPath || plan.end !== null)) stats.planDrawn(plan.plan, hasPath);
    stats.frameDrawn(performance.now() - started, isUnderWay || scene.state.driveS !== null);
  }

  /** Map, pheromone and cells of the step: drawn only when they have changed. */
  private drawBase({ state, map, plan, moment, step }: Scene): void {
    const { base } = this;
    const bytes = state.layers.pheromone && step === null ? moment.iteration?.pheromone : undefined;
    const stages = plan?.end?.stages;
    const shown = step === null ? null : stages;
    if (!this.isOutdated(base, [map.values, map.version, bytes, step?.name, shown])) return;
    const ctx = base.inPixels();
    ctx.fillStyle = base.colors.offMap;
    ctx.fillRect(0, 0, this.view.widthPx, this.view.heightPx);
    this.ground.draw(base, map);
    if (bytes !== undefined) this.pheromone.draw(base, map, bytes);
    if (step !== null && stages !== undefined) drawStageCells(base, map, stages, step.name);
  }

  /** Whether a sheet must be drawn again, for another view, other colors or another key. */
  private isOutdated(sheet: Sheet, ownKey: readonly unknown[]): boolean {
    const { x, y, pxPerM } = this.view.camera;
    const key = [x, y, pxPerM, sheet.colors, ...ownKey];
    const before = this.drawnFrom.get(sheet);
    if (key.length === before?.length && key.every((part, i) => part === before[i])) return false;
    this.drawnFrom.set(sheet, key);
    return true;
  }

  /** The motions of hybrid A*; all of them stay if it found no path. */
  private drawSearch({ state, plan, moment, step }: Scene): void {
    const { frames, end } = plan ?? { frames: [], end: null };
    const nAtEnd = end !== null && !end.answer.path ? frames.length : 0;
    const isShown = state.layers.ants && step === null;
    const nShown = isShown ? (moment.nBegun ?? nAtEnd) : 0;
    if (nShown > 0) this.expanded.draw(frames, nShown);
    else this.expanded.clear();
  }

  /** The traffic of the ants of an iteration: drawn only when it has changed. */
  private drawWays({ state, map, moment, step }: Scene): void {
    const { ways } = this;
    const isShown = state.layers.ants && step === null && moment.nBegun !== null;
    const frame = isShown ? moment.iteration : null;
    if (!this.isOutdated(ways, [map.values, frame])) return;
    ways.canvas.hidden = frame === null;
    ways.clear();
    if (frame !== null) drawPassages(ways, map, frame);
  }

  private drawOver(scene: Scene): void {
    const { over } = this;
    const { state, map, plan, step, side } = scene;
    over.clear();
    keepRoom(over, scene);
    this.drawAnts(scene);
    if (step !== null && plan?.end) drawStageWays(over, map, plan.end.stages, step.name);
    if (step === null || isTold("arcs", step.name)) this.drawShape(scene);
    drawEnds(over, state.request, state.vehicle, this.hands.held);
    const answer = plan?.end?.answer;
    const isEnd = scene.moment.nBegun === null;
    if (answer && isEnd && !answer.path && step === null) drawFailure(over, map, answer);
    if (side.driven !== null && state.driveS !== null) drawDrive(over, scene);
    else if (isEnd) drawTightest(over, scene);
    if (state.shown === this.slot) drawHover(over, scene);
    if (state.tool !== "move" && this.hands.pointer)
      drawBrush(over, this.hands.pointer, state.brushM);
    scaleBar(over);
  }

  /** Ants, and what else the run shows on its way. */
  private drawAnts({ state, map, plan, moment, step }: Scene): void {
    if (!state.layers.ants || step !== null || moment.nBegun === null) return;
    const { over } = this;
    if (moment.iteration) drawWalkers(over, map, moment.iteration, this.walkedS);
    if (moment.generation) drawGeneration(over, map, moment.generation);
    drawNewest(over, plan?.frames[moment.nBegun - 1]);
    if (moment.drive === null) return;
    drawDrivers(over, moment.drive, moment.driveBefore, moment.isDriveLast ? moment.share : 1);
  }

  private drawShape({ state, shape, step }: Scene): void {
    if (shape === null) return;
    const { over } = this;
    const { vehicle, layers } = state;
    const isSwept = step === null ? layers.swept : step.name === "judged";
    if (isSwept && vehicle) drawSwept(over, shape, vehicle);
    drawPath(over, shape);
  }

  /** Words over the map, and where the buttons for keyboards are. */
  private write({ state, plan, moment }: Scene): void {
    this.handles.place();
    this.element.style.cursor = this.hands.cursor;
    setText(this.readout, this.hands.readout);
    const answer = plan?.end?.answer;
    const reason =
      answer && moment.nBegun === null && state.step === null ? reasonOf(answer) : null;
    // While something is held, words would flicker under the hand.
    this.note.hidden = reason === null || this.hands.isBusy;
    setText(this.note, reason ?? "");
  }
}
