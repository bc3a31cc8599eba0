// The latest way of points of a machine that lives: lines that grow at one end and are forgotten at the other.
import * as THREE from "three";
import type { Samples } from "../connection";
import type { Actor } from "./actor";

const POINTS = 1500;
const COLOUR = 0xd9682b;

export class Trails {
  readonly root = new THREE.Group();
  private readonly lines: { line: THREE.Line; body: number; point: readonly [number, number, number]; count: number }[] = [];
  private readonly frame: Float32Array; // what a sample says of one
  private time = -Infinity;

  /** traced : bodies whose poses stand behind so many gauges in a sample. */
  constructor(
    private readonly actor: Actor,
    private readonly traced: number[],
    private readonly gaugeCount: number,
  ) {
    this.frame = new Float32Array(actor.stage.layout.width);
    for (const { body, point } of actor.stage.markers) {
      if (!traced.includes(body)) continue;
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * POINTS), 3));
      geometry.setDrawRange(0, 0);
      const line = new THREE.Line(geometry, new THREE.LineBasicMaterial({ color: COLOUR }));
      line.frustumCulled = false;
      this.root.add(line);
      this.lines.push({ line, body, point, count: 0 });
    }
  }

  /** Every sample adds a point to every trail; one of an earlier moment begins them anew. */
  add({ width, values }: Samples): void {
    const { bodies } = this.actor.stage.layout;
    const first = 1 + this.gaugeCount;
    for (let row = 0; row < values.length; row += width) {
      if (values[row]! < this.time) for (const trail of this.lines) trail.count = 0;
      this.time = values[row]!;
      this.traced.forEach((body, k) => this.frame.set(values.subarray(row + first + 7 * k, row + first + 7 * k + 7), 7 * body));
      this.frame.set(values.subarray(row + first + 7 * this.traced.length, row + width), 7 * bodies);
      for (const trail of this.lines) this.lengthen(trail);
    }
    for (const { line, count } of this.lines) {
      line.geometry.getAttribute("position").needsUpdate = true;
      line.geometry.setDrawRange(0, count);
    }
  }

  private lengthen(trail: (typeof this.lines)[number]): void {
    const numbers = trail.line.geometry.getAttribute("position").array as Float32Array;
    if (trail.count === POINTS) numbers.copyWithin(0, 3);
    else trail.count++;
    this.actor.placeIn(this.frame, trail.body, trail.point, AT).toArray(numbers, 3 * (trail.count - 1));
  }
}

const AT = new THREE.Vector3();
