/** The panels, one of them open: a rail beside them, on a phone a bar below. */

import { h } from "../dom";
import { icon, type IconName } from "../icons";

export interface Tab {
  id: string;
  label: string;
  icon: IconName;
  panel: HTMLElement;
}

export class Tabs {
  readonly bar: HTMLElement;
  private readonly buttons: HTMLButtonElement[];

  /** `root` carries the id of the open panel as `data-tab`, empty where all are closed. */
  constructor(
    private readonly root: HTMLElement,
    private readonly tabs: readonly Tab[],
  ) {
    this.buttons = tabs.map((tab) => this.button(tab));
    this.bar = h(
      "div",
      {
        class: "tabs",
        role: "tablist",
        "aria-label": "Panels",
        onkeydown: (event: KeyboardEvent) => this.key(event),
      },
      ...this.buttons,
    );
    for (const { id, label, panel } of tabs) {
      panel.id ||= `panel-${id}`;
      if (!panel.hasAttribute("role")) panel.setAttribute("role", "tabpanel");
      panel.setAttribute("aria-label", label);
    }
    this.open(tabs[0]?.id ?? "");
  }

  /** Opens a panel. */
  open(id: string): void {
    this.root.dataset.tab = id;
    const isNone = this.tabs.every((tab) => tab.id !== id);
    this.tabs.forEach((tab, i) => {
      const isOpen = tab.id === id;
      tab.panel.toggleAttribute("data-open", isOpen);
      const element = this.buttons[i];
      element?.setAttribute("aria-selected", String(isOpen));
      if (element) element.tabIndex = isOpen || (isNone && i === 0) ? 0 : -1;
    });
    dispatchEvent(new Event("resize"));
  }

  /** Opens a panel, or closes it if it is open. */
  toggle(id: string): void {
    this.open(this.root.dataset.tab === id ? "" : id);
  }

  get openId(): string {
    return this.root.dataset.tab ?? "";
  }

  private button({ id, label, icon: name, panel }: Tab): HTMLButtonElement {
    return h(
      "button",
      {
        type: "button",
        role: "tab",
        id: `tab-${id}`,
        class: `tab tab-${id}`,
        "aria-controls": panel.id || `panel-${id}`,
        onclick: () => this.toggle(id),
      },
      icon(name),
      h("span", {}, label),
    );
  }

  private key(event: KeyboardEvent): void {
    const step = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 }[event.key];
    if (step === undefined) return;
    event.preventDefault();
    const shown = this.buttons.filter((element) => element.offsetParent !== null);
    const now = shown.indexOf(document.activeElement as HTMLButtonElement);
    const next = shown[(now + step + shown.length) % shown.length];
    const tab = this.tabs[this.buttons.indexOf(next as HTMLButtonElement)];
    if (tab === undefined) return;
    this.open(tab.id);
    next?.focus();
  }
}
