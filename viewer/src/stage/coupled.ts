// Couplings: pitch circles with a spoke on the bodies that turn, pitch lines of racks, belts about two wheels, or a line between joints.
import * as THREE from "three";
import type { Coupling, Wheel } from "../generated/records";
import type { Actor, Picked } from "./actor";
import { noPieces, type Piece } from "./batch";
import type { Stretched, Stretching } from "./stretching";

const LINE = 0.0042; // radius of lines, of the wheel
const THIN = 0.0024; // of the machine, where there is no wheel

const Y = new THREE.Vector3(0, 1, 0);
const Z = new THREE.Vector3(0, 0, 1);
const ONE = new THREE.Vector3(1, 1, 1);

export function coupled(actor: Actor): Stretched {
  const out: Stretched = { moving: [], pieces: noPieces() };
  for (const coupling of actor.stage.couplings) {
    const said: Picked = { kind: "coupling", name: coupling.name };
    const add = (geometry: THREE.BufferGeometry, body: number) => out.pieces.wire.push({ geometry, body: -1, holder: actor.holder(body), said });
    for (const wheel of coupling.wheels) for (const geometry of circle(wheel, thickness(actor, wheel))) add(geometry, wheel.body);
    for (const { body, point, along, half } of coupling.tracks) {
      const turn = new THREE.Quaternion().setFromUnitVectors(Y, new THREE.Vector3(...along).normalize());
      const bar = new THREE.CylinderGeometry(0.02 * half, 0.02 * half, 2 * half, 8);
      add(bar.applyMatrix4(new THREE.Matrix4().compose(new THREE.Vector3(...point), turn, ONE)), body);
    }
    if (coupling.belt !== "none") out.moving.push(...belt(actor, coupling, said, out.pieces.wire));
    out.moving.push(...joined(actor, coupling, said, out.pieces.wire));
  }
  return out;
}

const thickness = (actor: Actor, wheel: Wheel) => Math.min(2.5 * LINE * wheel.radius + 0.3 * THIN * actor.stage.size, 0.2 * wheel.radius);

/** The pitch circle, and a spoke that shows how it turns. */
function circle({ centre, axis, radius }: Wheel, thick: number): THREE.BufferGeometry[] {
  const turn = new THREE.Quaternion().setFromUnitVectors(Z, new THREE.Vector3(...axis).normalize());
  const place = new THREE.Matrix4().compose(new THREE.Vector3(...centre), turn, ONE);
  const spoke = new THREE.CylinderGeometry(0.6 * thick, 0.6 * thick, 0.22 * radius, 8).translate(0, 0.89 * radius, 0);
  return [new THREE.TorusGeometry(radius, thick, 8, 72), spoke].map((each) => each.applyMatrix4(place));
}

/** A line between two points that `find` gives at every frame. */
function run(radius: number, said: Picked, pieces: Piece[], isBad: () => boolean, find: (from: THREE.Vector3, to: THREE.Vector3) => void): Stretching {
  const holder = new THREE.Object3D();
  const geometry = new THREE.CylinderGeometry(radius, radius, 1, 8).translate(0, 0.5, 0);
  pieces.push({ geometry, body: -1, holder, said });
  const from = new THREE.Vector3();
  const to = new THREE.Vector3();
  return {
    object: holder,
    update() {
      holder.visible = !isBad();
      if (!holder.visible) return;
      find(from, to);
      holder.position.copy(from);
      const length = to.sub(from).length();
      holder.scale.set(1, Math.max(length, 1e-12), 1);
      if (length > 0) holder.quaternion.setFromUnitVectors(Y, to.divideScalar(length));
    },
  };
}

/** The two straight runs of a belt: tangents of the pitch circles, at an angle whose cosine is (r₁ ∓ r₂)/distance from the line of centres. */
function belt(actor: Actor, { wheels, belt: kind }: Coupling, said: Picked, pieces: Piece[]): Stretching[] {
  const [one, two] = wheels;
  if (!one || !two) return [];
  const crossed = kind === "crossed" ? -1 : 1;
  const axis = new THREE.Vector3();
  const centre = new THREE.Vector3();
  const apart = new THREE.Vector3();
  const aside = new THREE.Vector3();
  return [1, -1].map((side) =>
    run(thickness(actor, one), said, pieces, () => wheels.some(({ body }) => actor.isBad[body]), (from, to) => {
      axis.set(...one.axis).applyQuaternion(actor.holder(one.body).quaternion).normalize();
      actor.place(one.body, one.centre, centre);
      actor.place(two.body, two.centre, apart).sub(centre);
      const offset = apart.dot(axis);
      apart.addScaledVector(axis, -offset);
      const distance = apart.length();
      apart.divideScalar(distance || 1);
      aside.crossVectors(axis, apart);
      const cosine = Math.min(Math.max((one.radius - crossed * two.radius) / (distance || 1), -1), 1);
      const sine = side * Math.sqrt(1 - cosine * cosine);
      from.copy(centre).addScaledVector(apart, one.radius * cosine).addScaledVector(aside, one.radius * sine);
      to.copy(centre).addScaledVector(axis, offset).addScaledVector(apart, distance + crossed * two.radius * cosine);
      to.addScaledVector(aside, crossed * two.radius * sine);
    }),
  );
}

/** Lines from each joint to the next, of a coupling without wheels. */
function joined(actor: Actor, coupling: Coupling, said: Picked, pieces: Piece[]): Stretching[] {
  return coupling.joined.slice(1).map((next, k) => {
    const before = coupling.joined[k]!;
    return run(THIN * actor.stage.size, said, pieces, () => actor.isBad[before.body] || actor.isBad[next.body] || false, (from, to) => {
      actor.place(before.body, before.point, from);
      actor.place(next.body, next.point, to);
    });
  });
}
