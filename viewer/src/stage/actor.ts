// A machine in the picture: groups that follow the frames, with bodies, joint signs and what stretches between bodies.
import * as THREE from "three";
import type { Body, Stage } from "../generated/records";
import type { Arrays } from "../package";
import { Deforming } from "./deforming";
import { Palette, type Look } from "./look";
import { bodyFrame, jointSign } from "./signs";
import { bar, edgesOf, partGeometry } from "./solids";
import { stretching, type Stretching } from "./stretching";

const LINK = 0.013; // radius of automatic links, of the machine's size
const THIN = 0.008; // where a shape is there too

export type Kind = "body" | "joint" | "force";
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
  readonly signs = new THREE.Group(); // joint signs, each in its body's group
  readonly frame: Float32Array; // as shown
  readonly isBad: boolean[];
  private readonly stretching: Stretching[];
  private readonly signObjects: THREE.Object3D[] = [];
  private readonly triads: THREE.Object3D[] = [];
  private readonly centres: THREE.Object3D[] = [];
  private readonly edges: THREE.Object3D[] = [];
  private marked: THREE.Object3D[] = [];

  constructor(
    readonly stage: Stage,
    arrays: Arrays,
    look: Look,
    readonly isGhost: boolean,
  ) {
    this.palette = new Palette(look, isGhost);
    this.frame = new Float32Array(stage.layout.width);
    this.isBad = stage.bodies.map(() => false);
    for (const body of stage.bodies) {
      const group = this.build(body, arrays);
      this.bodies.push(group);
      this.root.add(group);
    }
    this.root.add(this.ground);
    if (!isGhost) this.furnish();
    this.stretching = stretching(this, this.palette);
    for (const each of this.stretching) this.root.add(each.object);
    this.deforming = stage.flexible.map((each) => new Deforming(each, arrays, isGhost));
    for (const each of this.deforming) this.holder(each.record.body).add(each.mesh);
  }

  /** The group of a body, or of the ground. */
  holder(body: number): THREE.Group {
    return this.bodies[body] ?? this.ground;
  }

  /** A point of a body in space, into `out`. */
  place(body: number, point: readonly [number, number, number], out: THREE.Vector3): THREE.Vector3 {
    out.set(...point);
    const group = this.bodies[body];
    return group ? out.applyQuaternion(group.quaternion).add(group.position) : out.sub(this.origin);
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

  /** Show the frame that stands in `this.frame`. Bodies whose pose is not finite are hidden. */
  apply(): void {
    this.bodies.forEach((group, body) => {
      const [x, y, z, e0, e1, e2, e3] = this.frame.subarray(7 * body, 7 * body + 7) as unknown as [number, number, number, number, number, number, number];
      const fit = Number.isFinite(x + y + z + e0 + e1 + e2 + e3);
      this.isBad[body] = !fit;
      group.visible = fit;
      if (!fit) return;
      group.position.set(x, y, z);
      group.quaternion.set(e1, e2, e3, e0).normalize();
    });
    for (const each of this.stretching) each.update();
    const first = 7 * this.stage.layout.bodies;
    for (const each of this.deforming) each.update(this.frame, first);
  }

  show(what: "signs" | "triads" | "centres" | "edges", on: boolean): void {
    const objects = { signs: this.signObjects, triads: this.triads, centres: this.centres, edges: this.edges }[what];
    for (const each of objects) each.visible = on;
  }

  recolour(look: Look): void {
    this.palette.recolour(look);
  }

  /** Light up an element. */
  mark(picked: Picked | null, look: Look): void {
    for (const each of this.marked) each.removeFromParent();
    this.marked = [];
    if (!picked) return;
    const material = new THREE.MeshBasicMaterial({ color: look.accent, transparent: true, opacity: 0.34, depthTest: true, polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -1 });
    const found: THREE.Mesh[] = [];
    this.root.traverse((object) => {
      if (object instanceof THREE.Mesh && object.userData.kind === picked.kind && object.userData.name === picked.name) found.push(object);
    });
    for (const mesh of found) {
      const glow = new THREE.Mesh(mesh.geometry, material);
      mesh.add(glow);
      this.marked.push(glow);
    }
  }

  private build(body: Body, arrays: Arrays): THREE.Group {
    const group = new THREE.Group();
    const said = { kind: "body", name: body.name };
    const material = this.palette.solid(body.colour);
    for (const part of body.parts) {
      const geometry = partGeometry(part, arrays);
      const mesh = solid(geometry, material, said);
      group.add(mesh);
      const edges = edgesOf(part, geometry);
      if (edges) {
        const lines = new THREE.LineSegments(edges, this.palette.edge);
        group.add(lines);
        this.edges.push(lines);
      }
    }
    const centre = new THREE.Vector3(...body.centre_of_mass);
    const size = this.stage.size;
    const radius = (body.parts.length ? THIN : LINK) * size;
    for (const point of body.links) {
      const to = new THREE.Vector3(...point);
      if (to.distanceTo(centre) < 1e-6 * size) continue;
      group.add(solid(bar(centre, to, radius), material, said));
      group.add(ball(to, radius, material, said));
    }
    if (!body.parts.length) group.add(ball(centre, body.links.length > 1 ? 1.5 * radius : 2.2 * radius, material, said));
    return group;
  }

  private furnish(): void {
    const size = this.stage.size;
    for (const joint of this.stage.joints) {
      const holder = this.holder(joint.bodies[joint.place]);
      const sign = jointSign(joint, this.stage, this.palette);
      for (const each of sign.moving) {
        if (holder === this.ground) each.position.sub(this.origin);
        holder.add(each);
        this.signObjects.push(each);
      }
      for (const each of sign.standing) {
        each.position.sub(this.origin);
        this.ground.add(each);
        this.signObjects.push(each);
      }
    }
    for (const [k, body] of this.stage.bodies.entries()) {
      const triad = bodyFrame(0.09 * size);
      triad.visible = false;
      this.bodies[k]!.add(triad);
      this.triads.push(triad);
      const centre = ball(new THREE.Vector3(...body.centre_of_mass), 0.014 * size, this.palette.signDark, { kind: "body", name: body.name });
      (centre.material as THREE.Material).depthTest = true;
      centre.renderOrder = 2;
      centre.visible = false;
      this.bodies[k]!.add(centre);
      this.centres.push(centre);
    }
  }
}

export function solid(geometry: THREE.BufferGeometry, material: THREE.Material, said: Picked | { kind: string; name: string }): THREE.Mesh {
  const mesh = new THREE.Mesh(geometry, material);
  mesh.castShadow = !material.transparent;
  mesh.receiveShadow = false;
  mesh.userData = { ...said };
  return mesh;
}

export function ball(at: THREE.Vector3, radius: number, material: THREE.Material, said: { kind: string; name: string }): THREE.Mesh {
  const mesh = solid(new THREE.SphereGeometry(radius, 20, 14), material, said);
  mesh.position.copy(at);
  return mesh;
}
