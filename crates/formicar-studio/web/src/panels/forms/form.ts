/** A form over a document: sections that fold, help below, only what was changed where wanted. */

import { h, setText } from "../../dom";
import type { JsonSchema } from "../../protocol";
import { Fields } from "./fields";
import type { Context, Help } from "./row";
import { isSame } from "./same";
import { defaultOf, helpOf, labelOf, resolve } from "./schema";

type Document = Record<string, unknown>;

interface Section {
  key: string;
  schema: JsonSchema;
  fields: Fields;
  element: HTMLElement;
  mark: HTMLElement;
}

/** Sections of an object, one for each of its fields that is an object itself. */
export class Form {
  readonly element = h("div", { class: "form" });
  readonly help = new HelpLine();
  private readonly context: Context;
  private sections: Section[] = [];
  private value: Document = {};

  constructor(
    root: JsonSchema,
    private readonly change: (value: Document) => void,
  ) {
    this.context = { root, point: (help) => this.help.show(help) };
  }

  /** Shows the sections that the preset has. */
  show(value: Document, preset: Document): void {
    this.value = value;
    const keys = Object.keys(preset).filter((key) => this.schemaOf(key) !== null);
    if (
      !isSame(
        keys,
        this.sections.map(({ key }) => key),
      )
    )
      this.build(keys, preset);
    for (const { key, schema, fields, mark, element } of this.sections) {
      const usual = preset[key] ?? defaultOf(schema, this.context.root);
      fields.show(value[key] ?? usual, usual);
      const nChanged = element.querySelectorAll("[data-changed]").length;
      setText(mark, nChanged === 0 ? "" : `${nChanged} changed`);
    }
  }

  /** Leaves out what is as in the preset; or all but what a word is found in. */
  filter(isOnlyChanged: boolean, word: string): void {
    this.element.toggleAttribute("data-only-changed", isOnlyChanged);
    const needle = word.trim().toLowerCase();
    this.element.toggleAttribute("data-filtered", needle !== "");
    for (const { element } of this.sections) {
      for (const row of element.querySelectorAll(".field")) {
        row.toggleAttribute(
          "data-hit",
          needle !== "" && (row.textContent ?? "").toLowerCase().includes(needle),
        );
      }
      if (needle !== "" || isOnlyChanged) element.setAttribute("open", "");
    }
  }

  private schemaOf(key: string): JsonSchema | null {
    const schema = this.context.root.properties?.[key];
    return schema && key !== "planner" ? resolve(schema, this.context.root) : null;
  }

  private build(keys: string[], preset: Document): void {
    this.sections = keys.flatMap((key) => {
      const schema = this.schemaOf(key);
      return schema ? [this.sectionOf(key, schema, preset[key])] : [];
    });
    this.element.replaceChildren(...this.sections.map(({ element }) => element));
  }

  private sectionOf(key: string, schema: JsonSchema, preset: unknown): Section {
    const set = (value: unknown): void => this.change({ ...this.value, [key]: value });
    const fields = new Fields(
      Object.entries(schema.properties ?? {}),
      key,
      this.context,
      preset,
      set,
    );
    const mark = h("span", { class: "section-mark" });
    const about = helpOf(this.context.root.properties?.[key] ?? schema);
    const element = h(
      "details",
      { class: "form-section" },
      h("summary", {}, h("span", {}, labelOf(key)), mark),
      h("p", { class: "section-about" }, about),
      ...fields.elements,
    );
    return { key, schema, fields, element, mark };
  }
}

/** The help of the field under the pointer, in a fixed position. */
export class HelpLine {
  readonly element: HTMLElement;
  private readonly path = h("code", {});
  private readonly range = h("span", { class: "help-range" });
  private readonly text = h("p", {});

  constructor() {
    this.element = h(
      "div",
      { class: "help-line", "data-unused": true, "aria-hidden": "true" },
      h("div", {}, this.path, this.range),
      this.text,
    );
    this.text.textContent = "Point at a parameter to read its description.";
  }

  show(help: Help): void {
    this.element.removeAttribute("data-unused");
    setText(this.path, help.path);
    setText(this.range, help.range);
    setText(this.text, help.text);
  }
}
