// Names over the picture, as text of the page: sharp, selectable by machines that read, and never in the way of the mouse.
import * as THREE from "three";
import type { Actor } from "./actor";
import { isCovered } from "./covered";

const MOST = 80; // names that are shown at once
const LINE = 17; // pixels from one name to the next below it
const DOWN = 3; // lines that a name goes down to where it fits; further away nobody would know what it belongs to,
const MANY = 60; // and of so many names at once already in the next line
const LETTER = 7; // pixels, about
const LOOKED = 40; // bodies at most whose names are looked at whether they are covered

type Point = readonly [number, number, number];
export type Named = "body" | "joint" | "force";

interface Label {
  element: HTMLElement;
  text: string;
  body: number;
  point: Point;
  kind: Named;
}

/** Names of forces are those of drivers and couplings too. */
export class Labels {
  readonly shown = { body: false, joint: false, force: false };
  private readonly labels: Label[] = [];

  constructor(
    private readonly actor: Actor,
    private readonly holder: HTMLElement,
  ) {
    const { stage } = actor;
    const swept = new Map(stage.sweeps.flatMap((sweep) => sweep.bodies.map((body, k) => [body, k === sweep.bodies.length >> 1 ? sweep.name : ""])));
    for (const [k, body] of stage.bodies.entries()) this.add("body", swept.get(k) ?? body.name, k, body.centre_of_mass);
    for (const joint of stage.joints) this.add("joint", joint.name, joint.bodies[joint.place], joint.points[joint.place]);
    for (const force of [...stage.forces, ...stage.drivers]) if (force.points[0]) this.add("force", force.name, force.bodies[0]!, force.points[0]);
    for (const { name, wheels, joined } of stage.couplings) {
      const [wheel] = wheels;
      const [end] = joined;
      if (wheel) this.add("force", name, wheel.body, wheel.centre);
      else if (end) this.add("force", name, end.body, end.point);
    }
  }

  /** Names that would lie on each other go down, one line each; those that still do not fit are left out. At rest, those of bodies behind
   *  others are faint. */
  update(camera: THREE.PerspectiveCamera, width: number, height: number, atRest: boolean): void {
    const at = new THREE.Vector3();
    const taken: [number, number, number][] = [];
    const lines = this.labels.length > MANY ? 0 : DOWN;
    for (const label of this.labels) {
      const { style } = label.element;
      const wanted = this.shown[label.kind] && taken.length < MOST && !this.actor.isBad[label.body];
      if (wanted && label.kind === "body" && this.actor.stage.bodies.length <= LOOKED) {
        const covered = atRest && isCovered(this.actor, label.body, this.actor.place(label.body, label.point, at), camera);
        label.element.classList.toggle("covered", covered);
      }
      if (wanted) this.actor.place(label.body, label.point, at).project(camera);
      const wide = LETTER * label.text.length;
      const place = (0.5 + 0.5 * at.x) * width;
      const x = Math.min(Math.max(place, 0.5 * wide + 4), width - 0.5 * wide - 4);
      const y = (0.5 - 0.5 * at.y) * height;
      const isFree = (down: number) => !taken.some(([a, b, c]) => Math.abs(a - x) < 0.5 * (wide + c) && Math.abs(b - y - LINE * down) < LINE - 1);
      const off = !wanted || at.z > 1 || place < 0 || y < 0 || place > width || y > height;
      let down = 0;
      while (!off && down <= lines && !isFree(down)) down++;
      const shown = !off && down <= lines;
      style.display = shown ? "" : "none";
      if (!shown) continue;
      taken.push([x, y + LINE * down, wide]);
      style.transform = `translate(${x.toFixed(1)}px, ${(y + LINE * down).toFixed(1)}px) translate(-50%, 9px)`;
    }
  }

  private add(kind: Named, text: string, body: number, point: Point): void {
    if (!text) return;
    const element = document.createElement("span");
    element.className = `label ${kind}`;
    element.textContent = text;
    element.style.display = "none";
    this.holder.append(element);
    this.labels.push({ element, text, body, point, kind });
  }
}
