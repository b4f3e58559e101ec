/** Pointer actions on the map: move an end, turn it, paint, erase, hover. */

import type { Actions } from "../actions";
import { toCells } from "../cells";
import type { Pose, Slot } from "../protocol";
import type { Store } from "../store";
import { cellsUnder } from "./brush";
import type { Point, View } from "./camera";
import { gripAt, type Grip } from "./ends";
import type { Drag, Touched } from "./gestures";
import { nearestOn, type PathShape } from "./path_shape";

const REACH_PX = 7;
const TOUCH_REACH_PX = 22;
const HOVER_PX = 26;
const OCCUPIED = 100;
const FREE = 0;
/** Turns snap to multiples of 90 degrees within this. */
const SNAP_RAD = 0.05;

export class Hands implements Touched {
  /** The object that is held or lies under the pointer. */
  held: Grip | null = null;
  /** The position of the pointer, world coordinates. */
  pointer: Point | null = null;
  /** Whether something is being dragged or painted. */
  isBusy = false;
  /** Whether the arc length pointed at was found here. */
  private isPointing = false;

  constructor(
    private readonly store: Store,
    private readonly actions: Actions,
    private readonly slot: Slot,
    private readonly view: View,
    private readonly shape: () => PathShape | null,
    private readonly changed: () => void,
  ) {}

  press(at: Point, isTouch: boolean): Drag | null {
    const drag = this.take(at, isTouch);
    if (drag === null) return null;
    this.isBusy = true;
    const release = (how: () => void) => () => {
      this.isBusy = false;
      how();
    };
    return { move: drag.move, end: release(drag.end), cancel: release(drag.cancel) };
  }

  private take(at: Point, isTouch: boolean): Drag | null {
    const { map, tool, request, vehicle } = this.store.state;
    if (map === null) return null;
    this.pointer = this.view.toWorld(at);
    if (tool !== "move") return this.stroke(at, tool === "paint" ? OCCUPIED : FREE);
    const grip = gripAt(this.view, request, vehicle, at, isTouch ? TOUCH_REACH_PX : REACH_PX);
    if (grip === null) return null;
    this.held = grip;
    this.changed();
    return grip.part === "body" ? this.moveEnd(grip, at) : this.turnEnd(grip);
  }

  hover(at: Point | null): void {
    const { request, vehicle, tool, map } = this.store.state;
    const { held } = this;
    if (this.isBusy) return;
    this.pointer = at === null ? null : this.view.toWorld(at);
    this.held =
      at === null || tool !== "move" || map === null
        ? null
        : gripAt(this.view, request, vehicle, at, REACH_PX);
    if (held?.end !== this.held?.end || held?.part !== this.held?.part) this.changed();
    if (tool !== "move") this.changed();
    this.point(this.held === null && tool === "move" ? this.pointer : null);
  }

  /** The action of the pointer. */
  get cursor(): string {
    if (this.store.state.tool !== "move") return "none";
    if (this.held !== null) return this.held.part === "body" ? "move" : "grab";
    return "";
  }

  /** The cell and place under the pointer, in words. */
  get readout(): string {
    const { map } = this.store.state;
    if (map === null || this.pointer === null) return "";
    const [x, y] = this.pointer;
    const [col, row] = toCells(map, x, y).map(Math.floor) as [number, number];
    const isOff = col < 0 || row < 0 || col >= map.n_cols || row >= map.n_rows;
    const digits = map.resolution_m < 0.1 ? 2 : 1;
    return `${x.toFixed(digits)}, ${y.toFixed(digits)} m${isOff ? "" : ` · cell ${col}, ${row}`}`;
  }

  private moveEnd({ end }: Grip, from: Point): Drag {
    const [x, y, heading] = this.store.state.request[end];
    const [grabX, grabY] = this.view.toWorld(from);
    let pose: Pose = [x, y, heading];
    const drag = this.poseDrag(end, () => pose);
    return {
      ...drag,
      move: (at) => {
        const [toX, toY] = this.view.toWorld(at);
        pose = [x + toX - grabX, y + toY - grabY, heading];
        drag.move(at);
      },
    };
  }

  private turnEnd({ end }: Grip): Drag {
    const [x, y, heading] = this.store.state.request[end];
    let pose: Pose = [x, y, heading];
    const drag = this.poseDrag(end, () => pose);
    return {
      ...drag,
      move: (at) => {
        const [toX, toY] = this.view.toWorld(at);
        pose = [x, y, snapped(Math.atan2(toY - y, toX - x))];
        drag.move(at);
      },
    };
  }

  /** A drag of an end; a press that does not move changes nothing. */
  private poseDrag(end: Grip["end"], pose: () => Pose): Drag {
    const before = this.store.state.request[end];
    let isMoved = false;
    const settle = (last: Pose) => {
      this.held = null;
      this.changed();
      if (isMoved) this.actions.moveEnd(end, last, false);
    };
    return {
      move: () => {
        isMoved = true;
        this.actions.moveEnd(end, pose(), true);
      },
      end: () => settle(pose()),
      cancel: () => settle(before),
    };
  }

  private stroke(from: Point, value: number): Drag {
    let last = this.view.toWorld(from);
    const dab = (to: Point) => {
      const { map, brushM } = this.store.state;
      if (map === null) return;
      this.actions.paint(cellsUnder(map, last, to, brushM), value);
      last = to;
    };
    dab(last);
    return {
      move: (at) => {
        this.pointer = this.view.toWorld(at);
        dab(this.pointer);
      },
      end: () => this.actions.endStroke(),
      cancel: () => this.actions.dropStroke(),
    };
  }

  /** Points at the nearest place of the path. */
  private point(at: Point | null): void {
    const { slots, shown } = this.store.state;
    const shape = this.slot === shown || slots.b === null ? this.shape() : null;
    const near = at === null || shape === null ? null : nearestOn(shape, at[0], at[1]);
    const isNear = near !== null && near.distance_m * this.view.pxPerM <= HOVER_PX;
    if (isNear) this.store.set({ hoverM: near.s });
    else if (this.isPointing) this.store.set({ hoverM: null });
    this.isPointing = isNear;
  }
}

function snapped(angle: number): number {
  const quarter = Math.PI / 2;
  const nearest = Math.round(angle / quarter) * quarter;
  return Math.abs(angle - nearest) < SNAP_RAD ? nearest : angle;
}
