// The way of the camera from one view to another.
import * as THREE from "three";

const TURN_TIME = 260; // ms

export class Flight {
  private readonly start = performance.now();

  /** from, to : of the eye; target, aim : what it is aimed at, now and then. */
  constructor(
    private readonly from: THREE.Vector3,
    private readonly target: THREE.Vector3,
    private readonly to: THREE.Vector3,
    private readonly aim: THREE.Vector3,
  ) {}

  /** What it flies to moves. */
  shift(by: THREE.Vector3): void {
    this.to.add(by);
    this.aim.add(by);
  }

  /** Bring eye and target to where they are at this moment of the page's clock [ms]; whether they have arrived. */
  bring(eye: THREE.Vector3, target: THREE.Vector3, now: number): boolean {
    const t = Math.min(Math.max((now - this.start) / TURN_TIME, 0), 1);
    const share = t * t * (3 - 2 * t);
    target.lerpVectors(this.target, this.aim, share);
    const a = this.from.clone().sub(this.target);
    const b = this.to.clone().sub(this.aim);
    const length = THREE.MathUtils.lerp(a.length(), b.length(), share);
    const turn = new THREE.Quaternion().setFromUnitVectors(a.clone().normalize(), b.clone().normalize());
    eye.copy(a.applyQuaternion(new THREE.Quaternion().slerp(turn, share)).setLength(length)).add(target);
    return t >= 1;
  }
}
