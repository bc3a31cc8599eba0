// Constraint violations, exaggerated: at each joint how far its second point and frame are from where they should be.
import * as THREE from "three";
import type { Joint } from "../generated/records";
import type { Motion } from "../motion";
import type { Actor, Picked } from "./actor";
import { Instances } from "./instances";
import type { Look } from "./look";

const SHOWN = 0.12; // the largest violation is drawn this long, of the machine's size, at the exaggeration that is proposed
const COUNTED = 400; // frames that the largest one is looked for in

export class Violations {
  readonly root = new THREE.Group();
  exaggeration = 1;
  on = false;
  private readonly material = new THREE.MeshBasicMaterial();
  private readonly joints: Joint[];
  private readonly lines: Instances; // from where the second point should be to where it is, exaggerated
  private readonly dots: Instances;
  private readonly axes: Instances;

  constructor(
    private readonly actor: Actor,
    look: Look,
  ) {
    const size = actor.stage.size;
    this.joints = actor.stage.joints.filter((joint) => joint.violation >= 0);
    const owners: Picked[] = this.joints.map(({ name }) => ({ kind: "joint", name }));
    this.lines = new Instances(new THREE.CylinderGeometry(0.004 * size, 0.004 * size, 1, 8).translate(0, 0.5, 0), this.material, owners);
    this.axes = new Instances(new THREE.CylinderGeometry(0.003, 0.003, 0.16, 8), this.material, owners);
    this.dots = new Instances(new THREE.SphereGeometry(0.011, 16, 12), this.material, owners);
    for (const { mesh } of [this.lines, this.axes, this.dots]) this.root.add(mesh);
    this.root.visible = false;
    this.recolour(look);
  }

  get isKnown(): boolean {
    return this.joints.length > 0;
  }

  recolour(look: Look): void {
    this.material.color.set(look.dark ? "#ff7a70" : "#d0312a");
  }

  /** A power of ten at which the largest violation of the motion can be seen; 1 where nothing is violated. */
  proposed(motion: Motion): number {
    const { bodies, modes } = this.actor.stage.layout;
    const step = Math.max(1, Math.floor(motion.count / COUNTED));
    let largest = 0;
    for (const { violation: place } of this.joints) {
      for (const [vector, length] of [[place, 1], [place + 1, 0.3 * this.actor.stage.size]] as const) {
        const row = 7 * bodies + modes + 3 * vector;
        for (let k = 0; k < motion.count; k += step) {
          const size = length * Math.hypot(motion.value(row, k), motion.value(row + 1, k), motion.value(row + 2, k));
          if (Number.isFinite(size)) largest = Math.max(largest, size);
        }
      }
    }
    return largest > 0 ? 10 ** Math.round(Math.log10((SHOWN * this.actor.stage.size) / largest)) : 1;
  }

  update(): void {
    this.root.visible = this.on;
    if (!this.on) return;
    const [gap, turn, at, axis, scale] = [0, 1, 2, 3, 4].map(() => new THREE.Vector3()) as [THREE.Vector3, THREE.Vector3, THREE.Vector3, THREE.Vector3, THREE.Vector3];
    const tilt = new THREE.Quaternion();
    this.joints.forEach((joint, k) => {
      if (joint.bodies.some((body) => this.actor.isBad[body])) {
        for (const each of [this.lines, this.dots, this.axes]) each.hide(k);
        return;
      }
      const size = this.actor.nearness.joint(joint);
      this.actor.place(joint.bodies[0], joint.points[0], at);
      this.actor.vector(joint.violation, gap).multiplyScalar(this.exaggeration).clampLength(0, 3 * this.actor.stage.size);
      this.actor.vector(joint.violation + 1, turn).multiplyScalar(this.exaggeration);
      const length = gap.length();
      if (length > 0) tilt.setFromUnitVectors(UP, axis.copy(gap).divideScalar(length));
      this.lines.set(k, at, tilt, scale.set(1, Math.max(length, 1e-9), 1));
      at.add(gap);
      axis.set(...joint.axes[0]).applyQuaternion(this.actor.holder(joint.bodies[0]).quaternion);
      const angle = Math.min(turn.length(), Math.PI);
      if (angle > 0) axis.applyAxisAngle(turn.normalize(), angle);
      scale.setScalar(size);
      this.axes.set(k, at, tilt.setFromUnitVectors(UP, axis.normalize()), scale);
      this.dots.set(k, at, tilt, scale);
    });
    for (const each of [this.lines, this.dots, this.axes]) each.done();
  }
}

const UP = new THREE.Vector3(0, 1, 0);
