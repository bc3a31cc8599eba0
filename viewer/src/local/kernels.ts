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
  private readonly numbers: Float64Array; // the words as numbers
  private readonly energy: Float64Array;
  private readonly parameters: number[];
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
    this.numbers = new Float64Array(buffer, this.base, machine.bytes / 8);
    this.energy = new Float64Array(buffer, at(machine.parameters.energy), 3);
    this.parameters = [...machine.parameters.values];
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
  restore(state?: BigUint64Array): void {
    this.words.set(state ?? this.start);
    if (state || !this.follow()) return;
    // energies are referred to those at the start, which parameters have changed
    this.observe();
    const [kinetic, potential] = this.energy;
    this.words.set(this.start);
    this.follow();
    this.energy.set([kinetic!, potential!, kinetic! + potential!]);
  }

  /** Another value of a parameter, from the next start on. */
  adjust(parameter: number, value: number): void {
    this.parameters[parameter] = value;
  }

  /** Put the numbers that follow from parameters which are not at their defaults; whether there are any. */
  private follow(): boolean {
    const { numbers, values, frames } = this.machine.parameters;
    const t = frames.map(([centre, width], k) => (this.parameters[k]! - centre) / width);
    const changed = this.parameters.map((value, k) => value !== values[k]);
    for (const { word, constant, power, sign, terms } of numbers) {
      if (!terms.some(([k]) => changed[k])) continue;
      const z = terms.reduce((sum, [k, above, below]) => sum + polynomial(above, t[k]!) / polynomial(below, t[k]!), constant);
      this.numbers[word] = power === 1 ? z : sign * Math.abs(z) ** power;
    }
    return changed.some(Boolean);
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
    const before = this.words.slice(), row = this.observe(), kept = row.slice();
    this.words.set(before);
    row.set(kept);
    this.control[this.machine.session.shown]! += 1n;
  }

  /** Write the present state into the next frame of the ring. */
  private observe(): Float64Array {
    const { loop, session } = this.machine;
    const row = this.frame(this.shown), count = BigInt(loop.count);
    const machine = this.at(loop.machine), y = this.base + loop.y, rate = this.base + loop.rate;
    this.functions[loop.evaluate]!(machine, this.time, y, count, rate, count);
    row[0] = this.time;
    this.functions[loop.observe]!(machine, this.time, y, count, row.byteOffset, BigInt(session.width));
    return row;
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

function polynomial(factors: number[], t: number): number {
  return factors.reduceRight((sum, each) => sum * t + each, 0);
}
