// Von Mises stress at the vertices of a flexible body, from its modal stresses and the modal coordinates of the moment.
import type { Stress } from "../generated/records";
import type { Arrays } from "../package";

export class Stressed {
  readonly values: Float32Array; // of the vertices; not a number where it is not known
  peak = -1; // vertex of the largest, -1 without one
  private readonly modes: Float32Array; // (modes, 6, stations)
  private readonly ranges: Uint32Array; // (vertices, 2)
  private readonly tensor: Float32Array; // (6, stations)
  private readonly count: number; // stations

  constructor(
    readonly record: Stress,
    arrays: Arrays,
  ) {
    this.modes = arrays.rounded(record.modes);
    this.ranges = arrays.indices(record.stations);
    this.count = record.modes.numbers.shape[2] ?? 0;
    this.tensor = new Float32Array(6 * this.count);
    this.values = new Float32Array(record.stations.shape[0] ?? 0);
  }

  /** From the modal coordinates, which stand in `frame` from `first` on. */
  update(frame: Float32Array, first: number): void {
    const { tensor, modes, count, values, ranges } = this;
    const length = 6 * count;
    tensor.fill(0);
    for (let mode = 0; mode * length < modes.length; mode++) {
      const q = frame[first + mode]!;
      if (!Number.isFinite(q) || q === 0) continue;
      for (let k = 0; k < length; k++) tensor[k]! += q * modes[mode * length + k]!;
    }
    this.peak = -1;
    for (let vertex = 0; vertex < values.length; vertex++) {
      let largest = NaN;
      for (let station = ranges[2 * vertex]!; station < ranges[2 * vertex + 1]!; station++) {
        const value = this.vonMises(station);
        if (!(value <= largest)) largest = value;
      }
      values[vertex] = largest;
      if (largest > (values[this.peak] ?? 0)) this.peak = vertex;
    }
  }

  private vonMises(station: number): number {
    const { tensor, count } = this;
    const [xx, yy, zz] = [tensor[station]!, tensor[count + station]!, tensor[2 * count + station]!];
    const [xy, yz, zx] = [tensor[3 * count + station]!, tensor[4 * count + station]!, tensor[5 * count + station]!];
    return Math.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * (xy * xy + yz * yz + zx * zx));
  }
}
