/** Numbers as the page writes them. */

const MINUS = "\u2212";
const DASH = "\u2013";

/** A number with `digits` behind the point, a real minus sign, and no minus zero. */
export function fixed(value: number | null | undefined, digits: number): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return DASH;
  const text = value.toFixed(digits);
  return Number(text) === 0 ? text.replace("-", "") : text.replace("-", MINUS);
}

/** A length, as fine as its size calls for. */
export function meters(value: number | null | undefined): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return DASH;
  const size = Math.abs(value);
  const digits = size < 0.1 ? 3 : size < 10 ? 2 : size < 1000 ? 1 : 0;
  return `${fixed(value, digits)} m`;
}

/** A span of time. */
export function seconds(value: number | null | undefined): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return DASH;
  if (value < 0.001) return `${fixed(value * 1e6, 0)} \u00b5s`;
  if (value < 0.01) return `${fixed(value * 1e3, 1)} ms`;
  if (value < 1) return `${fixed(value * 1e3, 0)} ms`;
  return value < 100 ? `${fixed(value, 2)} s` : `${fixed(value, 0)} s`;
}

export function degrees(radians: number | null | undefined, digits = 1): string {
  if (radians === null || radians === undefined) return DASH;
  return `${fixed((radians * 180) / Math.PI, digits)}\u00b0`;
}

/** A number for an input: short, and the same when read again to that many digits. */
export function plain(value: number, digits = 12): string {
  return String(Number(value.toPrecision(digits)));
}

/** `1 234 567`, with thin spaces. */
export function count(value: number): string {
  return String(value).replace(/\B(?=(\d{3})+$)/g, "\u2009");
}

/** A number with its noun. */
export function plural(n: number, one: string, many = `${one}s`): string {
  return `${count(n)} ${n === 1 ? one : many}`;
}
