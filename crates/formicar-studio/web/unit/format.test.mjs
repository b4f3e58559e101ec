/** Numbers as the page writes them. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { count, degrees, fixed, meters, plain, plural, seconds } from "../src/format.ts";

test("minus signs are real, and zero has none", () => {
  assert.equal(fixed(-1.25, 1), "\u22121.3");
  assert.equal(fixed(-0.001, 2), "0.00");
  assert.equal(fixed(3, 0), "3");
});

test("a number that is absent or not finite is a dash", () => {
  for (const write of [(value) => fixed(value, 1), meters, seconds]) {
    for (const value of [null, undefined, Number.NaN, Infinity]) assert.equal(write(value), "\u2013");
  }
  assert.equal(degrees(null), "\u2013");
});

test("lengths and times are as fine as their size", () => {
  assert.deepEqual([0.0123, 1.234, 12.34, 1234.5].map(meters), ["0.012 m", "1.23 m", "12.3 m", "1235 m"]);
  assert.deepEqual(
    [2e-6, 0.0012, 0.25, 12.345, 250].map(seconds),
    ["2 \u00b5s", "1.2 ms", "250 ms", "12.35 s", "250 s"],
  );
  assert.equal(degrees(Math.PI / 2), "90.0\u00b0");
});

test("a plain number is short and reads back", () => {
  assert.equal(plain(0.1 + 0.2), "0.3");
  assert.equal(Number(plain(Math.PI, 6)), 3.14159);
});

test("counts have thin spaces and plurals", () => {
  assert.equal(count(1234567), "1\u2009234\u2009567");
  assert.equal(count(999), "999");
  assert.equal(plural(1, "cell"), "1 cell");
  assert.equal(plural(2000, "cell"), "2\u2009000 cells");
  assert.equal(plural(2, "vertex", "vertices"), "2 vertices");
});
