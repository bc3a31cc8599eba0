// Paths of points through the whole motion: faint as a whole, strong up to the present moment.
import * as THREE from "three";
import { Line2 } from "three/examples/jsm/lines/Line2.js";
import { LineGeometry } from "three/examples/jsm/lines/LineGeometry.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import type { Motion } from "../motion";
import type { Actor } from "./actor";
import type { Look } from "./look";

const MOST = 6000; // points of a path

export interface Traceable {
  key: string;
  label: string;
  body: number;
  point: readonly [number, number, number];
}

interface Path {
  of: Traceable;
  whole: THREE.Line;
  past: Line2;
  dot: THREE.Mesh;
  frames: number[];
}

export class Traces {
  readonly root = new THREE.Group();
  private readonly paths = new Map<string, Path>();

  constructor(
    private readonly actor: Actor,
    private readonly motion: Motion | null,
    private look: Look,
  ) {}

  get keys(): string[] {
    return [...this.paths.keys()];
  }

  has(key: string): boolean {
    return this.paths.has(key);
  }

  toggle(of: Traceable): void {
    const path = this.paths.get(of.key);
    if (path) {
      for (const each of [path.whole, path.past, path.dot]) each.removeFromParent();
      this.paths.delete(of.key);
    } else if (this.motion) {
      this.paths.set(of.key, this.make(of, this.motion));
    }
  }

  clear(): void {
    this.root.clear();
    this.paths.clear();
  }

  recolour(look: Look): void {
    this.look = look;
    [...this.paths.values()].forEach((path, k) => this.paint(path, k));
  }

  update(frame: number): void {
    for (const path of this.paths.values()) {
      let count = 0;
      while (count < path.frames.length && path.frames[count]! <= frame) count++;
      path.past.geometry.instanceCount = Math.max(count - 1, 0);
      this.actor.place(path.of.body, path.of.point, path.dot.position);
      path.dot.visible = !this.actor.isBad[path.of.body];
    }
  }

  private make(of: Traceable, motion: Motion): Path {
    const step = Math.max(Math.ceil(motion.count / MOST), 1);
    const points: number[] = [];
    const frames: number[] = [];
    const frame = new Float32Array(motion.layout.width);
    const turn = new THREE.Quaternion();
    const at = new THREE.Vector3();
    for (let k = 0; k < motion.count; k += step) {
      const time = motion.time[k]!;
      motion.sample(time, frame);
      const [x, y, z, e0, e1, e2, e3] = frame.subarray(7 * of.body, 7 * of.body + 7) as unknown as number[];
      turn.set(e1!, e2!, e3!, e0!);
      this.actor.bent(of.body, of.point, frame, at).applyQuaternion(turn).add(new THREE.Vector3(x, y, z));
      if (!Number.isFinite(at.x + at.y + at.z)) continue;
      points.push(at.x, at.y, at.z);
      frames.push(k);
    }
    const whole = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ transparent: true, opacity: 0.4 }));
    whole.geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    const geometry = new LineGeometry();
    geometry.setPositions(points.length >= 6 ? points : [...points, ...points, 0, 0, 0, 0, 0, 0].slice(0, 6));
    const past = new Line2(geometry, new LineMaterial({ linewidth: 2.2 }));
    const dot = new THREE.Mesh(new THREE.SphereGeometry(0.011 * this.actor.nearness.body(of.body), 16, 12), new THREE.MeshBasicMaterial());
    for (const each of [whole, past]) each.frustumCulled = false;
    this.root.add(whole, past, dot);
    const path = { of, whole, past, dot, frames };
    this.paint(path, this.paths.size);
    return path;
  }

  private paint(path: Path, k: number): void {
    const colour = this.look.trace[(k + 1) % this.look.trace.length]!;
    (path.whole.material as THREE.LineBasicMaterial).color.set(colour);
    path.past.material.color.set(colour);
    (path.dot.material as THREE.MeshBasicMaterial).color.set(colour);
  }
}
