// Many solids of one shape, each at its place and scale, drawn in one go.
import * as THREE from "three";
import type { Picked } from "./actor";

export class Instances {
  readonly mesh: THREE.InstancedMesh;
  private readonly matrix = new THREE.Matrix4();

  constructor(
    geometry: THREE.BufferGeometry,
    material: THREE.Material,
    private readonly owners: readonly Picked[],
  ) {
    this.mesh = new THREE.InstancedMesh(geometry, material, owners.length);
    this.mesh.frustumCulled = false; // its extent changes
    this.mesh.userData = { instances: this };
    owners.forEach((_, k) => this.hide(k));
  }

  set(k: number, position: THREE.Vector3, turn: THREE.Quaternion, scale: THREE.Vector3): void {
    this.mesh.setMatrixAt(k, this.matrix.compose(position, turn, scale));
  }

  hide(k: number): void {
    this.mesh.setMatrixAt(k, this.matrix.makeScale(0, 0, 0));
  }

  /** All are set. */
  done(): void {
    this.mesh.instanceMatrix.needsUpdate = true;
    this.mesh.boundingSphere = null; // clicks look for it where it is now
  }

  /** What the instance with this number belongs to. */
  said(k: number | undefined): Picked | null {
    return this.owners[k ?? -1] ?? null;
  }
}
