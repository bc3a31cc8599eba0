// The standard views, and how far away a machine is seen as a whole.
import * as THREE from "three";
import type { Viewpoint } from "../generated/records";

export const VIEWS = ["first", "front", "right", "top", "back", "left", "below"] as const;
export type View = (typeof VIEWS)[number];

export interface Room {
  width: number; // of the picture, in pixels
  height: number;
  across: number; // of what no panel covers
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

/** The distance from `middle` at which all points are in the free part of the picture. */
export function distanceFor(
  points: readonly THREE.Vector3[],
  middle: THREE.Vector3,
  towards: THREE.Vector3,
  up: THREE.Vector3,
  room: Room,
  field: number,
  size: number,
): number {
  const back = towards.clone().normalize();
  const side = new THREE.Vector3().crossVectors(up, back);
  if (side.lengthSq() < 1e-6) side.crossVectors(new THREE.Vector3(0.1, 0.3, 1), back);
  side.normalize();
  const rise = new THREE.Vector3().crossVectors(back, side);
  const slope = Math.tan(THREE.MathUtils.degToRad(field / 2));
  const across = room.height / Math.max(room.across, 80);
  const down = room.height / Math.max(room.down, 80);
  let distance = 0.2 * size;
  for (const point of points) {
    const off = point.clone().sub(middle);
    const needed = Math.max(Math.abs(off.dot(side)) * across, Math.abs(off.dot(rise)) * down);
    distance = Math.max(distance, off.dot(back) + (1.08 * needed + 0.05 * size) / slope);
  }
  return distance;
}
