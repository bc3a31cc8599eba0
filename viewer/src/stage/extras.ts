// What is drawn only where the user wants it: frames of bodies, joints and markers, axes of joints, centres of mass. Made when first wanted.
import * as THREE from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import type { Actor, Picked } from "./actor";
import { LINES } from "./batch";
import { Instances } from "./instances";

const TONES = [0xd2473f, 0x279a55, 0x2f6fd6]; // x, y, z
const FRAME = 0.09; // length of an axis, of the size near it
const OF_JOINT = 0.7; // frames of joints and markers are as much smaller than those of bodies
const CENTRE = 0.014; // radius
const LINE = 0.16; // half the length of the line along a joint's axis
const THIN = 0.0012; // its radius
const AXIAL = ["revolute", "cylindrical", "translational", "screw", "planar", "point-on-line", "point-on-plane", "revolute-spherical", "revolute-cylindrical", "revolute-translational", "universal", "cylindrical-on-beam", "translational-on-beam"];

type Point = readonly [number, number, number];
export type Extra = "triads" | "centres" | "joints" | "markers" | "axes";

/** Where one stands: at a point of a body, turned against it, and how large it is. */
interface Spot {
  owner: Picked;
  body: number;
  point: Point;
  turn: THREE.Quaternion;
  size: number;
}

export class Extras {
  private readonly made = new Map<Extra, { spots: Spot[]; instances: Instances }>();
  private readonly at = new THREE.Vector3();
  private readonly turn = new THREE.Quaternion();
  private readonly scale = new THREE.Vector3();

  constructor(private readonly actor: Actor) {}

  show(what: Extra, on: boolean): void {
    if (on && !this.made.has(what)) this.made.set(what, this.make(what));
    const made = this.made.get(what);
    if (made) made.instances.mesh.visible = on;
  }

  /** levels : how much is seen of each body. */
  update(levels: Uint8Array): void {
    for (const [what, { spots, instances }] of this.made) {
      if (!instances.mesh.visible) continue;
      spots.forEach(({ body, point, turn, size }, k) => {
        if (this.actor.isBad[body] || (levels[body] ?? 0) >= LINES) {
          instances.hide(k);
          return;
        }
        if (what === "triads") this.at.copy(this.actor.holder(body).position); // not carried by what bends
        else this.actor.place(body, point, this.at);
        this.turn.copy(this.actor.holder(body).quaternion).multiply(turn);
        instances.set(k, this.at, this.turn, this.scale.setScalar(size));
      });
      instances.done();
    }
  }

  private make(what: Extra): { spots: Spot[]; instances: Instances } {
    const spots = this.spots(what);
    const { geometry, material } = this.looks(what);
    const instances = new Instances(geometry, material, spots.map(({ owner }) => owner));
    this.actor.root.add(instances.mesh);
    return { spots, instances };
  }

  private looks(what: Extra): { geometry: THREE.BufferGeometry; material: THREE.Material } {
    if (what === "centres") return { geometry: new THREE.SphereGeometry(CENTRE, 16, 12), material: this.actor.palette.signDark };
    if (what === "axes") return { geometry: axis(), material: new THREE.MeshBasicMaterial({ color: TONES[2]!, depthTest: false, transparent: true, opacity: 0.75 }) };
    return { geometry: triad(), material: new THREE.MeshBasicMaterial({ vertexColors: true }) };
  }

  private spots(what: Extra): Spot[] {
    const { stage, nearness } = this.actor;
    const own = new THREE.Quaternion();
    switch (what) {
      case "triads":
      case "centres":
        return stage.bodies.map((each, body) => ({ owner: { kind: "body", name: each.name }, body, point: what === "triads" ? [0, 0, 0] : each.centre_of_mass, turn: own, size: nearness.body(body) }));
      case "markers":
        return stage.markers.map(({ body, point, x_axis, axis }) => ({ owner: { kind: "body", name: stage.bodies[body]!.name }, body, point, turn: turnOf(axis, x_axis), size: OF_JOINT * nearness.body(body) }));
      case "joints":
      case "axes":
        return stage.joints.flatMap((joint) => {
          if (what === "axes" && !AXIAL.includes(joint.kind)) return [];
          const sides = ([0, 1] as const).filter((side) => (what === "joints" && !(side && joint.kind.endsWith("-on-beam"))) || side === joint.place || joint.kind === "universal");
          return sides.map((side) => ({ owner: { kind: "joint" as const, name: joint.name }, body: joint.bodies[side], point: joint.points[side], turn: turnOf(joint.axes[side], joint.x_axes?.[side]), size: (what === "joints" ? OF_JOINT : 1) * nearness.joint(joint) }));
        });
    }
  }
}

/** Turns z into an axis and x as near to another as can be. */
function turnOf(axis: Point, xAxis?: Point): THREE.Quaternion {
  const z = new THREE.Vector3(...axis).normalize();
  if (!xAxis) return new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 0, 1), z);
  const x = new THREE.Vector3(...xAxis);
  x.addScaledVector(z, -x.dot(z)).normalize();
  return new THREE.Quaternion().setFromRotationMatrix(new THREE.Matrix4().makeBasis(x, new THREE.Vector3().crossVectors(z, x), z));
}

/** A thin line along z. */
function axis(): THREE.BufferGeometry {
  return new THREE.CylinderGeometry(THIN, THIN, 2 * LINE, 6).rotateX(Math.PI / 2);
}

/** Three coloured arrows along the axes. */
function triad(): THREE.BufferGeometry {
  const radius = 0.028 * FRAME;
  const arrows = TONES.map((tone, k) => {
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
