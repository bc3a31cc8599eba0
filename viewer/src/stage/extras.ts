// What is drawn of every body only where the user wants it: its frame, its centre of mass. It is made when it is first wanted.
import * as THREE from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import type { Actor, Picked } from "./actor";
import { LINES } from "./batch";
import { Instances } from "./instances";

const AXES = [0xd2473f, 0x279a55, 0x2f6fd6]; // x, y, z
const FRAME = 0.09; // length of an axis, of the size near the body
const CENTRE = 0.014; // radius

export class Extras {
  private made: { triads?: Instances; centres?: Instances } = {};
  private readonly at = new THREE.Vector3();
  private readonly scale = new THREE.Vector3();

  constructor(private readonly actor: Actor) {}

  show(what: "triads" | "centres", on: boolean): void {
    if (on) this.made[what] ??= what === "triads" ? this.triads() : this.centres();
    const made = this.made[what];
    if (made) made.mesh.visible = on;
  }

  /** levels : how much is seen of each body. */
  update(levels: Uint8Array): void {
    const { bodies, isBad, nearness, stage } = this.actor;
    for (const [what, instances] of Object.entries(this.made)) {
      if (!instances.mesh.visible) continue;
      bodies.forEach((group, k) => {
        const size = nearness.body(k);
        if (what === "triads") this.at.copy(group.position);
        else this.actor.place(k, stage.bodies[k]!.centre_of_mass, this.at);
        if (isBad[k] || levels[k]! >= LINES) instances.hide(k);
        else instances.set(k, this.at, group.quaternion, this.scale.setScalar(size));
      });
      instances.done();
    }
  }

  private triads(): Instances {
    return this.instances(triad(), new THREE.MeshBasicMaterial({ vertexColors: true }));
  }

  private centres(): Instances {
    return this.instances(new THREE.SphereGeometry(CENTRE, 16, 12), this.actor.palette.signDark);
  }

  private instances(geometry: THREE.BufferGeometry, material: THREE.Material): Instances {
    const owners: Picked[] = this.actor.stage.bodies.map(({ name }) => ({ kind: "body", name }));
    const instances = new Instances(geometry, material, owners);
    this.actor.root.add(instances.mesh);
    return instances;
  }
}

/** Three coloured arrows along the axes. */
function triad(): THREE.BufferGeometry {
  const radius = 0.028 * FRAME;
  const arrows = AXES.map((tone, k) => {
    const shaft = new THREE.CylinderGeometry(radius, radius, 0.8 * FRAME, 6).translate(0, 0.4 * FRAME, 0);
    const tip = new THREE.ConeGeometry(3 * radius, 0.2 * FRAME, 10).translate(0, 0.9 * FRAME, 0);
    const arrow = mergeGeometries([shaft, tip]);
    if (k === 0) arrow.rotateZ(-Math.PI / 2);
    if (k === 2) arrow.rotateX(Math.PI / 2);
    const colours = Array.from({ length: arrow.getAttribute("position").count }, () => new THREE.Color(tone).toArray()).flat();
    arrow.setAttribute("color", new THREE.Float32BufferAttribute(colours, 3));
    return arrow;
  });
  return mergeGeometries(arrows);
}
