// Arrows of forces and torques: length by value. Twice the typical value of the motion is as long as a fixed share of the machine, or a
// quarter of the largest value, so that a short peak neither hides all others nor leaves the picture.
import * as THREE from "three";
import type { Arrow } from "../generated/records";
import type { Actor, Picked } from "./actor";
import { Instances } from "./instances";
import type { Look } from "./look";

const LONGEST = 0.32; // of the machine's size
const SHAFT = 0.0052;
const HEAD = 0.05;
const ROUND_OFF = 1e-9; // of the torque that the forces have over the machine's size, and the other way round
const MANY = 100; // arrows of a family, from which on they have fewer facets
const UP = new THREE.Vector3(0, 1, 0);

export type Family = "reaction-force" | "reaction-torque" | "applied-force" | "applied-torque";
export const FAMILIES: readonly Family[] = ["applied-force", "applied-torque", "reaction-force", "reaction-torque"];

interface Drawn {
  record: Arrow;
  place: number; // among the arrows of its family
  visible: boolean;
}

/** All arrows of one family. */
interface Bundle {
  arrows: Drawn[];
  shafts: Instances;
  heads: Instances; // two to an arrow of a torque
}

export class Arrows {
  readonly root = new THREE.Group();
  readonly shown = new Set<Family>();
  scale = 1;
  only: string | null = null; // element whose arrows alone are shown
  private readonly drawn: Drawn[];
  private readonly bundles = new Map<Family, Bundle>();
  private readonly reference = new Map<string, number>();
  private readonly materials = new Map<Family, THREE.MeshBasicMaterial>();

  constructor(
    private readonly actor: Actor,
    look: Look,
  ) {
    for (const family of FAMILIES) this.materials.set(family, new THREE.MeshBasicMaterial({ depthTest: false, transparent: true }));
    this.recolour(look);
    for (const arrow of actor.stage.arrows) {
      // one scale for all forces and one for all torques: lengths can be compared
      const reference = Math.max(2 * arrow.typical, arrow.largest / 4);
      this.reference.set(arrow.kind, Math.max(this.reference.get(arrow.kind) ?? 0, reference));
    }
    this.dropRoundOff();
    this.drawn = actor.stage.arrows.map((record) => ({ record, place: 0, visible: false }));
    for (const family of FAMILIES) this.bundle(family);
  }

  has(family: Family): boolean {
    return this.drawn.some(({ record }) => familyOf(record) === family && record.largest > ROUND_OFF * (this.reference.get(record.kind) ?? Infinity));
  }

  /** [N or N m] what an arrow of a tenth of the machine's size stands for. */
  unit(kind: "force" | "torque"): number {
    return ((this.reference.get(kind) ?? 0) * 0.1) / (LONGEST * this.scale);
  }

  /** Joints that carry no torque say round-off: that is no reason to draw it as long as what is carried. */
  private dropRoundOff(): void {
    const { size } = this.actor.stage;
    const force = this.reference.get("force") ?? 0;
    const torque = this.reference.get("torque") ?? 0;
    if (torque <= ROUND_OFF * force * size) this.reference.delete("torque");
    if (force * size <= ROUND_OFF * torque) this.reference.delete("force");
  }

  recolour(look: Look): void {
    for (const [family, material] of this.materials) {
      material.color.set(family.startsWith("applied") ? look.applied : family.endsWith("torque") ? look.moment : look.reaction);
    }
  }

  update(): void {
    for (const [family, { arrows, shafts, heads }] of this.bundles) {
      const shown = this.shown.has(family);
      shafts.mesh.visible = heads.mesh.visible = shown;
      for (const each of arrows) each.visible = shown && this.draw(each, shafts, heads);
      if (!shown) continue;
      shafts.done();
      heads.done();
    }
  }

  /** Bring an arrow to its place; whether there is anything to see of it. */
  private draw({ record, place }: Drawn, shafts: Instances, heads: Instances): boolean {
    const { size } = this.actor.stage;
    const count = headsOf(record.kind);
    const value = this.actor.vector(record.vector, VECTOR).length();
    const reference = this.reference.get(record.kind) ?? 0;
    const length = reference > 0 ? (value / reference) * LONGEST * size * this.scale : 0;
    const seen = length > 1e-3 * size && Number.isFinite(length) && !this.actor.isBad[record.body] && (!this.only || this.only === record.owner);
    if (!seen) {
      shafts.hide(place);
      for (let k = 0; k < count; k++) heads.hide(count * place + k);
      return false;
    }
    const along = VECTOR.divideScalar(value);
    if (record.place >= 0) this.actor.vector(record.place, FOOT);
    else this.actor.place(record.body, record.point, FOOT);
    TURN.setFromUnitVectors(UP, along);
    const head = Math.min(HEAD * size, 0.5 * length);
    const wide = head / (HEAD * size);
    shafts.set(place, FOOT, TURN, SCALE.set(1, Math.max(length - head, 1e-9), 1));
    SCALE.setScalar(wide);
    for (let k = 0; k < count; k++) heads.set(count * place + k, TIP.copy(FOOT).addScaledVector(along, length - head - 0.55 * k * head), TURN, SCALE);
    return true;
  }

  private bundle(family: Family): void {
    const arrows = this.drawn.filter(({ record }) => familyOf(record) === family);
    if (!arrows.length) return;
    const { size } = this.actor.stage;
    const material = this.materials.get(family)!;
    const owners = arrows.map(({ record }) => this.owner(record));
    const facets = arrows.length > MANY ? 6 : 18;
    const shafts = new Instances(new THREE.CylinderGeometry(SHAFT * size, SHAFT * size, 1, facets).translate(0, 0.5, 0), material, owners);
    const cone = new THREE.ConeGeometry(3.1 * SHAFT * size, HEAD * size, facets).translate(0, 0.5 * HEAD * size, 0);
    const heads = new Instances(cone, material, owners.flatMap((owner, k) => Array<Picked>(headsOf(arrows[k]!.record.kind)).fill(owner)));
    arrows.forEach((each, k) => (each.place = k));
    for (const { mesh } of [shafts, heads]) {
      mesh.renderOrder = 5; // seen through bodies
      mesh.visible = false;
      this.root.add(mesh);
    }
    this.bundles.set(family, { arrows, shafts, heads });
  }

  private owner(record: Arrow): Picked {
    const { joints, drivers } = this.actor.stage;
    const owns = (each: { name: string }) => each.name === record.owner;
    return { kind: record.source === "reaction" && joints.some(owns) ? "joint" : drivers.some(owns) ? "driver" : "force", name: record.owner };
  }
}

const headsOf = (kind: Arrow["kind"]) => (kind === "torque" ? 2 : 1);
const [VECTOR, FOOT, TIP, SCALE, TURN] = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3(), new THREE.Quaternion()];

export function familyOf(arrow: Arrow): Family {
  return `${arrow.source}-${arrow.kind}`;
}
