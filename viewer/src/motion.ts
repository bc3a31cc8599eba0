// The whole motion of a stage: frames at their times, and what lies between them.
import type { Layout, Stage } from "./generated/records";
import type { Arrays } from "./package";

export class Motion {
  readonly time: Float64Array;
  readonly count: number;
  readonly layout: Layout;
  readonly load: Float64Array | null; // of equilibria
  private readonly frames: Float32Array; // (width, count)

  constructor(stage: Stage, arrays: Arrays) {
    if (!stage.motion) throw new Error("there is no motion");
    this.layout = stage.layout;
    this.time = arrays.times(stage.motion.time);
    this.count = this.time.length;
    this.frames = arrays.floats(stage.motion.frames);
    this.load = stage.motion.load ? arrays.times(stage.motion.load) : null;
  }

  /** A time in words: of equilibria the load factor there. */
  says(time: number, write: (value: number) => string): string {
    if (!this.load) return `${write(time)} s`;
    const k = this.at(time);
    const next = Math.min(k + 1, this.count - 1);
    const span = this.time[next]! - this.time[k]!;
    const share = span > 0 ? Math.min(Math.max((time - this.time[k]!) / span, 0), 1) : 0;
    return `load factor ${write(this.load[k]! + share * (this.load[next]! - this.load[k]!))}`;
  }

  get start(): number {
    return this.time[0] ?? 0;
  }

  get end(): number {
    return this.time[this.count - 1] ?? 0;
  }

  /** The last frame that is not after `time`. */
  at(time: number): number {
    let low = 0;
    let high = this.count - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.time[middle]! <= time) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  value(row: number, frame: number): number {
    return this.frames[row * this.count + frame]!;
  }

  /** The frame at `time` into `out` (width,): between two frames positions are mixed, quaternions too. */
  sample(time: number, out: Float32Array): void {
    const k = this.at(time);
    const next = Math.min(k + 1, this.count - 1);
    const span = this.time[next]! - this.time[k]!;
    const share = span > 0 ? Math.min(Math.max((time - this.time[k]!) / span, 0), 1) : 0;
    const { frames, count } = this;
    for (let row = 0; row < this.layout.width; row++) {
      const a = frames[row * count + k]!;
      out[row] = share === 0 ? a : a + share * (frames[row * count + next]! - a);
    }
    if (share === 0) return;
    for (let body = 0; body < this.layout.bodies; body++) {
      const first = 7 * body + 3;
      let dot = 0;
      for (let i = first; i < first + 4; i++) dot += frames[i * count + k]! * frames[i * count + next]!;
      const sign = dot < 0 ? -1 : 1; // θ and -θ are one orientation
      for (let i = first; i < first + 4; i++) {
        out[i] = (1 - share) * frames[i * count + k]! + sign * share * frames[i * count + next]!;
      }
    }
  }
}
