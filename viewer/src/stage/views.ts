// The standard views, and how far away a machine is seen as a whole.
import * as THREE from "three";
import type { Viewpoint } from "../generated/records";

export const VIEWS = ["first", "front", "right", "top", "back", "left", "below"] as const;
export type View = (typeof VIEWS)[number];

const LEAST = 40; // pixels of room, however much is covered

export interface Room {
  height: number; // of the picture, in pixels
  across: number; // pixels of what no panel covers
  down: number;
}

export const vector = (v: readonly [number, number, number]) => new THREE.Vector3(...v);

/** The eight corners of a box. */
export function corners(box: THREE.Box3): THREE.Vector3[] {
  const { min, max } = box;
  return Array.from({ length: 8 }, (_, k) => new THREE.Vector3(k & 1 ? min.x : max.x, k & 2 ? min.y : max.y, k & 4 ? min.z : max.z));
}

/** From where a view looks, and what is up in it; `up` is against gravity. */
export function sideOf(name: View, first: Viewpoint, up: THREE.Vector3): { towards: THREE.Vector3; up: THREE.Vector3 } {
  if (name === "first") return { towards: vector(first.towards), up: vector(first.up) };
  const front = Math.abs(up.z) > 0.9 ? new THREE.Vector3(0, -1, 0) : new THREE.Vector3(0, 0, 1);
  const right = new THREE.Vector3().crossVectors(up, front);
  const towards = {
    front,
    right,
    top: up.clone(),
    back: front.clone().negate(),
    left: right.clone().negate(),
    below: up.clone().negate(),
  }[name];
  return { towards, up: name === "top" ? front.clone().negate() : name === "below" ? front.clone() : up.clone() };
}

const AROUND = 1.08; // of what is to be seen, for thicknesses and signs
const BESIDE = 0.05; // of the machine's length

/**
 * Where the eye looks, and from how far, so that all points are just in the free part of the picture.
 *
 * A point at a sideways, d towards the eye is in sight of an eye at x, z where ±(a - x) ≤ s (z - d), with the slope s of the edge of the
 * picture. The largest a + s d and -a + s d of all points give x and the least z; the same holds upwards, and the larger z counts.
 */
export function framed(points: readonly THREE.Vector3[], towards: THREE.Vector3, up: THREE.Vector3, room: Room, field: number, size: number): { aim: THREE.Vector3; distance: number } {
  const back = towards.clone().normalize();
  const side = new THREE.Vector3().crossVectors(up, back);
  if (side.lengthSq() < 1e-6) side.crossVectors(new THREE.Vector3(0.1, 0.3, 1), back);
  side.normalize();
  const rise = new THREE.Vector3().crossVectors(back, side);
  const slope = Math.tan(THREE.MathUtils.degToRad(field / 2)) / AROUND / room.height;
  const across = edges(points, side, back, slope * Math.max(room.across, LEAST), BESIDE * size);
  const down = edges(points, rise, back, slope * Math.max(room.down, LEAST), BESIDE * size);
  const depth = new THREE.Box3().setFromPoints([...points]).getCenter(new THREE.Vector3()).dot(back);
  const aim = side.multiplyScalar(across.middle).addScaledVector(rise, down.middle).addScaledVector(back, depth);
  return { aim, distance: Math.max(across.eye - depth, down.eye - depth, 0.2 * size) };
}

/** Where an eye is between the points along `axis`, and how far out along `back`. */
function edges(points: readonly THREE.Vector3[], axis: THREE.Vector3, back: THREE.Vector3, slope: number, beside: number): { middle: number; eye: number } {
  let over = -Infinity;
  let under = -Infinity;
  for (const point of points) {
    const near = slope * point.dot(back);
    over = Math.max(over, near + point.dot(axis));
    under = Math.max(under, near - point.dot(axis));
  }
  return { middle: 0.5 * (over - under), eye: (0.5 * (over + under) + beside) / slope };
}
