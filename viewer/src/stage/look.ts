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

/** What is drawn in one colour that light and dark decide: signs, feet on the ground, wires. */
export const TONES = ["sign", "signDark", "foot", "wire"] as const;
export type Tone = (typeof TONES)[number];

/** Materials that all bodies share; a ghost's let the machine shine through. */
export class Palette {
  readonly body: THREE.MeshPhongMaterial; // takes the colours of the pieces
  private readonly own: THREE.MeshPhongMaterial[] = [];
  readonly edge: THREE.LineBasicMaterial;
  readonly sign: THREE.MeshLambertMaterial;
  readonly signDark: THREE.MeshLambertMaterial;
  readonly foot: THREE.MeshLambertMaterial;
  readonly wire: THREE.MeshLambertMaterial;

  constructor(
    look: Look,
    private readonly ghost: boolean,
  ) {
    this.body = new THREE.MeshPhongMaterial({
      shininess: 28,
      specular: 0x222222,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
      transparent: ghost,
      opacity: ghost ? 0.24 : 1,
      depthWrite: !ghost,
      side: THREE.DoubleSide,
    });
    this.edge = new THREE.LineBasicMaterial({ transparent: true, opacity: ghost ? 0.35 : 0.5 });
    this.sign = new THREE.MeshLambertMaterial();
    this.signDark = new THREE.MeshLambertMaterial();
    this.foot = new THREE.MeshLambertMaterial();
    this.wire = new THREE.MeshLambertMaterial();
    if (ghost) for (const each of [this.sign, this.signDark, this.foot, this.wire]) Object.assign(each, { transparent: true, opacity: 0.3, depthWrite: false });
    this.recolour(look);
  }

  /** As of bodies, for something that is one piece. */
  bodyOf(colour: string): THREE.MeshPhongMaterial {
    const material = this.body.clone();
    if (!this.ghost) material.color.set(colour);
    this.own.push(material);
    return material;
  }

  recolour(look: Look): void {
    this.edge.color.set(look.dark ? "#0b0f14" : "#1b2430");
    this.sign.color.set(look.dark ? "#dfe6ee" : "#ffffff");
    this.signDark.color.set(look.dark ? "#aab6c4" : "#39434f");
    this.foot.color.set(look.dark ? "#566272" : "#9aa5b2");
    this.wire.color.set(look.dark ? "#c2ccd8" : "#56616f");
    if (this.ghost) for (const each of [this.body, ...this.own]) each.color.set(look.soft);
  }
}
