/** Fields of a form, built from a JSON schema; each shows a value beside its preset. */

import { freshId, h, setText } from "../../dom";
import type { JsonSchema } from "../../protocol";
import { NumberField, SwitchField, TextField } from "./leaves";
import { Row, type Context, type Field, type Parts } from "./row";
import {
  defaultOf,
  helpOf,
  isNullable,
  labelOf,
  resolve,
  shapeOf,
  valueOf,
  variantIn,
  type Variant,
} from "./schema";

type Values = Record<string, unknown>;

/** The field for a schema. */
function fieldFor(parts: Parts): Field {
  const shape = shapeOf(parts.schema, parts.context.root);
  switch (shape.kind) {
    case "number":
      return new NumberField(parts, shape.isInteger, shape.isOptional);
    case "choice":
      return new ChoiceField(parts, shape.variants);
    case "object":
      return new GroupField(parts, shape.fields);
    case "switch":
      return new SwitchField(parts);
    default:
      return new TextField(parts);
  }
}

/** The fields of an object, in the order of its preset, for schemas are sorted by name; `path`
 * names the object in configuration files. */
export class Fields {
  readonly elements: HTMLElement[];
  private readonly fields: [string, JsonSchema, Field][];
  private value: Values = {};

  constructor(
    entries: [string, JsonSchema][],
    path: string,
    private readonly context: Context,
    preset: unknown,
    change: (value: Values) => void,
  ) {
    const presets = asValues(preset);
    this.fields = inOrder(entries, Object.keys(presets)).map(([key, brief]) => {
      const schema = resolve(brief, context.root);
      const inner = path === "" ? key : `${path}.${key}`;
      const set = (value: unknown): void => change({ ...this.value, [key]: value });
      const parts = { key, schema, path: inner, context, preset: presets[key], change: set };
      return [key, schema, fieldFor(parts)];
    });
    this.elements = this.fields.map(([, , field]) => field.element);
  }

  show(value: unknown, preset: unknown): void {
    this.value = asValues(value);
    const presets = asValues(preset);
    for (const [key, schema, field] of this.fields) {
      const usual = presets[key] ?? defaultOf(schema, this.context.root);
      field.show(this.value[key] ?? (isNullable(schema) ? null : usual), usual);
    }
  }

  /** Numbers that follow where they are left out, by their names. */
  hint(values: Record<string, number | null>): void {
    for (const [key, , field] of this.fields) if (key in values) field.hint?.(values[key] ?? null);
  }
}

/** One of several shapes, with the fields of the one that is chosen below. */
class ChoiceField implements Field {
  readonly element: HTMLElement;
  private readonly row: Row;
  private readonly select: HTMLSelectElement;
  private readonly about = h("p", { class: "variant-about" });
  private readonly inner = h("div", { class: "nested" });
  private fields: Fields | null = null;
  private shown: Variant | null = null;

  constructor(
    private readonly parts: Parts,
    private readonly variants: Variant[],
  ) {
    const options = variants.map(({ name }) => h("option", { value: name }, labelOf(name)));
    this.select = h("select", { onchange: () => this.choose() }, ...options);
    this.row = new Row(parts, this.select, "");
    this.element = h("div", { class: "choice" }, this.row.element, this.about, this.inner);
  }

  show(value: unknown, preset: unknown): void {
    const variant = variantIn(value, this.variants);
    if (!variant) return;
    const usual = variantIn(preset, this.variants);
    const base = usual === variant ? preset : valueOf(variant, this.parts.context.root);
    if (variant !== this.shown) this.build(variant, base);
    this.select.value = variant.name;
    this.fields?.show(value, base);
    this.row.mark(variant.name, usual?.name);
  }

  private choose(): void {
    const variant = this.variants.find(({ name }) => name === this.select.value);
    if (variant) this.parts.change(valueOf(variant, this.parts.context.root));
  }

  private build(variant: Variant, preset: unknown): void {
    const { path, context, change } = this.parts;
    this.shown = variant;
    setText(this.about, variant.about);
    this.about.hidden = isPlain(variant);
    const tag = variant.writing === "tagged" ? { rule: variant.name } : {};
    this.fields = new Fields(variant.fields, path, context, preset, (value) =>
      change({ ...value, ...tag }),
    );
    this.inner.replaceChildren(...this.fields.elements);
  }
}

/** An object within an object, under a heading of its own. */
class GroupField implements Field {
  readonly element: HTMLElement;
  private readonly fields: Fields;

  constructor(parts: Parts, entries: [string, JsonSchema][]) {
    this.fields = new Fields(entries, parts.path, parts.context, parts.preset, parts.change);
    const id = freshId("group");
    this.element = h(
      "div",
      { class: "group", role: "group", "aria-labelledby": id },
      h("h3", { id, title: helpOf(parts.schema) }, labelOf(parts.key)),
      h("div", { class: "nested" }, ...this.fields.elements),
    );
  }

  show(value: unknown, preset: unknown): void {
    this.fields.show(value, preset);
  }
}

function inOrder(entries: [string, JsonSchema][], keys: string[]): [string, JsonSchema][] {
  const place = (key: string): number => (keys.includes(key) ? keys.indexOf(key) : keys.length);
  return [...entries].sort(([a], [b]) => place(a) - place(b));
}

/** Whether the description adds nothing to the name. */
function isPlain({ name, about }: Variant): boolean {
  return about.replace(/\.$/, "").toLowerCase() === labelOf(name).toLowerCase();
}

function asValues(value: unknown): Values {
  return typeof value === "object" && value !== null ? (value as Values) : {};
}
