// What is moved by hand stays in the picture, and what drives away.
import * as THREE from "three";
import type { Actor } from "./actor";
import { boxesNow } from "./cloud";
import type { World } from "./world";

const SOMETIMES = 400; // ms
const AWAY = 2; // times its size that a machine has gone as a whole, from which on it drives
const SAME = 1.5; // times its size at first, up to which it has not grown

export class Handled {
  private body = -1; // that is moved
  private patience = 0; // ms between two looks
  private looked = 0;
  private readonly start = new THREE.Box3();

  constructor(
    private readonly world: World,
    private readonly actor: Actor,
    private readonly follow: (body: string) => void,
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
    this.start.setFromPoints(boxesNow(this.actor).flat());
  }

  /** See all of the machine again where some of it left the picture; if the user looks closer, where the body that moves did. */
  keepInSight(): void {
    const now = performance.now();
    if (now - this.looked < this.patience) return;
    this.looked = now;
    const body = this.actor.bodies[this.body];
    if (!this.world.around || !body || this.actor.isBad[this.body]) return;
    if (this.patience && !this.world.isFitted) return;
    if (this.world.holds(this.world.isFitted ? this.world.around() : [body.position])) return;
    const driven = this.patience ? this.driven() : null;
    if (driven) this.follow(driven);
    else this.world.fit();
  }

  /** The largest body of a machine that has gone away as a whole; null where it stands, however far it reaches. */
  private driven(): string | null {
    const boxes = boxesNow(this.actor).map((points) => new THREE.Box3().setFromPoints(points));
    const now = boxes.reduce((all, box) => all.union(box), new THREE.Box3());
    const size = this.start.min.distanceTo(this.start.max);
    const gone = now.getCenter(new THREE.Vector3()).distanceTo(this.start.getCenter(new THREE.Vector3()));
    if (!(gone > AWAY * size) || now.min.distanceTo(now.max) > SAME * size) return null;
    const sizes = boxes.map((box) => (box.isEmpty() ? 0 : box.min.distanceTo(box.max)));
    return this.actor.stage.bodies[sizes.indexOf(Math.max(...sizes))]!.name;
  }
}
