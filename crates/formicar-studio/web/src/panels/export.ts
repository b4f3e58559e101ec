/** Exports: a link, the path, a picture, the command line and the configuration. */

import type { Actions } from "../actions";
import { textOf } from "../connection";
import { h, setText } from "../dom";
import { plain } from "../format";
import { notify } from "../notice";
import type { PoseRecord, Slot } from "../protocol";
import { saveFile } from "../save";
import { answerOf, shownSlot } from "../state";
import type { State, Store } from "../store";
import { SlotChoice } from "./slot";
import { button, section } from "./widgets";

/** As `formicar plan --out path.csv` writes them. */
const COLUMNS: readonly [string, keyof PoseRecord][] = [
  ["x", "x"],
  ["y", "y"],
  ["heading", "heading"],
  ["s", "s"],
  ["direction", "direction"],
  ["curvature", "curvature"],
  ["steer", "steer"],
  ["clearance", "clearance"],
  ["speed", "speed"],
  ["time", "time"],
];

export function exportPanel(host: HTMLElement, store: Store, actions: Actions): void {
  new Panel(host, store, actions);
}

class Panel {
  private readonly slots: SlotChoice;
  private readonly link = h("input", {
    type: "text",
    class: "text mono",
    readonly: true,
    "aria-label": "Link to this scene",
  });
  private readonly cli = h("pre", { class: "code", tabindex: 0, "aria-label": "Command line" });
  private readonly toml = h("pre", {
    class: "code tall",
    tabindex: 0,
    "aria-label": "Configuration as TOML",
  });
  private readonly needPath: HTMLButtonElement[];
  private readonly needAnswer: HTMLButtonElement[];

  constructor(
    host: HTMLElement,
    private readonly store: Store,
    private readonly actions: Actions,
  ) {
    this.slots = new SlotChoice(store);
    const csv = button("Path, CSV", () => this.saveCsv(), { icon: "download" });
    const json = button("Answer, JSON", () => this.saveJson(), { icon: "download" });
    const svg = button("SVG", () => actions.picture(this.slot, "svg"), { icon: "download" });
    const png = button("PNG", () => actions.picture(this.slot, "png"), { icon: "download" });
    const copyCli = button("Copy", () => copy(this.cli.textContent ?? "", "Command line"), {
      icon: "copy",
      class: "quiet",
    });
    const copyToml = button("Copy", () => copy(this.toml.textContent ?? "", "Configuration"), {
      icon: "copy",
      class: "quiet",
    });
    const saveToml = button("TOML", () => this.saveToml(), { icon: "download", class: "quiet" });
    this.needPath = [csv];
    this.needAnswer = [json, svg, png, copyCli, copyToml, saveToml];
    host.append(
      this.slots.element,
      section(
        "Link",
        button("Copy link", () => void this.copyLink(), { icon: "link", class: "primary" }),
        h(
          "p",
          { class: "about" },
          "Holds map, vehicle, request, planners and seeds. It opens in any formicar studio.",
        ),
        this.link,
      ),
      section("Path", null, h("div", { class: "buttons" }, csv, json)),
      section("Picture", null, h("div", { class: "buttons" }, svg, png)),
      section("Command line", copyCli, this.cli),
      section("Configuration", h("span", { class: "head-buttons" }, copyToml, saveToml), this.toml),
    );
    this.link.addEventListener("focus", () => this.link.select());
    this.link.hidden = true;
    store.watch(["slots", "shown"], (state) => this.show(state));
  }

  private get slot(): Slot {
    return this.store.state.shown;
  }

  private show(state: Readonly<State>): void {
    this.slots.show(state);
    const slot = shownSlot(state);
    const end = slot.plan?.end ?? null;
    const hasPath = Boolean(answerOf(slot)?.path);
    for (const one of this.needPath) one.disabled = !hasPath;
    for (const one of this.needAnswer) one.disabled = end === null;
    if (end === null) return;
    setText(this.cli, inLines(end.cli));
    setText(this.toml, end.toml);
  }

  private async copyLink(): Promise<void> {
    const url = await this.actions.link();
    this.link.hidden = false;
    this.link.value = url;
    await copy(url, "Link");
  }

  private saveJson(): void {
    const end = shownSlot(this.store.state).plan?.end;
    if (end) saveFile(this.stem(), "json", `${textOf(end)}\n`);
  }

  private saveCsv(): void {
    const poses = answerOf(shownSlot(this.store.state))?.path?.poses;
    if (poses) saveFile(this.stem(), "csv", csvOf(poses));
  }

  private saveToml(): void {
    saveFile(shownSlot(this.store.state).config.planner, "toml", this.toml.textContent ?? "");
  }

  private stem(): string {
    return `${this.store.state.map?.name ?? "map"}-${shownSlot(this.store.state).config.planner}`;
  }
}

function csvOf(poses: readonly PoseRecord[]): string {
  const columns = COLUMNS.filter(([, key]) => poses.some((pose) => typeof pose[key] === "number"));
  const lines = poses.map((pose) => columns.map(([, key]) => numberText(pose[key])).join(","));
  return `${columns.map(([name]) => name).join(",")}\n${lines.join("\n")}\n`;
}

function numberText(value: number | null | undefined): string {
  return typeof value === "number" ? plain(value, 17) : "";
}

/** A command with each option on a line of its own, as a shell reads it too. */
function inLines(command: string): string {
  return command.replace(/ (?=--\w)/g, " \\\n  ");
}

async function copy(text: string, what: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
    notify(`${what} copied`);
  } catch {
    notify(`${what}: the browser does not let the page copy; select the text instead`);
  }
}
