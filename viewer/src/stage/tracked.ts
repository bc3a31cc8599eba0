// The belt of a track: shoes around two wheels of the sprocket's radius, which run as the sprocket turns against the frame.
import * as THREE from "three";
import type { Force } from "../generated/records";
import type { Actor, Picked } from "./actor";
import type { Stretched } from "./stretching";

const TEETH = 12; // of a sprocket: shoes on its circumference
const GAP = 0.12; // between shoes, of their pitch

/** force : points are the front and rear end of the belt on the ground, on the frame, and the sprocket. */
export function tracked(actor: Actor, force: Force, out: Stretched): void {
  const [radius = 0, width = 0, thickness = 0] = force.sizes;
  const [frame, , sprocket] = force.bodies as [number, number, number];
  const said: Picked = { kind: "force", name: force.name };
  const [front, rear] = [0, 1].map((k) => new THREE.Vector3(...force.points[k]!)) as [THREE.Vector3, THREE.Vector3];
  const forwards = front.clone().sub(rear);
  const length = forwards.length();
  forwards.normalize();
  const left = new THREE.Vector3(...(force.axis ?? [0, 0, 1])).cross(forwards).normalize();
  const up = forwards.clone().cross(left);
  const round = Math.PI * radius;
  const whole = 2 * (length + round);
  const count = Math.max(Math.round((whole * TEETH) / (2 * round)), 3);
  const pitch = whole / count;
  const group = new THREE.Group();
  const shoes = Array.from({ length: count }, () => {
    const holder = new THREE.Object3D();
    group.add(holder);
    out.pieces.foot.push({ geometry: new THREE.BoxGeometry((1 - GAP) * pitch, width, thickness), body: -1, holder, parent: group, said });
    return holder;
  });
  const tangent = new THREE.Vector3();
  const outwards = new THREE.Vector3();
  const basis = new THREE.Matrix4();
  /** Lays a shoe so far from the front end, first back along the ground. */
  const lay = (shoe: THREE.Object3D, way: number): void => {
    const behind = way < length + round;
    const along = behind ? way : way - length - round; // from the front end back, or from the rear end on top
    const angle = Math.max(along - length, 0) / radius;
    const sign = behind ? 1 : -1;
    tangent.copy(forwards).multiplyScalar(-sign * Math.cos(angle)).addScaledVector(up, sign * Math.sin(angle));
    outwards.copy(up).multiplyScalar(-sign * Math.cos(angle)).addScaledVector(forwards, -sign * Math.sin(angle));
    shoe.position.copy(behind ? front : rear).addScaledVector(forwards, -sign * Math.min(along, length));
    shoe.position.addScaledVector(up, radius + 0.5 * thickness).addScaledVector(outwards, radius);
    basis.makeBasis(tangent, left, tangent.clone().cross(left));
    shoe.quaternion.setFromRotationMatrix(basis);
  };
  const relative = new THREE.Quaternion();
  out.moving.push({
    object: group,
    update() {
      group.visible = !force.bodies.some((body) => actor.isBad[body]);
      if (!group.visible) return;
      actor.place(frame, [0, 0, 0], group.position);
      group.quaternion.copy(actor.holder(frame).quaternion);
      relative.copy(group.quaternion).invert().multiply(actor.holder(sprocket).quaternion);
      const turn = 2 * Math.atan2(relative.x * left.x + relative.y * left.y + relative.z * left.z, relative.w);
      // turned by a tooth it looks the same
      const passed = ((((turn * TEETH) / (2 * Math.PI)) % 1) + 1) % 1;
      shoes.forEach((shoe, k) => lay(shoe, (k + passed) * pitch));
    },
  });
}
