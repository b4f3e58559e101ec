/** Mouse, pen and fingers on the map: drag, pan, pinch, wheel, hover. */

import type { Camera, Point, View } from "./camera";

/** The object of a press. */
export interface Drag {
  move(at: Point): void;
  end(): void;
  /** A second finger came down: it was no drag after all. */
  cancel(): void;
}

export interface Touched {
  /** Finds the object of a press; null: the map itself, which is then panned. */
  press(at: Point, isTouch: boolean): Drag | null;
  /** The position of the hovering pointer; null once it has left. */
  hover(at: Point | null): void;
}

const ZOOM_PER_PX = 0.0016;
/** Trackpads report a pinch as a wheel with the control key, in small steps. */
const PINCH_PER_PX = 0.01;
const LINE_PX = 32;

export class Gestures {
  private readonly pointers = new Map<number, Point>();
  private drag: Drag | null = null;

  constructor(
    private readonly element: HTMLElement,
    private readonly view: View,
    private readonly touched: Touched,
  ) {
    element.addEventListener("pointerdown", (event) => this.down(event));
    element.addEventListener("pointermove", (event) => this.moved(event));
    element.addEventListener("pointerup", (event) => this.up(event, true));
    element.addEventListener("pointercancel", (event) => this.up(event, false));
    element.addEventListener("pointerleave", () => this.touched.hover(null));
    element.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    element.addEventListener("contextmenu", (event) => event.preventDefault());
  }

  private get camera(): Camera {
    return this.view.camera;
  }

  private down(event: PointerEvent): void {
    if (event.target instanceof Element && event.target.closest("[data-own-pointer]")) return;
    this.element.setPointerCapture(event.pointerId);
    const at = this.place(event);
    this.pointers.set(event.pointerId, at);
    if (this.pointers.size > 1) {
      this.drag?.cancel();
      this.drag = null;
      return;
    }
    const pans = event.button !== 0;
    this.drag = pans ? null : this.touched.press(at, event.pointerType === "touch");
    this.element.classList.toggle("is-panning", this.drag === null);
  }

  private moved(event: PointerEvent): void {
    const before = this.pointers.get(event.pointerId);
    const at = this.place(event);
    if (before === undefined) {
      if (event.pointerType !== "touch") this.touched.hover(at);
      return;
    }
    if (this.pointers.size === 2) this.pinch(event.pointerId, before, at);
    else if (this.drag !== null) this.drag.move(at);
    else this.camera.pan(at[0] - before[0], at[1] - before[1]);
    this.pointers.set(event.pointerId, at);
    if (event.pointerType !== "touch") this.touched.hover(at);
  }

  private up(event: PointerEvent, isDone: boolean): void {
    if (!this.pointers.delete(event.pointerId)) return;
    this.element.classList.remove("is-panning");
    if (isDone) this.drag?.end();
    else this.drag?.cancel();
    this.drag = null;
  }

  /** One of two fingers moves: the world stays under both. */
  private pinch(id: number, before: Point, at: Point): void {
    const other = [...this.pointers].find(([key]) => key !== id)?.[1];
    if (other === undefined) return;
    const span = (point: Point) => Math.hypot(point[0] - other[0], point[1] - other[1]);
    this.camera.pan((at[0] - before[0]) / 2, (at[1] - before[1]) / 2);
    const middle: Point = [(at[0] + other[0]) / 2, (at[1] + other[1]) / 2];
    this.camera.zoom(span(at) / Math.max(span(before), 1), this.view.toWorld(middle));
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const px =
      event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? event.deltaY : event.deltaY * LINE_PX;
    const rate = event.ctrlKey ? PINCH_PER_PX : ZOOM_PER_PX;
    this.camera.zoom(Math.exp(-px * rate), this.view.toWorld(this.place(event)));
  }

  private place(event: MouseEvent): Point {
    const { left, top } = this.element.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  }
}
