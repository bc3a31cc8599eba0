// A machine as machine code: its module of WebAssembly, its memory, and the loop of live operation (`nivel.integrate.loop.paced`).
import type { LocalMachine } from "../generated/records";

const PAGE = 65536; // bytes by which memory of WebAssembly grows
const LINE = 64; // bytes: where records begin
const BEHIND = 1 << 16; // bytes behind the machine's memory
const TABLE = 64; // places of the table beside those of the codes, for functions that code takes the address of

type Code = (...numbers: (bigint | number)[]) => bigint;

export class Kernels {
  readonly frames: Float64Array[]; // rows of the ring
  private readonly words: BigUint64Array;
  private readonly control: BigInt64Array;
  private readonly target: Float64Array;
  private readonly value: Float64Array;
  private readonly clock: Float64Array;
  private readonly counter: BigInt64Array;
  private readonly failed: Uint32Array;
  private readonly base: number;
  private readonly first: number; // code 0 in the table
  private readonly functions: Code[];
  private readonly start: BigUint64Array;

  constructor(
    private readonly machine: LocalMachine,
    memory: Uint8Array,
    kernels: Uint8Array,
    inputs: number,
  ) {
    const { loop, session, codes } = machine;
    const space = new WebAssembly.Memory({ initial: Math.ceil((memory.length + BEHIND) / PAGE) + 8 });
    const table = new WebAssembly.Table({ element: "anyfunc", initial: codes.length + 2 * TABLE });
    const module = new WebAssembly.Module(kernels as BufferSource);
    const { exports } = new WebAssembly.Instance(module, { env: { memory: space, __indirect_function_table: table } });
    this.functions = codes.map((name) => exports[name] as Code);
    this.first = 2 * TABLE;
    this.functions.forEach((code, k) => table.set(this.first + k, code));
    const heap = Number((exports["__heap_base"] as WebAssembly.Global).value);
    this.base = Math.ceil(heap / LINE) * LINE;
    const lacking = this.base + memory.length + BEHIND - space.buffer.byteLength;
    if (lacking > 0) space.grow(Math.ceil(lacking / PAGE));
    const { buffer } = space, at = (place: number) => this.base + place;
    this.words = new BigUint64Array(buffer, this.base, machine.bytes / 8);
    this.words.set(new BigUint64Array(memory.slice().buffer));
    for (const [word, place] of machine.inner) this.words[word] = BigInt(at(place));
    for (const [word, code] of machine.outer) this.words[word] = BigInt(this.first + code);
    this.control = new BigInt64Array(buffer, at(session.control), 32);
    this.target = new Float64Array(buffer, at(session.target), inputs);
    this.value = new Float64Array(buffer, at(session.value), inputs);
    this.clock = new Float64Array(buffer, at(loop.clock), 16);
    this.counter = new BigInt64Array(buffer, at(loop.counter), 16);
    this.failed = new Uint32Array(buffer, at(loop.failed), 1);
    this.frames = [...Array(session.rows).keys()].map((row) => new Float64Array(buffer, at(session.frames) + 8 * session.width * row, session.width));
    this.start = this.words.slice();
  }

  /** Simulated time [s]. */
  get time(): number {
    return this.clock[this.machine.loop.time]!;
  }

  /** The state, to which `restore` comes back. */
  save(): BigUint64Array {
    return this.words.slice();
  }

  /** Back to a state, or to the start. */
  restore(state: BigUint64Array = this.start): void {
    this.words.set(state);
  }

  /** Values of the inputs at the end of the last tick. */
  get values(): Float64Array {
    return this.value;
  }

  /** An input goes to this value, as fast as it may. */
  want(k: number, value: number): void {
    this.target[k] = value;
  }

  /** Frames shown so far, in the ring. */
  get shown(): number {
    return Number(this.control[this.machine.session.shown]!);
  }

  /** The frame with this number. */
  frame(number: number): Float64Array {
    return this.frames[number % this.frames.length]!;
  }

  /** Do so many ticks; a status. */
  go(ticks: number): number {
    const { loop, session } = this.machine;
    this.control[session.ticks] = BigInt(ticks);
    const codes = [loop.advance, loop.evaluate, loop.correct, loop.step].map((code) => BigInt(this.first + code));
    return Number(this.functions[loop.drive]!(...codes, this.at(loop.machine), this.at(loop.history), this.at(loop.session)));
  }

  /** Put a frame of the present state into the ring, and leave no trace of it in the run. */
  show(): void {
    const { loop, session } = this.machine;
    const before = this.words.slice(), row = this.frame(this.shown), count = BigInt(loop.count);
    const machine = this.at(loop.machine), y = this.base + loop.y, rate = this.base + loop.rate;
    this.functions[loop.evaluate]!(machine, this.time, y, count, rate, count);
    row[0] = this.time;
    this.functions[loop.observe]!(machine, this.time, y, count, row.byteOffset, BigInt(session.width));
    const kept = row.slice();
    this.words.set(before);
    row.set(kept);
    this.control[session.shown]! += 1n;
  }

  /** Why the run has ended or failed. */
  reason(status: number): string {
    const { events, failures, done, loop } = this.machine;
    if (status === done) {
      const event = Number(this.counter[loop.stopped]!);
      return `the run has ended${event ? ` at the event ${events[event - 1]}` : ""}; reset it`;
    }
    const failure = failures.find((each) => each.status === status);
    const said = failure?.sentence.replace("{}", failure.names[this.failed[0]!] ?? "something") ?? `failure ${status}`;
    return `the run failed at t = ${this.clock[loop.accepted]!.toPrecision(6)} s: ${said}`;
  }

  private at(place: number): bigint {
    return BigInt(this.base + place);
  }
}
