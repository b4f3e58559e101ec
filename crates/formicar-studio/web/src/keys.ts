/** Keys for what stands beside the map; those of the map and its tools are in `map/keys`. */

import type { Actions } from "./actions";
import { showKeys } from "./dialogs";
import { isTyping } from "./map/keys";
import type { Tabs } from "./panels/tabs";
import type { Fit } from "./panels/toolbar";

const PANELS = ["scene", "planner", "vehicle", "compare", "drive", "export"];

export function listenToKeys(
  actions: Actions,
  tabs: Tabs,
  views: () => readonly Fit[],
  toggleCharts: () => void,
): void {
  const keys: Record<string, () => void> = {
    f: () => views().forEach((view) => view.fit()),
    r: () => actions.plan(),
    c: toggleCharts,
    "?": showKeys,
    Escape: () => actions.cancel(),
  };
  PANELS.forEach((id, i) => {
    keys[String(i + 1)] = () => tabs.toggle(id);
  });
  addEventListener("keydown", (event) => {
    const isOther = event.defaultPrevented || event.altKey || event.ctrlKey || event.metaKey;
    const call = isOther || isTyping(event.target) ? undefined : keys[event.key];
    if (call === undefined) return;
    event.preventDefault();
    call();
  });
}
