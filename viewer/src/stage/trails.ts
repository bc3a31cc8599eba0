// The latest way of points of a machine that lives: lines that grow at one end and are forgotten at the other.
import * as THREE from "three";
import type { Actor } from "./actor";

const POINTS = 1500;
const MOST = 3; // a machine with more markers has none of its trails drawn
const COLOUR = 0xd9682b;

export class Trails {
  readonly root = new THREE.Group();
  private readonly lines: { line: THREE.Line; body: number; point: readonly [number, number, number]; count: number }[] = [];

  constructor(private readonly actor: Actor) {
    const markers = actor.stage.markers.filter((each) => each.body >= 0);
    if (markers.length > MOST) return;
    for (const { body, point } of markers) {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * POINTS), 3));
      geometry.setDrawRange(0, 0);
      const line = new THREE.Line(geometry, new THREE.LineBasicMaterial({ color: COLOUR }));
      line.frustumCulled = false;
      this.root.add(line);
      this.lines.push({ line, body, point, count: 0 });
    }
  }

  /** The frame that is shown adds a point to every trail. */
  add(): void {
    const at = new THREE.Vector3();
    for (const trail of this.lines) {
      this.actor.place(trail.body, trail.point, at);
      const attribute = trail.line.geometry.getAttribute("position") as THREE.BufferAttribute;
      const numbers = attribute.array as Float32Array;
      if (trail.count === POINTS) numbers.copyWithin(0, 3);
      else trail.count++;
      at.toArray(numbers, 3 * (trail.count - 1));
      attribute.needsUpdate = true;
      trail.line.geometry.setDrawRange(0, trail.count);
    }
  }

  clear(): void {
    for (const trail of this.lines) trail.count = 0;
  }
}
