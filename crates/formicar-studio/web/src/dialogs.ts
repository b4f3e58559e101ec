/** Dialogs: opening map files, and the keys of the page. */

import type { Actions } from "./actions";
import { h } from "./dom";
import { count } from "./format";
import { button, iconButton, NumberInput, row } from "./panels/widgets";
import type { Store } from "./store";

const ACCEPT = ".yaml,.yml,.pgm,.png,.map,.csv,.txt,.gif,.jpg,.jpeg,.bmp";
/** A description with its own resolution; everything else leaves it open. */
const DESCRIBED = /\.ya?ml$/i;
const USUAL_M: Record<string, number> = { png: 0.05, pgm: 0.05, map: 1, csv: 1, txt: 1 };

const KEYS: readonly (readonly [string, string])[] = [
  ["M, P, E", "move, paint, erase"],
  ["[ and ]", "smaller, larger brush"],
  ["Arrows, + and \u2212", "on the map: pan, zoom"],
  ["F", "whole map"],
  ["Space", "play or pause the run"],
  [", and .", "one frame back, one ahead"],
  ["R", "plan, and show the run from its beginning"],
  ["Esc", "stop planning; back to move"],
  ["Ctrl Z, Ctrl Shift Z", "undo, redo"],
  ["1 to 6", "panels"],
  ["C", "charts"],
  ["?", "this list"],
];

/** Asks for files of a map, then opens them. */
export function chooseFiles(store: Store, actions: Actions): void {
  const input = h("input", { type: "file", multiple: true, accept: ACCEPT });
  input.addEventListener("change", () => openFiles([...(input.files ?? [])], store, actions));
  input.click();
}

/** Opens files; asks for the side of a cell where they do not say. */
export function openFiles(files: File[], store: Store, actions: Actions): void {
  const [first] = files;
  if (first === undefined) return;
  const limit = store.state.catalog?.limits.max_upload_bytes ?? Infinity;
  const bytes = files.reduce((sum, file) => sum + file.size, 0);
  if (bytes > limit) {
    store.set({
      error: `${first.name}: ${count(bytes)} bytes; at most ${count(limit)} can be opened`,
    });
  } else if (files.some(({ name }) => DESCRIBED.test(name))) {
    void actions.upload(files);
  } else {
    askResolution(first, (resolution) => void actions.upload(files, resolution));
  }
}

/** Takes files that are dropped anywhere on the page. */
export function acceptDrops(host: HTMLElement, store: Store, actions: Actions): void {
  const veil = h(
    "div",
    { class: "drop-veil", hidden: true, "aria-hidden": "true" },
    h("p", {}, "Drop a map: ROS YAML with its image, PNG, PGM, MovingAI, CSV"),
  );
  host.append(veil);
  const carriesFiles = (event: DragEvent): boolean =>
    event.dataTransfer?.types.includes("Files") ?? false;
  addEventListener("dragover", (event) => {
    if (!carriesFiles(event)) return;
    event.preventDefault();
    veil.hidden = false;
  });
  addEventListener("dragleave", (event) => {
    if (event.relatedTarget === null) veil.hidden = true;
  });
  addEventListener("drop", (event) => {
    veil.hidden = true;
    if (!carriesFiles(event)) return;
    event.preventDefault();
    openFiles([...(event.dataTransfer?.files ?? [])], store, actions);
  });
}

export function showKeys(): void {
  const list = h(
    "dl",
    { class: "keys" },
    ...KEYS.map(([keys, what]) => h("div", {}, h("dt", {}, keys), h("dd", {}, what))),
  );
  openDialog("Keys", list);
}

function askResolution(file: File, open: (resolutionM: number) => void): void {
  const kind = file.name.split(".").pop()?.toLowerCase() ?? "";
  let resolution = USUAL_M[kind] ?? 0.05;
  const input = new NumberInput({ min: 0.001, max: 1000, step: 0.01 }, (value) => {
    if (value !== null) resolution = value;
  });
  input.show(resolution);
  const dialog = openDialog(
    `Open ${file.name}`,
    h(
      "p",
      { class: "about" },
      "The file does not hold its cell size. A ROS YAML, dropped together with its image, does.",
    ),
    row("Cell size", input.element, "m"),
    h(
      "div",
      { class: "buttons" },
      button("Open", () => finish(), { class: "primary" }),
      button("Cancel", () => dialog.close()),
    ),
  );
  const finish = (): void => {
    dialog.close();
    open(resolution);
  };
  input.element.addEventListener("keydown", (event) => {
    if (event.key !== "Enter") return;
    event.preventDefault();
    input.element.blur();
    finish();
  });
  input.element.select();
}

function openDialog(title: string, ...content: HTMLElement[]): HTMLDialogElement {
  const close = iconButton("close", "Close", () => dialog.close());
  const dialog: HTMLDialogElement = h(
    "dialog",
    { class: "dialog", "aria-label": title },
    h("div", { class: "dialog-head" }, h("h2", {}, title), close),
    ...content,
  );
  dialog.addEventListener("close", () => dialog.remove());
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();
  });
  document.body.append(dialog);
  dialog.showModal();
  return dialog;
}
