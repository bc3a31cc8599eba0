// What stands around a machine: solids on the ground, of which the machine knows nothing. They are not chosen and do not move.
import * as THREE from "three";
import type { Stage } from "../generated/records";
import type { Arrays } from "../package";
import { edgesOf, partGeometry } from "./solids";

const PLAIN = "#858e98"; // colour of a solid without one

export function surroundings(stage: Stage, arrays: Arrays): THREE.Group {
  const group = new THREE.Group();
  group.position.set(...stage.origin).negate();
  const line = new THREE.LineBasicMaterial({ color: "#1b2430", transparent: true, opacity: 0.35 });
  const paints = new Map<string, THREE.MeshLambertMaterial>();
  for (const part of stage.surroundings) {
    const colour = part.colour || PLAIN;
    const paint = paints.get(colour) ?? new THREE.MeshLambertMaterial({ color: colour, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
    paints.set(colour, paint);
    const geometry = partGeometry(part, arrays);
    const mesh = new THREE.Mesh(geometry, paint);
    mesh.castShadow = mesh.receiveShadow = true;
    group.add(mesh);
    const edges = edgesOf(part, geometry);
    if (edges) group.add(new THREE.LineSegments(edges, line));
  }
  return group;
}
