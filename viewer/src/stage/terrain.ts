// Ground that deforms: nodes that move by whole steps along its normal, forwards and backwards in time; and what bodies carry of it.
import * as THREE from "three";
import type { Load, Terrain as Ground } from "../generated/records";
import type { Arrays } from "../package";
import type { Actor } from "./actor";
import { triangleMesh } from "./solids";

const LAID = new THREE.Color("#a39781");
const MOVED = new THREE.Color("#694f35");
const FRESH = 0.5; // of a cell: what has moved by so much shows the other colour wholly

/** Which nodes move by how many steps, and volumes that are carried then. */
export interface Moves {
  carried: Float32Array;
  nodes: Uint32Array;
  moves: Int16Array;
}

export class Terrain {
  readonly mesh: THREE.Mesh;
  readonly heaps: THREE.Mesh[];
  private readonly cell: number;
  private readonly columns: number;
  private readonly normal: THREE.Vector3;
  private readonly at: Float32Array; // positions of the nodes
  private readonly normals: Float32Array;
  private readonly colours: Float32Array;
  private readonly steps: Int32Array; // of each node from where it lay
  private readonly course: { time: Float64Array; ends: Uint32Array; carried: Float32Array; nodes: Uint32Array; moves: Int16Array };
  private readonly marked: Uint8Array; // nodes whose normal is not known any more
  private waiting: number[] = [];
  private passed = 0; // moments
  private carried: Float32Array = new Float32Array();

  constructor(
    private readonly ground: Ground,
    arrays: Arrays,
    private readonly actor: Actor,
  ) {
    const heights = arrays.floats(ground.heights);
    const count = heights.length;
    const [along, across] = [new THREE.Vector3(...ground.along), new THREE.Vector3(...ground.across)];
    this.cell = along.length();
    this.columns = ground.heights.shape[1]!;
    this.normal = along.clone().cross(across).normalize();
    this.at = new Float32Array(3 * count);
    heights.forEach((height, k) => {
      const column = k % this.columns;
      ALONG.set(...ground.corner).addScaledVector(along, column).addScaledVector(across, (k - column) / this.columns);
      ALONG.addScaledVector(this.normal, height).toArray(this.at, 3 * k);
    });
    const geometry = triangleMesh(this.at, triangles(count, this.columns));
    geometry.computeVertexNormals();
    this.normals = geometry.getAttribute("normal").array as Float32Array;
    this.colours = new Float32Array(3 * count);
    for (let k = 0; k < count; k++) LAID.toArray(this.colours, 3 * k);
    geometry.setAttribute("color", new THREE.BufferAttribute(this.colours, 3));
    this.steps = new Int32Array(count);
    this.marked = new Uint8Array(count);
    this.mesh = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ vertexColors: true, side: THREE.DoubleSide }));
    this.mesh.position.set(...actor.stage.origin).negate();
    this.mesh.castShadow = this.mesh.receiveShadow = true;
    this.mesh.frustumCulled = false; // its extent changes
    this.heaps = ground.loads.map(heap);
    const nodes = arrays.indices(ground.nodes);
    for (let k = 1; k < nodes.length; k++) nodes[k]! += nodes[k - 1]!;
    this.course = { time: arrays.times(ground.time), ends: arrays.indices(ground.ends), carried: arrays.floats(ground.carried), nodes, moves: arrays.signed(ground.moves) };
  }

  /** As it is at a time of a motion that is known. */
  goTo(time: number): void {
    const { course } = this;
    if (!course.time.length) return;
    const slots = course.carried.length / course.time.length;
    while (this.passed < course.time.length && course.time[this.passed]! <= time) this.pass(this.passed++, 1);
    while (this.passed > 0 && course.time[this.passed - 1]! > time) this.pass(--this.passed, -1);
    const now = slots * Math.max(this.passed - 1, 0);
    this.carried = course.carried.subarray(now, now + slots);
    this.settle();
  }

  /** What has come of a machine that lives. */
  take({ carried, nodes, moves }: Moves): void {
    nodes.forEach((node, k) => this.move(node, moves[k]!));
    this.carried = carried;
    this.settle();
  }

  /** Bring what is carried to the bodies that carry it. */
  update(): void {
    this.ground.loads.forEach((load, k) => this.place(load, this.heaps[k]!));
  }

  private place({ slot, body, point, half }: Load, mesh: THREE.Mesh): void {
    const volume = this.carried[slot] ?? 0;
    mesh.visible = volume > this.cell ** 3 && !this.actor.isBad[body];
    if (!mesh.visible) return;
    const length = Math.hypot(...half);
    const radius = Math.sqrt((3 * volume) / (4 * Math.PI * length));
    mesh.scale.set(length, radius, radius);
    mesh.quaternion.copy(this.actor.holder(body).quaternion).multiply(TURN.setFromUnitVectors(X, ALONG.set(...half).normalize()));
    this.actor.place(body, point, mesh.position);
  }

  private pass(moment: number, way: 1 | -1): void {
    const { ends, nodes, moves } = this.course;
    for (let k = moment ? ends[moment - 1]! : 0; k < ends[moment]!; k++) this.move(nodes[k]!, way * moves[k]!);
  }

  private move(node: number, by: number): void {
    const { columns, normal, at } = this;
    const rise = by * this.ground.step;
    this.steps[node]! += by;
    at[3 * node]! += rise * normal.x;
    at[3 * node + 1]! += rise * normal.y;
    at[3 * node + 2]! += rise * normal.z;
    for (const near of [node, node - 1, node + 1, node - columns, node + columns]) {
      if (near < 0 || near >= this.marked.length || this.marked[near]) continue;
      this.marked[near] = 1;
      this.waiting.push(near);
    }
  }

  /** Find normals and colours again about what has moved. */
  private settle(): void {
    if (!this.waiting.length) return;
    const { columns, cell } = this;
    const last = this.marked.length / columns - 1;
    for (const node of this.waiting) {
      this.marked[node] = 0;
      const column = node % columns;
      const row = (node - column) / columns;
      this.between(node - Number(column > 0), node + Number(column < columns - 1), ALONG);
      this.between(node - columns * Number(row > 0), node + columns * Number(row < last), ACROSS);
      ALONG.cross(ACROSS).normalize().toArray(this.normals, 3 * node);
      TONE.copy(LAID).lerp(MOVED, Math.min(Math.abs(this.steps[node]! * this.ground.step) / (FRESH * cell), 1)).toArray(this.colours, 3 * node);
    }
    this.waiting = [];
    for (const name of ["position", "normal", "color"]) this.mesh.geometry.getAttribute(name).needsUpdate = true;
  }

  private between(from: number, to: number, out: THREE.Vector3): void {
    const { at } = this;
    out.set(at[3 * to]! - at[3 * from]!, at[3 * to + 1]! - at[3 * from + 1]!, at[3 * to + 2]! - at[3 * from + 2]!);
  }
}

const ALONG = new THREE.Vector3();
const ACROSS = new THREE.Vector3();
const TURN = new THREE.Quaternion();
const X = new THREE.Vector3(1, 0, 0);
const TONE = new THREE.Color();

/** Two in each cell, seen from above counter-clockwise. */
function triangles(count: number, columns: number): Uint32Array {
  const out = new Uint32Array(6 * (columns - 1) * (count / columns - 1));
  let end = 0;
  for (let k = 0; k < count - columns; k++) {
    if ((k + 1) % columns === 0) continue;
    out.set([k, k + 1, k + columns + 1, k, k + columns + 1, k + columns], end);
    end += 6;
  }
  return out;
}

/** What a bucket carries: an ellipsoid of its volume, as long as the edge. */
function heap(): THREE.Mesh {
  const mesh = new THREE.Mesh(new THREE.SphereGeometry(1, 32, 24), new THREE.MeshLambertMaterial({ color: MOVED }));
  mesh.castShadow = mesh.receiveShadow = true;
  mesh.visible = false;
  return mesh;
}
