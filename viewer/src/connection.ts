// The connection to the server that the page came from. Frames are acknowledged once they are on the screen, so that the server
// never has more than one on its way.
import { COLUMN, FRAME, MOVES, PACKAGE, SAMPLES, TABLE, type FromPage, type FromServer } from "./generated/records";
import type { Moves } from "./stage/terrain";

const PATIENCE = [500, 1000, 2000, 4000]; // ms before the next attempt

export interface Frame {
  number: number;
  time: number;
  values: Float32Array;
}

/** Samples of a live machine one after the other, each so wide: see `Package.traced`. */
export interface Samples {
  width: number;
  values: Float64Array;
}

/** How a terrain has moved. */
export interface Moved extends Moves {
  terrain: number;
}

/** What messages go over: a websocket, or the worker of a page whose machine is inside. */
export interface Link {
  readonly readyState: number;
  onopen: (() => void) | null;
  onmessage: ((event: MessageEvent) => void) | null;
  onclose: (() => void) | null;
  send(text: string): void;
}

export interface Listener {
  onPackage(bytes: Uint8Array): void;
  onFrame(frame: Frame): void;
  onSamples(samples: Samples): void;
  onMoves(moved: Moved): void;
  onMessage(message: FromServer): void;
  /** A table to be saved. */
  onTable(text: Uint8Array): void;
  /** The program answers again, but shows something else than before. */
  onOther(): void;
  /** failures : attempts in a row that were in vain. */
  onState(connected: boolean, failures: number): void;
}

export class Connection {
  private socket: Link | null = null;
  private requests = new Map<number, (column: Float32Array | string) => void>();
  private lastRequest = 0;
  private failures = 0;
  private known: Uint8Array | null = null; // the package, once it came

  constructor(
    private readonly connect: () => Link,
    private readonly listener: Listener,
  ) {
    this.open();
  }

  send(message: FromPage): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  /** A column of a stage, or in words why there is none. */
  column(stage: number, name: string): Promise<Float32Array | string> {
    const request = ++this.lastRequest;
    return new Promise((done) => {
      if (this.socket?.readyState !== WebSocket.OPEN) {
        done("not connected");
        return;
      }
      this.requests.set(request, done);
      this.send({ type: "want", request, stage, name });
    });
  }

  private open(): void {
    const socket = this.connect();
    socket.onopen = () => {
      this.failures = 0;
      this.listener.onState(true, 0);
    };
    socket.onmessage = (event) => this.receive(event.data);
    socket.onclose = () => {
      for (const done of this.requests.values()) done("the connection was lost");
      this.requests.clear();
      const wait = PATIENCE[Math.min(this.failures++, PATIENCE.length - 1)]!;
      this.listener.onState(false, this.failures);
      if (this.failures < 40) setTimeout(() => this.open(), wait);
    };
    this.socket = socket;
  }

  private receive(data: ArrayBuffer | string): void {
    if (typeof data === "string") {
      const message = JSON.parse(data) as FromServer;
      if (message.type === "refused") this.answer(message.request, message.problem);
      else this.listener.onMessage(message);
      return;
    }
    const view = new DataView(data);
    const kind = view.getUint32(0, true);
    if (kind === PACKAGE) {
      this.receivePackage(new Uint8Array(data, 4));
    } else if (kind === FRAME) {
      const values = new Float32Array(data, 16);
      this.listener.onFrame({ number: view.getUint32(4, true), time: view.getFloat64(8, true), values });
    } else if (kind === SAMPLES) {
      this.listener.onSamples({ width: view.getUint32(4, true), values: new Float64Array(data, 8) });
    } else if (kind === MOVES) {
      this.listener.onMoves(movesIn(data, view));
    } else if (kind === TABLE) {
      this.listener.onTable(new Uint8Array(data, 4));
    } else if (kind === COLUMN) {
      this.answer(view.getUint32(4, true), new Float32Array(data, 12));
    }
  }

  private receivePackage(bytes: Uint8Array): void {
    const { known } = this;
    if (!known) {
      this.known = bytes.slice();
      this.listener.onPackage(bytes);
    } else if (known.length !== bytes.length || known.some((byte, k) => byte !== bytes[k])) this.listener.onOther();
  }

  private answer(request: number, column: Float32Array | string): void {
    this.requests.get(request)?.(column);
    this.requests.delete(request);
  }
}

function movesIn(data: ArrayBuffer, view: DataView): Moved {
  const [terrain, loads, count] = [4, 8, 12].map((at) => view.getUint32(at, true)) as [number, number, number];
  const first = 16 + 4 * loads;
  const [nodes, moves] = [new Uint32Array(data, first, count), new Int16Array(data, first + 4 * count, count)];
  return { terrain, carried: new Float32Array(data, 16, loads), nodes, moves };
}
