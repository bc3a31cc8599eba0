// A section drawn along a line through frames of bodies, and bent with them at every frame: beams, hoses, ropes.
//
// Between two frames the line is a cubic (Hermite) that leaves and arrives along their axes with a slope as long as the bodies are apart.
// The section turns evenly from one frame to the next, and is then tilted so that it stands square to the line.
import * as THREE from "three";
import type { Sweep } from "../generated/records";
import type { Actor, Picked } from "./actor";
import { ramp } from "./ramp";

const MOST_RINGS = 240; // of one sweep, where there are not more frames
const MOST_FRAMES = 500; // that the line goes through; of more it takes some, evenly
const FINEST = 10; // rings from one frame to the next
const CREASE = Math.cos((35 * Math.PI) / 180); // edges of the section that are sharper stay sharp

const X = new THREE.Vector3(1, 0, 0);

/** A corner of the section as it is drawn: place and outward normal (y, z). Each edge of it has two. */
interface Corner {
  at: readonly [number, number];
  normal: readonly [number, number];
}

export class Swept {
  readonly mesh: THREE.Mesh;
  private readonly corners: Corner[];
  private readonly caps: readonly (readonly [number, number])[];
  private readonly steps: number; // rings from one frame to the next
  private readonly turns: THREE.Quaternion[]; // of the section's axes in the frame of each body

  private readonly kept: readonly number[]; // places of its frames among those of the whole
  private readonly painted = new THREE.MeshPhongMaterial({ vertexColors: true, shininess: 20, specular: 0x1a1a1a, side: THREE.DoubleSide });

  readonly record: Sweep;

  constructor(
    whole: Sweep,
    private readonly actor: Actor,
    private readonly material: THREE.Material,
  ) {
    this.kept = keptFrames(whole.bodies.length);
    const record = thinned(whole, this.kept);
    this.record = record;
    const spans = record.bodies.length - 1;
    this.steps = record.smooth ? Math.min(Math.max(Math.floor(MOST_RINGS / spans), 1), FINEST) : 1;
    this.corners = [...edges(record.section, 1), ...edges(record.hollow, -1)];
    this.caps = [...record.section, ...record.hollow];
    this.turns = record.bodies.map((_, k) => sectionTurn(record.axes[k]!, record.across[k]!));
    const rings = spans * this.steps + 1;
    const count = rings * this.corners.length + 2 * this.caps.length;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * count), 3));
    geometry.setAttribute("normal", new THREE.BufferAttribute(new Float32Array(3 * count), 3));
    geometry.setAttribute("color", new THREE.BufferAttribute(new Float32Array(3 * count).fill(1), 3));
    geometry.setIndex(this.triangles(rings));
    this.mesh = new THREE.Mesh(geometry, material);
    this.mesh.castShadow = !material.transparent;
    this.mesh.frustumCulled = false; // its extent changes
  }

  /** The body of the chain that is nearest to a point in the picture. */
  nearest(point: THREE.Vector3): Picked {
    const at = new THREE.Vector3();
    const local = this.actor.root.worldToLocal(point.clone());
    const far = this.record.bodies.map((body, k) => this.actor.place(body, this.record.points[k]!, at).distanceTo(local));
    const body = this.record.bodies[far.indexOf(Math.min(...far))]!;
    return { kind: "body", name: this.actor.stage.bodies[body]!.name };
  }

  /** The part around a body of the chain, to be lit up; it bends as the whole. */
  around(name: string): THREE.BufferGeometry | null {
    const k = this.record.bodies.findIndex((body) => this.actor.stage.bodies[body]!.name === name);
    if (k < 0) return null; // of another sweep, or left out
    const part = new THREE.BufferGeometry();
    for (const each of ["position", "normal"]) part.setAttribute(each, this.mesh.geometry.getAttribute(each));
    part.setIndex(this.mesh.geometry.index);
    const first = Math.max(k - 0.5, 0);
    const last = Math.min(k + 0.5, this.record.bodies.length - 1);
    const whole = 3 * this.corners.length;
    const start = whole * Math.floor(first * this.steps);
    part.setDrawRange(start, whole * Math.ceil(last * this.steps) - start);
    return part;
  }

  /** Points (k, 3) around each body of the chain, in its frame. */
  *extent(): Iterable<[number, THREE.Vector3]> {
    for (const [k, body] of this.record.bodies.entries()) {
      for (const [y, z] of this.record.section) {
        yield [body, new THREE.Vector3(0, y, z).applyQuaternion(this.turns[k]!).add(new THREE.Vector3(...this.record.points[k]!))];
      }
    }
  }

  update(): void {
    const { bodies, points } = this.record;
    this.mesh.visible = bodies.every((body) => !this.actor.isBad[body]);
    if (!this.mesh.visible) return;
    const place = bodies.map((body, k) => this.actor.place(body, points[k]!, new THREE.Vector3()));
    const turn = bodies.map((body, k) => this.actor.holder(body).quaternion.clone().multiply(this.turns[k]!));
    const at = new THREE.Vector3();
    const along = new THREE.Vector3();
    const section = new THREE.Quaternion();
    const tilt = new THREE.Quaternion();
    let ring = 0;
    for (let k = 0; k + 1 < bodies.length; k++) {
      for (let step = 0; step < this.steps; step++) {
        const s = step / this.steps;
        hermite(s, place[k]!, place[k + 1]!, turn[k]!, turn[k + 1]!, this.record.smooth, at, along);
        section.slerpQuaternions(turn[k]!, turn[k + 1]!, s);
        if (this.record.smooth && along.lengthSq() > 0) {
          section.premultiply(tilt.setFromUnitVectors(X.clone().applyQuaternion(section), along.normalize()));
        }
        this.ring(ring++, at, section);
      }
    }
    const last = bodies.length - 1;
    this.ring(ring, place[last]!, turn[last]!);
    const first = (ring + 1) * this.corners.length;
    this.cap(first, place[0]!, turn[0]!, -1);
    this.cap(first + this.caps.length, place[last]!, turn[last]!, 1);
    for (const each of ["position", "normal"]) this.mesh.geometry.getAttribute(each).needsUpdate = true;
    this.mesh.geometry.boundingSphere = null; // clicks look for it where it is now
  }

  /** Show by colours from low to high what is felt at places, in numbers of frames; or be of one colour. */
  paint(felt: { at(place: number): number } | null, low: number, high: number): void {
    this.mesh.material = felt ? this.painted : this.material;
    if (!felt) return;
    const colour = this.mesh.geometry.getAttribute("color") as THREE.BufferAttribute;
    const colours = colour.array as Float32Array;
    const span = high > low ? high - low : 1;
    const rings = (this.record.bodies.length - 1) * this.steps + 1;
    const fill = (from: number, count: number, place: number) => {
      ramp((felt.at(place) - low) / span, colours, 3 * from);
      for (let k = 1; k < count; k++) colours.copyWithin(3 * (from + k), 3 * from, 3 * from + 3);
    };
    for (let ring = 0; ring < rings; ring++) fill(ring * this.corners.length, this.corners.length, this.placeOf(ring));
    const first = rings * this.corners.length;
    fill(first, this.caps.length, 0);
    fill(first + this.caps.length, this.caps.length, this.kept.at(-1)!);
    colour.needsUpdate = true;
  }

  /** Of a ring, in numbers of frames of the whole. */
  private placeOf(ring: number): number {
    const k = Math.min(Math.floor(ring / this.steps), this.kept.length - 1);
    const [from, to] = [this.kept[k]!, this.kept[k + 1] ?? this.kept[k]!];
    return from + ((to - from) * (ring - k * this.steps)) / this.steps;
  }

  private ring(ring: number, at: THREE.Vector3, turn: THREE.Quaternion): void {
    this.corners.forEach(({ at: [y, z], normal: [ny, nz] }, k) => this.vertex(ring * this.corners.length + k, at, turn, y, z, 0, ny, nz));
  }

  private cap(first: number, at: THREE.Vector3, turn: THREE.Quaternion, sign: number): void {
    this.caps.forEach(([y, z], k) => this.vertex(first + k, at, turn, y, z, sign, 0, 0));
  }

  private vertex(k: number, at: THREE.Vector3, turn: THREE.Quaternion, y: number, z: number, nx: number, ny: number, nz: number): void {
    const { position, normal } = this.mesh.geometry.attributes;
    const v = VECTOR.set(0, y, z).applyQuaternion(turn).add(at);
    position!.setXYZ(k, v.x, v.y, v.z);
    v.set(nx, ny, nz).applyQuaternion(turn);
    normal!.setXYZ(k, v.x, v.y, v.z);
  }

  /** Sides from ring to ring, then both ends. */
  private triangles(rings: number): number[] {
    const out: number[] = [];
    const width = this.corners.length;
    for (let ring = 0; ring + 1 < rings; ring++) {
      for (let k = 0; k < width; k += 2) {
        const [a, b] = [ring * width + k, ring * width + k + 1];
        out.push(a, b, b + width, a, b + width, a + width);
      }
    }
    const outline = this.record.section.map(([y, z]) => new THREE.Vector2(y, z));
    const hole = this.record.hollow.map(([y, z]) => new THREE.Vector2(y, z));
    const faces = THREE.ShapeUtils.triangulateShape(outline, hole.length ? [hole] : []);
    const first = rings * width;
    for (const [a, b, c] of faces) out.push(first + a!, first + c!, first + b!);
    const second = first + this.caps.length;
    for (const [a, b, c] of faces) out.push(second + a!, second + b!, second + c!);
    return out;
  }
}

/** Numbers of the frames that the line goes through, the first and the last among them. */
function keptFrames(count: number): number[] {
  const most = Math.min(count, MOST_FRAMES);
  return Array.from({ length: most }, (_, k) => Math.round((k * (count - 1)) / (most - 1)));
}

/** The sweep through some of its frames. */
function thinned(whole: Sweep, kept: readonly number[]): Sweep {
  const some = <T>(list: T[]) => kept.map((k) => list[k]!);
  return { ...whole, bodies: some(whole.bodies), points: some(whole.points), axes: some(whole.axes), across: some(whole.across) };
}

const VECTOR = new THREE.Vector3();

/** Place and direction at the share s of the way from one frame to the next. */
function hermite(s: number, a: THREE.Vector3, b: THREE.Vector3, from: THREE.Quaternion, to: THREE.Quaternion, smooth: boolean, at: THREE.Vector3, along: THREE.Vector3): void {
  if (!smooth) {
    at.lerpVectors(a, b, s);
    along.subVectors(b, a);
    return;
  }
  const length = a.distanceTo(b);
  const u = X.clone().applyQuaternion(from).multiplyScalar(length);
  const v = X.clone().applyQuaternion(to).multiplyScalar(length);
  const [s2, s3] = [s * s, s * s * s];
  at.copy(a).multiplyScalar(2 * s3 - 3 * s2 + 1).addScaledVector(b, 3 * s2 - 2 * s3).addScaledVector(u, s3 - 2 * s2 + s).addScaledVector(v, s3 - s2);
  along.subVectors(b, a).multiplyScalar(6 * (s - s2)).addScaledVector(u, 3 * s2 - 4 * s + 1).addScaledVector(v, 3 * s2 - 2 * s);
}

/** Turns x, y, z into the line's direction, `across` made square to it, and what completes them. */
function sectionTurn(axis: readonly [number, number, number], across: readonly [number, number, number]): THREE.Quaternion {
  const x = new THREE.Vector3(...axis).normalize();
  const y = new THREE.Vector3(...across);
  y.addScaledVector(x, -y.dot(x));
  if (y.lengthSq() < 1e-12) y.set(x.z, x.x, x.y).cross(x);
  y.normalize();
  return new THREE.Quaternion().setFromRotationMatrix(new THREE.Matrix4().makeBasis(x, y, new THREE.Vector3().crossVectors(x, y)));
}

/** The edges of an outline, two corners each; normals point away from what is inside (sign 1), or into a hole (-1). */
function edges(outline: readonly (readonly [number, number])[], sign: number): Corner[] {
  const n = outline.length;
  const area = outline.reduce((sum, [y, z], k) => sum + y * outline[(k + 1) % n]![1] - outline[(k + 1) % n]![0] * z, 0);
  const corners = area * sign < 0 ? [...outline].reverse() : outline; // as seen against the line, solid on the left
  const normals = corners.map(([y, z], k) => {
    const [ny, nz] = corners[(k + 1) % n]!;
    const length = Math.hypot(ny - y, nz - z) || 1;
    return [(nz - z) / length, (y - ny) / length] as const;
  });
  return corners.flatMap((at, k) => {
    const own = normals[k]!;
    const smooth = (other: readonly [number, number]) => {
      if (own[0] * other[0] + own[1] * other[1] < CREASE) return own;
      const length = Math.hypot(own[0] + other[0], own[1] + other[1]);
      return [(own[0] + other[0]) / length, (own[1] + other[1]) / length] as const;
    };
    return [
      { at, normal: smooth(normals[(k + n - 1) % n]!) },
      { at: corners[(k + 1) % n]!, normal: smooth(normals[(k + 1) % n]!) },
    ];
  });
}
