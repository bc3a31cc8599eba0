// The floor: a grid that fades out, of squares with a round size, and the shadow on it.
import * as THREE from "three";
import type { Stage } from "../generated/records";
import type { Look } from "./look";

const LINES = 24; // to each side of the middle
const PIECES = 12; // of a half line: the fading is that smooth
const HEAVY = 5; // each so many a line is heavy

export class Floor {
  readonly group = new THREE.Group();
  readonly square: number; // [m]
  private readonly lines: THREE.LineSegments;
  private readonly material = new THREE.LineBasicMaterial({ vertexColors: true, transparent: true, depthWrite: false });
  private readonly shadow: THREE.Mesh;
  private readonly height: number; // along the axes of the floor
  private readonly shade = new THREE.ShadowMaterial({ opacity: 0.16, depthWrite: false });

  constructor(stage: Stage, look: Look) {
    const low = new THREE.Vector3(...stage.low);
    const high = new THREE.Vector3(...stage.high);
    const up = new THREE.Vector3(...stage.up);
    const reach = Math.max(low.distanceTo(high), stage.size);
    this.square = roundSize(reach / 9);
    const middle = low.clone().add(high).multiplyScalar(0.5);
    // just under the lowest point
    const heights = [low.dot(up), high.dot(up)];
    const height = Math.min(...heights) - 0.04 * stage.size;
    const base = middle.clone().addScaledVector(up, height - middle.dot(up));
    const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 0, 1), up);
    const flat = (v: THREE.Vector3) => v.applyQuaternion(turn.clone().invert());
    this.height = flat(base.clone()).z;
    this.group.quaternion.copy(turn);
    this.under(base, this.square);
    this.lines = new THREE.LineSegments(gridLines(this.square), this.material);
    this.lines.renderOrder = -1;
    this.shadow = new THREE.Mesh(new THREE.PlaneGeometry(3 * reach, 3 * reach), this.shade);
    this.shadow.receiveShadow = true;
    this.shadow.renderOrder = -2;
    this.group.add(this.lines, this.shadow);
    this.recolour(look);
  }

  /** Below a point, moved by whole squares of the size `step`. */
  under(point: THREE.Vector3, step = HEAVY * this.square): void {
    const at = point.clone().applyQuaternion(this.group.quaternion.clone().invert());
    const snapped = new THREE.Vector3(Math.round(at.x / step) * step, Math.round(at.y / step) * step, this.height);
    this.group.position.copy(snapped.applyQuaternion(this.group.quaternion));
  }

  setGrid(on: boolean): void {
    this.lines.visible = on;
  }

  setShadows(on: boolean): void {
    this.shadow.visible = on;
  }

  recolour(look: Look): void {
    this.material.color.set(look.grid);
    this.shade.opacity = look.dark ? 0.4 : 0.15;
  }
}

/** 1, 2 or 5 times a power of ten, at most `about`. */
export function roundSize(about: number): number {
  const power = 10 ** Math.floor(Math.log10(about));
  return power * ([5, 2, 1].find((k) => k * power <= about * 1.0001) ?? 1);
}

function gridLines(square: number): THREE.BufferGeometry {
  const points: number[] = [];
  const colours: number[] = [];
  const reach = LINES * square;
  const step = reach / PIECES;
  const strength = (x: number, y: number, heavy: boolean) => Math.max(0, 1 - Math.hypot(x, y) / reach) ** 1.4 * (heavy ? 1 : 0.5);
  for (let k = -LINES; k <= LINES; k++) {
    const across = k * square;
    const heavy = k % HEAVY === 0;
    for (let piece = -PIECES; piece < PIECES; piece++) {
      for (const along of [piece * step, (piece + 1) * step]) {
        points.push(across, along, 0);
        colours.push(1, 1, 1, strength(across, along, heavy));
      }
      for (const along of [piece * step, (piece + 1) * step]) {
        points.push(along, across, 0);
        colours.push(1, 1, 1, strength(along, across, heavy));
      }
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
  geometry.setAttribute("color", new THREE.Float32BufferAttribute(colours, 4));
  return geometry;
}
