// The diagram of hydraulic circuits with the pressures of the moment; a click at a pressure plots it.
import type { Columns } from "../columns";
import { el, enlarging } from "./dom";
import type { Plots } from "./plots";

const START = "hydraulics.";
const BAR = 1e5;
const COLD = 220; // hue of no pressure, red is that of the highest one

/** The colour of a share of the highest pressure, as in the diagram at the start. */
function colourOf(share: number): string {
  return `hsl(${Math.round(COLD * (1 - Math.min(Math.max(share, 0), 1)))} 80% 42%)`;
}

export class Circuit {
  readonly element: HTMLElement;
  private readonly shown: { place: Element; values: Float32Array | null }[] = [];
  private readonly levels: { line: SVGElement; values: Float32Array }[] = [];
  private readonly key: Element | null;
  private highest = 0;
  private frame = 0;

  constructor(svg: string, columns: Columns, plots: Plots) {
    const diagram = el("div", { class: "diagram" });
    diagram.innerHTML = svg;
    this.element = el("section", { class: "circuits" }, el("h3", {}, "Hydraulics"), enlarging("Large", diagram), diagram);
    this.key = diagram.querySelector("[data-highest]");
    for (const line of diagram.querySelectorAll<SVGElement>("[data-level]")) {
      void columns.get(0, START + line.getAttribute("data-level")).then((values) => {
        if (typeof values === "string") return;
        this.levels.push({ line, values });
        for (const value of values) this.highest = Math.max(this.highest, value);
        this.moveTo(this.frame);
      });
    }
    for (const place of diagram.querySelectorAll("[data-pressure]")) {
      const name = START + place.getAttribute("data-pressure");
      const shown: { place: Element; values: Float32Array | null } = { place, values: null };
      this.shown.push(shown);
      place.textContent = "";
      place.closest("text")?.addEventListener("click", () => plots.toggle(name));
      void columns.get(0, name).then((values) => {
        if (typeof values === "string") return;
        shown.values = values;
        this.moveTo(this.frame);
      });
    }
  }

  moveTo(frame: number): void {
    this.frame = frame;
    for (const { place, values } of this.shown) {
      const pressure = values?.[frame];
      if (pressure !== undefined) place.textContent = `${+(pressure / BAR).toPrecision(4)} bar`;
    }
    for (const { line, values } of this.levels) {
      const pressure = values[frame];
      if (pressure !== undefined && this.highest > 0) line.style.stroke = colourOf(pressure / this.highest);
    }
    if (this.key && this.highest > 0) this.key.textContent = `${+(this.highest / BAR).toPrecision(4)}`;
  }
}
