/** Maps on their way to the server. */

import { notify } from "./notice";
import type { UploadAnswer } from "./protocol";
import type { MapState } from "./store";
import { withToken } from "./urls";

/** Uploads files that make up a map, and returns the hash that opens it.
 *
 * Throws what is wrong with them. */
export async function uploadMap(files: File[], resolutionM?: number): Promise<string> {
  const form = new FormData();
  for (const file of files) form.append("files", file, file.name);
  if (resolutionM !== undefined) form.append("resolution_m", String(resolutionM));
  const response = await fetch(withToken("api/maps"), { method: "POST", body: form });
  const answer = (await response.json()) as UploadAnswer;
  if ("error" in answer) throw new Error(answer.error);
  for (const warning of answer.warnings) notify(`${answer.name}: ${warning}`);
  return answer.hash;
}

/** A map as a ROS map file with a raw image, which holds its values as they are. */
export function filesOf(map: MapState): File[] {
  const { n_cols, n_rows, values } = map;
  const stem = map.name.replace(/\.[^.]*$/, "");
  const head = new TextEncoder().encode(`P5\n${n_cols} ${n_rows}\n255\n`);
  const image = new Uint8Array(head.length + values.length);
  image.set(head);
  // Images begin at the top; what is unknown, -1, becomes 255.
  for (let row = 0; row < n_rows; row += 1) {
    const from = (n_rows - 1 - row) * n_cols;
    image.set(values.subarray(from, from + n_cols), head.length + row * n_cols);
  }
  const yaml = [
    `image: ${JSON.stringify(`${stem}.pgm`)}`,
    "mode: raw",
    `resolution: ${map.resolution_m}`,
    `origin: [${map.origin.join(", ")}]`,
    "negate: 0",
    "occupied_thresh: 0.65",
    "free_thresh: 0.196",
  ].join("\n");
  return [new File([yaml], `${stem}.yaml`), new File([image], `${stem}.pgm`)];
}
