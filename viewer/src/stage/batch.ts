// Many small solids drawn in one go. Each is a piece that goes along with a holder: the group of a body, or a part of what stretches.
// A machine of 300 links has some thousand of them; drawn one by one they would take longer than a frame.
import * as THREE from "three";
import type { Picked } from "./actor";
import type { Tone } from "./look";

export interface Piece {
  geometry: THREE.BufferGeometry;
  coarse?: THREE.BufferGeometry; // for a body far away
  thin?: boolean; // left out where the body is so far away that nothing is seen of it
  body: number; // -1 the ground
  holder: THREE.Object3D; // stands in the actor's root, or in `parent`, which does
  parent?: THREE.Object3D;
  said: Picked;
  colour?: string;
}

/** How much is seen of a body: everything, coarse solids, or only lines in place of thin ones; HIDDEN: it is out of sight. */
export const FINE = 0;
export const COARSE = 1;
export const LINES = 2;
export const HIDDEN = 3;

export const noPieces = (): Record<Tone, Piece[]> => ({ sign: [], signDark: [], foot: [], wire: [] });

export class Batch {
  readonly mesh: THREE.BatchedMesh;
  private readonly matrix = new THREE.Matrix4();
  private readonly fine: number[] = []; // geometries by piece
  private readonly coarse: number[] = [];

  constructor(
    private readonly pieces: readonly Piece[],
    material: THREE.Material,
  ) {
    const own = pieces.map(({ geometry }) => plain(geometry));
    const far = pieces.map(({ coarse }) => (coarse ? plain(coarse) : null));
    const geometries = [...own, ...far.filter((each) => each !== null)];
    const vertices = geometries.reduce((count, each) => count + each.getAttribute("position").count, 0);
    const indices = geometries.reduce((count, each) => count + each.index!.count, 0);
    this.mesh = new THREE.BatchedMesh(pieces.length, vertices, indices, material);
    // all are nearly always in sight, and sorting them costs more than it saves
    this.mesh.frustumCulled = this.mesh.perObjectFrustumCulled = this.mesh.sortObjects = false;
    this.mesh.castShadow = !material.transparent;
    const colour = new THREE.Color();
    own.forEach((geometry, k) => {
      this.fine.push(this.mesh.addGeometry(geometry));
      const coarse = far[k];
      this.coarse.push(coarse ? this.mesh.addGeometry(coarse) : this.fine[k]!);
      const id = this.mesh.addInstance(this.fine[k]!);
      const tone = pieces[k]!.colour;
      if (tone) this.mesh.setColorAt(id, colour.set(tone));
    });
  }

  /** Bring all pieces to their holders. levels : how much is seen of each body. */
  update(levels: Uint8Array): void {
    this.pieces.forEach(({ holder, parent, body, thin }, k) => {
      const level = levels[body] ?? FINE;
      const seen = holder.visible && (parent?.visible ?? true) && level < (thin ? LINES : HIDDEN);
      this.mesh.setVisibleAt(k, seen);
      if (!seen) return;
      this.mesh.setGeometryIdAt(k, level === FINE ? this.fine[k]! : this.coarse[k]!);
      holder.updateMatrix();
      if (parent) parent.updateMatrix();
      this.mesh.setMatrixAt(k, parent ? this.matrix.multiplyMatrices(parent.matrix, holder.matrix) : holder.matrix);
    });
  }

  /** What the piece with this number belongs to. */
  said(piece: number): Picked | null {
    return this.pieces[piece]?.said ?? null;
  }
}

/** With positions, normals and indices, and nothing else: all geometries of a batch are alike. */
export function plain(geometry: THREE.BufferGeometry): THREE.BufferGeometry {
  const out = new THREE.BufferGeometry();
  const position = geometry.getAttribute("position");
  out.setAttribute("position", position);
  out.setAttribute("normal", geometry.getAttribute("normal"));
  out.setIndex(geometry.index ?? new THREE.BufferAttribute(Uint32Array.from({ length: position.count }, (_, k) => k), 1));
  return out;
}
