/** Icons as strokes on a field of 20 by 20. */

import { s } from "./dom";

const PATHS = {
  alert: "M10 3 L18 17 H2 Z M10 8 V12 M10 14.2 V14.8",
  brush:
    "M4 16 C4 13 5.5 12 7.5 12 C9 12 9.5 13.5 8.5 14.8 C7.5 16 5.5 16.2 4 16 Z M9 12 L15.5 4.5 L17 6 L10 13",
  car: "M3 12 V9.5 L5 5.5 H15 L17 9.5 V12 Z M3 12 V15 H5.5 V12 M17 12 V15 H14.5 V12 M4 9.5 H16",
  chart: "M3 3 V17 H17 M6 13 L9 9 L12 11 L16 5",
  check: "M4 10.5 L8.2 14.7 L16 6",
  chevron: "M7 4.5 L12.5 10 L7 15.5",
  close: "M5 5 L15 15 M15 5 L5 15",
  columns: "M3 4 H17 V16 H3 Z M10 4 V16",
  contrast: "M10 3 A7 7 0 1 0 10 17 A7 7 0 1 0 10 3 M10 3 V17 M12.5 5 V15 M15 6.5 V13.5",
  copy: "M7 7 H16 V17 H7 Z M4 13 V3 H13",
  dice: "M4 4 H16 V16 H4 Z M7.4 7.4 V7.6 M12.6 7.4 V7.6 M10 9.9 V10.1 M7.4 12.4 V12.6 M12.6 12.4 V12.6",
  download: "M10 3 V12.5 M6 8.8 L10 12.8 L14 8.8 M4 16.5 H16",
  erase: "M7 16 L3.5 12.5 L12 4 L16.5 8.5 L9 16 Z M7.6 8.4 L12.1 12.9 M7 16 H17",
  export: "M10 12.5 V3 M6 6.8 L10 2.8 L14 6.8 M4 10 V17 H16 V10",
  fit: "M3 7 V3 H7 M13 3 H17 V7 M17 13 V17 H13 M7 17 H3 V13 M7 7 H13 V13 H7 Z",
  help: "M10 3 A7 7 0 1 0 10 17 A7 7 0 1 0 10 3 M7.8 8 C7.8 5.4 12.2 5.4 12.2 8 C12.2 9.6 10 9.8 10 11.6 M10 13.9 V14.1",
  layers: "M10 3 L17.5 7 L10 11 L2.5 7 Z M3.5 10.4 L10 14 L16.5 10.4 M3.5 13.4 L10 17 L16.5 13.4",
  link: "M8.5 11.5 L12 8 M9 6 L11 4 A3.2 3.2 0 0 1 16 9 L14 11 M11 14 L9 16 A3.2 3.2 0 0 1 4 11 L6 9",
  map: "M3 5 L7.5 3 L12.5 5 L17 3 V15 L12.5 17 L7.5 15 L3 17 Z M7.5 3 V15 M12.5 5 V17",
  moon: "M15.5 12 A6.5 6.5 0 1 1 8 4.5 A5.2 5.2 0 0 0 15.5 12 Z",
  move: "M10 2.5 V17.5 M2.5 10 H17.5 M7.8 4.7 L10 2.5 L12.2 4.7 M7.8 15.3 L10 17.5 L12.2 15.3 M4.7 7.8 L2.5 10 L4.7 12.2 M15.3 7.8 L17.5 10 L15.3 12.2",
  open: "M3 16 V4 H8 L10 6.5 H16 V9 M3 16 L5.5 9 H18 L15.5 16 Z",
  pause: "M7 4.5 V15.5 M13 4.5 V15.5",
  play: "M6 4 L15.5 10 L6 16 Z",
  redo: "M12.5 3.5 L16 7 L12.5 10.5 M16 7 H8.5 A4.5 4.5 0 0 0 8.5 16 H12",
  reset: "M4 4 V8 H8 M4.6 8 A6.2 6.2 0 1 1 4 11.5",
  sliders: "M3 6 H9 M13 6 H17 M11 4 V8 M3 14 H6 M10 14 H17 M8 12 V16",
  steps: "M3 16 H7 V12 H11 V8 H15 V4 H17.5",
  stop: "M5 5 H15 V15 H5 Z",
  sun: "M10 6.5 A3.5 3.5 0 1 0 10 13.5 A3.5 3.5 0 1 0 10 6.5 M10 2 V3.5 M10 16.5 V18 M2 10 H3.5 M16.5 10 H18 M4.3 4.3 L5.4 5.4 M14.6 14.6 L15.7 15.7 M4.3 15.7 L5.4 14.6 M14.6 5.4 L15.7 4.3",
  swap: "M4 7 H16 L13 4 M16 13 H4 L7 16",
  undo: "M7.5 3.5 L4 7 L7.5 10.5 M4 7 H11.5 A4.5 4.5 0 0 1 11.5 16 H8",
  wheel:
    "M10 3 A7 7 0 1 0 10 17 A7 7 0 1 0 10 3 M10 8.4 A1.6 1.6 0 1 0 10 11.6 A1.6 1.6 0 1 0 10 8.4 M3.2 9 L8.4 9.6 M16.8 9 L11.6 9.6 M10 11.6 V17",
} as const;

export type IconName = keyof typeof PATHS;

/** The icon, hidden from screen readers: what it stands in names itself. */
export function icon(name: IconName): SVGSVGElement {
  return s(
    "svg",
    { class: "icon", viewBox: "0 0 20 20", "aria-hidden": true, focusable: "false" },
    s("path", { d: PATHS[name] }),
  );
}
