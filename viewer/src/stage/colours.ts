// What the colours of beams and flexible bodies show: which quantity, between which ends, in which unit.
import type { Actor } from "./actor";
import type { Deforming } from "./deforming";

export const STRESS = "von Mises stress";

/** A quantity in colours. now : the largest at this moment, where that is known. */
export interface Scale {
  quantity: string;
  unit: string;
  low: number;
  high: number;
  now: number | null;
}

export class Colours {
  constructor(private readonly actor: Actor) {
    this.spread();
  }

  /** Quantities that beams can show; none where there are none, or nothing is known of them. */
  get ofBeams(): string[] {
    return this.actor.sections.quantities.map((each) => each.name);
  }

  /** And flexible bodies; none where there is nothing to choose. */
  get ofBodies(): string[] {
    const { deforming } = this.actor;
    return deforming.some((each) => each.stressed) ? [deforming[0]!.record.quantity, STRESS] : [];
  }

  get all(): string[] {
    return [...this.ofBeams, ...this.ofBodies];
  }

  /** Colour beams by a quantity; by none where its name is empty. */
  beams(name: string): void {
    this.actor.sections.show(name);
  }

  /** Colour flexible bodies by their stress, or by what they show without it. */
  bodies(name: string): void {
    for (const each of this.actor.deforming) each.showsStress = name === STRESS && each.stressed !== null;
    this.spread();
  }

  /** What is in the picture now. */
  scales(): Scale[] {
    const { shown } = this.actor.sections;
    const out: Scale[] = [];
    if (shown) out.push({ quantity: shown.name, unit: shown.unit, low: shown.low, high: shown.high, now: null });
    for (const group of this.groups()) {
      const [first] = group;
      const { quantity, unit, low, high } = first!.scale;
      const now = first!.showsStress ? Math.max(...group.map((each) => each.peakValue)) : null;
      out.push({ quantity, unit, low, high, now });
    }
    return out;
  }

  /** Bodies that show the same have the same ends; of a motion that goes on these follow what was seen. */
  spread(): void {
    for (const group of this.groups()) {
      const low = Math.min(...group.map((each) => each.ownScale.low));
      const high = Math.max(...group.map((each) => each.ownScale.high));
      for (const each of group) each.scale = { ...each.ownScale, low, high };
    }
  }

  private groups(): Deforming[][] {
    const out = new Map<string, Deforming[]>();
    for (const each of this.actor.deforming) {
      const { quantity, unit } = each.ownScale;
      const key = `${quantity} ${unit}`;
      out.set(key, [...(out.get(key) ?? []), each]);
    }
    return [...out.values()];
  }
}
