// How large signs may be at a body or a joint: in a machine of few bodies they are measured by the machine, in a long chain by the link.
import type { Body, Joint, Part, Stage } from "../generated/records";

const REACH = 6; // a machine this many times as long as a body is too large to measure the body's signs by

type Point = readonly [number, number, number];

export class Nearness {
  private readonly bodies: number[];

  constructor(private readonly stage: Stage) {
    this.bodies = stage.bodies.map(lengthOf);
  }

  /** [m] the size that signs of a body are shares of; of the ground that of the machine. */
  body(body: number): number {
    return this.atMost(this.bodies[body] ?? 0);
  }

  /** [m] of a joint: that of the smaller of its bodies, the ground apart. */
  joint(joint: Joint): number {
    return this.between(joint.bodies);
  }

  /** [m] of what stands between bodies. */
  between(bodies: readonly number[]): number {
    const known = bodies.map((body) => this.bodies[body] ?? 0).filter((length) => length > 0);
    return this.atMost(known.length ? Math.min(...known) : 0);
  }

  /** [m] of something that is `length` long; the machine's size where that is not known. */
  atMost(length: number): number {
    return length > 1e-9 * this.stage.size ? Math.min(this.stage.size, REACH * length) : this.stage.size;
  }
}

/** [m] how long a body is: the box around the points that hold it, or its shape where that is longer. */
function lengthOf(body: Body): number {
  const points: Point[] = [...body.held, body.centre_of_mass];
  const sides = [0, 1, 2].map((axis) => {
    const places = points.map((point) => point[axis]!);
    return places.reduce((a, b) => Math.max(a, b)) - places.reduce((a, b) => Math.min(a, b));
  });
  return Math.max(Math.hypot(...sides), ...body.parts.map(longestSide));
}

function longestSide(part: Part): number {
  const [a = 0, b = 0, c = 0] = part.size;
  switch (part.kind) {
    case "box":
      return Math.max(a, b, c);
    case "sphere":
      return 2 * a;
    case "ellipsoid":
      return 2 * Math.max(a, b, c);
    case "cylinder":
    case "capsule":
      return Math.max(2 * a, b);
    case "tube":
      return Math.max(2 * a, c);
    case "extrusion":
      return Math.max(a, ...part.outline.map(([x, y]) => 2 * Math.hypot(x, y)));
    case "mesh":
      return 0;
  }
}
