/** The line to the server: kept up, opened again when it breaks. */

import type { AnswerMessage, ClientMessage, ServerMessage } from "./protocol";

/** A message with the payload behind it, empty for text messages. */
export type Received = (message: ServerMessage, payload: Uint8Array) => void;

/** The texts of answers as the server sent them: written anew, they would lose the sign of zeros. */
const texts = new WeakMap<AnswerMessage, string>();

/** The text of an answer as it was sent; of one that the page has made, as it writes it. */
export function textOf(message: AnswerMessage): string {
  return texts.get(message) ?? JSON.stringify(message.answer);
}

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

/** A message and its payload. */
export function decode(data: string | ArrayBuffer): [ServerMessage, Uint8Array] {
  if (typeof data === "string") {
    const message = JSON.parse(data) as ServerMessage;
    if (message.type === "answer") texts.set(message, lastField(data, "answer"));
    return [message, NOTHING];
  }
  const length = new DataView(data).getUint32(0, true);
  const header = new TextDecoder().decode(new Uint8Array(data, 4, length));
  return [JSON.parse(header) as ServerMessage, new Uint8Array(data, 4 + length)];
}

/** The text of the last field of an object in JSON; its key appears nowhere before as a key. */
function lastField(json: string, key: string): string {
  const begin = `,"${key}":`;
  return json.slice(json.indexOf(begin) + begin.length, -1);
}
