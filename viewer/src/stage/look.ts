// Colours of the picture, in light and dark, from the style sheet; and the materials made of them.
import * as THREE from "three";

export interface Look {
  dark: boolean;
  sky: string;
  ground: string;
  grid: string;
  ink: string;
  paper: string;
  soft: string;
  accent: string;
  reaction: string;
  moment: string;
  applied: string;
  trace: string[];
}

export function readLook(): Look {
  const style = getComputedStyle(document.documentElement);
  const colour = (name: string) => style.getPropertyValue(`--${name}`).trim();
  return {
    dark: matchMedia("(prefers-color-scheme: dark)").matches,
    sky: colour("sky"),
    ground: colour("floor"),
    grid: colour("mesh-line"),
    ink: colour("ink"),
    paper: colour("card"),
    soft: colour("soft"),
    accent: colour("accent"),
    reaction: colour("reaction"),
    moment: colour("moment"),
    applied: colour("applied"),
    trace: [0, 1, 2, 3, 4, 5, 6, 7].map((k) => colour(`tone-${k}`)),
  };
}

/** Materials that all bodies share by colour; a ghost's let the machine shine through. */
export class Palette {
  private readonly solids = new Map<string, THREE.MeshPhongMaterial>();
  readonly edge: THREE.LineBasicMaterial;
  readonly sign: THREE.MeshLambertMaterial;
  readonly signDark: THREE.MeshLambertMaterial;
  readonly foot: THREE.MeshLambertMaterial;
  readonly wire: THREE.MeshLambertMaterial;

  constructor(
    private look: Look,
    private readonly ghost: boolean,
  ) {
    this.edge = new THREE.LineBasicMaterial({ transparent: true, opacity: ghost ? 0.35 : 0.5 });
    this.sign = new THREE.MeshLambertMaterial();
    this.signDark = new THREE.MeshLambertMaterial();
    this.foot = new THREE.MeshLambertMaterial();
    this.wire = new THREE.MeshLambertMaterial();
    if (ghost) for (const each of [this.sign, this.signDark, this.foot, this.wire]) Object.assign(each, { transparent: true, opacity: 0.3, depthWrite: false });
    this.recolour(look);
  }

  solid(colour: string): THREE.MeshPhongMaterial {
    let material = this.solids.get(colour);
    if (!material) {
      material = new THREE.MeshPhongMaterial({
        shininess: 28,
        specular: 0x222222,
        polygonOffset: true,
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 1,
        transparent: this.ghost,
        opacity: this.ghost ? 0.24 : 1,
        depthWrite: !this.ghost,
        side: THREE.DoubleSide,
      });
      this.solids.set(colour, material);
      this.paint(material, colour);
    }
    return material;
  }

  recolour(look: Look): void {
    this.look = look;
    this.edge.color.set(look.dark ? "#0b0f14" : "#1b2430");
    this.sign.color.set(look.dark ? "#dfe6ee" : "#ffffff");
    this.signDark.color.set(look.dark ? "#aab6c4" : "#39434f");
    this.foot.color.set(look.dark ? "#566272" : "#9aa5b2");
    this.wire.color.set(look.dark ? "#c2ccd8" : "#56616f");
    for (const [colour, material] of this.solids) this.paint(material, colour);
  }

  private paint(material: THREE.MeshPhongMaterial, colour: string): void {
    material.color.set(this.ghost ? this.look.soft : colour);
  }

  dispose(): void {
    for (const each of [...this.solids.values(), this.edge, this.sign, this.signDark, this.foot, this.wire]) each.dispose();
  }
}
