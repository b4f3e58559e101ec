/** Maps as files, made in tests: a hall with walls that are drawn cell by cell. */

import { deflateSync } from "node:zlib";

/** A hall with a wall around it, and rectangles of obstacles `[col, row, n_cols, n_rows]` within;
 * rows from the bottom. Cells as text, `@` occupied. */
export function hall(nCols, nRows, blocks = []) {
  const edges = [[0, 0, nCols, 1], [0, nRows - 1, nCols, 1], [0, 0, 1, nRows], [nCols - 1, 0, 1, nRows]];
  const rows = Array.from({ length: nRows }, () => Array(nCols).fill("."));
  for (const [col, row, width, height] of [...edges, ...blocks]) {
    for (let r = row; r < row + height; r += 1) rows[r].fill("@", col, col + width);
  }
  return rows;
}

/** As a MovingAI map. */
export function movingAi(rows) {
  const lines = rows.map((row) => row.join("")).reverse();
  const text = `type octile\nheight ${rows.length}\nwidth ${rows[0].length}\nmap\n${lines.join("\n")}\n`;
  return file("hall.map", "text/plain", text);
}

/** As an image of the netpbm kind. */
export function pgm(rows, name = "hall.pgm") {
  const head = `P5\n${rows[0].length} ${rows.length}\n255\n`;
  return file(name, "image/x-portable-graymap", Buffer.concat([Buffer.from(head), grays(rows).flat]));
}

/** As a PNG of shades of grey. */
export function png(rows, name = "hall.png") {
  const header = Buffer.alloc(13);
  header.writeUInt32BE(rows[0].length, 0);
  header.writeUInt32BE(rows.length, 4);
  header[8] = 8;
  const lines = grays(rows).lines.map((line) => Buffer.concat([Buffer.of(0), line]));
  const parts = [
    Buffer.from("\x89PNG\r\n\x1a\n", "latin1"),
    chunk("IHDR", header),
    chunk("IDAT", deflateSync(Buffer.concat(lines))),
    chunk("IEND", Buffer.alloc(0)),
  ];
  return file(name, "image/png", Buffer.concat(parts));
}

/** The description of an image that map servers write. */
export function rosYaml(image, resolutionM, origin) {
  const text = [
    `image: ${image}`,
    `resolution: ${resolutionM}`,
    `origin: [${origin.join(", ")}]`,
    "negate: 0",
    "occupied_thresh: 0.65",
    "free_thresh: 0.196",
  ];
  return file("hall.yaml", "application/yaml", `${text.join("\n")}\n`);
}

function file(name, mimeType, content) {
  return { name, mimeType, buffer: Buffer.from(content) };
}

/** Images have their highest row first. */
function grays(rows) {
  const lines = rows.map((row) => Buffer.from(row.map((cell) => (cell === "@" ? 0 : 254)))).reverse();
  return { lines, flat: Buffer.concat(lines) };
}

function chunk(kind, data) {
  const body = Buffer.concat([Buffer.from(kind, "latin1"), data]);
  const [length, check] = [Buffer.alloc(4), Buffer.alloc(4)];
  length.writeUInt32BE(data.length);
  check.writeUInt32BE(crcOf(body));
  return Buffer.concat([length, body, check]);
}

/** The checksum of PNG chunks; node has its own only from 20.15 on. */
function crcOf(bytes) {
  let crc = 0xffffffff;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit += 1) crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc >>> 0;
}
