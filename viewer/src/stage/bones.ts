// Automatic links as lines of constant width, so that a long chain is seen from afar, where its links are thinner than a point of the
// screen. Near by the lines lie inside the links.
import * as THREE from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import type { Actor } from "./actor";

const WIDTH = 2; // pixels

type Point = readonly [number, number, number];

export class Bones {
  readonly object: LineSegments2;
  private readonly ends: { body: number; points: [Point, Point] }[] = [];
  private readonly material: LineMaterial;

  constructor(
    private readonly actor: Actor,
    isGhost: boolean,
  ) {
    const colours: number[] = [];
    const colour = new THREE.Color();
    actor.stage.bodies.forEach((body, k) => {
      for (const point of body.links) {
        this.ends.push({ body: k, points: [body.centre_of_mass, point] });
        colour.set(body.colour);
        colours.push(...colour.toArray(), ...colour.toArray());
      }
    });
    this.material = new LineMaterial({ linewidth: WIDTH, vertexColors: !isGhost, transparent: isGhost, opacity: isGhost ? 0.4 : 1 });
    const geometry = new LineSegmentsGeometry();
    geometry.setPositions(new Float32Array(6 * this.ends.length));
    if (!isGhost) geometry.setColors(colours);
    this.object = new LineSegments2(geometry, this.material);
    this.object.frustumCulled = false;
    this.object.raycast = () => {}; // links are chosen by their solids, or in the list
  }

  recolour(colour: string): void {
    if (!this.material.vertexColors) this.material.color.set(colour);
  }

  update(): void {
    const point = new THREE.Vector3();
    const starts = this.object.geometry.getAttribute("instanceStart") as THREE.InterleavedBufferAttribute;
    const into = starts.data.array as Float32Array;
    this.ends.forEach(({ body, points }, k) => {
      const bad = this.actor.isBad[body];
      points.forEach((each, end) => {
        this.actor.place(body, bad ? points[0] : each, point);
        point.toArray(into, 6 * k + 3 * end);
      });
    });
    starts.data.needsUpdate = true;
  }
}
