/** Addresses of the server, relative to the page, with the token that came with it. */

const PARAMETER = "token";

/** The same address with the page's token, if it has one. */
export function withToken(url: string): string {
  const token = new URLSearchParams(location.search).get(PARAMETER);
  if (token === null) return url;
  return `${url}${url.includes("?") ? "&" : "?"}${PARAMETER}=${encodeURIComponent(token)}`;
}

/** The address of the WebSocket. */
export function socketUrl(): string {
  const url = new URL(withToken("ws"), location.href);
  url.protocol = url.protocol === "https:" ? "wss:" : "ws:";
  url.hash = "";
  return url.href;
}

/** The page's own address with another hash. */
export function pageUrl(hash: string): string {
  const url = new URL(location.href);
  url.hash = hash;
  return url.href;
}
