// In the corner of the picture: the global axes as they are seen, and how long a length is.
import * as THREE from "three";
import { roundSize } from "./floor";
import type { World } from "./world";

const ARM = 24; // pixels of an axis seen from its side
const MIDDLE = 34; // pixels from the left and from the top of the sign
const BAR = 90; // pixels that the bar has at most
const UNITS = [
  [1e3, "km"],
  [1, "m"],
  [1e-3, "mm"],
  [1e-6, "µm"],
] as const;
const NAMESPACE = "http://www.w3.org/2000/svg";

export class Compass {
  readonly element = shape("svg", { class: "compass", width: "190", height: "72", "aria-hidden": "true" });
  private readonly axes = ["x", "y", "z"].map((name) => {
    const line = shape("line", { class: `axis ${name}`, x1: String(MIDDLE), y1: String(MIDDLE) });
    const text = shape("text", { class: `axis ${name}` });
    text.textContent = name;
    return { line, text };
  });
  private readonly bar = shape("path", { class: "bar" });
  private readonly length = shape("text", { class: "length", x: "84", y: "40" });

  constructor(private readonly world: World) {
    for (const { line, text } of this.axes) this.element.append(line, text);
    this.element.append(this.bar, this.length);
  }

  /** As the camera stands now. */
  update(): void {
    const { camera, controls } = this.world;
    const turn = camera.quaternion.clone().invert();
    const seen = [0, 1, 2].map((k) => new THREE.Vector3().setComponent(k, 1).applyQuaternion(turn));
    seen.forEach((axis, k) => {
      const { line, text } = this.axes[k]!;
      line.setAttribute("x2", (MIDDLE + ARM * axis.x).toFixed(1));
      line.setAttribute("y2", (MIDDLE - ARM * axis.y).toFixed(1));
      text.setAttribute("x", (MIDDLE + (ARM + 8) * axis.x).toFixed(1));
      text.setAttribute("y", (MIDDLE - (ARM + 8) * axis.y + 4).toFixed(1));
    });
    // what is nearer to the camera is drawn last
    const order = [0, 1, 2].sort((a, b) => seen[a]!.z - seen[b]!.z);
    for (const k of order) this.element.append(this.axes[k]!.line, this.axes[k]!.text);
    const distance = camera.position.distanceTo(controls.target);
    const metres = (2 * distance * Math.tan(THREE.MathUtils.degToRad(camera.fov / 2))) / Math.max(this.world.holder.clientHeight, 1);
    const length = roundSize(BAR * metres);
    const end = 84 + length / metres;
    this.bar.setAttribute("d", `M84 48v6H${end.toFixed(1)}v-6`);
    this.length.textContent = inWords(length);
  }
}

/** A length in the unit that suits it. */
function inWords(length: number): string {
  const [factor, unit] = UNITS.find(([each]) => length >= 0.999 * each) ?? UNITS[UNITS.length - 1]!;
  return `${Number((length / factor).toPrecision(3))} ${unit}`;
}

function shape(name: string, given: Record<string, string>): SVGElement {
  const out = document.createElementNS(NAMESPACE, name);
  for (const [key, value] of Object.entries(given)) out.setAttribute(key, value);
  return out;
}
