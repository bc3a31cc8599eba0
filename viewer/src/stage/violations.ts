// Constraint violations, exaggerated: at each joint how far its second point and frame are from where they should be.
import * as THREE from "three";
import type { Motion } from "../motion";
import type { Actor } from "./actor";
import type { Look } from "./look";

const SHOWN = 0.12; // the largest violation is drawn this long, of the machine's size, at the exaggeration that is proposed
const COUNTED = 400; // frames that the largest one is looked for in

export class Violations {
  readonly root = new THREE.Group();
  exaggeration = 1;
  on = false;
  private readonly material = new THREE.MeshBasicMaterial();
  private readonly drawn: { joint: number; line: THREE.Mesh; dot: THREE.Mesh; axis: THREE.Mesh }[] = [];

  constructor(
    private readonly actor: Actor,
    look: Look,
  ) {
    const size = actor.stage.size;
    actor.stage.joints.forEach((joint, k) => {
      if (joint.violation < 0) return;
      const line = new THREE.Mesh(new THREE.CylinderGeometry(0.004 * size, 0.004 * size, 1, 8).translate(0, 0.5, 0), this.material);
      const axis = new THREE.Mesh(new THREE.CylinderGeometry(0.003 * size, 0.003 * size, 0.16 * size, 8), this.material);
      const dot = new THREE.Mesh(new THREE.SphereGeometry(0.011 * size, 16, 12), this.material);
      for (const each of [line, axis, dot]) each.userData = { kind: "joint", name: joint.name };
      this.root.add(line, axis, dot);
      this.drawn.push({ joint: k, line, dot, axis });
    });
    this.root.visible = false;
    this.recolour(look);
  }

  get isKnown(): boolean {
    return this.drawn.length > 0;
  }

  recolour(look: Look): void {
    this.material.color.set(look.dark ? "#ff7a70" : "#d0312a");
  }

  /** A power of ten at which the largest violation of the motion can be seen; 1 where nothing is violated. */
  proposed(motion: Motion): number {
    const { bodies, modes } = this.actor.stage.layout;
    const step = Math.max(1, Math.floor(motion.count / COUNTED));
    let largest = 0;
    for (const { joint } of this.drawn) {
      const place = this.actor.stage.joints[joint]!.violation;
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
    const gap = new THREE.Vector3();
    const turn = new THREE.Vector3();
    const at = new THREE.Vector3();
    const up = new THREE.Vector3(0, 1, 0);
    for (const { joint, line, dot, axis } of this.drawn) {
      const record = this.actor.stage.joints[joint]!;
      const bad = record.bodies.some((body) => this.actor.isBad[body]);
      for (const each of [line, dot, axis]) each.visible = !bad;
      if (bad) continue;
      this.actor.place(record.bodies[0], record.points[0], at);
      this.actor.vector(record.violation, gap).multiplyScalar(this.exaggeration).clampLength(0, 3 * this.actor.stage.size);
      this.actor.vector(record.violation + 1, turn).multiplyScalar(this.exaggeration);
      const length = gap.length();
      line.position.copy(at);
      line.scale.y = Math.max(length, 1e-9);
      if (length > 0) line.quaternion.setFromUnitVectors(up, gap.clone().divideScalar(length));
      dot.position.copy(at).add(gap);
      const direction = new THREE.Vector3(...record.axes[0]).applyQuaternion(this.actor.holder(record.bodies[0]).quaternion);
      const angle = Math.min(turn.length(), Math.PI);
      if (angle > 0) direction.applyAxisAngle(turn.normalize(), angle);
      axis.quaternion.setFromUnitVectors(up, direction);
      axis.position.copy(dot.position);
    }
  }
}
