/** Transient notices, and errors, which stay until they are closed or outdated. */

import { h, setText } from "./dom";
import { icon } from "./icons";
import type { Store } from "./store";
import { iconButton } from "./panels/widgets";

const SHOWN_MS = 4000;
const ERROR_SHOWN_MS = 15000;

const toast = h("div", { class: "toast", role: "status", "aria-live": "polite", hidden: true });
let timer = 0;
let errorTimer = 0;

/** Shows a notice for a few seconds. */
export function notify(text: string): void {
  setText(toast, text);
  toast.hidden = false;
  clearTimeout(timer);
  timer = window.setTimeout(() => {
    toast.hidden = true;
  }, SHOWN_MS);
}

export function showNotices(host: HTMLElement, store: Store): void {
  const words = h("p", {});
  const close = iconButton("close", "Close this message", () => store.set({ error: null }));
  const error = h(
    "div",
    { class: "error", role: "alert", hidden: true },
    icon("alert"),
    words,
    close,
  );
  host.append(error, toast);
  store.watch(["error"], (state) => {
    error.hidden = state.error === null;
    setText(words, state.error ?? "");
    clearTimeout(errorTimer);
    if (state.error !== null)
      errorTimer = window.setTimeout(() => store.set({ error: null }), ERROR_SHOWN_MS);
  });
}
