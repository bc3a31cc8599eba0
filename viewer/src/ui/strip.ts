// A number that changes, and its last seconds as a curve.
import { el, measured } from "./dom";

const SPAN = 15; // s that are shown
const NOISE = 1e-6; // share of the largest number, and a number, below which a change is round-off
const WIDTH = 284;
const HEIGHT = 40;

export class Strip {
  readonly element: HTMLElement;
  private readonly times: number[] = [];
  private readonly numbers: number[] = [];
  private readonly output = el("output", {});
  private readonly canvas = el("canvas", { width: 2 * WIDTH, height: 2 * HEIGHT, "aria-hidden": "true" });

  constructor(
    name: string,
    private readonly unit: string,
  ) {
    this.element = el("li", { class: "strip" }, el("span", { class: "name" }, name), this.output, this.canvas);
  }

  add(time: number, value: number): void {
    const last = this.times.at(-1);
    if (last !== undefined && time < last) this.clear(); // put back to an earlier moment
    this.times.push(time);
    this.numbers.push(Math.abs(value) < 1e-3 * NOISE ? 0 : value);
    while (this.times[0]! < time - SPAN) {
      this.times.shift();
      this.numbers.shift();
    }
  }

  private clear(): void {
    this.times.length = 0;
    this.numbers.length = 0;
  }

  draw(): void {
    const value = this.numbers.at(-1);
    const end = this.times.at(-1);
    if (value === undefined || end === undefined) return;
    const { texts, unit } = measured([value], this.unit);
    this.output.textContent = `${texts[0]} ${unit}`.trim();
    const context = this.canvas.getContext("2d");
    if (!context) return;
    const { width, height } = this.canvas;
    const low = Math.min(...this.numbers);
    const high = Math.max(...this.numbers);
    const span = Math.max(high - low, NOISE * Math.max(Math.abs(low), Math.abs(high), 1));
    context.clearRect(0, 0, width, height);
    context.strokeStyle = getComputedStyle(this.element).getPropertyValue("--accent");
    context.lineWidth = 2.5;
    context.beginPath();
    this.numbers.forEach((number, k) => {
      const x = width * (1 - (end - this.times[k]!) / SPAN);
      const y = height - 4 - ((number - low) / span) * (height - 8);
      if (k) context.lineTo(x, y);
      else context.moveTo(x, y);
    });
    context.stroke();
  }
}
