// The camera goes along with a body.
import * as THREE from "three";
import type { Actor } from "./actor";
import type { World } from "./world";

export class Follower {
  name: string | null = null;
  private body = -1;
  private readonly last = new THREE.Vector3();

  constructor(
    private readonly world: World,
    private readonly actor: Actor,
  ) {}

  toggle(name: string): void {
    if (this.name === name) {
      this.stop();
      return;
    }
    this.name = name;
    this.body = this.actor.stage.bodies.findIndex((body) => body.name === name);
    this.centre(this.last);
    this.world.shift(this.last.clone().sub(this.world.controls.target));
    this.world.invalidate();
  }

  stop(): void {
    this.name = null;
    this.body = -1;
  }

  update(): void {
    if (this.body < 0 || this.actor.isBad[this.body]) return;
    const now = this.centre(new THREE.Vector3());
    this.world.shift(now.clone().sub(this.last));
    this.last.copy(now);
  }

  private centre(out: THREE.Vector3): THREE.Vector3 {
    return this.actor.place(this.body, this.actor.stage.bodies[this.body]!.centre_of_mass, out);
  }
}
