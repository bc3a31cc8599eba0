// The clock of the playback.
import type { Motion } from "./motion";

export const SPEEDS = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10] as const;

export class Player {
  time: number;
  playing = false;
  speed = 1;
  loop = true;
  private last = 0;
  onChange: () => void = () => {};
  onTime: () => void = () => {};

  constructor(readonly motion: Motion) {
    this.time = motion.start;
  }

  get frame(): number {
    return this.motion.at(this.time);
  }

  toggle(on = !this.playing): void {
    if (on && !this.loop && this.time >= this.motion.end) this.time = this.motion.start;
    this.playing = on && this.motion.count > 1 && this.motion.end > this.motion.start;
    this.last = 0;
    this.onChange();
    this.onTime();
  }

  seek(time: number): void {
    if (!Number.isFinite(time)) return;
    this.time = Math.min(Math.max(time, this.motion.start), this.motion.end);
    this.onTime();
  }

  /** By frames. */
  step(by: number): void {
    this.toggle(false);
    const next = Math.min(Math.max(this.frame + by, 0), this.motion.count - 1);
    this.seek(this.motion.time[next]!);
  }

  faster(by: number): void {
    const at = SPEEDS.findIndex((speed) => speed >= this.speed * 0.999);
    this.speed = SPEEDS[Math.min(Math.max(at + by, 0), SPEEDS.length - 1)]!;
    this.onChange();
  }

  /** To the moment `now` of the page's clock in ms. */
  advance(now: number): void {
    if (!this.playing) return;
    const passed = this.last ? Math.min(now - this.last, 250) / 1000 : 0;
    this.last = now;
    const { start, end } = this.motion;
    let time = this.time + passed * this.speed;
    if (time > end) {
      if (this.loop) time = start + ((time - start) % (end - start));
      else {
        time = end;
        this.playing = false;
        this.onChange();
      }
    }
    this.time = time;
    this.onTime();
  }
}
