// A mesh that deforms with its modal coordinates, coloured by what it shows. The morphing is done here: a frame brings only the coordinates.
import * as THREE from "three";
import type { Flexible } from "../generated/records";
import type { Arrays } from "../package";
import { ramp } from "./ramp";
import { Stressed } from "./stressed";
import { triangleMesh } from "./solids";

const UNKNOWN = 0.55; // lightness of vertices whose stress is not known
const PEAK = 0.012; // radius of the ball at the largest stress, of the machine's size

const ALIKE = 1.001; // distances that differ by less are the same: those of the corners of a bar from its node

/** What colours show, and their ends. */
interface Ends {
  quantity: string;
  unit: string;
  low: number;
  high: number;
}

export class Deforming {
  readonly mesh: THREE.Mesh;
  readonly values: Float32Array; // that the colours of the vertices show
  readonly stressed: Stressed | null;
  exaggeration = 1;
  showsStress = false;
  scale: Ends;
  seen = 0; // the largest displacement so far, which is the end of the colours where a motion goes on
  private readonly peak: THREE.Mesh;
  private readonly near = new WeakMap<readonly [number, number, number], number[]>(); // vertices nearest to points
  private readonly rest: Float32Array;
  private readonly modes: Float32Array; // (modes, 3 n)
  private readonly field: Float32Array | null; // (modes, n)
  private readonly count: number;
  private readonly modeCount: number;

  constructor(
    readonly record: Flexible,
    arrays: Arrays,
    isGhost: boolean,
    size: number,
  ) {
    this.rest = arrays.floats(record.vertices);
    this.modes = arrays.floats(record.modes);
    this.field = record.field ? arrays.floats(record.field) : null;
    this.count = this.rest.length / 3;
    this.values = new Float32Array(this.count);
    this.stressed = record.stress ? new Stressed(record.stress, arrays) : null;
    this.scale = this.ownScale;
    this.modeCount = record.modes.shape[0] ?? 0;
    const geometry = triangleMesh(this.rest.slice(), arrays.indices(record.triangles));
    geometry.setAttribute("color", new THREE.BufferAttribute(new Float32Array(3 * this.count).fill(1), 3));
    geometry.computeVertexNormals();
    const material = new THREE.MeshPhongMaterial({ vertexColors: true, shininess: 20, specular: 0x1a1a1a, side: THREE.DoubleSide, transparent: isGhost, opacity: isGhost ? 0.25 : 1 });
    this.mesh = new THREE.Mesh(geometry, material);
    this.mesh.castShadow = !isGhost;
    this.mesh.frustumCulled = false; // its extent changes
    this.mesh.userData = { kind: "body", name: record.name };
    this.peak = new THREE.Mesh(new THREE.SphereGeometry(PEAK * size, 16, 12), new THREE.MeshBasicMaterial({ color: 0xd0021b, depthTest: false, transparent: true }));
    this.peak.renderOrder = 2; // seen through the body
    this.peak.visible = false;
    this.mesh.add(this.peak);
  }

  /** Of this body alone. */
  get ownScale(): Ends {
    const { quantity, unit, low, high, stress } = this.record;
    return this.showsStress && stress ? { quantity: "von Mises stress", unit: "Pa", low: 0, high: stress.high } : { quantity, unit, low, high: high > low ? high : this.seen };
  }

  /** The largest stress at this moment. */
  get peakValue(): number {
    return this.stressed && this.stressed.peak >= 0 ? this.stressed.values[this.stressed.peak]! : 0;
  }

  /** How far a point of the body is carried by its modes, in its frame: as the nearest vertices on the average. first : as of `update`. */
  carried(point: readonly [number, number, number], frame: Float32Array, first: number, out: THREE.Vector3): THREE.Vector3 {
    let near = this.near.get(point);
    if (!near) this.near.set(point, (near = this.nearest(point)));
    out.set(0, 0, 0);
    for (let mode = 0; mode < this.modeCount; mode++) {
      const q = frame[first + this.record.first + mode]! / near.length;
      for (const vertex of near) {
        const at = 3 * (this.count * mode + vertex);
        out.x += q * this.modes[at]!;
        out.y += q * this.modes[at + 1]!;
        out.z += q * this.modes[at + 2]!;
      }
    }
    return out;
  }

  private nearest([x, y, z]: readonly [number, number, number]): number[] {
    const far = Array.from({ length: this.count }, (_, k) => Math.hypot(this.rest[3 * k]! - x, this.rest[3 * k + 1]! - y, this.rest[3 * k + 2]! - z));
    const least = far.reduce((a, b) => Math.min(a, b));
    return far.flatMap((each, k) => (each <= ALIKE * least + 1e-12 ? [k] : []));
  }

  /** `first` : place of the first modal coordinate of the frame. */
  update(frame: Float32Array, first: number): void {
    const { count, modes, rest, field } = this;
    const position = this.mesh.geometry.getAttribute("position") as THREE.BufferAttribute;
    const colour = this.mesh.geometry.getAttribute("color") as THREE.BufferAttribute;
    const at = position.array as Float32Array;
    const moved = new Float32Array(3 * count);
    const shown = new Float32Array(count);
    for (let mode = 0; mode < this.modeCount; mode++) {
      const q = frame[first + this.record.first + mode]!;
      if (!Number.isFinite(q) || q === 0) continue;
      const shape = 3 * count * mode;
      for (let k = 0; k < 3 * count; k++) moved[k]! += q * modes[shape + k]!;
      if (field) for (let k = 0; k < count; k++) shown[k]! += q * field[count * mode + k]!;
    }
    if (this.showsStress) this.stressed?.update(frame, first + this.record.first);
    const { low, high } = this.scale;
    const span = high > low ? high - low : 1;
    const colours = colour.array as Float32Array;
    for (let k = 0; k < count; k++) {
      const [x, y, z] = [moved[3 * k]!, moved[3 * k + 1]!, moved[3 * k + 2]!];
      at[3 * k] = rest[3 * k]! + this.exaggeration * x;
      at[3 * k + 1] = rest[3 * k + 1]! + this.exaggeration * y;
      at[3 * k + 2] = rest[3 * k + 2]! + this.exaggeration * z;
      const value = this.showsStress ? this.stressed!.values[k]! : field ? shown[k]! : Math.hypot(x, y, z);
      this.values[k] = value;
      if (value > this.seen) this.seen = value;
      if (Number.isNaN(value)) colours.fill(UNKNOWN, 3 * k, 3 * k + 3);
      else ramp((value - low) / span, colours, 3 * k);
    }
    const vertex = this.showsStress ? this.stressed!.peak : -1;
    this.peak.visible = vertex >= 0;
    if (vertex >= 0) this.peak.position.fromArray(at, 3 * vertex);
    position.needsUpdate = true;
    colour.needsUpdate = true;
    this.mesh.geometry.computeVertexNormals();
  }
}
