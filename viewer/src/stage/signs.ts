// Signs of joints in space: what textbooks draw, at the size of what is near.
import * as THREE from "three";
import type { Joint, Stage } from "../generated/records";
import type { Tone } from "./look";

const SIZE = 0.021; // half the size of a sign, of the size near the joint

/** A solid of a sign, in the frame of the body at which the sign stands; standing : on the ground instead. */
export interface Sign {
  tone: Tone;
  geometry: THREE.BufferGeometry;
  standing: boolean;
}
type Solid = Pick<Sign, "tone" | "geometry">;

const Z = new THREE.Vector3(0, 0, 1);

/** size : near the joint. facets : of round solids. */
export function jointSigns(joint: Joint, stage: Stage, size: number, facets: number): Sign[] {
  if (joint.rod) return []; // drawn as a rod with its ends
  const s = SIZE * size;
  const at = new THREE.Vector3(...joint.points[joint.place]);
  const axis = new THREE.Vector3(...(joint.slot && joint.place === 1 ? joint.slot : joint.axes[joint.place])).normalize();
  const frame = new THREE.Matrix4().compose(at, new THREE.Quaternion().setFromUnitVectors(Z, axis), new THREE.Vector3(1, 1, 1));
  const moving = shapes(joint.kind, s, facets).map(({ tone, geometry }) => ({ tone, geometry: geometry.applyMatrix4(frame), standing: false }));
  const side = joint.bodies[0] < 0 ? 0 : joint.bodies[1] < 0 ? 1 : -1;
  const standing = side < 0 ? [] : foot(joint, side as 0 | 1, stage, s).map((geometry) => ({ tone: "foot" as const, geometry, standing: true }));
  return [...moving, ...standing];
}

/** Solids of a sign; its axis is z. */
function shapes(kind: string, s: number, facets: number): Solid[] {
  const light = (geometry: THREE.BufferGeometry): Solid => ({ tone: "sign", geometry });
  const dark = (geometry: THREE.BufferGeometry): Solid => ({ tone: "signDark", geometry });
  const round = (radius: number, length: number) => new THREE.CylinderGeometry(radius, radius, length, facets).rotateX(Math.PI / 2);
  const globe = (radius: number) => new THREE.SphereGeometry(radius, facets, Math.round(0.7 * facets));
  switch (kind) {
    case "revolute":
      return [light(round(0.95 * s, 1.9 * s)), dark(round(0.42 * s, 2.7 * s))];
    case "cylindrical":
      return [light(round(0.95 * s, 1.9 * s)), dark(round(0.42 * s, 4.4 * s))];
    case "screw": {
      const rings = [-0.6, 0, 0.6].map((z) => dark(new THREE.TorusGeometry(0.95 * s, 0.14 * s, 8, 24).translate(0, 0, z * s)));
      return [light(round(0.9 * s, 1.9 * s)), dark(round(0.42 * s, 4.4 * s)), ...rings];
    }
    case "translational":
      return [light(new THREE.BoxGeometry(1.7 * s, 1.7 * s, 2.8 * s))];
    case "spherical":
      return [light(globe(1.1 * s))];
    case "universal":
      return [dark(round(0.36 * s, 2.8 * s)), dark(round(0.36 * s, 2.8 * s).rotateX(Math.PI / 2)), light(globe(0.62 * s))];
    case "fixed":
      return [dark(new THREE.BoxGeometry(1.5 * s, 1.5 * s, 1.5 * s))];
    case "planar":
      return [light(new THREE.BoxGeometry(4.2 * s, 4.2 * s, 0.3 * s))];
    case "point-on-beam":
    case "keyed-on-beam":
      return [light(globe(0.9 * s)), ...(kind === "keyed-on-beam" ? [dark(new THREE.BoxGeometry(2.6 * s, 0.5 * s, 0.5 * s))] : [])];
    case "cylindrical-on-beam":
      return [light(round(1.1 * s, 2.8 * s)), dark(round(0.5 * s, 3.4 * s))];
    case "translational-on-beam":
      return [light(new THREE.BoxGeometry(1.9 * s, 1.9 * s, 2.8 * s))];
    case "point-on-line":
      return [dark(round(0.22 * s, 6 * s)), light(globe(0.8 * s))];
    case "point-on-plane":
      return [light(new THREE.BoxGeometry(4.2 * s, 4.2 * s, 0.16 * s)), dark(globe(0.7 * s))];
    default:
      return [light(globe(0.9 * s))];
  }
}

const RAILS = ["translational", "cylindrical", "screw", "point-on-line"];

/** The ground under a joint: a rail as long as the motion for what slides, else a cone with its tip at the joint. */
function foot(joint: Joint, side: 0 | 1, stage: Stage, s: number): THREE.BufferGeometry[] {
  const at = new THREE.Vector3(...joint.points[side]);
  const up = new THREE.Vector3(...stage.up);
  const one = new THREE.Vector3(1, 1, 1);
  if (RAILS.includes(joint.kind) || joint.slot) {
    const axis = new THREE.Vector3(...(joint.slot ?? joint.axes[side])).normalize();
    const half = Math.max(0.62 * reachAlong(axis, stage), 4 * s);
    const middle = new THREE.Vector3(...stage.low).add(new THREE.Vector3(...stage.high)).multiplyScalar(0.5).add(new THREE.Vector3(...stage.origin));
    const shift = Math.max(Math.min(middle.sub(at).dot(axis), half - 3 * s), 3 * s - half);
    const rail = new THREE.CylinderGeometry(0.24 * s, 0.24 * s, 2 * half, 12).rotateX(Math.PI / 2);
    const turn = new THREE.Quaternion().setFromUnitVectors(Z, axis);
    return [rail.applyMatrix4(new THREE.Matrix4().compose(at.addScaledVector(axis, shift), turn, one))];
  }
  const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 1, 0), up);
  const cone = new THREE.ConeGeometry(1.5 * s, 2.5 * s, 4, 1).rotateY(Math.PI / 4).translate(0, -2 * s, 0);
  const plate = new THREE.BoxGeometry(3.4 * s, 0.3 * s, 3.4 * s).translate(0, -3.35 * s, 0);
  const place = new THREE.Matrix4().compose(at, turn, one);
  return [cone.applyMatrix4(place), plate.applyMatrix4(place)];
}

function reachAlong(axis: THREE.Vector3, stage: Stage): number {
  const box = new THREE.Vector3(...stage.high).sub(new THREE.Vector3(...stage.low));
  return 0.5 * (Math.abs(axis.x) * box.x + Math.abs(axis.y) * box.y + Math.abs(axis.z) * box.z);
}
