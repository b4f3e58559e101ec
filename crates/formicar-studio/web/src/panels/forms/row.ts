/** The row of a form field: it marks a changed value and resets it. */

import { freshId, h } from "../../dom";
import { count, plain } from "../../format";
import type { JsonSchema } from "../../protocol";
import { iconButton } from "../widgets";
import { isSame } from "./same";
import { helpOf, labelOf, rangeOf, shapeOf } from "./schema";

/** The help of a field. */
export interface Help {
  path: string;
  text: string;
  range: string;
}

/** The part that all fields of a form share. */
export interface Context {
  root: JsonSchema;
  /** Hears which field is pointed at. */
  point: (help: Help) => void;
}

export interface Field {
  readonly element: HTMLElement;
  /** Shows a value and marks the field if it differs from the preset. */
  show(value: unknown, preset: unknown): void;
  /** Tells what takes the place of a number that is left out. */
  hint?(value: number | null): void;
}

/** The parts of a field. */
export interface Parts {
  key: string;
  /** Its schema, with references followed. */
  schema: JsonSchema;
  path: string;
  context: Context;
  /** The preset that it is built for. */
  preset: unknown;
  change: (value: unknown) => void;
}

/** One row: label, control, unit, and what takes it back to the preset. */
export class Row {
  readonly element: HTMLElement;
  private preset: unknown;

  constructor(parts: Parts, control: HTMLElement, unit: string) {
    const { key, schema, path, context, change } = parts;
    const about = freshId("about");
    control.id = freshId("field");
    control.setAttribute("aria-describedby", about);
    const reset = iconButton("reset", `Reset ${labelOf(key)}`, () => change(this.preset));
    reset.classList.add("reset");
    const [text, range] = [helpOf(schema), rangeText(schema, context.root)];
    const point = (): void =>
      context.point({ path, text, range: [range, this.presetText()].filter(Boolean).join(", ") });
    this.element = h(
      "div",
      { class: "row field", onpointerenter: point, onfocusin: point },
      h("label", { for: control.id }, labelOf(key)),
      reset,
      h("span", { class: "control" }, control, h("span", { class: "unit" }, unit)),
      h("span", { id: about, class: "sr-only" }, `${text} ${range}`),
    );
  }

  private presetText(): string {
    return typeof this.preset === "number" ? `preset ${plain(this.preset)}` : "";
  }

  mark(value: unknown, preset: unknown): void {
    this.preset = preset;
    this.element.toggleAttribute("data-changed", !isSame(value, preset));
  }
}

function rangeText(schema: JsonSchema, root: JsonSchema): string {
  if (shapeOf(schema, root).kind !== "number") return "";
  const { min, max } = rangeOf(schema);
  const text = (value: number): string => (Number.isInteger(value) ? count(value) : plain(value));
  if (min !== null && max !== null) return `${text(min)} to ${text(max)}`;
  return min !== null ? `at least ${text(min)}` : "";
}
