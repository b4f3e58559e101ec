/** Maps that were asked for, and maps that came. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { opens } from "../src/choices.ts";

test("a map that came late is not the one that was asked for last", () => {
  const asked = { builtin: "narrow-junction" };
  assert.ok(opens(asked, { name: "narrow-junction", hash: null }));
  assert.ok(!opens(asked, { name: "neighborhood", hash: null }));
  assert.ok(!opens(asked, { name: "narrow-junction", hash: "5f" }), "an upload of that name");
  assert.ok(opens({ hash: "5f" }, { name: "yard.yaml", hash: "5f" }));
  assert.ok(!opens({ hash: "5f" }, { name: "yard.yaml", hash: null }));
});
