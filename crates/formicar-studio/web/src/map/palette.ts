/** Colors of the map in both themes, as in printed pictures (`render/palette.rs`); on dark ground
 * all is lighter and obstacles are light, so that the order in greyscale turns around whole. */

import { isDark } from "../theme";

export interface Palette {
  isDark: boolean;
  page: string;
  ink: string;
  muted: string;
  rule: string;
  free: Rgb;
  obstacle: Rgb;
  unknown: Rgb;
  graded: Rgb;
  offMap: string;
  expanded: string;
  closed: string;
  forward: string;
  reverse: string;
  swept: string;
  start: string;
  goal: string;
  limit: string;
  waypoints: string;
  /** Ants that arrive, and those that do not. */
  arrived: string;
  lost: string;
}

export type Rgb = readonly [number, number, number];

const LIGHT: Palette = {
  isDark: false,
  page: "#ffffff",
  ink: "#22272e",
  muted: "#5d6670",
  rule: "#a9b1b9",
  free: [0xfb, 0xfb, 0xf9],
  obstacle: [0x2f, 0x34, 0x3a],
  unknown: [0xb4, 0xbc, 0xc4],
  graded: [0x9a, 0x8f, 0x7c],
  offMap: "#dfe3e7",
  expanded: "#c9c9c6",
  closed: "#9468b4",
  forward: "#0b4f9c",
  reverse: "#d9690a",
  swept: "#4f9ad6",
  start: "#0b7a53",
  goal: "#7b2d8b",
  limit: "#d81e3f",
  waypoints: "#8c5a14",
  arrived: "#22272e",
  lost: "#4f9ad6",
};

const DARK: Palette = {
  isDark: true,
  page: "#0d1013",
  ink: "#e9edf1",
  muted: "#98a3ae",
  rule: "#515b66",
  free: [0x17, 0x1b, 0x20],
  obstacle: [0x8b, 0x95, 0x9f],
  unknown: [0x4a, 0x53, 0x5d],
  graded: [0x6b, 0x62, 0x50],
  offMap: "#0d1013",
  expanded: "#3a4149",
  closed: "#7a55a0",
  forward: "#6fb1f5",
  reverse: "#f3a356",
  swept: "#4d92cc",
  start: "#46c496",
  goal: "#cf8fdc",
  limit: "#ff6b7f",
  waypoints: "#cf9a4a",
  arrived: "#e9edf1",
  lost: "#5b93c4",
};

export function palette(): Palette {
  return isDark() ? DARK : LIGHT;
}

export function css([red, green, blue]: Rgb): string {
  return `rgb(${red} ${green} ${blue})`;
}

/** The color at `t` of the way from one to another. */
export function mix(a: Rgb, b: Rgb, t: number): Rgb {
  const at = (i: 0 | 1 | 2) => Math.round(a[i] + (b[i] - a[i]) * t);
  return [at(0), at(1), at(2)];
}

/** A perceptually uniform scale, straight in OKLab (Ottosson 2020): from pale yellow to dark red;
 * on dark ground from dark red to pale yellow. */
export function heat(t: number, onDark: boolean): Rgb {
  const lightness = onDark ? 0.3 + 0.58 * t : 0.97 - 0.47 * t;
  const chroma = onDark ? 0.07 + 0.07 * t : 0.05 + 0.12 * t;
  const hue = ((onDark ? 25 + 75 * t : 105 - 80 * t) * Math.PI) / 180;
  return fromOklab(lightness, chroma * Math.cos(hue), chroma * Math.sin(hue));
}

function fromOklab(lightness: number, a: number, b: number): Rgb {
  const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
  const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
  const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
  return [
    gamma(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
    gamma(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
    gamma(-0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s),
  ];
}

/** Linear light to an sRGB byte (IEC 61966-2-1). */
function gamma(linear: number): number {
  const encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055;
  return Math.round(Math.min(Math.max(encoded, 0), 1) * 255);
}
