// Which names belong to something that stands behind another body: they are shown faintly.
import * as THREE from "three";
import type { Actor } from "./actor";

const CASTER = new THREE.Raycaster();
const NEARER = 0.02; // of the distance: what covers a point stands that much nearer

/** Whether another body stands between the camera and a point of `body`. */
export function isCovered(actor: Actor, body: number, point: THREE.Vector3, camera: THREE.PerspectiveCamera): boolean {
  const towards = point.clone().sub(camera.position);
  const distance = towards.length();
  CASTER.set(camera.position, towards.divideScalar(distance));
  CASTER.near = camera.near;
  CASTER.far = (1 - NEARER) * distance;
  const own = actor.stage.bodies[body]?.name;
  return CASTER.intersectObjects(actor.bodyMeshes, false).some((hit) => {
    const said = actor.said(hit);
    return said !== null && said.kind === "body" && said.name !== own;
  });
}
