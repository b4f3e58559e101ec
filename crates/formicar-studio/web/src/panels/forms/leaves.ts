/** Fields of single values: numbers, switches, and text for everything else. */

import { h } from "../../dom";
import { plain } from "../../format";
import { NumberInput } from "../widgets";
import { Row, type Field, type Parts } from "./row";
import { rangeOf, unitOf, type Range } from "./schema";

export class NumberField implements Field {
  readonly element: HTMLElement;
  private readonly row: Row;
  private readonly input: NumberInput;

  constructor(parts: Parts, isInteger: boolean, isOptional: boolean) {
    const range = rangeOf(parts.schema);
    const take = (value: number | null): void =>
      parts.change(value !== null && isInteger ? Math.round(value) : value);
    this.input = new NumberInput(
      {
        min: range.min ?? undefined,
        max: range.max ?? undefined,
        excluded: range.excluded,
        step: isInteger ? 1 : stepOf(range, parts.schema.default),
        isOptional,
        placeholder: isOptional ? "none" : undefined,
      },
      take,
    );
    this.row = new Row(parts, this.input.element, unitOf(parts.key));
    this.element = this.row.element;
  }

  show(value: unknown, preset: unknown): void {
    this.input.show(typeof value === "number" ? value : null);
    this.row.mark(value ?? null, preset ?? null);
  }

  hint(value: number | null): void {
    this.input.element.placeholder = value === null ? "none" : plain(value, 4);
  }
}

export class SwitchField implements Field {
  readonly element: HTMLElement;
  private readonly row: Row;
  private readonly box: HTMLInputElement;

  constructor(parts: Parts) {
    this.box = h("input", { type: "checkbox", onchange: () => parts.change(this.box.checked) });
    this.row = new Row(parts, this.box, "");
    this.element = this.row.element;
  }

  show(value: unknown, preset: unknown): void {
    this.box.checked = value === true;
    this.row.mark(value, preset);
  }
}

/** Lists of numbers, separated by commas; and whatever has no field of its own, as JSON. */
export class TextField implements Field {
  readonly element: HTMLElement;
  private readonly row: Row;
  private readonly input: HTMLInputElement;

  constructor(parts: Parts) {
    this.input = h("input", {
      type: "text",
      class: "text",
      spellcheck: "false",
      onchange: () => this.changed(parts.change),
    });
    this.row = new Row(parts, this.input, unitOf(parts.key));
    this.element = this.row.element;
  }

  show(value: unknown, preset: unknown): void {
    const text = isNumbers(value)
      ? value.map((one) => plain(one)).join(", ")
      : JSON.stringify(value);
    if (document.activeElement !== this.input) this.input.value = value === null ? "" : text;
    this.row.mark(value, preset);
  }

  private changed(change: Parts["change"]): void {
    const value = read(this.input.value);
    this.input.toggleAttribute("aria-invalid", value === undefined);
    if (value !== undefined) change(value);
  }
}

function isNumbers(value: unknown): value is number[] {
  return Array.isArray(value) && value.every((one) => typeof one === "number");
}

/** A list of numbers or JSON; undefined for neither. */
function read(text: string): unknown {
  if (text.trim() === "") return null;
  const numbers = text.split(",").map((part) => (part.trim() === "" ? Number.NaN : Number(part)));
  if (numbers.every((one) => Number.isFinite(one))) return numbers;
  try {
    return JSON.parse(text);
  } catch {
    return undefined;
  }
}

/** The step of the arrow keys: a tenth of the default, as a power of ten. */
function stepOf(range: Range, usual: unknown): number {
  const size = typeof usual === "number" && usual !== 0 ? Math.abs(usual) : (range.max ?? 1);
  return Math.min(10 ** Math.floor(Math.log10(Math.min(size, 1e6)) - 0.3), 10);
}
