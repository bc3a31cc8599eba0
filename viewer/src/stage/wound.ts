// The way of a rope around wheels with parallel axes: tangents and arcs, as `nivel.elements.forces.wound_ropes` has it.
import * as THREE from "three";
import type { Force, Winding } from "../generated/records";
import type { Motion } from "../motion";
import type { Actor } from "./actor";

const STEPS = 24; // bars of an arc

/** A wheel, or a point without one, seen along the axis. */
interface Place {
  number: number; // among the points of the rope
  centre: THREE.Vector3;
  x: number;
  y: number;
  radius: number; // signed: positive where the rope runs right-handed about the axis
  ux: number; // direction of the free part behind it
  uy: number;
  arc: number; // [rad], below zero where the rope does not touch it
}

export class Wound {
  readonly most: number; // bars from point to point
  private readonly near: number[]; // arcs of the last picture, next to which those of the next one are
  private table: number[][] | null = null; // arcs of all frames
  private readonly x = new THREE.Vector3();
  private readonly y = new THREE.Vector3();
  private readonly axis = new THREE.Vector3();

  constructor(
    private readonly actor: Actor,
    private readonly force: Force,
    private readonly winding: Winding,
    private readonly motion: Motion | null,
  ) {
    this.most = force.points.length - 1 + STEPS * winding.radii.filter((radius) => radius).length;
    this.near = [...winding.arcs];
  }

  /** The rope's points from its first end to its last, in the frame that is shown. */
  points(): THREE.Vector3[] {
    const { motion, actor } = this;
    if (motion && motion.count > 1) {
      this.table ??= this.follow(motion);
      this.table[motion.at(actor.time)]!.forEach((arc, k) => (this.near[k] = arc));
    }
    const places = this.layOut(actor.frame);
    return places.flatMap((place, k) => this.around(place, places[k - 1] ?? null));
  }

  /** Arcs of all frames: turns of a drum are counted from the start on. */
  private follow(motion: Motion): number[][] {
    const frame = new Float32Array(motion.layout.width);
    return Array.from({ length: motion.count }, (_, k) => {
      motion.sample(motion.time[k]!, frame);
      this.layOut(frame);
      return [...this.near];
    });
  }

  /** The places that the rope touches in a frame. */
  private layOut(frame: Float32Array): Place[] {
    const { actor, force, winding, axis, x, y } = this;
    actor.turnIn(frame, force.bodies[winding.carrier]!, winding.axis, axis).normalize();
    x.set(Math.abs(axis.x) < 0.6 ? 1 : 0, Math.abs(axis.x) < 0.6 ? 0 : 1, 0).cross(axis).normalize();
    y.crossVectors(axis, x);
    const all = force.points.map((point, number): Place => {
      const centre = actor.placeIn(frame, force.bodies[number]!, point, new THREE.Vector3());
      return { number, centre, x: centre.dot(x), y: centre.dot(y), radius: winding.radii[number]!, ux: 0, uy: 0, arc: 0 };
    });
    const ends = [all[0]!, all[all.length - 1]!];
    const fixed = ends.map(({ number }, k) => actor.turnIn(frame, force.bodies[number]!, winding.fixed[k]!, new THREE.Vector3()));
    this.find(all, fixed);
    all.forEach(({ arc, number }) => {
      if (Number.isFinite(arc)) this.near[number] = arc;
    });
    if (all.every(({ arc }) => arc >= 0)) return all;
    // a wheel that it does not touch is passed over, a drum that is unwound holds it at the rim
    const touched = all.filter((place) => ends.includes(place) || place.arc >= 0);
    ends.forEach((end, k) => {
      if (end.arc >= 0) return;
      end.centre.addScaledVector(fixed[k]!, Math.abs(end.radius));
      Object.assign(end, { x: end.centre.dot(x), y: end.centre.dot(y), radius: 0 });
    });
    this.find(touched, fixed);
    return touched;
  }

  /** Directions of the free parts from place to place, and the arcs. fixed : where the rope is fixed at its ends. */
  private find(places: Place[], fixed: THREE.Vector3[]): void {
    for (let k = 1; k < places.length; k++) {
      const [a, b] = [places[k - 1]!, places[k]!];
      const [dx, dy, rho] = [b.x - a.x, b.y - a.y, b.radius - a.radius];
      const square = dx * dx + dy * dy;
      const length = Math.sqrt(Math.max(square - rho * rho, 0));
      a.ux = (dx * length + dy * rho) / square;
      a.uy = (dy * length - dx * rho) / square;
    }
    places.forEach((place, k) => {
      const sign = Math.sign(place.radius);
      const before = places[k - 1];
      const isLast = k === places.length - 1;
      place.arc = 0;
      if (!sign) return;
      if (before && !isLast) {
        place.arc = this.next(place, sign * (before.ux * place.uy - before.uy * place.ux), before.ux * place.ux + before.uy * place.uy);
        return;
      }
      const { ux, uy } = before ?? place;
      const [tx, ty] = [sign * uy, -sign * ux]; // from the centre to where the free part touches the rim
      const e = fixed[before ? 1 : 0]!;
      const [ex, ey] = [e.dot(this.x), e.dot(this.y)];
      place.arc = this.next(place, (before ? -sign : sign) * (ex * ty - ey * tx), ex * tx + ey * ty);
    });
  }

  /** The angle with this sine and cosine that is next to the arc of the last picture. */
  private next({ number }: Place, sine: number, cosine: number): number {
    const angle = Math.atan2(sine, cosine);
    return angle + 2 * Math.PI * Math.round((this.near[number]! - angle) / (2 * Math.PI));
  }

  /** Points of a place: the arc on its wheel, of more than a turn the whole rim, or its centre. */
  private around(place: Place, before: Place | null): THREE.Vector3[] {
    const { centre, radius } = place;
    if (!radius) return [centre];
    const { ux, uy } = before ?? place;
    const turned = Math.min(place.arc, 2 * Math.PI) * Math.sign(radius);
    const start = Math.atan2(-radius * ux, radius * uy) - (before ? 0 : turned); // the rope leaves a first drum where its free part begins
    return Array.from({ length: STEPS + 1 }, (_, k) => {
      const angle = start + (turned * k) / STEPS;
      const out = centre.clone().addScaledVector(this.x, Math.abs(radius) * Math.cos(angle));
      return out.addScaledVector(this.y, Math.abs(radius) * Math.sin(angle));
    });
  }
}
