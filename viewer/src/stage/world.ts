// Renderer, light, floor and camera. A picture is drawn only when something changed.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Stage } from "../generated/records";
import { Flight } from "./flight";
import { Floor } from "./floor";
import { readLook, type Look } from "./look";
import { corners, framed, sideOf, vector, type View } from "./views";

const FIELD = 26; // degrees, of the shorter side of the picture
const SLOW = 30; // ms a frame: slower than this is not smooth
const PACED = 12; // frames that the pace is taken of
const LEAST = 3; // quality: nothing more can be left out
const REST = 300; // ms after which a picture at rest is drawn in full

export class World {
  readonly scene = new THREE.Scene();
  readonly renderer: THREE.WebGLRenderer;
  readonly camera = new THREE.PerspectiveCamera(FIELD, 1, 0.01, 1000);
  readonly controls: OrbitControls;
  readonly floor: Floor;
  look: Look = readLook();
  onBeforeRender: (now: number) => void = () => {};
  onEdges: (on: boolean) => void = () => {};
  onRecolour: (look: Look) => void = () => {};
  around: (() => THREE.Vector3[]) | null = null; // points around a machine that is moved by hand, as it stands now
  now: (() => THREE.Vector3[]) | null = null; // points around the machine as it stands now
  frameCount = 0;
  private readonly sun = new THREE.DirectionalLight(0xffffff, 2.1);
  private readonly sky = new THREE.HemisphereLight(0xffffff, 0x8893a0, 1.55);
  private readonly low: THREE.Vector3;
  private readonly high: THREE.Vector3;
  private readonly up: THREE.Vector3;
  private cloud: THREE.Vector3[];
  private free = { left: 0, top: 0, right: 0, bottom: 0 };
  private dirty = true;
  private finest: number; // pixels of the picture for one of the page
  private ratio: number;
  private shadows = true; // as the user wants
  private fitted = true; // everything is in sight, and stays so when the room changes
  private level = 0;
  private learnt = 0; // the quality at which motion is smooth
  private last = 0;
  private readonly paces: number[] = [];
  private flight: Flight | null = null;
  running = false; // frames follow each other, as long as this is set

  constructor(
    readonly holder: HTMLElement,
    private readonly stage: Stage,
  ) {
    const slow = drawsWithProcessor();
    document.body.classList.toggle("plain", slow);
    this.renderer = new THREE.WebGLRenderer({ antialias: !slow, powerPreference: "high-performance" });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = slow ? THREE.BasicShadowMap : THREE.PCFShadowMap;
    this.renderer.toneMapping = THREE.NoToneMapping;
    this.finest = slow ? 1 : Math.min(devicePixelRatio, 2);
    this.ratio = this.finest;
    const canvas = this.renderer.domElement;
    canvas.setAttribute("aria-label", `${stage.name} in three dimensions: drag to turn, two fingers or right button to move, wheel to zoom`);
    canvas.setAttribute("role", "img");
    canvas.tabIndex = 0;
    holder.append(canvas);
    this.up = vector(stage.up);
    this.low = vector(stage.low);
    this.high = vector(stage.high);
    this.cloud = corners(new THREE.Box3(this.low, this.high));
    this.camera.up.copy(this.up);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.invalidate());
    this.controls.addEventListener("start", () => {
      this.flight = null;
      this.fitted = false;
    });
    this.floor = new Floor(stage, this.look);
    this.floor.group.visible = !stage.surroundings.length && !stage.terrains.length; // they are the ground
    this.scene.add(this.floor.group, this.sky, this.sun, this.sun.target);
    this.light();
    this.recolour();
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.recolour());
    new ResizeObserver(() => {
      this.resize();
      if (this.fitted) this.fit(false);
    }).observe(holder);
    this.resize();
    this.view("first", false);
    requestAnimationFrame((now) => this.tick(now));
  }

  invalidate(): void {
    this.dirty = true;
  }

  /** Pixels at the sides that panels cover: the machine is shown in the middle of the rest. */
  keepFree(sides: { left: number; top: number; right: number; bottom: number }): void {
    this.free = sides;
    this.resize();
    if (this.fitted) this.fit(false);
  }

  setShadows(on: boolean): void {
    this.shadows = on;
    this.sun.castShadow = on && this.level < 1;
    this.floor.setShadows(this.sun.castShadow);
    this.invalidate();
  }

  /** Smooth edges and soft shadows whatever they cost: for pictures that are kept. */
  drawFinely(): void {
    document.body.classList.remove("plain");
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.finest = this.ratio = 2;
    this.scene.traverse((each) => {
      if (each instanceof THREE.Mesh) for (const material of [each.material].flat()) material.needsUpdate = true;
    });
    this.resize();
  }

  /** Look from one of the standard sides, far enough to see everything. */
  view(name: View, animate = true): void {
    const { towards, up } = sideOf(name, this.stage.viewpoint, this.up);
    this.fitted = true;
    if (this.around) this.see(this.around());
    this.flyTo(towards, up, animate);
  }

  fit(animate = true): void {
    this.fitted = true;
    if (this.around) this.see(this.around());
    const towards = this.camera.position.clone().sub(this.controls.target).normalize();
    this.flyTo(towards, this.up, animate);
  }

  /** What stands there at this moment is in sight, as large as it can be; the standard views have the whole motion in sight. */
  fitNow(): void {
    if (this.around || !this.now) return this.fit();
    const whole = this.cloud;
    this.see(this.now());
    this.fit();
    this.cloud = whole;
    this.fitted = false;
  }

  /** Everything is in sight, as long as nobody looks closer. */
  get isFitted(): boolean {
    return this.fitted;
  }

  /** Whether all points are in the picture, or will be when the camera has arrived. */
  holds(points: THREE.Vector3[]): boolean {
    if (this.flight) return true;
    this.camera.updateMatrixWorld();
    return points.every((point) => {
      const { x, y, z } = point.clone().project(this.camera);
      return Math.abs(x) <= 1 && Math.abs(y) <= 1 && Math.abs(z) <= 1;
    });
  }

  /** Turn the camera about its target by angles in radians. */
  orbit(sideways: number, upwards: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    offset.applyAxisAngle(this.up, sideways);
    const right = new THREE.Vector3().crossVectors(this.up, offset).normalize();
    const lifted = offset.clone().applyAxisAngle(right, -upwards);
    if (Math.abs(lifted.clone().normalize().dot(this.up)) < 0.995) offset.copy(lifted);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.invalidate();
  }

  zoom(factor: number): void {
    this.fitted = false;
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.controls.update();
    this.invalidate();
  }

  /** Move camera and target together. */
  shift(by: THREE.Vector3): void {
    this.fitted = false;
    this.camera.position.add(by);
    this.controls.target.add(by);
    this.flight?.shift(by);
    this.controls.update();
    if (!this.around) return;
    // what is moved by hand or drives has left what was seen at first
    for (const point of this.cloud) point.add(by);
    this.floor.under(this.controls.target);
    this.light();
  }

  private tick(now: number): void {
    requestAnimationFrame((next) => this.tick(next));
    if (this.flight) this.fly(now);
    this.onBeforeRender(now);
    if (this.running) this.draw(this.learnt);
    else if (this.level && now - this.last > REST) this.draw(0);
    if (!this.dirty) return;
    this.dirty = false;
    this.near();
    this.renderer.render(this.scene, this.camera);
    this.frameCount++;
    this.pace(now);
  }

  /** Where pictures come too slowly while the machine moves, less is drawn: first no shadows, then no edges, then fewer pixels. */
  private pace(now: number): void {
    const took = now - this.last;
    this.last = now;
    if (!this.running || took > 500) return;
    this.paces.push(took);
    if (this.paces.length < PACED) return;
    const middle = this.paces.sort((a, b) => a - b)[PACED >> 1]!;
    this.paces.length = 0;
    if (middle > SLOW && this.learnt < LEAST) this.draw(++this.learnt);
  }

  /** Draw with a quality: 0 is everything, LEAST the least. */
  private draw(level: number): void {
    if (level === this.level) return;
    this.level = level;
    this.sun.castShadow = this.shadows && level < 1;
    this.floor.setShadows(this.sun.castShadow);
    this.onEdges(level < 2);
    this.ratio = level < 3 ? this.finest : 0.6 * this.finest;
    this.resize();
  }

  /** Points around everything that is to be seen, during the whole motion. */
  see(points: THREE.Vector3[]): void {
    if (points.length) this.cloud = points;
  }

  private middle(): THREE.Vector3 {
    return new THREE.Box3().setFromPoints(this.cloud).getCenter(new THREE.Vector3());
  }

  /** Where the eye looks, and from how far, to have everything in sight. */
  private framed(towards: THREE.Vector3, up: THREE.Vector3): { aim: THREE.Vector3; distance: number } {
    const { width, height } = this.size();
    const room = { height, across: width - this.free.left - this.free.right, down: height - this.free.top - this.free.bottom };
    return framed(this.cloud, towards, up, room, this.camera.fov, this.stage.size);
  }

  private flyTo(towards: THREE.Vector3, up: THREE.Vector3, animate: boolean): void {
    const { aim, distance } = this.framed(towards, up);
    const offset = towards.clone().normalize();
    // the controls know no direction exactly along the vertical
    if (Math.abs(offset.dot(this.up)) > 0.9999) offset.addScaledVector(up, -1e-3 * Math.sign(offset.dot(this.up))).normalize();
    const to = aim.clone().addScaledVector(offset, distance);
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (!animate || still) {
      this.flight = null;
      this.camera.position.copy(to);
      this.controls.target.copy(aim);
      this.controls.update();
      this.invalidate();
      return;
    }
    this.flight = new Flight(this.camera.position.clone(), this.controls.target.clone(), to, aim.clone());
  }

  private fly(now: number): void {
    if (this.flight!.bring(this.camera.position, this.controls.target, now)) this.flight = null;
    this.controls.update();
    this.invalidate();
  }

  /** Near and far planes around what is there, so that depth keeps its digits. */
  private near(): void {
    const distance = this.camera.position.distanceTo(this.middle());
    const reach = 0.5 * this.low.distanceTo(this.high) + 12 * this.stage.size;
    // whoever looks at one link of a long chain is nearer to it than the chain is long
    const close = this.camera.position.distanceTo(this.controls.target);
    this.camera.near = Math.max(distance - reach, 0.02 * Math.min(close, 0.2 * this.stage.size));
    this.camera.far = distance + 4 * reach;
    this.camera.updateProjectionMatrix();
  }

  private light(): void {
    const middle = this.middle();
    const reach = Math.max(0.75 * this.low.distanceTo(this.high), 0.75 * this.stage.size);
    const { towards } = sideOf("first", this.stage.viewpoint, this.up);
    const right = new THREE.Vector3().crossVectors(this.up, towards);
    const from = this.up.clone().multiplyScalar(1.5).addScaledVector(towards, 0.5).addScaledVector(right, -0.55).normalize();
    this.sun.position.copy(middle).addScaledVector(from, 3 * reach);
    this.sun.target.position.copy(middle);
    this.sun.castShadow = this.shadows && this.level < 1;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.radius = 3;
    this.sun.shadow.normalBias = 0.004 * this.stage.size;
    const frustum = this.sun.shadow.camera;
    frustum.left = frustum.bottom = -1.25 * reach;
    frustum.right = frustum.top = 1.25 * reach;
    frustum.near = 0.5 * reach;
    frustum.far = 8 * reach;
    this.sky.position.copy(this.up);
  }

  private recolour(): void {
    this.look = readLook();
    this.scene.background = new THREE.Color(this.look.sky);
    this.sky.intensity = this.look.dark ? 1.75 : 1.7;
    this.sun.intensity = this.look.dark ? 2.2 : 1.9;
    this.floor.recolour(this.look);
    this.onRecolour(this.look);
    this.invalidate();
  }

  private size(): { width: number; height: number } {
    return { width: Math.max(this.holder.clientWidth, 1), height: Math.max(this.holder.clientHeight, 1) };
  }

  private resize(): void {
    const { width, height } = this.size();
    this.renderer.setPixelRatio(this.ratio);
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    const { left, top, right, bottom } = this.free;
    this.camera.setViewOffset(width, height, (right - left) / 2, (bottom - top) / 2, width, height);
    this.camera.updateProjectionMatrix();
    this.invalidate();
  }
}

/** Whether there is no graphics hardware: then edges are not smoothed, which costs several times the rest. */
function drawsWithProcessor(): boolean {
  const probe = document.createElement("canvas").getContext("webgl2");
  const info = probe?.getExtension("WEBGL_debug_renderer_info");
  const name = probe && info ? String(probe.getParameter(info.UNMASKED_RENDERER_WEBGL)) : "";
  probe?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}
