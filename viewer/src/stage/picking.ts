// A click, or a touch that does not move, chooses what is under it.
import * as THREE from "three";
import type { Actor, Picked } from "./actor";
import type { World } from "./world";

const STILL = 5; // pixels that a pointer may move between down and up

export function listenToPicks(world: World, actor: Actor, arrows: THREE.Object3D, choose: (picked: Picked | null) => void): void {
  const canvas = world.renderer.domElement;
  let down: { x: number; y: number } | null = null;
  canvas.addEventListener("pointerdown", (event) => (down = event.button === 0 && event.isPrimary ? { x: event.clientX, y: event.clientY } : null));
  canvas.addEventListener("pointerup", (event) => {
    if (down && event.isPrimary && Math.hypot(event.clientX - down.x, event.clientY - down.y) < STILL) choose(under(event));
    down = null;
  });
  const caster = new THREE.Raycaster();

  function under(event: PointerEvent): Picked | null {
    const box = canvas.getBoundingClientRect();
    const at = new THREE.Vector2((2 * (event.clientX - box.left)) / box.width - 1, 1 - (2 * (event.clientY - box.top)) / box.height);
    caster.setFromCamera(at, world.camera);
    const hits = caster.intersectObjects([actor.root, arrows], true);
    // a joint sign half inside a bar is meant where it is nearly as near
    const named = hits.flatMap((hit) => {
      const said = seen(hit.object) ? actor.said(hit) : null;
      return said ? [{ said, distance: hit.distance, size: sizeOf(said) }] : [];
    });
    const first = named[0];
    if (!first) return null;
    return (named.find(({ said, distance, size }) => said.kind !== "body" && distance < first.distance + 0.02 * size) ?? first).said;
  }

  function sizeOf(said: Picked): number {
    const joint = said.kind === "joint" && actor.stage.joints.find(({ name }) => name === said.name);
    return joint ? actor.nearness.joint(joint) : actor.stage.size;
  }
}

function seen(object: THREE.Object3D | null): boolean {
  for (let each = object; each; each = each.parent) if (!each.visible) return false;
  return true;
}
