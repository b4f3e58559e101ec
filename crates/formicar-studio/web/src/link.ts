/** A scene in the hash of an address: map, vehicle, request and what plans it. */

import type { Catalog, Config, MapChoice, Request, Slot, VehicleChoice } from "./protocol";

/** All that it takes to see the same again. */
export interface Scene {
  map: MapChoice;
  vehicle: VehicleChoice;
  request: Request;
  slots: { config: Config; seed: number }[];
  shown: Slot;
}

/** The content of a link, in short keys; of a configuration only the differences. */
interface Packed {
  m: MapChoice;
  v: VehicleChoice;
  r: Request;
  s: { p: string; c?: unknown; n: number }[];
  b?: 1;
}

const VERSION = "1";
const KEY = "scene";
/** Marks a whole value, as opposed to changes of another one. */
const WHOLE = "=";

/** The hash, without its `#`. */
export async function encode(scene: Scene, catalog: Catalog): Promise<string> {
  const slots = scene.slots.map(({ config, seed }) => {
    const changes = difference(config, defaultConfig(catalog, config.planner));
    return { p: config.planner, n: seed, ...(changes === undefined ? {} : { c: changes }) };
  });
  const packed: Packed = { m: scene.map, v: scene.vehicle, r: scene.request, s: slots };
  if (scene.shown === "b") packed.b = 1;
  const bytes = await pipe(new TextEncoder().encode(JSON.stringify(packed)), "deflate");
  return `${KEY}=${VERSION}.${toBase64(bytes)}`;
}

/** The scene of a hash; null if it holds none or is damaged. */
export async function decode(hash: string, catalog: Catalog): Promise<Scene | null> {
  const [version, data] = (new URLSearchParams(hash.replace(/^#/, "")).get(KEY) ?? "").split(".");
  if (version !== VERSION || data === undefined) return null;
  try {
    const text = new TextDecoder().decode(await pipe(fromBase64(data), "inflate"));
    return unpacked(JSON.parse(text) as Packed, catalog);
  } catch {
    return null;
  }
}

function unpacked(packed: Packed, catalog: Catalog): Scene {
  const slots = packed.s.map(({ p, c, n }) => ({
    config: merged(defaultConfig(catalog, p), c) as Config,
    seed: n,
  }));
  if (slots.length === 0) throw new Error("a scene without a planner");
  const shown = packed.b === 1 && slots.length > 1 ? "b" : "a";
  return { map: packed.m, vehicle: packed.v, request: packed.r, slots, shown };
}

/** A planner's configuration as the catalog has it. */
export function defaultConfig(catalog: Catalog, planner: string): Config {
  return catalog.planners.find((one) => one.name === planner)?.config ?? { planner };
}

/** The part of `value` that differs from `base`; undefined if nothing does. */
function difference(value: unknown, base: unknown): unknown {
  if (!isRecord(value) || !isRecord(base)) {
    return JSON.stringify(value) === JSON.stringify(base) ? undefined : value;
  }
  // A variant with other fields is another value, not the same one changed.
  if (Object.keys(base).some((key) => !(key in value))) return { [WHOLE]: value };
  const changes = Object.entries(value).flatMap(([key, part]) => {
    const change = difference(part, base[key]);
    return change === undefined ? [] : [[key, change] as const];
  });
  return changes.length === 0 ? undefined : Object.fromEntries(changes);
}

/** `base` with the changes that `difference` found. */
function merged(base: unknown, changes: unknown): unknown {
  if (changes === undefined) return base;
  if (isRecord(changes) && WHOLE in changes) return changes[WHOLE];
  if (!isRecord(base) || !isRecord(changes)) return changes;
  const keys = new Set([...Object.keys(base), ...Object.keys(changes)]);
  return Object.fromEntries([...keys].map((key) => [key, merged(base[key], changes[key])]));
}

function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

async function pipe(
  bytes: Uint8Array<ArrayBuffer>,
  how: "deflate" | "inflate",
): Promise<Uint8Array> {
  const through =
    how === "deflate"
      ? new CompressionStream("deflate-raw")
      : new DecompressionStream("deflate-raw");
  const stream = new Blob([bytes]).stream().pipeThrough(through);
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function toBase64(bytes: Uint8Array): string {
  const letters = Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");
  return btoa(letters).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
}

function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  const letters = atob(text.replace(/-/g, "+").replace(/_/g, "/"));
  return Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
}
