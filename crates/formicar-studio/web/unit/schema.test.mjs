/** JSON schemas as forms see them. */

import assert from "node:assert/strict";
import { test } from "node:test";
import {
  defaultOf,
  helpOf,
  isNullable,
  labelOf,
  rangeOf,
  resolve,
  shapeOf,
  unitOf,
  valueOf,
  variantIn,
} from "../src/panels/forms/schema.ts";

const root = {
  $defs: {
    Limits: {
      type: "object",
      properties: {
        n_ants: { type: "integer", minimum: 1, default: 20 },
        rho: { type: "number", exclusiveMinimum: 0, maximum: 1 },
        name: { type: ["string", "null"] },
      },
    },
    Rule: {
      oneOf: [
        {
          description: "A constant [rate](crate::Rate).",
          properties: { rule: { const: "constant" }, rho: { type: "number", default: 0.1 } },
        },
        { const: "none", description: "No `rate`." },
        { properties: { cells: { type: "integer", minimum: 3 } } },
      ],
    },
  },
};
const rule = { $ref: "#/$defs/Rule" };

test("a reference is followed, and what stands beside it has precedence", () => {
  const schema = { $ref: "#/$defs/Limits", description: "Own words." };
  assert.equal(resolve(schema, root).description, "Own words.");
  assert.equal(resolve(schema, root).type, "object");
});

test("shapes are told by type", () => {
  const shape = (schema) => shapeOf(schema, root);
  assert.deepEqual(shape({ type: "integer" }), { kind: "number", isInteger: true, isOptional: false });
  assert.deepEqual(shape({ type: ["number", "null"] }), { kind: "number", isInteger: false, isOptional: true });
  assert.deepEqual(shape({ type: "array", items: { type: "number" } }), { kind: "numbers" });
  assert.deepEqual(shape({ type: "boolean" }), { kind: "switch" });
  assert.deepEqual(shape({ type: ["string", "null"] }), { kind: "text", isOptional: true });
  assert.equal(shape({ anyOf: [rule, { type: "null" }] }).kind, "choice");
  assert.equal(shape({ $ref: "#/$defs/Limits" }).fields.length, 3);
  assert.deepEqual(shape({}), { kind: "other" });
  assert.equal(isNullable({ anyOf: [rule, { type: "null" }] }), true);
  assert.equal(isNullable(rule), false);
});

test("variants are written as the server reads them", () => {
  const { variants } = shapeOf(rule, root);
  assert.deepEqual(variants.map(({ name, writing }) => [name, writing]), [
    ["constant", "tagged"],
    ["none", "word"],
    ["cells", "wrapped"],
  ]);
  assert.deepEqual(variants.map((variant) => valueOf(variant, root)), [
    { rule: "constant", rho: 0.1 },
    "none",
    { cells: 3 },
  ]);
  assert.equal(variantIn({ rule: "constant", rho: 1 }, variants).name, "constant");
  assert.equal(variantIn({ cells: 5 }, variants).name, "cells");
  assert.equal(variantIn("none", variants).name, "none");
  assert.equal(variantIn(undefined, variants).name, "constant");
});

test("ranges, units, labels, help and defaults come from the schema", () => {
  assert.deepEqual(rangeOf({ exclusiveMinimum: 0, maximum: 1 }), { min: 0, max: 1, excluded: [0, undefined] });
  assert.deepEqual(rangeOf({}), { min: null, max: null, excluded: [undefined, undefined] });
  assert.deepEqual(["max_steer_rad", "rate_rad_per_s", "wheelbase_m", "n_ants"].map(unitOf), ["rad", "rad/s", "m", ""]);
  assert.equal(labelOf("max_steer_rad"), "Max steer");
  assert.equal(labelOf("n_ants"), "Number of ants");
  assert.equal(labelOf("hybrid_astar"), "Hybrid A*");
  assert.equal(helpOf({ description: "A [`Cell`] of\nthe [map](crate::map).\n\nMore." }), "A Cell of the map. More.");
  assert.deepEqual(defaultOf({ $ref: "#/$defs/Limits" }, root), { n_ants: 20, rho: 0, name: null });
});
