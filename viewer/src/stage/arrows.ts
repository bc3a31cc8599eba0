// Arrows of forces and torques: length by value. Twice the typical value of the motion is as long as a fixed share of the machine, or a
// quarter of the largest value, so that a short peak neither hides all others nor leaves the picture.
import * as THREE from "three";
import type { Arrow } from "../generated/records";
import type { Actor } from "./actor";
import type { Look } from "./look";

const LONGEST = 0.32; // of the machine's size
const SHAFT = 0.0052;
const HEAD = 0.05;
const UP = new THREE.Vector3(0, 1, 0);

export type Family = "reaction-force" | "reaction-torque" | "applied-force" | "applied-torque";
export const FAMILIES: readonly Family[] = ["applied-force", "applied-torque", "reaction-force", "reaction-torque"];

interface Drawn {
  record: Arrow;
  group: THREE.Group;
  shaft: THREE.Mesh;
  heads: THREE.Mesh[];
}

export class Arrows {
  readonly root = new THREE.Group();
  readonly shown = new Set<Family>();
  scale = 1;
  only: string | null = null; // element whose arrows alone are shown
  private readonly drawn: Drawn[];
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
    this.drawn = actor.stage.arrows.map((arrow) => this.make(arrow));
  }

  has(family: Family): boolean {
    return this.drawn.some((each) => familyOf(each.record) === family && each.record.largest > 0);
  }

  /** [N or N m] what an arrow of a tenth of the machine's size stands for. */
  unit(kind: "force" | "torque"): number {
    return ((this.reference.get(kind) ?? 0) * 0.1) / (LONGEST * this.scale);
  }

  recolour(look: Look): void {
    for (const [family, material] of this.materials) {
      material.color.set(family.startsWith("applied") ? look.applied : family.endsWith("torque") ? look.moment : look.reaction);
    }
  }

  update(): void {
    const vector = new THREE.Vector3();
    const size = this.actor.stage.size;
    for (const each of this.drawn) {
      const { record, group } = each;
      group.visible = this.shown.has(familyOf(record)) && (!this.only || this.only === record.owner) && !this.actor.isBad[record.body];
      if (!group.visible) continue;
      this.actor.vector(record.vector, vector);
      const value = vector.length();
      const reference = this.reference.get(record.kind) ?? 0;
      const length = reference > 0 ? (value / reference) * LONGEST * size * this.scale : 0;
      if (!(length > 1e-3 * size) || !Number.isFinite(length)) {
        group.visible = false;
        continue;
      }
      this.actor.place(record.body, record.point, group.position);
      group.quaternion.setFromUnitVectors(UP, vector.divideScalar(value));
      const head = Math.min(HEAD * size, 0.5 * length);
      const wide = head / (HEAD * size);
      each.shaft.scale.set(1, Math.max(length - head, 1e-9), 1);
      each.heads.forEach((tip, k) => {
        tip.scale.setScalar(wide);
        tip.position.y = length - head - 0.55 * k * head;
      });
    }
  }

  private make(record: Arrow): Drawn {
    const size = this.actor.stage.size;
    const material = this.materials.get(familyOf(record))!;
    const shaft = new THREE.Mesh(new THREE.CylinderGeometry(SHAFT * size, SHAFT * size, 1, 10).translate(0, 0.5, 0), material);
    const heads = Array.from({ length: record.kind === "torque" ? 2 : 1 }, () => {
      return new THREE.Mesh(new THREE.ConeGeometry(3.1 * SHAFT * size, HEAD * size, 18).translate(0, 0.5 * HEAD * size, 0), material);
    });
    const group = new THREE.Group();
    group.add(shaft, ...heads);
    group.visible = false;
    const { joints, drivers } = this.actor.stage;
    const owns = (each: { name: string }) => each.name === record.owner;
    const said = { kind: record.source === "reaction" && joints.some(owns) ? "joint" : drivers.some(owns) ? "driver" : "force", name: record.owner };
    for (const each of [shaft, ...heads]) {
      each.userData = said;
      each.renderOrder = 5; // seen through bodies
    }
    this.root.add(group);
    return { record, group, shaft, heads };
  }
}

export function familyOf(arrow: Arrow): Family {
  return `${arrow.source}-${arrow.kind}`;
}
