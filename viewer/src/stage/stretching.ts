// What stretches between two bodies: springs, dampers, cylinders, rods of massless links; belts of tracks, and planes of contacts.
import * as THREE from "three";
import type { Force, Joint, Winding } from "../generated/records";
import type { Motion } from "../motion";
import { standing } from "./acting";
import type { Actor, Picked } from "./actor";
import { noPieces, type Piece } from "./batch";
import type { Tone } from "./look";
import { tracked } from "./tracked";
import { Wound } from "./wound";

const WIRE = 0.0042; // radii, of the size near the element
const COIL = 0.021;
const ROD = 0.0075;
const BARREL = 0.0135;
const ROPE = 0.0016; // of the machine's size
const FOOT = 0.012;
const TURNS = 9;
const BETWEEN = ["spring", "damper", "spring-damper", "cylinder"];
const MANY = 20; // springs from which on each is drawn with fewer facets

export interface Stretching {
  object: THREE.Object3D;
  update(): void;
}

/** moving : what has to be brought to its place at every frame; pieces : what hangs on it, or on bodies. */
export interface Stretched {
  moving: Stretching[];
  pieces: Record<Tone, Piece[]>;
}

type Point = readonly [number, number, number];
const Z = new THREE.Vector3(0, 0, 1);

/** motion : the whole of it where that is known. */
export function stretching(actor: Actor, motion: Motion | null): Stretched {
  const out: Stretched = { moving: [], pieces: noPieces() };
  for (const joint of actor.stage.joints) if (joint.rod) rod(actor, joint, out);
  for (const force of actor.stage.forces) {
    if (force.look === "plane") out.moving.push(plane(actor, force));
    else if (force.winding) wound(actor, force, force.winding, motion, out);
    else if (force.look === "rope") rope(actor, force, out);
    else if (force.look === "track") tracked(actor, force, out);
    else if (BETWEEN.includes(force.look)) between(actor, force, out);
    else standing(actor, force, "force", out.pieces);
  }
  for (const driver of actor.stage.drivers) standing(actor, driver, "driver", out.pieces);
  return out;
}

/** A group whose z axis is laid from one point to the other at every frame; `fill` sets what depends on the length. */
function laid(actor: Actor, bodies: readonly number[], points: readonly Point[], group: THREE.Group, fill: (length: number) => void): Stretching {
  const from = new THREE.Vector3();
  const to = new THREE.Vector3();
  return {
    object: group,
    update() {
      actor.place(bodies[0]!, points[0]!, from);
      actor.place(bodies[1]!, points[1]!, to);
      const bad = bodies.some((body) => actor.isBad[body]);
      group.visible = !bad;
      if (bad) return;
      group.position.copy(from);
      const length = to.sub(from).length();
      if (length > 0) group.quaternion.setFromUnitVectors(Z, to.divideScalar(length));
      fill(Math.max(length, 1e-9 * actor.stage.size));
    },
  };
}

/** A holder in a group, for a piece whose length or place in the group changes. */
function part(group: THREE.Group, tone: Tone, geometry: THREE.BufferGeometry, said: Picked, out: Stretched): THREE.Object3D {
  const holder = new THREE.Object3D();
  group.add(holder);
  out.pieces[tone].push({ geometry, body: -1, holder, parent: group, said });
  return holder;
}

/** A cylinder from z = 0 to 1. */
const unit = (radius: number, facets = 18) => new THREE.CylinderGeometry(radius, radius, 1, facets).rotateX(Math.PI / 2).translate(0, 0, 0.5);

function rod(actor: Actor, joint: Joint, out: Stretched): void {
  const size = actor.nearness.atMost(distance(actor, joint.bodies, joint.points));
  const said: Picked = { kind: "joint", name: joint.name };
  const group = new THREE.Group();
  feet(actor, joint.bodies, joint.points, said, out);
  const shaft = part(group, "foot", unit(ROD * size), said, out);
  const ends = [0, 1].map(() => part(group, "sign", new THREE.SphereGeometry(0.016 * size, 20, 14), said, out));
  out.moving.push(
    laid(actor, joint.bodies, joint.points, group, (length) => {
      shaft.scale.z = length;
      ends[1]!.position.z = length;
    }),
  );
}

/** The ground under the ends of what pulls or pushes there: a cone with its tip at the end, turned away from the other one. */
function feet(actor: Actor, bodies: readonly number[], points: readonly Point[], said: Picked, out: Stretched): void {
  const ends = points.map((point, k) => actor.place(bodies[k]!, point, new THREE.Vector3()));
  bodies.forEach((body, k) => {
    if (body >= 0) return;
    const other = bodies.findIndex((each, n) => each >= 0 && Math.abs(n - k) === 1);
    const away = other < 0 ? new THREE.Vector3(...actor.stage.up).negate() : ends[k]!.clone().sub(ends[other]!);
    const size = actor.nearness.atMost(away.length());
    for (const geometry of groundSign(FOOT * size)) {
      const turn = new THREE.Quaternion().setFromUnitVectors(Z, away.clone().normalize());
      geometry.applyMatrix4(new THREE.Matrix4().compose(new THREE.Vector3(...points[k]!), turn, new THREE.Vector3(1, 1, 1)));
      out.pieces.foot.push({ geometry, body: -1, holder: actor.ground, said });
    }
  });
}

/** A cone with its tip at the origin on a plate across z. */
function groundSign(s: number): THREE.BufferGeometry[] {
  const cone = new THREE.ConeGeometry(1.5 * s, 2.5 * s, 4, 1).rotateX(-Math.PI / 2).rotateZ(Math.PI / 4).translate(0, 0, 1.25 * s);
  const plate = new THREE.BoxGeometry(3.4 * s, 3.4 * s, 0.3 * s).translate(0, 0, 2.65 * s);
  return [cone, plate];
}

/** A rope: a thin round bar from each of its points to the next. */
function rope(actor: Actor, force: Force, out: Stretched): void {
  const said: Picked = { kind: "force", name: force.name };
  feet(actor, force.bodies, force.points, said, out);
  for (let k = 1; k < force.points.length; k++) {
    const bodies = force.bodies.slice(k - 1, k + 1);
    const points = force.points.slice(k - 1, k + 1);
    const group = new THREE.Group();
    const line = part(group, "signDark", unit(ROPE * actor.stage.size), said, out);
    out.moving.push(laid(actor, bodies, points, group, (length) => (line.scale.z = length)));
  }
}

/** A rope around wheels: thin round bars along its free parts and, short ones, along its arcs. */
function wound(actor: Actor, force: Force, winding: Winding, motion: Motion | null, out: Stretched): void {
  const said: Picked = { kind: "force", name: force.name };
  const group = new THREE.Group();
  const way = new Wound(actor, force, winding, motion);
  const bars = Array.from({ length: way.most }, () => part(group, "signDark", unit(ROPE * actor.stage.size, 8), said, out));
  const along = new THREE.Vector3();
  feet(actor, force.bodies, force.points, said, out);
  out.moving.push({
    object: group,
    update() {
      group.visible = !force.bodies.some((body) => actor.isBad[body]);
      if (!group.visible) return;
      const points = way.points();
      bars.forEach((bar, k) => {
        const [from, to] = [points[k], points[k + 1]];
        bar.visible = !!from && !!to;
        if (!from || !to) return;
        const length = along.copy(to).sub(from).length();
        bar.position.copy(from);
        bar.scale.z = Math.max(length, 1e-9 * actor.stage.size);
        if (length > 0) bar.quaternion.setFromUnitVectors(Z, along.divideScalar(length));
      });
    },
  });
}

/** A helix about z from 0 to 1 with straight ends; its length scales, its wire keeps about its thickness. */
function helix(radius: number, wire: number, natural: number, isOneOfMany: boolean): THREE.BufferGeometry {
  const points: THREE.Vector3[] = [];
  const steps = TURNS * (isOneOfMany ? 8 : 16);
  for (let k = 0; k <= steps; k++) {
    const share = k / steps;
    const angle = 2 * Math.PI * TURNS * share;
    const open = Math.min(1, 6 * share, 6 * (1 - share));
    points.push(new THREE.Vector3(open * radius * Math.cos(angle), open * radius * Math.sin(angle), natural * (0.04 + 0.92 * share)));
  }
  points.unshift(new THREE.Vector3(0, 0, 0));
  points.push(new THREE.Vector3(0, 0, natural));
  const path = new THREE.CatmullRomCurve3(points, false, "catmullrom", 0.3);
  return new THREE.TubeGeometry(path, steps, wire, isOneOfMany ? 4 : 6).scale(1, 1, 1 / natural);
}

function between(actor: Actor, force: Force, out: Stretched): void {
  const natural = naturalLength(actor, force);
  const size = actor.nearness.atMost(natural);
  const said: Picked = { kind: "force", name: force.name };
  const group = new THREE.Group();
  feet(actor, force.bodies, force.points, said, out);
  const sprung = force.look === "spring" || force.look === "spring-damper";
  const hydraulic = force.look === "cylinder";
  const many = actor.stage.forces.length > MANY;
  const [barrelRadius = (hydraulic ? 1.35 : 0.8) * BARREL * size, rodRadius = 0.55 * ROD * size * (hydraulic ? 1.5 : 1), barrelLength = 0.58 * natural] = force.sizes;
  const spring = sprung ? part(group, "wire", helix(COIL * size, WIRE * size, natural, many), said, out) : null;
  const barrel = force.look === "spring" ? null : part(group, "foot", unit(barrelRadius), said, out);
  const piston = barrel ? part(group, "sign", unit(rodRadius), said, out) : null;
  const pins = [0, 1].map(() => part(group, "signDark", new THREE.SphereGeometry(force.sizes.length ? 1.1 * rodRadius : 0.008 * size, 14, 10), said, out));
  out.moving.push(
    laid(actor, force.bodies, force.points, group, (length) => {
      if (spring) spring.scale.z = length;
      if (barrel && piston) {
        barrel.scale.z = Math.min(barrelLength, 0.92 * length);
        piston.scale.z = length;
      }
      pins[1]!.position.z = length;
    }),
  );
}

/** [m] the length at the start, or a share of the machine's where both ends lie on each other. */
function naturalLength(actor: Actor, force: Force): number {
  const length = distance(actor, force.bodies, force.points);
  return length > 1e-6 * actor.stage.size ? length : 0.2 * actor.stage.size;
}

/** [m] between two points in the frame that is shown. */
function distance(actor: Actor, bodies: readonly number[], points: readonly Point[]): number {
  const [a, b] = [0, 1].map((k) => actor.place(bodies[k]!, points[k]!, new THREE.Vector3()));
  return a!.distanceTo(b!);
}

/** The plane of a contact, on the second body. */
function plane(actor: Actor, force: Force): Stretching {
  const size = 1.6 * Math.max(actor.stage.size, new THREE.Vector3(...actor.stage.high).distanceTo(new THREE.Vector3(...actor.stage.low)) * 0.6);
  const material = new THREE.MeshLambertMaterial({ color: 0x8fa0b3, transparent: true, opacity: 0.16, side: THREE.DoubleSide, depthWrite: false });
  const sheet = new THREE.Mesh(new THREE.PlaneGeometry(size, size), material);
  sheet.userData = { kind: "force", name: force.name };
  const group = new THREE.Group();
  const normal = new THREE.Vector3(...(force.axis ?? [0, 0, 1])).normalize();
  sheet.quaternion.setFromUnitVectors(Z, normal);
  group.add(sheet);
  const foot = new THREE.Vector3();
  const centre = new THREE.Vector3();
  const turned = new THREE.Vector3();
  const body = force.bodies[1]!;
  const start: { offset: THREE.Vector3 | null } = { offset: null };
  return {
    object: group,
    update() {
      group.visible = !actor.isBad[body];
      actor.place(body, force.points[1]!, foot);
      if (!start.offset) {
        // under what touches it at the start, so that it need not be endless
        actor.place(force.bodies[0]!, force.points[0]!, centre);
        const n = turned.copy(normal).applyQuaternion(actor.holder(body).quaternion);
        start.offset = centre.sub(foot).addScaledVector(n, -centre.dot(n)).applyQuaternion(actor.holder(body).quaternion.clone().invert());
        if (!Number.isFinite(start.offset.lengthSq())) start.offset.set(0, 0, 0);
      }
      group.quaternion.copy(actor.holder(body).quaternion);
      group.position.copy(start.offset).applyQuaternion(group.quaternion).add(foot);
    },
  };
}
