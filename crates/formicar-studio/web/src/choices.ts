/** The choice of a vehicle that the server was last given. */

import type { VehicleChoice, VehicleMessage } from "./protocol";

export function vehicleChoice(vehicle: VehicleMessage): VehicleChoice {
  const { name, parameters } = vehicle;
  return name === "own" ? { parameters } : { preset: name };
}
