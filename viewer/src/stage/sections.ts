// What the sections of beams feel at the moment that is shown: strains at points along them, and the forces that go with these.
import type { Felt, Quantity, Stage } from "../generated/records";
import type { Arrays } from "../package";

const STRAINS = 6;

/** One beam: a number for each of its points, and for any place between them. */
class FeltBeam {
  readonly values: Float32Array; // of the quantity that is shown, at the points
  private readonly strain: Float32Array; // (6, frames, points)

  constructor(
    readonly record: Felt,
    arrays: Arrays,
  ) {
    this.strain = arrays.rounded(record.strain);
    this.values = new Float32Array(record.places.length);
  }

  /** The numbers at the share of the way from one frame to the next. */
  set(quantity: Quantity, frame: number, next: number, share: number): void {
    const [, frames = 0, points = 0] = this.record.strain.numbers.shape;
    const strain = new Float64Array(STRAINS);
    for (let point = 0; point < points; point++) {
      for (let i = 0; i < STRAINS; i++) {
        const first = i * frames * points + point;
        strain[i] = (1 - share) * this.strain[first + frame * points]! + share * this.strain[first + next * points]!;
      }
      const rows = quantity.rows.map((row) => (row < STRAINS ? strain[row]! : this.record.stiffness[row - STRAINS]!.reduce((sum, k, i) => sum + k * strain[i]!, 0)));
      this.values[point] = rows.length === 1 ? rows[0]! : Math.hypot(...rows);
    }
  }

  /** At a place in numbers of frames of bodies; beyond the first and last point as there. */
  at(place: number): number {
    const { places } = this.record;
    let k = 0;
    while (k < places.length && places[k]! < place) k++;
    if (k === 0) return this.values[0]!;
    if (k === places.length) return this.values[k - 1]!;
    const share = (place - places[k - 1]!) / (places[k]! - places[k - 1]!);
    return this.values[k - 1]! + share * (this.values[k]! - this.values[k - 1]!);
  }
}

export class Sections {
  readonly quantities: readonly Quantity[];
  shown: Quantity | null = null;
  private readonly time: Float64Array;
  private readonly beams = new Map<number, FeltBeam>();

  constructor(stage: Stage, arrays: Arrays) {
    this.quantities = stage.sections?.quantities ?? [];
    this.time = stage.sections ? arrays.times(stage.sections.time) : new Float64Array();
    for (const each of stage.sections?.beams ?? []) this.beams.set(each.sweep, new FeltBeam(each, arrays));
  }

  /** Of a sweep of the stage, while a quantity is shown. */
  of(sweep: number): FeltBeam | null {
    return this.shown ? (this.beams.get(sweep) ?? null) : null;
  }

  show(name: string): void {
    this.shown = this.quantities.find((each) => each.name === name) ?? null;
  }

  moveTo(time: number): void {
    if (!this.shown) return;
    let frame = 0;
    while (frame + 1 < this.time.length && this.time[frame + 1]! <= time) frame++;
    const next = Math.min(frame + 1, this.time.length - 1);
    const span = this.time[next]! - this.time[frame]!;
    const share = span > 0 ? Math.min(Math.max((time - this.time[frame]!) / span, 0), 1) : 0;
    for (const beam of this.beams.values()) beam.set(this.shown, frame, next, share);
  }
}
