// Names over the picture, as text of the page: sharp, selectable by machines that read, and never in the way of the mouse.
import * as THREE from "three";
import type { Actor } from "./actor";

const MOST = 80; // names that are shown at once

interface Label {
  element: HTMLElement;
  body: number;
  point: readonly [number, number, number];
  kind: "body" | "joint" | "force";
}

export class Labels {
  readonly shown = { body: false, joint: false, force: false };
  private readonly labels: Label[] = [];

  constructor(
    private readonly actor: Actor,
    private readonly holder: HTMLElement,
  ) {
    const { stage } = actor;
    for (const [k, body] of stage.bodies.entries()) this.add("body", body.name, k, body.centre_of_mass);
    for (const joint of stage.joints) this.add("joint", joint.name, joint.bodies[joint.place], joint.points[joint.place]);
    for (const force of stage.forces) if (force.points[0]) this.add("force", force.name, force.bodies[0]!, force.points[0]);
  }

  update(camera: THREE.PerspectiveCamera, width: number, height: number): void {
    const at = new THREE.Vector3();
    let count = 0;
    const taken: [number, number, number][] = [];
    for (const label of this.labels) {
      const { style } = label.element;
      const wanted = this.shown[label.kind] && count < MOST && !this.actor.isBad[label.body];
      if (wanted) this.actor.place(label.body, label.point, at).project(camera);
      const x = (0.5 + 0.5 * at.x) * width;
      const y = (0.5 - 0.5 * at.y) * height;
      const off = !wanted || at.z > 1 || x < 0 || y < 0 || x > width || y > height;
      style.display = off ? "none" : "";
      if (off) continue;
      count++;
      // names that would lie on each other go down, one line each
      let down = 0;
      const wide = 7 * (label.element.textContent ?? "").length;
      while (down < 5 && taken.some(([a, b, c]) => Math.abs(a - x) < 0.5 * (wide + c) && Math.abs(b - y - 17 * down) < 16)) down++;
      taken.push([x, y + 17 * down, wide]);
      style.transform = `translate(${x.toFixed(1)}px, ${(y + 17 * down).toFixed(1)}px) translate(-50%, 9px)`;
    }
  }

  private add(kind: Label["kind"], text: string, body: number, point: readonly [number, number, number]): void {
    const element = document.createElement("span");
    element.className = `label ${kind}`;
    element.textContent = text;
    element.style.display = "none";
    this.holder.append(element);
    this.labels.push({ element, body, point, kind });
  }
}
