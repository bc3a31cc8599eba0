// Forces and drivers that stand at one place: signs about and along the axis of a joint, coils, dots where something acts on a body.
import * as THREE from "three";
import type { Force } from "../generated/records";
import type { Actor, Picked } from "./actor";
import type { Piece } from "./batch";
import type { Tone } from "./look";

const MANY = 20; // elements from which on each is drawn with fewer facets

const Z = new THREE.Vector3(0, 0, 1);

/** Pieces of an element that stands at its first end, its z along the element's axis. */
export function standing(actor: Actor, force: Force, kind: Picked["kind"], pieces: Record<Tone, Piece[]>): void {
  const point = force.points[0];
  const body = force.bodies[0];
  if (!point || body === undefined) return;
  const turn = new THREE.Quaternion().setFromUnitVectors(Z, new THREE.Vector3(...(force.axis ?? [0, 0, 1])).normalize());
  const place = new THREE.Matrix4().compose(new THREE.Vector3(...point), turn, new THREE.Vector3(1, 1, 1));
  const size = actor.nearness.between(force.bodies);
  for (const [tone, geometry] of solids(force, size, actor.stage.forces.length > MANY)) {
    pieces[tone].push({ geometry: geometry.applyMatrix4(place), thin: true, body, holder: actor.holder(body), said: { kind, name: force.name } });
  }
}

function solids(force: Force, size: number, isOneOfMany: boolean): [Tone, THREE.BufferGeometry][] {
  switch (force.look) {
    case "coil":
      return [["wire", spiral(size, isOneOfMany)]];
    case "bushing":
      return [["signDark", new THREE.TorusGeometry(0.02 * size, 0.009 * size, 12, 28)]];
    case "turn":
      return turning(size);
    case "slide":
      return sliding(size);
    case "ring":
      return [["wire", new THREE.TorusGeometry(0.034 * size, 0.0045 * size, 8, isOneOfMany ? 20 : 36)]];
    case "dot":
      return [["wire", new THREE.OctahedronGeometry(0.015 * size)]];
    default:
      return [];
  }
}

/** A flat spiral about z. */
function spiral(size: number, isOneOfMany: boolean): THREE.BufferGeometry {
  const points = Array.from({ length: 80 }, (_, k) => {
    const angle = (k / 79) * 5 * Math.PI;
    const radius = size * (0.012 + 0.026 * (k / 79));
    return new THREE.Vector3(radius * Math.cos(angle), radius * Math.sin(angle), 0);
  });
  return new THREE.TubeGeometry(new THREE.CatmullRomCurve3(points), isOneOfMany ? 50 : 120, 0.0036 * size, isOneOfMany ? 4 : 6);
}

/** An arrow around z, as wide as three quarters of a turn. */
function turning(size: number): [Tone, THREE.BufferGeometry][] {
  const radius = 0.036 * size;
  const arc = 1.5 * Math.PI;
  const tip = new THREE.ConeGeometry(0.0125 * size, 0.028 * size, 14).translate(0, 0.01 * size, 0);
  tip.rotateZ(arc).translate(radius * Math.cos(arc), radius * Math.sin(arc), 0);
  return [
    ["wire", new THREE.TorusGeometry(radius, 0.0045 * size, 8, 30, arc)],
    ["wire", tip],
  ];
}

/** An arrow with two heads along z, beside the axis. */
function sliding(size: number): [Tone, THREE.BufferGeometry][] {
  const [half, aside] = [0.045 * size, 0.036 * size];
  const shaft = new THREE.CylinderGeometry(0.0045 * size, 0.0045 * size, 2 * half, 10).rotateX(Math.PI / 2);
  const heads = [1, -1].map((sign) => {
    return new THREE.ConeGeometry(0.0125 * size, 0.028 * size, 14).rotateX((sign * Math.PI) / 2).translate(0, 0, sign * half);
  });
  return [shaft, ...heads].map((each) => ["wire", each.translate(aside, 0, 0)]);
}
