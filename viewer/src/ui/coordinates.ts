// A slider for every number that a machine is moved by: joint coordinates, angles of balls, places of bodies that nothing holds.
import type { Coordinate } from "../generated/records";
import { breakable, el, iconButton, scaleOf, short } from "./dom";

export class Coordinates {
  readonly element: HTMLElement;
  private readonly rows: { record: Coordinate; slider: HTMLInputElement; value: HTMLElement }[] = [];
  private readonly problem = el("p", { class: "problem", role: "status" });

  constructor(
    coordinates: Coordinate[],
    private readonly move: (name: string, value: number) => void,
    reset: () => void,
  ) {
    const free = coordinates.filter((each) => each.free);
    const rows = free.map((record) => this.row(record));
    this.element = el(
      "div",
      { class: "coordinates" },
      el("header", {}, el("h3", {}, "Move the machine"), iconButton("reset", "Back to the assembled position", reset, "R")),
      this.problem,
      rows.length ? el("ul", {}, ...rows) : el("p", { class: "note" }, "Nothing of this machine can move."),
    );
  }

  update(values: number[], all: Coordinate[], problem: string): void {
    const place = new Map(all.map((each, k) => [each.name, values[k]]));
    for (const row of this.rows) {
      const value = place.get(row.record.name);
      if (value === undefined) continue;
      if (document.activeElement !== row.slider || problem) row.slider.value = String(value);
      row.value.textContent = inWords(value, row.record);
    }
    this.problem.textContent = problem;
  }

  private row(record: Coordinate): HTMLElement {
    const value = el("output", {}, inWords(record.value, record));
    const slider = el("input", { type: "range", min: record.low, max: record.high, step: "any", value: record.value, "aria-label": record.name });
    slider.addEventListener("input", () => this.move(record.name, Number(slider.value)));
    this.rows.push({ record, slider, value });
    return el("li", {}, el("label", {}, el("span", { class: "name" }, ...breakable(record.name)), value, slider));
  }
}

function inWords(value: number, { unit, low, high }: Coordinate): string {
  return unit === "rad" ? `${((value * 180) / Math.PI).toFixed(1)}°`.replace(/^-0\.0°/, "0.0°").replace("-", "−") : `${short(value, scaleOf([low, high], unit))} ${unit}`;
}
