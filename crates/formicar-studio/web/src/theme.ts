/** Light and dark: as the system has it, or as chosen. */

export type ThemeChoice = "auto" | "light" | "dark";

const KEY = "formicar-theme";
const CHOICES: readonly ThemeChoice[] = ["auto", "light", "dark"];

const system = matchMedia("(prefers-color-scheme: dark)");
const listeners: (() => void)[] = [];
let choice: ThemeChoice = remembered();

export function themeChoice(): ThemeChoice {
  return choice;
}

export function isDark(): boolean {
  return choice === "dark" || (choice === "auto" && system.matches);
}

export function chooseTheme(next: ThemeChoice): void {
  choice = next;
  try {
    localStorage.setItem(KEY, next);
  } catch {
    // Where nothing can be kept, the choice lasts as long as the page.
  }
  apply();
}

/** Calls `call` whenever colors have changed. */
export function onThemeChange(call: () => void): void {
  listeners.push(call);
}

/** A color of `theme.css` by its name, without the dashes. */
export function color(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

export function startTheme(): void {
  system.addEventListener("change", apply);
  apply();
}

function apply(): void {
  document.documentElement.dataset.theme = isDark() ? "dark" : "light";
  for (const call of listeners) call();
}

function remembered(): ThemeChoice {
  try {
    const kept = localStorage.getItem(KEY);
    return CHOICES.find((one) => one === kept) ?? "auto";
  } catch {
    return "auto";
  }
}
