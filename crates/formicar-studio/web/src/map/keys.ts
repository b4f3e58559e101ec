/** Keys of the map and its tools. */

import type { Actions } from "../actions";
import type { Store } from "../store";
import type { View } from "./camera";

const PAN_PX = 60;
const ZOOM = 1.3;
const BRUSH = 1.25;
const MAX_BRUSH_CELLS = 60;
/** Inputs that take no letters. */
const UNTYPED = ["range", "checkbox", "radio", "button"];

/** Keys while the map has the focus: pan, zoom, fit. */
export function mapKeys(element: HTMLElement, view: View, fit: () => void): void {
  element.addEventListener("keydown", (event) => {
    if (event.target !== element || event.ctrlKey || event.metaKey || event.altKey) return;
    const { camera } = view;
    const step = event.shiftKey ? 4 * PAN_PX : PAN_PX;
    const middle: [number, number] = [camera.x, camera.y];
    const acts: Record<string, () => void> = {
      ArrowLeft: () => camera.pan(step, 0),
      ArrowRight: () => camera.pan(-step, 0),
      ArrowUp: () => camera.pan(0, step),
      ArrowDown: () => camera.pan(0, -step),
      "+": () => camera.zoom(ZOOM, middle),
      "=": () => camera.zoom(ZOOM, middle),
      "-": () => camera.zoom(1 / ZOOM, middle),
      "0": fit,
      f: fit,
    };
    const act = acts[event.key];
    if (act === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    act();
  });
}

/** Keys that hold wherever nobody types: tools, brush, undo and redo. */
export function pageKeys(store: Store, actions: Actions): void {
  const acts: Record<string, () => void> = {
    m: () => store.set({ tool: "move" }),
    p: () => store.set({ tool: "paint" }),
    e: () => store.set({ tool: "erase" }),
    "[": () => scaleBrush(store, 1 / BRUSH),
    "]": () => scaleBrush(store, BRUSH),
    "control z": () => actions.undo(),
    "control shift z": () => actions.redo(),
    "control y": () => actions.redo(),
  };
  document.addEventListener("keydown", (event) => {
    if (isTyping(event.target) || event.defaultPrevented || event.altKey) return;
    const isControl = event.ctrlKey || event.metaKey;
    const shift = event.shiftKey ? "shift " : "";
    const key = event.key.toLowerCase();
    const act = acts[isControl ? `control ${shift}${key}` : key];
    if (act === undefined) return;
    event.preventDefault();
    act();
  });
}

/** Makes the brush wider or narrower, within what is of use on the map. */
function scaleBrush(store: Store, factor: number): void {
  const { map, brushM } = store.state;
  if (map === null) return;
  const [least, most] = [map.resolution_m, MAX_BRUSH_CELLS * map.resolution_m];
  store.set({ brushM: Math.min(Math.max(brushM * factor, least), most) });
}

/** Whether the focused element, a field or a dialog, takes the keys. */
export function isTyping(target: EventTarget | null): boolean {
  if (!(target instanceof HTMLElement)) return false;
  if (target.closest("dialog") !== null) return true;
  if (target instanceof HTMLInputElement) return !UNTYPED.includes(target.type);
  return target.isContentEditable || ["TEXTAREA", "SELECT"].includes(target.tagName);
}
