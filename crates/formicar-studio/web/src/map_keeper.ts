/** Edited maps that the server keeps under the hash of their content. */

import type { Connection } from "./connection";
import type { MapState } from "./store";

interface Waiting {
  done: (hash: string) => void;
  failed: (why: Error) => void;
}

export class MapKeeper {
  /** The state of the map that was kept last. */
  private kept: { values: Int8Array; version: number; hash: string } | null = null;
  private readonly waiting: Waiting[] = [];

  constructor(private readonly connection: Connection) {}

  /** The hash under which the map is kept as it is now. */
  keep(map: MapState): Promise<string> {
    const { values, version } = map;
    if (this.kept?.values === values && this.kept.version === version) {
      return Promise.resolve(this.kept.hash);
    }
    return new Promise((resolve, failed) => {
      const done = (hash: string) => {
        this.kept = { values, version, hash };
        resolve(hash);
      };
      this.waiting.push({ done, failed });
      if (!this.connection.send({ type: "keep_map" })) this.reject("there is no connection to the server");
    });
  }

  /** The server has kept the map of the oldest request. */
  resolve(hash: string): void {
    this.waiting.shift()?.done(hash);
  }

  /** All requests have failed. */
  reject(why: string): void {
    for (const { failed } of this.waiting.splice(0)) failed(new Error(`map not kept: ${why}`));
  }
}
