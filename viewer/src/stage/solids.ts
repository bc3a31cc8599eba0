// Geometry of the parts of a body, in its frame.
import * as THREE from "three";
import type { Part } from "../generated/records";
import type { Arrays } from "../package";

const ROUND = 40; // facets of a round bar
const CREASE = 28; // degrees: edges sharper than this are drawn
const MOST_EDGED = 40_000; // triangles of a mesh whose edges are looked for

/** Turns the axis of three's round bars (y) to `along`. */
function alongAxis(geometry: THREE.BufferGeometry, along: string): THREE.BufferGeometry {
  if (along === "x") geometry.rotateZ(-Math.PI / 2);
  else if (along === "z") geometry.rotateX(Math.PI / 2);
  return geometry;
}

function tube(outer: number, inner: number, length: number, facets: number): THREE.BufferGeometry {
  const h = length / 2;
  const corners = [[inner, -h], [outer, -h], [outer, h], [inner, h], [inner, -h]] as const;
  const geometry = new THREE.LatheGeometry(corners.map(([r, y]) => new THREE.Vector2(r, y)), facets).toNonIndexed();
  geometry.computeVertexNormals();
  smoothRound(geometry);
  return geometry;
}

/** Normals of faces around the y axis point away from (or to) it, so that they look round. */
function smoothRound(geometry: THREE.BufferGeometry): void {
  const at = geometry.getAttribute("position");
  const normal = geometry.getAttribute("normal");
  for (let k = 0; k < at.count; k++) {
    if (Math.abs(normal.getY(k)) > 0.5) continue;
    const r = Math.hypot(at.getX(k), at.getZ(k)) || 1;
    const sign = Math.sign(normal.getX(k) * at.getX(k) + normal.getZ(k) * at.getZ(k)) || 1;
    normal.setXYZ(k, (sign * at.getX(k)) / r, 0, (sign * at.getZ(k)) / r);
  }
}

/** A prism along z from its outline in x and y, then turned so that z becomes `along` and x, y the two axes that follow. */
function prism(part: Part): THREE.BufferGeometry {
  const shape = new THREE.Shape(part.outline.map(([a, b]) => new THREE.Vector2(a, b)));
  const length = part.size[0] ?? 1;
  const geometry = new THREE.ExtrudeGeometry(shape, { depth: length, bevelEnabled: false, steps: 1 });
  geometry.translate(0, 0, -length / 2);
  const [x, y, z] = [new THREE.Vector3(1, 0, 0), new THREE.Vector3(0, 1, 0), new THREE.Vector3(0, 0, 1)];
  const basis = new THREE.Matrix4();
  if (part.along === "x") basis.makeBasis(y, z, x);
  else if (part.along === "y") basis.makeBasis(z, x, y);
  return geometry.applyMatrix4(basis);
}

export function triangleMesh(vertices: Float32Array, triangles: Uint32Array): THREE.BufferGeometry {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(vertices, 3));
  geometry.setIndex(new THREE.BufferAttribute(triangles, 1));
  return geometry;
}

/** Sharp edges stay sharp: triangles do not share vertices, normals are those of the triangles around a vertex that are nearly level. */
function creased(geometry: THREE.BufferGeometry): THREE.BufferGeometry {
  const flat = geometry.toNonIndexed();
  flat.computeVertexNormals();
  return flat;
}

/** facets : of round bars and spheres. */
export function partGeometry(part: Part, arrays: Arrays, facets = ROUND): THREE.BufferGeometry {
  const [a = 1, b = 1, c = 1] = part.size;
  let geometry: THREE.BufferGeometry;
  switch (part.kind) {
    case "box":
      geometry = new THREE.BoxGeometry(a, b, c);
      break;
    case "cylinder":
      geometry = alongAxis(new THREE.CylinderGeometry(a, a, b, facets), part.along);
      break;
    case "capsule":
      geometry = alongAxis(new THREE.CapsuleGeometry(a, b, Math.ceil(0.3 * facets), facets), part.along);
      break;
    case "tube":
      geometry = alongAxis(tube(a, b, c, facets), part.along);
      break;
    case "sphere":
      geometry = new THREE.SphereGeometry(a, facets, facets / 2);
      break;
    case "ellipsoid":
      geometry = new THREE.SphereGeometry(1, facets, facets / 2).scale(a, b, c);
      break;
    case "extrusion":
      geometry = prism(part);
      break;
    case "mesh":
      if (!part.vertices || !part.triangles) throw new Error("a mesh without vertices");
      geometry = creased(triangleMesh(arrays.floats(part.vertices), arrays.indices(part.triangles)));
  }
  return geometry.translate(...part.centre);
}

/** The edges that a drawing would show, or null where there are none, or too many to look for. */
export function edgesOf(part: Part, geometry: THREE.BufferGeometry): THREE.BufferGeometry | null {
  if (part.kind === "sphere" || part.kind === "ellipsoid" || part.kind === "capsule") return null;
  const triangles = (geometry.index?.count ?? geometry.getAttribute("position").count) / 3;
  return triangles > MOST_EDGED ? null : new THREE.EdgesGeometry(geometry, CREASE);
}

const Y = new THREE.Vector3(0, 1, 0);

/** A round bar between two points, open at its ends. */
export function bar(from: THREE.Vector3, to: THREE.Vector3, radius: number, facets: number): THREE.BufferGeometry {
  const length = from.distanceTo(to);
  const geometry = new THREE.CylinderGeometry(radius, radius, length || 1e-9, facets, 1, true);
  const turn = new THREE.Quaternion().setFromUnitVectors(Y, to.clone().sub(from).normalize());
  const middle = from.clone().add(to).multiplyScalar(0.5);
  return geometry.applyMatrix4(new THREE.Matrix4().compose(middle, turn, new THREE.Vector3(1, 1, 1)));
}

/** A ball about a point. */
export function ball(at: THREE.Vector3, radius: number, facets: number): THREE.BufferGeometry {
  return new THREE.SphereGeometry(radius, facets, Math.round(0.7 * facets)).translate(at.x, at.y, at.z);
}
