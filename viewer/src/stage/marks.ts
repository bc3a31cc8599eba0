// Marks on round bodies: on a wheel of one colour nobody sees that it turns.
import * as THREE from "three";
import type { Part } from "../generated/records";

const WIDE = 0.16; // of a mark, in radii
const OUT = 1.015; // how far it stands out
const AXES = { x: 0, y: 1, z: 2 } as const;

/** A stripe on one side of a round part: along the bar and on both of its ends, or half around a ball. Null where a part is not round. */
export function markOf(part: Part): THREE.BufferGeometry | null {
  const [a = 1, b = 1, c = 1] = part.size;
  let geometry: THREE.BufferGeometry;
  if (part.kind === "cylinder") geometry = stripe(0.3 * a, a, b);
  else if (part.kind === "tube") geometry = stripe(b, a, c);
  else if (part.kind === "sphere") geometry = new THREE.TorusGeometry(a, 0.03 * a, 6, 32, Math.PI);
  else return null;
  const along = AXES[part.along as keyof typeof AXES] ?? 2;
  if (along === 0) geometry.rotateY(Math.PI / 2);
  else if (along === 1) geometry.rotateX(-Math.PI / 2);
  return geometry.translate(...part.centre);
}

/** A box along z, between two radii. */
function stripe(inner: number, outer: number, length: number): THREE.BufferGeometry {
  const high = OUT * outer - inner;
  return new THREE.BoxGeometry(high, WIDE * outer, length + 2 * (OUT - 1) * outer).translate(inner + 0.5 * high, 0, 0);
}

/** The colour of a mark on a body of a colour: darker, on dark bodies lighter. */
export function markColour(colour: string): string {
  const out = new THREE.Color(colour);
  const { h, s, l } = out.getHSL({ h: 0, s: 0, l: 0 });
  return `#${out.setHSL(h, s, l > 0.25 ? 0.55 * l : l + 0.3).getHexString()}`;
}
