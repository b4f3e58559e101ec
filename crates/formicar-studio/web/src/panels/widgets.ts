/** Buttons, rows and inputs that all panels are made of. */

import { freshId, h, setValue } from "../dom";
import { plain } from "../format";
import { icon, type IconName } from "../icons";

interface ButtonOptions {
  icon?: IconName;
  class?: string;
  title?: string;
}

/** A button with words on it. */
export function button(
  label: string,
  press: () => void,
  options: ButtonOptions = {},
): HTMLButtonElement {
  return h(
    "button",
    {
      type: "button",
      class: `button ${options.class ?? ""}`,
      title: options.title,
      onclick: press,
    },
    options.icon ? icon(options.icon) : null,
    h("span", {}, label),
  );
}

/** A button with an icon alone; its label is read out and shown as a tip. */
export function iconButton(name: IconName, label: string, press: () => void): HTMLButtonElement {
  return h(
    "button",
    { type: "button", class: "icon-button", "aria-label": label, title: label, onclick: press },
    icon(name),
  );
}

/** A part of a panel under a heading, with buttons beside it. */
export function section(
  title: string,
  aside: Node | null,
  ...children: (Node | null)[]
): HTMLElement {
  const id = freshId("section");
  return h(
    "section",
    { class: "section", "aria-labelledby": id },
    h("div", { class: "section-head" }, h("h2", { id }, title), aside),
    ...children,
  );
}

/** A label with what it labels to its right. */
export function row(label: string, control: HTMLElement, unit = ""): HTMLElement {
  if (control.id === "") control.id = freshId("field");
  return h(
    "div",
    { class: "row" },
    h("label", { for: control.id }, label),
    h(
      "span",
      { class: "control" },
      control,
      unit === "" ? null : h("span", { class: "unit" }, unit),
    ),
  );
}

export interface NumberOptions {
  label?: string;
  step?: number;
  min?: number;
  max?: number;
  /** Numbers that are outside all the same: the ends of an open range. */
  excluded?: readonly (number | undefined)[];
  /** Whether it may be left empty; `change` then gets null. */
  isOptional?: boolean;
  placeholder?: string;
}

/** An input of one number; `change` gets only numbers within the range. */
export class NumberInput {
  readonly element: HTMLInputElement;

  constructor(
    private readonly options: NumberOptions,
    private readonly change: (value: number | null) => void,
  ) {
    this.element = h("input", {
      type: "number",
      class: "number",
      inputmode: "decimal",
      step: options.step ?? "any",
      min: options.min,
      max: options.max,
      placeholder: options.placeholder,
      "aria-label": options.label,
      onchange: () => this.changed(),
    });
  }

  show(value: number | null | undefined, digits = 12): void {
    const text = value === null || value === undefined ? "" : plain(value, digits);
    setValue(this.element, text);
    if (document.activeElement !== this.element) this.element.removeAttribute("aria-invalid");
  }

  private changed(): void {
    const { min = -Infinity, max = Infinity, excluded = [], isOptional = false } = this.options;
    const text = this.element.value.trim();
    const value = text === "" ? null : Number(text);
    const isWithin = (number: number): boolean =>
      number >= min && number <= max && !excluded.includes(number);
    const isFine =
      value === null ? isOptional && !this.element.validity.badInput : isWithin(value);
    this.element.toggleAttribute("data-out-of-range", !isFine);
    if (isFine) {
      this.element.removeAttribute("aria-invalid");
      this.change(value);
    } else {
      this.element.setAttribute("aria-invalid", "true");
    }
  }
}

/** One of several: value and label of each. */
export class Select<T extends string> {
  readonly element: HTMLSelectElement;

  constructor(
    options: readonly (readonly [T, string])[],
    change: (value: T) => void,
    label?: string,
  ) {
    this.element = h(
      "select",
      { "aria-label": label, onchange: () => change(this.element.value as T) },
      ...options.map(([value, text]) => h("option", { value }, text)),
    );
  }

  show(value: T): void {
    setValue(this.element, value);
  }
}

/** A few choices side by side, one of them pressed. */
export class Segments<T extends string> {
  readonly element: HTMLElement;
  private readonly buttons: Map<T, HTMLButtonElement>;

  constructor(
    label: string,
    options: readonly (readonly [T, string])[],
    change: (value: T) => void,
  ) {
    this.buttons = new Map(
      options.map(([value, text]) => [
        value,
        h(
          "button",
          { type: "button", "aria-pressed": "false", onclick: () => change(value) },
          text,
        ),
      ]),
    );
    this.element = h(
      "div",
      { class: "segments", role: "group", "aria-label": label },
      ...this.buttons.values(),
    );
  }

  show(value: T): void {
    for (const [key, element] of this.buttons)
      element.setAttribute("aria-pressed", String(key === value));
  }
}
