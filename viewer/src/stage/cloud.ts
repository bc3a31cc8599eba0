// Points around a machine during its whole motion, for the camera to keep in sight.
import * as THREE from "three";
import type { Motion } from "../motion";
import type { Actor } from "./actor";
import { corners } from "./views";

const MOMENTS = 24;
const MOST = 8000; // points

/** Corners of the boxes around all bodies, at some moments; and what stands on the ground. */
export function cloudOf(actor: Actor, motion: Motion): THREE.Vector3[] {
  const boxes = localBoxes(actor);
  const moments = Math.max(Math.min(MOMENTS, motion.count, Math.floor(MOST / (8 * Math.max(boxes.length, 1)))), 1);
  const frame = new Float32Array(motion.layout.width);
  const turn = new THREE.Quaternion();
  const room = new THREE.Box3(new THREE.Vector3(...actor.stage.low), new THREE.Vector3(...actor.stage.high));
  room.expandByScalar(room.min.distanceTo(room.max) + actor.stage.size); // what exploded is left out
  const out: THREE.Vector3[] = [];
  for (let k = 0; k < moments; k++) {
    motion.sample(motion.time[Math.round((k * (motion.count - 1)) / Math.max(moments - 1, 1))]!, frame);
    boxes.forEach((box, body) => {
      const [x, y, z, e0, e1, e2, e3] = frame.subarray(7 * body, 7 * body + 7) as unknown as number[];
      if (box.isEmpty() || !Number.isFinite(x! + y! + z! + e0! + e1! + e2! + e3!)) return;
      turn.set(e1!, e2!, e3!, e0!).normalize();
      const at = new THREE.Vector3(x, y, z);
      if (!room.containsPoint(at)) return;
      for (const corner of corners(box)) out.push(corner.applyQuaternion(turn).add(at));
    });
  }
  return [...out, ...standing(actor)];
}

/** Corners of the boxes around all bodies as they are drawn now; and what stands on the ground. */
export function cloudNow(actor: Actor): THREE.Vector3[] {
  return [...boxesNow(actor).flat(), ...standing(actor)];
}

/** Corners of the box around each body as it is drawn now; none of a body that is not drawn. */
export function boxesNow(actor: Actor): THREE.Vector3[][] {
  return localBoxes(actor).map((box, body) => {
    const { position, quaternion } = actor.bodies[body]!;
    return box.isEmpty() || actor.isBad[body] ? [] : corners(box).map((corner) => corner.applyQuaternion(quaternion).add(position));
  });
}

function standing(actor: Actor): THREE.Vector3[] {
  const out: THREE.Vector3[] = [];
  const ends = new THREE.Vector3();
  for (const each of [...actor.stage.joints, ...actor.stage.forces]) {
    each.points.forEach((point, side) => {
      if (each.bodies[side] === -1 && each.kind !== "contact") out.push(actor.place(-1, point, ends).clone());
    });
  }
  return out;
}

/** The box around each body, in its own axes; signs of joints do not count. */
function localBoxes(actor: Actor): THREE.Box3[] {
  const boxes = new Map(actor.bodies.map((group) => [group as THREE.Object3D, new THREE.Box3()]));
  const add = (holder: THREE.Object3D, geometry: THREE.BufferGeometry) => {
    geometry.computeBoundingBox();
    if (geometry.boundingBox) boxes.get(holder)?.union(geometry.boundingBox);
  };
  for (const { holder, geometry } of actor.solids) add(holder, geometry);
  for (const { record, mesh } of actor.deforming) add(actor.holder(record.body), mesh.geometry);
  for (const each of actor.swept) for (const [body, point] of each.extent()) boxes.get(actor.holder(body))?.expandByPoint(point);
  return [...boxes.values()];
}
