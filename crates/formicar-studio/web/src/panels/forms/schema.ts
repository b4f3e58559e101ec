/** A JSON schema as a form needs it: kind of value, range, unit and help. */

import type { JsonSchema } from "../../protocol";

/** One of several shapes; distinguished by the field `rule`, or by a word standing for itself. */
export interface Variant {
  name: string;
  about: string;
  /** The fields besides `rule`; none for a word. */
  fields: [string, JsonSchema][];
  /** The form of the variant: `{rule: name, ...}`, `name`, or `{name: value}`. */
  writing: "tagged" | "word" | "wrapped";
}

export type Shape =
  | { kind: "number"; isInteger: boolean; isOptional: boolean }
  | { kind: "text"; isOptional: boolean }
  | { kind: "switch" }
  | { kind: "numbers" }
  | { kind: "choice"; variants: Variant[] }
  | { kind: "object"; fields: [string, JsonSchema][] }
  | { kind: "other" };

export interface Range {
  min: number | null;
  max: number | null;
  /** The ends that are outside themselves. */
  excluded: readonly (number | undefined)[];
}

const UNITS: readonly (readonly [string, string])[] = [
  ["_rad_per_s", "rad/s"],
  ["_per_m2", "1/m\u00b2"],
  ["_m_per_n", "m/N"],
  ["_per_m", "1/m"],
  ["_per_s", "1/s"],
  ["_mps", "m/s"],
  ["_rad", "rad"],
  ["_deg", "\u00b0"],
  ["_ms", "ms"],
  ["_kg", "kg"],
  ["_cells", "cells"],
  ["_radii", "\u00d7 R"],
  ["_s", "s"],
  ["_m", "m"],
];

/** A schema with its reference followed; what stands beside the reference has precedence. */
export function resolve(schema: JsonSchema, root: JsonSchema): JsonSchema {
  if (schema.$ref === undefined) return schema;
  const name = schema.$ref.split("/").pop() ?? "";
  const { $ref: _, ...beside } = schema;
  return { ...resolve(root.$defs?.[name] ?? {}, root), ...beside };
}

export function shapeOf(schema: JsonSchema, root: JsonSchema): Shape {
  const { types, isOptional, one } = withoutNull(resolve(schema, root));
  if (one !== null) return shapeOf(one, root);
  const full = resolve(schema, root);
  if (full.oneOf) {
    return { kind: "choice", variants: full.oneOf.flatMap((each) => variantsOf(each, root)) };
  }
  if (full.enum) {
    return { kind: "choice", variants: full.enum.map((word) => wordOf(String(word), "")) };
  }
  if (types.includes("integer")) return { kind: "number", isInteger: true, isOptional };
  if (types.includes("number")) return { kind: "number", isInteger: false, isOptional };
  if (types.includes("boolean")) return { kind: "switch" };
  if (types.includes("string")) return { kind: "text", isOptional };
  if (types.includes("array") && full.items?.type === "number") return { kind: "numbers" };
  if (full.properties) return { kind: "object", fields: Object.entries(full.properties) };
  return { kind: "other" };
}

/** Whether a value may be left out without a default. */
export function isNullable(schema: JsonSchema): boolean {
  const types = schema.type === undefined ? [] : [schema.type].flat();
  return types.includes("null") || (schema.anyOf ?? []).some((option) => option.type === "null");
}

/** The range of a number, and which of its ends are outside it. */
export function rangeOf(schema: JsonSchema): Range {
  const { exclusiveMinimum, exclusiveMaximum } = schema;
  const min = exclusiveMinimum ?? schema.minimum ?? null;
  const max = exclusiveMaximum ?? schema.maximum ?? null;
  return { min, max, excluded: [exclusiveMinimum, exclusiveMaximum] };
}

export function unitOf(key: string): string {
  return UNITS.find(([suffix]) => key.endsWith(suffix))?.[1] ?? "";
}

/** A name as a label: without its unit, counts in words. */
export function labelOf(key: string): string {
  const unit = UNITS.find(([suffix]) => key.endsWith(suffix))?.[0] ?? "";
  const stem = key.slice(0, key.length - unit.length).replace(/^n_/, "number of ");
  return capitalized(stem.replace(/[_-]/g, " ").replace(/astar/g, "A*"));
}

/** Help as it is shown: without marks of code and references, on one line. */
export function helpOf(schema: JsonSchema): string {
  return (schema.description ?? "")
    .replace(/\[([^\]]*)\]\([^)]*\)/g, "$1")
    .replace(/\[`([^\]]*)`\]/g, "$1")
    .replace(/`/g, "")
    .replace(/\s*\n\n\s*/g, " ")
    .replace(/\n/g, " ");
}

/** The value that a schema takes by default, with that of each of its fields. */
export function defaultOf(schema: JsonSchema, root: JsonSchema): unknown {
  const full = resolve(schema, root);
  if (full.default !== undefined) return full.default;
  const shape = shapeOf(full, root);
  if (shape.kind === "object") {
    return Object.fromEntries(shape.fields.map(([key, field]) => [key, defaultOf(field, root)]));
  }
  if (shape.kind === "number" && !shape.isOptional) return rangeOf(full).min ?? 0;
  return null;
}

/** A new value of a variant, its fields by default. */
export function valueOf(variant: Variant, root: JsonSchema): unknown {
  if (variant.writing === "word") return variant.name;
  const fields = variant.fields.map(([key, field]) => [key, defaultOf(field, root)] as const);
  const value = Object.fromEntries(fields);
  return variant.writing === "tagged" ? { rule: variant.name, ...value } : value;
}

/** The variant of a value. */
export function variantIn(value: unknown, variants: readonly Variant[]): Variant | undefined {
  const name = typeof value === "string" ? value : nameOf(value);
  return variants.find((variant) => variant.name === name) ?? variants[0];
}

function nameOf(value: unknown): string {
  if (typeof value !== "object" || value === null) return "";
  const rule = (value as Record<string, unknown>).rule;
  return typeof rule === "string" ? rule : (Object.keys(value)[0] ?? "");
}

function variantsOf(schema: JsonSchema, root: JsonSchema): Variant[] {
  const full = resolve(schema, root);
  const about = helpOf(full);
  if (typeof full.const === "string") return [wordOf(full.const, about)];
  if (full.enum) return full.enum.map((word) => wordOf(String(word), about));
  const properties = Object.entries(full.properties ?? {});
  const rule = full.properties?.rule?.const;
  if (typeof rule === "string") {
    const fields = properties.filter(([key]) => key !== "rule");
    return [{ name: rule, about, fields, writing: "tagged" }];
  }
  const [first] = properties;
  return first ? [{ name: first[0], about, fields: [first], writing: "wrapped" }] : [];
}

function wordOf(name: string, about: string): Variant {
  return { name, about, fields: [], writing: "word" };
}

function withoutNull(schema: JsonSchema): {
  types: string[];
  isOptional: boolean;
  one: JsonSchema | null;
} {
  const types = schema.type === undefined ? [] : [schema.type].flat();
  const others = (schema.anyOf ?? []).filter((option) => option.type !== "null");
  const [one] = others;
  return {
    types: types.filter((type) => type !== "null"),
    isOptional: isNullable(schema),
    one: others.length === 1 && one ? one : null,
  };
}

function capitalized(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
