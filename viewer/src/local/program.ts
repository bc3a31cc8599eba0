// The program that the page of a machine is connected to where there is no server: it runs in a worker of the page, and says what
// `nivel live` says over its websocket.
import { FRAME, PACKAGE, SAMPLES, TABLE, type FromPage, type FromServer, type LocalMachine } from "../generated/records";
import { Kernels } from "./kernels";
import { Light } from "./light";

const TURN = 4; // ms between two turns
const BOUND = 0.05; // s: a longer delay stretches time
const TELLING = 200; // ms between two words on how the machine is
const UNANSWERED = 2000; // ms after which a frame that nobody acknowledged counts as lost
const SILENCE = 500; // ms after which an operator counts as lost
const KEPT = 6_000_000; // numbers of frames that are kept for a table: 48 MB
const HAND = { pull: 0, body: 1, count: 8 };
const SLOWEST = 0.01;

interface Given {
  machine: LocalMachine;
  memory: Uint8Array;
  kernels: Uint8Array;
  package: Uint8Array;
}
type Mode = "running" | "paused" | "ended" | "failed";
const scope = self as unknown as { postMessage(message: unknown, transfer?: Transferable[]): void; onmessage: (event: MessageEvent) => void };

class Program {
  private readonly kernels: Kernels;
  private readonly light: Light;
  private mode: Mode = "running";
  private speed = 1;
  private driving = false;
  private text = "";
  private saved: BigUint64Array | null = null;
  private wanted: number[];
  private heard = 0;
  private number = 0; // of frames sent, and the last one that the page has shown
  private drawn = 0;
  private sent = 0;
  private taken = 0; // frames of the ring that were looked at
  private newest: Float64Array;
  private samples: number[][] = [];
  private rows: Float64Array[] = []; // of the motion since the start
  private every = 1; // frames for each that is kept
  private count = 0;
  private last = performance.now();
  private behind = 0; // s that are not done yet
  private lost = 0; // s
  private asked = 0;
  private readonly spent: number[] = []; // µs a tick
  private readonly late: number[] = [];

  constructor(private readonly given: Given) {
    const { machine } = given;
    this.kernels = new Kernels(machine, given.memory, given.kernels, machine.inputs.length + HAND.count);
    this.light = new Light(machine);
    this.wanted = machine.inputs.map((each) => each.rest);
    this.newest = this.kernels.frame(this.kernels.shown - 1).slice();
    this.gather(true);
    this.send(PACKAGE, given.package);
    this.show();
    setInterval(() => this.turn(), TURN);
    setInterval(() => this.tell(), TELLING);
  }

  hear(message: FromPage): void {
    switch (message.type) {
      case "shown":
        this.drawn = message.frame;
        break;
      case "take":
        this.driving = !!message.on;
        if (!message.on) this.rest();
        this.tell();
        break;
      case "drive":
        if (this.driving && message.values.length === this.wanted.length) this.wanted = message.values;
        this.heard = performance.now();
        break;
      case "hold":
        if (this.driving) this.hold(message.on ? [message.body, ...message.point, ...message.towards.map((each, k) => each + this.given.machine.picture.origin[k]!)] : null);
        break;
      case "adjust":
        this.kernels.adjust(message.parameter, message.value);
        this.saved = null; // it was a state of another machine
        this.goTo(undefined);
        this.tell();
        break;
      case "command":
        this.command(message.word, message.number);
        break;
      case "want":
        this.say({ type: "refused", request: message.request, problem: "a live machine has no columns" });
    }
  }

  private command(word: string, number: number): void {
    const over = this.mode === "ended" || this.mode === "failed";
    if (word === "speed") this.speed = Math.min(Math.max(number, SLOWEST), 1);
    else if (word === "table") this.table();
    else if (word === "reset" || word === "restore") this.goTo(word === "reset" ? undefined : this.saved);
    else if (over) this.note("the run is over: go back to the start, or restore a state");
    else if (word === "run") this.mode = "running";
    else if (word === "pause") this.mode = "paused";
    else if (word === "save") this.saved = this.kernels.save();
    else if (word === "step") {
      this.mode = "paused";
      this.go(1);
      if (!this.over) this.kernels.show();
      this.gather();
      this.show();
    }
    this.tell();
  }

  private get over(): boolean {
    return this.mode === "ended" || this.mode === "failed";
  }

  private goTo(state: BigUint64Array | null | undefined): void {
    if (state === null) return this.note("no state has been saved");
    this.kernels.restore(state);
    if (this.mode !== "running") this.mode = "paused";
    [this.text, this.behind, this.lost, this.asked] = ["", 0, 0, 0];
    this.kernels.show();
    this.gather(true);
    this.show();
  }

  private rest(): void {
    this.wanted = this.given.machine.inputs.map((each) => each.rest);
    this.hold(null);
  }

  /** A hand that holds another point lets go first, and holds when it has the new one: inputs go straight from value to value. */
  private hold(grip: number[] | null): void {
    const begin = this.wanted.length, { values } = this.kernels;
    const same = grip?.every((each, k) => k >= 4 || values[begin + HAND.body + k] === each);
    const pulls = values[begin + HAND.pull] !== 0;
    if (grip && (same || !pulls)) grip.forEach((each, k) => this.kernels.want(begin + HAND.body + k, each));
    this.kernels.want(begin + HAND.pull, grip && same ? 1 : 0);
  }

  private turn(): void {
    const now = performance.now(), passed = now - this.last;
    this.last = now;
    if (this.mode !== "running") return;
    if (this.driving && now - this.heard > SILENCE) this.rest();
    const { tick } = this.given.machine;
    this.behind += (passed / 1000) * this.speed;
    this.asked += (passed / 1000) * this.speed;
    const due = Math.max(Math.floor(this.behind / tick), 0);
    const most = Math.max(Math.ceil((BOUND * this.speed) / tick), 1);
    const ticks = Math.min(due, most);
    this.lost += Math.max(due - most, 0) * tick;
    this.behind -= due * tick;
    if (ticks) this.go(ticks);
    note(this.late, 1000 * Math.max(passed - TURN, 0));
    this.gather();
    if (this.drawn === this.number || now - this.sent > UNANSWERED) this.show();
  }

  private go(ticks: number): void {
    const begin = performance.now(), { spent, done } = this.given.machine;
    this.wanted.forEach((value, k) => this.kernels.want(k, value));
    const status = this.kernels.go(ticks);
    note(this.spent, (1000 * (performance.now() - begin)) / ticks);
    if (status === spent) return;
    this.mode = status === done ? "ended" : "failed";
    this.text = this.kernels.reason(status);
    this.kernels.show();
  }

  /** Look at the frames that came since. anew : a motion begins, with the last of them. */
  private gather(anew = false): void {
    const { shown } = this.kernels;
    if (anew) {
      [this.taken, this.rows, this.every, this.count, this.samples] = [shown - 1, [], 1, 0, []];
      this.light.begin(this.kernels.frame(shown - 1));
    }
    for (; this.taken < shown; this.taken++) {
      const frame = (this.newest = this.kernels.frame(this.taken).slice());
      this.light.take(frame);
      this.samples.push(this.sample(frame));
      if (this.count++ % this.every === 0) this.rows.push(frame);
      if (this.rows.length * frame.length > KEPT) {
        this.rows = this.rows.filter((_, k) => k % 2 === 0);
        this.every *= 2;
      }
    }
  }

  /** What the page draws of a frame. */
  private row(frame: Float64Array): number[] {
    const { picture, bodies } = this.given.machine, out: number[] = [];
    for (let k = 0; k < bodies; k++) {
      for (let i = 0; i < 3; i++) out.push(frame[picture.position[0] + 3 * k + i]! - picture.origin[i]!);
      for (let i = 0; i < 4; i++) out.push(frame[picture.orientation[0] + 4 * k + i]!);
    }
    return [...out, ...frame.subarray(...picture.modal)];
  }

  private gauges(frame: Float64Array): number[] {
    return this.given.machine.picture.gauges.map((column) => frame[column]!);
  }

  private sample(frame: Float64Array): number[] {
    const row = this.row(frame), { traced } = this.given.machine.picture;
    return [frame[0]!, ...this.gauges(frame), ...traced.flatMap((k) => row.slice(7 * k, 7 * k + 7)), ...row.slice(7 * this.given.machine.bodies)];
  }

  private show(): void {
    if (this.samples.length) {
      const head = new DataView(new ArrayBuffer(4));
      head.setUint32(0, this.samples[0]!.length, true);
      this.send(SAMPLES, new Uint8Array(head.buffer), Float64Array.from(this.samples.flat()));
      this.samples = [];
    }
    const frame = this.newest, inputs = [...this.kernels.values.subarray(0, this.wanted.length)];
    const head = new DataView(new ArrayBuffer(12));
    head.setUint32(0, ++this.number, true);
    head.setFloat64(4, frame[0]!, true);
    this.sent = performance.now();
    this.send(FRAME, new Uint8Array(head.buffer), Float32Array.from([...this.row(frame), ...this.gauges(frame), ...inputs]));
  }

  /** All frames of the motion as a table, for the page to save. */
  private table(): void {
    const rows = this.rows.at(-1)?.[0] === this.newest[0] ? this.rows : [...this.rows, this.newest];
    const lines = rows.map((frame) => [...frame].join(","));
    const names = ["time [s]", ...this.given.machine.names].map((name) => (/[",\n]/.test(name) ? `"${name.replaceAll('"', '""')}"` : name));
    this.send(TABLE, new TextEncoder().encode([names.join(","), ...lines, ""].join("\n")));
    if (this.every > 1) this.note(`the table has every ${this.every}th frame: it would be too long`);
  }

  private tell(): void {
    const [light, reasons] = this.light.verdict(this.asked > 1 ? this.lost / this.asked : 0, this.mode === "failed" ? this.text : "");
    this.say({
      type: "status",
      mode: this.mode,
      time: this.kernels.time,
      speed: this.speed,
      driver: this.driving ? "you" : "nobody",
      watches: "",
      operated: this.driving,
      computing: percentile(this.spent),
      late: percentile(this.late),
      tick: 1e6 * this.given.machine.tick,
      overruns: 0,
      own: 0,
      dropped: 0,
      text: this.text,
      light,
      reasons,
    });
  }

  private note(text: string): void {
    this.say({ type: "note", text });
  }

  private say(message: FromServer): void {
    scope.postMessage(JSON.stringify(message));
  }

  private send(kind: number, ...parts: (Uint8Array | Float32Array | Float64Array)[]): void {
    const out = new Uint8Array(4 + parts.reduce((sum, each) => sum + each.byteLength, 0));
    new DataView(out.buffer).setUint32(0, kind, true);
    let at = 4;
    for (const { buffer, byteOffset, byteLength } of parts) {
      out.set(new Uint8Array(buffer, byteOffset, byteLength), at);
      at += byteLength;
    }
    scope.postMessage(out.buffer, [out.buffer]);
  }
}

/** Keep the last values. */
function note(values: number[], value: number): void {
  values.push(value);
  if (values.length > 500) values.shift();
}

function percentile(values: number[]): number {
  return [...values].sort((a, b) => a - b)[Math.floor(0.99 * values.length)] ?? 0;
}

let program: Program | null = null;
scope.onmessage = ({ data }: MessageEvent) => {
  if (program) program.hear(JSON.parse(data as string) as FromPage);
  else
    try {
      program = new Program(data as Given);
    } catch (error) {
      scope.postMessage({ problem: error instanceof Error ? error.message : String(error) });
    }
};
