// What is moved by hand stays in the picture.
import type { Actor } from "./actor";
import type { World } from "./world";

const SOMETIMES = 400; // ms

export class Handled {
  private body = -1; // that is moved
  private patience = 0; // ms between two looks
  private looked = 0;

  constructor(
    private readonly world: World,
    private readonly actor: Actor,
  ) {}

  /** A coordinate is moved. */
  move(coordinate: string): void {
    const { stage } = this.actor;
    const owner = stage.coordinates.find((each) => each.name === coordinate)?.joint;
    const joint = stage.joints.find((each) => each.name === owner);
    if (joint) this.body = joint.bodies[1] >= 0 ? joint.bodies[1] : joint.bodies[0];
    else this.body = stage.bodies.findIndex((each) => each.name === owner);
  }

  /** Whatever moves is watched. */
  watchAll(): void {
    this.body = 0;
    this.patience = SOMETIMES;
  }

  /** See all of the machine again where some of it left the picture; if the user looks closer, where the body that moves did. */
  keepInSight(): void {
    const now = performance.now();
    if (now - this.looked < this.patience) return;
    this.looked = now;
    const body = this.actor.bodies[this.body];
    if (!this.world.around || !body || this.actor.isBad[this.body]) return;
    if (this.patience && !this.world.isFitted) return;
    if (!this.world.holds(this.world.isFitted ? this.world.around() : [body.position])) this.world.fit();
  }
}
