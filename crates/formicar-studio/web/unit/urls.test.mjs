/** Addresses of the server, with the page's token. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { pageUrl, socketUrl, withToken } from "../src/urls.ts";

function at(url) {
  globalThis.location = new URL(url);
}

test("the token goes along, once and escaped", () => {
  at("http://localhost:8000/?token=a%26b");
  assert.equal(withToken("maps"), "maps?token=a%26b");
  assert.equal(withToken("maps?name=x"), "maps?name=x&token=a%26b");
  at("http://localhost:8000/");
  assert.equal(withToken("maps"), "maps");
});

test("the socket is as secure as the page and lies beside it", () => {
  at("https://robots.example/studio/?token=t#scene=1.x");
  assert.equal(socketUrl(), "wss://robots.example/studio/ws?token=t");
  at("http://localhost:8000/");
  assert.equal(socketUrl(), "ws://localhost:8000/ws");
});

test("a link keeps the address and exchanges the hash", () => {
  at("http://localhost:8000/?token=t#old");
  assert.equal(pageUrl("scene=1.x"), "http://localhost:8000/?token=t#scene=1.x");
});
