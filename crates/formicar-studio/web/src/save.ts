/** Files that the page hands to its user. */

const TYPES = {
  csv: "text/csv",
  json: "application/json",
  png: "image/png",
  svg: "image/svg+xml",
  toml: "application/toml",
} as const;

export type FileType = keyof typeof TYPES;

/** Downloads contents as `stem.type`. */
export function saveFile(stem: string, type: FileType, contents: Uint8Array | string): void {
  const part = typeof contents === "string" ? contents : contents.slice();
  const url = URL.createObjectURL(new Blob([part], { type: TYPES[type] }));
  const anchor = document.createElement("a");
  anchor.href = url;
  anchor.download = `${stem.replace(/[^\w.-]+/g, "-")}.${type}`;
  anchor.click();
  // The browser has begun to read it by then.
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
