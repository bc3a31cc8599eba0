// A body picked up with the mouse: while it is held, the point of it under the pointer is pulled to where the pointer is.
import * as THREE from "three";
import type { Hold } from "../generated/records";
import type { Actor } from "./actor";
import type { World } from "./world";

const EVERY = 20; // ms between two messages
const DOT = 0.008; // radius, of the machine's size

interface Held {
  body: number;
  point: THREE.Vector3; // in the frame of the body
  towards: THREE.Vector3; // in space
  plane: THREE.Plane; // in which the pointer moves
}

export class Hand {
  /** Whether a drag picks up without the shift key. */
  isOut = false;
  readonly object = new THREE.Group();
  private held: Held | null = null;
  private readonly caster = new THREE.Raycaster();
  private readonly line = new THREE.Line(new THREE.BufferGeometry().setFromPoints([new THREE.Vector3(), new THREE.Vector3()]), new THREE.LineBasicMaterial({ color: 0xe0483a, depthTest: false }));
  private readonly dot: THREE.Mesh;

  constructor(
    private readonly world: World,
    private readonly actor: Actor,
    private readonly send: (message: Hold) => void,
  ) {
    this.dot = new THREE.Mesh(new THREE.SphereGeometry(DOT * actor.stage.size, 16, 12), new THREE.MeshBasicMaterial({ color: 0xe0483a, depthTest: false }));
    this.line.frustumCulled = false;
    for (const each of [this.line, this.dot]) {
      each.renderOrder = 10;
      each.raycast = () => {};
    }
    this.object.add(this.line, this.dot);
    this.object.visible = false;
    const canvas = world.renderer.domElement;
    // before the controls of the camera hear of it
    world.holder.addEventListener("pointerdown", (event) => this.pick(event), true);
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"]) addEventListener(end, () => this.letGo());
    addEventListener("blur", () => this.letGo());
    setInterval(() => this.held && this.say(1), EVERY);
  }

  /** Show the spring. */
  update(): void {
    if (!this.held) return;
    const from = this.actor.place(this.held.body, this.held.point.toArray(), new THREE.Vector3());
    this.line.geometry.setFromPoints([from, this.held.towards]);
    this.dot.position.copy(this.held.towards);
  }

  private pick(event: PointerEvent): void {
    if (event.button !== 0 || !event.isPrimary || !(this.isOut || event.shiftKey) || event.target !== this.world.renderer.domElement) return;
    this.aim(event);
    const hit = this.caster.intersectObject(this.actor.root, true).find((each) => this.actor.said(each)?.kind === "body");
    if (!hit) return;
    const name = this.actor.said(hit)!.name;
    const body = this.actor.stage.bodies.findIndex((each) => each.name === name);
    const at = this.actor.root.worldToLocal(hit.point.clone());
    const group = this.actor.holder(body);
    const point = at.clone().sub(group.position).applyQuaternion(group.quaternion.clone().invert());
    const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(this.world.camera.getWorldDirection(new THREE.Vector3()), hit.point);
    this.held = { body, point, towards: at, plane };
    this.world.controls.enabled = false;
    this.object.visible = true;
    event.preventDefault();
    this.say(1);
  }

  private move(event: PointerEvent): void {
    if (!this.held || !event.isPrimary) return;
    this.aim(event);
    const at = this.caster.ray.intersectPlane(this.held.plane, new THREE.Vector3());
    if (at) this.held.towards = this.actor.root.worldToLocal(at);
    this.world.invalidate();
  }

  private letGo(): void {
    if (!this.held) return;
    this.say(0);
    this.held = null;
    this.object.visible = false;
    this.world.controls.enabled = true;
    this.world.invalidate();
  }

  private say(on: number): void {
    const { body, point, towards } = this.held!;
    this.send({ type: "hold", body, point: point.toArray(), towards: towards.toArray(), on });
    this.update();
  }

  private aim(event: PointerEvent): void {
    const box = this.world.renderer.domElement.getBoundingClientRect();
    const at = new THREE.Vector2((2 * (event.clientX - box.left)) / box.width - 1, 1 - (2 * (event.clientY - box.top)) / box.height);
    this.caster.setFromCamera(at, this.world.camera);
  }
}
