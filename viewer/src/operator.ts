// What an operator wants of every control: from keys held down, sticks on the page, a gamepad, sliders. Sent again and again.
import type { Control } from "./generated/records";

const EVERY = 20; // ms between two messages
const PAD_ASKS = 1000; // ms between two questions of a gamepad whether it may operate
const KEY_TIME = 1.5; // s in which a key moves a control that holds its place from end to end

export class Operator {
  /** Wanted values, in the order of the controls. */
  readonly values: number[];
  driving = false;
  onValues: () => void = () => {};
  private readonly held = new Set<string>();
  private readonly hand: (number | null)[]; // of sliders and buttons, while they are held
  private readonly sticks = new Map<string, number>(); // deflection from -1 to 1
  private readonly keys: Set<string>;
  private last = performance.now();
  private asked = -PAD_ASKS;

  constructor(
    private readonly controls: Control[],
    private readonly send: (values: number[]) => void,
    private readonly take: () => void,
  ) {
    this.values = controls.map((each) => each.rest);
    this.hand = controls.map(() => null);
    this.keys = new Set(controls.flatMap((each) => [each.raises, each.lowers]).filter(Boolean));
    addEventListener("keydown", (event) => this.press(event), true);
    addEventListener("keyup", (event) => this.held.delete(named(event.key)) && this.refresh(), true);
    addEventListener("blur", () => this.letGo());
    document.addEventListener("visibilitychange", () => document.hidden && this.letGo());
    setInterval(() => this.refresh(), EVERY);
  }

  /** A slider or button moved by hand, or let go of (null). */
  move(k: number, value: number | null): void {
    this.begin();
    if (value === null && this.controls[k]!.hold) return;
    this.hand[k] = value;
  }

  deflect(stick: string, value: number): void {
    if (value) this.begin();
    this.sticks.set(stick, value);
  }

  /** Somebody else operates, or nobody: controls that stay where they are left are taken over where they are. */
  follow(values: Float32Array): void {
    this.controls.forEach((each, k) => {
      if (each.hold) this.hand[k] = this.values[k] = values[k] ?? each.rest;
    });
  }

  /** All controls back to rest. */
  rest(): void {
    this.letGo();
    this.controls.forEach((each, k) => {
      this.hand[k] = null;
      this.values[k] = each.rest;
    });
  }

  private letGo(): void {
    this.held.clear();
    this.sticks.clear();
    this.controls.forEach((each, k) => each.hold || (this.hand[k] = null));
  }

  private begin(): void {
    if (!this.driving) this.take();
  }

  /** A gamepad that is deflected for long asks now and then: another page may operate, or its stick may not rest in the middle. */
  private askWithPad(): void {
    const now = performance.now();
    if (now - this.asked < PAD_ASKS) return;
    this.asked = now;
    this.take();
  }

  private press(event: KeyboardEvent): void {
    const key = named(event.key);
    if (event.ctrlKey || event.metaKey || event.altKey || !this.keys.has(key) || isText(event.target)) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    if (this.held.has(key)) return;
    this.begin();
    this.held.add(key);
    this.refresh(); // at once, and then every EVERY
  }

  private refresh(): void {
    const now = performance.now();
    const passed = Math.min(now - this.last, 100) / 1000;
    this.last = now;
    const pad = [...(navigator.getGamepads?.() ?? [])].find((each) => each?.connected) ?? null;
    this.controls.forEach((each, k) => (this.values[k] = this.wanted(each, k, pad, passed)));
    if (this.driving) this.send(this.values);
    this.onValues();
  }

  private wanted(control: Control, k: number, pad: Gamepad | null, passed: number): number {
    const { low, high, rest, hold } = control;
    const keys = Number(this.held.has(control.raises)) - Number(this.held.has(control.lowers));
    const deflection = keys || this.sticks.get(control.stick) || ofPad(control, pad);
    if (!keys && deflection && pad && !this.driving) this.askWithPad();
    if (hold) {
      const before = this.hand[k] ?? this.values[k]!;
      const after = Math.min(Math.max(before + (deflection * passed * (high - low)) / KEY_TIME, low), high);
      this.hand[k] = after;
      return after;
    }
    if (deflection) return deflection > 0 ? rest + deflection * (high - rest) : rest + deflection * (rest - low);
    return this.hand[k] ?? rest;
  }
}

/** Deflection of a gamepad from -1 to 1, without its dead zone, along its curve. */
export function ofPad(control: Control, pad: Gamepad | null): number {
  if (!pad) return 0;
  const raw = control.axis >= 0 ? (pad.axes[control.axis] ?? 0) : control.button >= 0 ? (pad.buttons[control.button]?.value ?? 0) : 0;
  const beyond = (Math.abs(raw) - control.dead_zone) / (1 - control.dead_zone);
  const size = beyond > 0 ? Math.min(beyond, 1) ** control.exponent : 0;
  return (control.reverse ? -1 : 1) * Math.sign(raw) * size;
}

function named(key: string): string {
  return key.length === 1 ? key.toLowerCase() : key;
}

function isText(target: EventTarget | null): boolean {
  return target instanceof HTMLInputElement && (target.type === "search" || target.type === "text");
}
