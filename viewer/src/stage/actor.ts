// A machine in the picture: groups that follow the frames, with bodies, joint signs and what stretches between bodies.
import * as THREE from "three";
import type { Body, Stage } from "../generated/records";
import type { Motion } from "../motion";
import type { Arrays } from "../package";
import { Batch, COARSE, FINE, HIDDEN, LINES, noPieces, type Piece } from "./batch";
import { Bones } from "./bones";
import { Deforming } from "./deforming";
import { Extras, type Extra } from "./extras";
import type { Instances } from "./instances";
import { Palette, TONES, type Look, type Tone } from "./look";
import { Nearness } from "./nearness";
import { jointSigns } from "./signs";
import { markColour, markOf } from "./marks";
import { ball, bar, edgesOf, partGeometry } from "./solids";
import { coupled } from "./coupled";
import { stretching, type Stretching } from "./stretching";
import { Sections } from "./sections";
import { Swept } from "./swept";

const LINK = 0.013; // radius of automatic links, of the size near the body
const THIN = 0.008; // where a shape is there too
const LARGEST = 1e30; // m: as playback.py says
const MANY = 40; // a machine of more bodies is drawn coarser where it is far away
const ROUND = 20; // facets of round solids
const ROUGH = 6; // and from afar
const NEAR = 6; // pixels of a link's radius from which on it is drawn finely
const FAR = 0.75; // and below which it is a line

const POINT = new THREE.Vector3();
const TURN = new THREE.Quaternion();

export type Kind = "body" | "joint" | "force" | "driver" | "coupling";
export interface Picked {
  kind: Kind;
  name: string;
}

export class Actor {
  readonly root = new THREE.Group();
  readonly bodies: THREE.Group[] = [];
  readonly ground = new THREE.Group();
  readonly palette: Palette;
  readonly deforming: Deforming[];
  readonly swept: Swept[];
  readonly sections: Sections;
  time = 0; // of the frame that is shown
  readonly nearness: Nearness;
  readonly frame: Float32Array; // as shown
  readonly isBad: boolean[];
  readonly solids: Piece[] = []; // of the bodies
  private readonly pieces: readonly Piece[]; // all
  private readonly levels: Uint8Array; // how much is seen of each body
  private readonly bones: Bones | null;
  private readonly stretching: Stretching[];
  private readonly batches: Batch[] = [];
  private readonly signBatches: Batch[] = [];
  private readonly edges: THREE.Object3D[] = [];
  private readonly extras = new Extras(this);
  private readonly bending = new Map<number, Deforming>(); // by the numbers of bodies
  private marked: THREE.Object3D[] = [];

  constructor(
    readonly stage: Stage,
    arrays: Arrays,
    look: Look,
    motion: Motion | null,
    readonly isGhost: boolean,
  ) {
    this.palette = new Palette(look, isGhost);
    this.nearness = new Nearness(stage);
    this.frame = new Float32Array(stage.layout.width);
    this.isBad = stage.bodies.map(() => false);
    this.levels = new Uint8Array(stage.bodies.length);
    this.ground.position.copy(this.origin).negate();
    this.root.add(this.ground);
    for (const [k, body] of stage.bodies.entries()) {
      this.bodies.push(new THREE.Group());
      this.root.add(this.bodies[k]!);
      this.build(k, body, arrays);
    }
    motion?.sample(motion.start, this.frame); // springs are as long as at the start
    this.pose();
    const { moving, pieces } = stretching(this, motion);
    const couplings = isGhost ? { moving: [], pieces: noPieces() } : coupled(this);
    this.stretching = [...moving, ...couplings.moving];
    for (const each of this.stretching) this.root.add(each.object);
    this.fill(this.solids, this.palette.body, this.batches);
    const signs = this.signs();
    for (const tone of TONES) {
      signs[tone].push(...couplings.pieces[tone]);
      this.fill(signs[tone], this.palette[tone], this.signBatches);
      this.fill(pieces[tone], this.palette[tone], this.batches);
    }
    this.pieces = [...this.solids, ...TONES.flatMap((tone) => [...signs[tone], ...pieces[tone]])];
    this.swept = stage.sweeps.map((each) => new Swept(each, this, this.palette.bodyOf(each.colour)));
    for (const each of this.swept) this.root.add(each.mesh);
    this.sections = new Sections(stage, arrays);
    this.bones = this.isLarge ? new Bones(this, isGhost) : null;
    if (this.bones) this.root.add(this.bones.object);
    this.recolour(look);
    this.deforming = stage.flexible.map((each) => new Deforming(each, arrays, isGhost, stage.size));
    for (const each of this.deforming) {
      this.holder(each.record.body).add(each.mesh);
      this.bending.set(each.record.body, each);
    }
  }

  /** The group of a body, or of the ground. */
  holder(body: number): THREE.Group {
    return this.bodies[body] ?? this.ground;
  }

  /** A point of a body in space, into `out`; of one that bends, where it is drawn. */
  place(body: number, point: readonly [number, number, number], out: THREE.Vector3): THREE.Vector3 {
    const group = this.holder(body);
    this.bent(body, point, this.frame, out, this.bending.get(body)?.exaggeration);
    return out.applyQuaternion(group.quaternion).add(group.position);
  }

  /** The same in another frame than the one that is shown. */
  placeIn(frame: Float32Array, body: number, point: readonly [number, number, number], out: THREE.Vector3): THREE.Vector3 {
    if (body < 0) return out.set(...point).add(this.ground.position);
    const [x, y, z, e0, e1, e2, e3] = frame.subarray(7 * body, 7 * body + 7) as unknown as [number, number, number, number, number, number, number];
    this.bent(body, point, frame, out, this.bending.get(body)?.exaggeration);
    out.applyQuaternion(TURN.set(e1, e2, e3, e0).normalize());
    return out.set(out.x + x, out.y + y, out.z + z);
  }

  /** A direction of a body in space, in a frame. */
  turnIn(frame: Float32Array, body: number, direction: readonly [number, number, number], out: THREE.Vector3): THREE.Vector3 {
    out.set(...direction);
    if (body < 0) return out;
    const [e0, e1, e2, e3] = frame.subarray(7 * body + 3, 7 * body + 7) as unknown as [number, number, number, number];
    return out.applyQuaternion(TURN.set(e1, e2, e3, e0).normalize());
  }

  /** A point of a body in its frame, carried by the modes of that in a frame, into `out`. */
  bent(body: number, point: readonly [number, number, number], frame: Float32Array, out: THREE.Vector3, exaggeration = 1): THREE.Vector3 {
    const bending = this.bending.get(body);
    if (!bending) return out.set(...point);
    return bending.carried(point, frame, 7 * this.stage.layout.bodies, out).multiplyScalar(exaggeration).add(POINT.set(...point));
  }

  private get origin(): THREE.Vector3 {
    return new THREE.Vector3(...this.stage.origin);
  }

  /** A vector of the frame that is shown, into `out`. */
  vector(place: number, out: THREE.Vector3): THREE.Vector3 {
    const { bodies, modes } = this.stage.layout;
    const first = 7 * bodies + modes + 3 * place;
    return out.set(this.frame[first]!, this.frame[first + 1]!, this.frame[first + 2]!);
  }

  /** Show the frame that stands in `this.frame`. */
  apply(): void {
    this.pose();
    for (const each of [...this.stretching, ...this.swept]) each.update();
    this.sections.moveTo(this.time);
    const { low = 0, high = 0 } = this.sections.shown ?? {};
    this.swept.forEach((each, k) => each.paint(this.sections.of(k), low, high));
    this.arrange();
    this.bones?.update();
    const first = 7 * this.stage.layout.bodies;
    for (const each of this.deforming) each.update(this.frame, first);
  }

  /** Draw as much of each body as is seen from the camera; of a machine of few bodies all is drawn. height : of the picture, in pixels. */
  look(camera: THREE.PerspectiveCamera, height: number): void {
    if (!this.isLarge) return;
    const at = new THREE.Vector3();
    const focal = (0.5 * height) / Math.tan(THREE.MathUtils.degToRad(camera.fov / 2));
    let changed = false;
    camera.updateMatrixWorld();
    this.bodies.forEach((group, k) => {
      const size = this.nearness.body(k);
      at.copy(group.position).add(this.root.position).applyMatrix4(camera.matrixWorldInverse);
      const depth = Math.max(-at.z, 0.1 * size);
      const pixels = (LINK * size * focal) / depth;
      // a body is about as long as a sixth of the size near it, what shows of it reaches twice as far
      const wide = (0.5 * size + depth * Math.tan(THREE.MathUtils.degToRad(camera.fov / 2))) * 1.05;
      const out = at.z > size || Math.abs(at.y) > wide || Math.abs(at.x) > wide * Math.max(camera.aspect, 1);
      const level = out ? HIDDEN : pixels > NEAR ? FINE : pixels > FAR ? COARSE : LINES;
      if (level !== this.levels[k]) changed = true;
      this.levels[k] = level;
    });
    if (changed) this.arrange();
  }

  private get isLarge(): boolean {
    return this.stage.bodies.length > MANY;
  }

  private arrange(): void {
    for (const batch of [...this.batches, ...this.signBatches]) batch.update(this.levels);
    this.extras.update(this.levels);
  }

  /** Bring the bodies to their places; those whose pose is not finite are hidden. */
  private pose(): void {
    this.bodies.forEach((group, body) => {
      const first = 7 * body;
      const [x, y, z, e0, e1, e2, e3] = [0, 1, 2, 3, 4, 5, 6].map((k) => this.frame[first + k]!) as [number, number, number, number, number, number, number];
      const fit = Number.isFinite(e0 + e1 + e2 + e3) && Math.max(Math.abs(x), Math.abs(y), Math.abs(z)) <= LARGEST;
      this.isBad[body] = !fit;
      group.visible = fit;
      if (!fit) return;
      group.position.set(x, y, z);
      group.quaternion.set(e1, e2, e3, e0).normalize();
    });
  }

  show(what: "signs" | "edges" | Extra, on: boolean): void {
    if (what === "signs") for (const each of this.signBatches) each.mesh.visible = on;
    else if (what === "edges") for (const each of this.edges) each.visible = on;
    else this.extras.show(what, on);
  }

  recolour(look: Look): void {
    this.palette.recolour(look);
    this.bones?.recolour(look.soft);
  }

  /** Light up an element. */
  mark(picked: Picked | null, look: Look): void {
    for (const each of this.marked) each.removeFromParent();
    this.marked = [];
    if (!picked) return;
    // signs often stand inside solids: they shine through
    const material = new THREE.MeshBasicMaterial({ color: look.accent, transparent: true, opacity: 0.34, depthTest: picked.kind === "body", polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -1 });
    const is = (said: unknown) => (said as Picked).kind === picked.kind && (said as Picked).name === picked.name;
    const found: [THREE.BufferGeometry, THREE.Object3D][] = this.pieces.filter(({ said }) => is(said)).map(({ geometry, holder }) => [geometry, holder]);
    this.root.traverse((object) => {
      if (object instanceof THREE.Mesh && is(object.userData)) found.push([object.geometry, object]);
    });
    for (const each of picked.kind === "body" ? this.swept : []) {
      const part = each.around(picked.name);
      if (part) found.push([part, each.mesh]);
    }
    for (const [geometry, holder] of found) {
      const glow = new THREE.Mesh(geometry, material);
      holder.add(glow);
      this.marked.push(glow);
    }
  }

  /** What the solids of the bodies are drawn by. */
  get bodyMeshes(): THREE.Object3D[] {
    return this.batches.map(({ mesh }) => mesh);
  }

  /** What is under a ray, of one of its hits. */
  said(hit: THREE.Intersection): Picked | null {
    const batch = [...this.batches, ...this.signBatches].find(({ mesh }) => mesh === hit.object);
    if (batch) return batch.said(hit.batchId ?? -1);
    if (hit.object instanceof THREE.InstancedMesh) return (hit.object.userData as { instances: Instances }).instances.said(hit.instanceId);
    const swept = this.swept.find(({ mesh }) => mesh === hit.object);
    if (swept) return swept.nearest(hit.point);
    return hit.object instanceof THREE.Mesh && hit.object.userData.name ? (hit.object.userData as Picked) : null;
  }

  private fill(pieces: Piece[], material: THREE.Material, into: Batch[]): void {
    if (!pieces.length) return;
    const batch = new Batch(pieces, material);
    this.root.add(batch.mesh);
    into.push(batch);
  }

  private build(k: number, body: Body, arrays: Arrays): void {
    const holder = this.bodies[k]!;
    const said: Picked = { kind: "body", name: body.name };
    const colour = this.isGhost ? undefined : body.colour;
    const add = (made: (facets: number) => THREE.BufferGeometry, facets: number, thin: boolean, own = "") => {
      const painted = own && !this.isGhost ? own : colour;
      const coarse = this.isLarge && facets > ROUGH ? { coarse: made(ROUGH) } : {};
      this.solids.push({ geometry: made(facets), ...coarse, thin, body: k, holder, said, ...(painted ? { colour: painted } : {}) });
    };
    for (const part of body.parts) {
      add((facets) => partGeometry(part, arrays, 2 * facets), part.kind === "mesh" ? ROUGH : ROUND, false, part.colour);
      const mark = this.isGhost || this.isLarge ? null : markOf(part);
      if (mark && (part.colour || colour)) add(() => mark, ROUGH, true, markColour(part.colour || colour!));
      const edges = edgesOf(part, partGeometry(part, arrays));
      if (edges) {
        const lines = new THREE.LineSegments(edges, this.palette.edge);
        holder.add(lines);
        this.edges.push(lines);
      }
    }
    const centre = new THREE.Vector3(...body.centre_of_mass);
    const size = this.nearness.body(k);
    const radius = (body.parts.length ? THIN : LINK) * size;
    for (const point of body.links) {
      const to = new THREE.Vector3(...point);
      if (to.distanceTo(centre) < 1e-6 * size) continue;
      add((facets) => bar(centre, to, radius, facets), ROUND, true);
      add((facets) => ball(to, radius, facets), ROUND, true);
    }
    if (body.automatic && !body.parts.length) add((facets) => ball(centre, (body.links.length > 1 ? 1.5 : 2.2) * radius, facets), ROUND, true);
  }

  /** Of the joints; a ghost has none. */
  private signs(): Record<Tone, Piece[]> {
    const out = noPieces();
    for (const joint of this.isGhost ? [] : this.stage.joints) {
      const said: Picked = { kind: "joint", name: joint.name };
      const size = this.nearness.joint(joint);
      const coarse = this.isLarge ? jointSigns(joint, this.stage, size, ROUGH) : [];
      jointSigns(joint, this.stage, size, ROUND + 4).forEach(({ tone, geometry, standing }, k) => {
        const body = standing ? -1 : joint.bodies[joint.place];
        const far = coarse[k] ? { coarse: coarse[k].geometry } : {};
        out[tone].push({ geometry, ...far, thin: true, body, holder: this.holder(body), said });
      });
    }
    return out;
  }
}
