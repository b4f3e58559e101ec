/** The line to the server: kept up, opened again when it breaks. */

import type { ClientMessage, ServerMessage } from "./protocol";

/** A message with the payload behind it, empty for text messages. */
export type Received = (message: ServerMessage, payload: Uint8Array) => void;

const FIRST_WAIT_MS = 250;
const LONGEST_WAIT_MS = 5000;
const NOTHING = new Uint8Array();

export class Connection {
  private socket: WebSocket | null = null;
  private waitMs = FIRST_WAIT_MS;

  /** `status` is called when the connection opens or closes, `received` with every message. */
  constructor(
    private readonly url: string,
    private readonly received: Received,
    private readonly status: (isOpen: boolean) => void,
  ) {
    this.open();
  }

  /** Sends a message; without a connection it is dropped, and the result is false. */
  send(message: ClientMessage): boolean {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }

  private open(): void {
    const socket = new WebSocket(this.url);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.waitMs = FIRST_WAIT_MS;
      this.status(true);
    };
    socket.onmessage = (event) => {
      const [message, payload] = decode(event.data as string | ArrayBuffer);
      this.received(message, payload);
    };
    socket.onclose = () => {
      this.status(false);
      setTimeout(() => this.open(), this.waitMs);
      this.waitMs = Math.min(2 * this.waitMs, LONGEST_WAIT_MS);
    };
    this.socket = socket;
  }
}

function decode(data: string | ArrayBuffer): [ServerMessage, Uint8Array] {
  if (typeof data === "string") return [JSON.parse(data) as ServerMessage, NOTHING];
  const length = new DataView(data).getUint32(0, true);
  const header = new TextDecoder().decode(new Uint8Array(data, 4, length));
  return [JSON.parse(header) as ServerMessage, new Uint8Array(data, 4 + length)];
}
