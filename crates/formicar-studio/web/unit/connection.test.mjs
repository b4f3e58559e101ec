/** Messages of the server. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { decode, textOf } from "../src/connection.ts";

test("the text of an answer is what the server sent", () => {
  const answer = '{"schema":"formicar/answer/1","reason":"\\",\\"answer\\":{}","x":-0.0,"y":1.50}';
  const sent = `{"type":"answer","plan":3,"slot":"a","cli":"a \\",\\"answer\\":1","answer":${answer}}`;
  const [message, payload] = decode(sent);
  assert.equal(textOf(message), answer);
  assert.equal(message.answer.y, 1.5);
  assert.equal(payload.length, 0);
});

test("an answer of the page's own is written by the page", () => {
  assert.equal(textOf({ answer: { schema: "formicar/answer/1" } }), '{"schema":"formicar/answer/1"}');
});
