/** What a page asks its server for, and what came of it. */

import type { MapChoice, MapMessage, VehicleChoice, VehicleMessage } from "./protocol";

/** The choice of a vehicle that the server was last given. */
export function vehicleChoice(vehicle: VehicleMessage): VehicleChoice {
  const { name, parameters } = vehicle;
  return name === "own" ? { parameters } : { preset: name };
}

/** Whether a map of the server is the one that a choice opens. */
export function opens(choice: MapChoice, { hash, name }: Pick<MapMessage, "hash" | "name">): boolean {
  return "hash" in choice ? hash === choice.hash : hash === null && name === choice.builtin;
}
