/** What says again which vehicle it is. */

import type { VehicleChoice, VehicleMessage } from "./protocol";

export function vehicleChoice(vehicle: VehicleMessage): VehicleChoice {
  const { name, parameters } = vehicle;
  return name === "own" ? { parameters } : { preset: name };
}
