// A number that changes, and its last seconds as a curve over its scale.
import type { Gauge } from "../generated/records";
import { el, measured } from "./dom";

const SPAN = 15; // s that are shown
const NOISE = 1e-6; // share of the largest number, and a number, below which a change is round-off
const WIDTH = 284;
const HEIGHT = 40;
const ROOM = 4; // pixels above and below the curve

export class Strip {
  readonly element: HTMLElement;
  readonly times: number[] = [];
  readonly numbers: number[] = [];
  private value = NaN; // as it is now
  private readonly output = el("output", {});
  private readonly canvas = el("canvas", { width: 2 * WIDTH, height: 2 * HEIGHT, "aria-hidden": "true" });

  constructor(private readonly gauge: Gauge) {
    const scale = scaleInWords(gauge);
    this.element = el("li", { class: "strip", title: gauge.name }, el("span", { class: "name" }, gauge.label), this.output, this.canvas, scale ? el("small", { class: "scale" }, scale) : null);
  }

  /** The number of the frame that is shown. */
  show(value: number): void {
    this.value = value;
  }

  /** A point of the curve; one of an earlier moment begins it anew. */
  add(time: number, value: number): void {
    const last = this.times.at(-1);
    if (last !== undefined && time < last) this.times.length = this.numbers.length = 0;
    this.times.push(time);
    this.numbers.push(Math.abs(value) < 1e-3 * NOISE ? 0 : value);
    while (this.times[0]! < time - SPAN) {
      this.times.shift();
      this.numbers.shift();
    }
  }

  draw(): void {
    const { low, high, limit } = this.gauge;
    const largest = Math.max(...this.numbers.map(Math.abs), Math.abs(low ?? 0), Math.abs(high ?? 0), 1e-3);
    const { texts, unit: shown } = inWords(this.gauge, [this.value], largest);
    this.output.textContent = withUnit(texts[0]!, shown);
    this.element.classList.toggle("beyond", limit !== null && Math.abs(this.value) > limit);
    const context = this.canvas.getContext("2d");
    const end = this.times.at(-1);
    if (!context || end === undefined) return;
    const { width, height } = this.canvas;
    const least = Math.min(...this.numbers, low ?? Infinity);
    const most = Math.max(...this.numbers, high ?? -Infinity);
    const span = Math.max(most - least, NOISE * Math.max(Math.abs(least), Math.abs(most), 1));
    const up = (number: number) => height - ROOM - ((number - least) / span) * (height - 2 * ROOM);
    const style = getComputedStyle(this.element);
    context.clearRect(0, 0, width, height);
    if (limit !== null) {
      context.strokeStyle = style.getPropertyValue("--limit");
      context.lineWidth = 2;
      context.setLineDash([8, 6]);
      for (const at of [limit, -limit].filter((each) => each <= most && each >= least)) {
        context.beginPath();
        context.moveTo(0, up(at));
        context.lineTo(width, up(at));
        context.stroke();
      }
      context.setLineDash([]);
    }
    context.strokeStyle = style.getPropertyValue("--accent");
    context.lineWidth = 2.5;
    context.beginPath();
    this.numbers.forEach((number, k) => {
      const x = width * (1 - (end - this.times[k]!) / SPAN);
      if (k) context.lineTo(x, up(number));
      else context.moveTo(x, up(number));
    });
    context.stroke();
  }
}

/** `0 … 250 bar, limit 230 bar`. */
function scaleInWords(gauge: Gauge): string {
  const { low, high, limit } = gauge;
  const words: string[] = [];
  if (low !== null && high !== null) {
    const { texts, unit: shown } = inWords(gauge, [low, high]);
    words.push(withUnit(texts.join(" … "), shown));
  }
  if (limit !== null) {
    const { texts, unit: shown } = inWords(gauge, [limit]);
    words.push(`limit ${withUnit(texts[0]!, shown)}`);
  }
  return words.join(", ");
}

/** `12 bar`, `30°`. */
function withUnit(text: string, unit: string): string {
  return unit === "°" ? `${text}°` : `${text} ${unit}`.trim();
}

/** Numbers of a gauge with their unit; angles in degrees. */
function inWords({ unit }: Gauge, values: number[], scale?: number): { texts: string[]; unit: string } {
  if (unit !== "rad" && unit !== "deg") return measured(values, unit, scale);
  const turned = (value: number) => (unit === "deg" ? value : (value * 180) / Math.PI);
  return { ...measured(values.map(turned), "deg", scale && turned(scale)), unit: "°" };
}
