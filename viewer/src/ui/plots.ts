// Curves of variables with the time of the picture as a line in them; a click or drag in a plot moves the picture.
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import type { Columns } from "../columns";
import { breakable, el, iconButton, scaleOf, short } from "./dom";

const HEIGHT = 132;
const MOST = 12; // curves at once

export interface Times {
  main: Float64Array;
  ghost: Float64Array | null;
  ghostTitle: string;
  isPath: boolean; // of equilibria, whose times are places along it
}

interface Chart {
  unit: string;
  names: string[];
  plot: uPlot | null;
  holder: HTMLElement;
  readout: HTMLElement;
  series: { label: string; colour: string; values: (number | null)[]; times: Float64Array; scale: number }[];
}

export class Plots {
  readonly element = el("div", { class: "plots" });
  private charts: Chart[] = [];
  private time = 0;
  private wish = 0; // counts changes: answers that come too late are dropped

  constructor(
    private readonly columns: Columns,
    private readonly times: Times,
    private readonly seek: (time: number) => void,
    private readonly onChange: () => void,
    private readonly says: (time: number) => string,
  ) {
    new ResizeObserver(() => this.resize()).observe(this.element);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => void this.show(this.names));
  }

  names: string[] = [];

  has(name: string): boolean {
    return this.names.includes(name);
  }

  toggle(name: string): void {
    void this.show(this.has(name) ? this.names.filter((each) => each !== name) : [...this.names, name].slice(-MOST));
  }

  async show(names: string[]): Promise<void> {
    this.names = names;
    const wish = ++this.wish;
    const units = [...new Set(names.map((name) => this.columns.unit(name)))];
    const charts = await Promise.all(units.map((unit) => this.load(unit, names.filter((name) => this.columns.unit(name) === unit))));
    if (wish !== this.wish) return;
    for (const chart of this.charts) chart.plot?.destroy();
    this.charts = charts;
    this.element.replaceChildren(...charts.map((chart) => this.frame(chart)));
    for (const chart of charts) this.draw(chart);
    this.moveTo(this.time);
    this.onChange();
  }

  moveTo(time: number): void {
    this.time = time;
    for (const chart of this.charts) {
      if (!chart.plot) continue;
      const left = chart.plot.valToPos(time, "x");
      const line = chart.holder.querySelector<HTMLElement>(".now");
      const shown = chart.series.map((each) => `${each.label} ${short(at(each.times, each.values, time) ?? NaN, each.scale)}`);
      chart.plot.over.setAttribute("aria-valuenow", String(time));
      chart.plot.over.setAttribute("aria-valuetext", `${this.says(time)}: ${shown.join(", ")}`);
      if (line) line.style.transform = `translateX(${left}px)`;
      chart.readout.replaceChildren(
        ...chart.series.filter((each) => !each.label.startsWith("ghost ")).map((each) => {
          const key = el("i", {});
          key.style.background = each.colour;
          const value = at(each.times, each.values, time);
          return el("li", {}, key, el("span", { class: "name" }, ...breakable(each.label)), el("b", {}, value === null ? "–" : short(value, each.scale)), iconButton("close", `Remove ${each.label}`, () => this.toggle(each.label)));
        }),
      );
    }
  }

  private async load(unit: string, names: string[]): Promise<Chart> {
    const style = getComputedStyle(document.documentElement);
    const chart: Chart = { unit, names, plot: null, holder: el("div", { class: "canvas" }), readout: el("ul", { class: "readout" }), series: [] };
    for (const [k, name] of names.entries()) {
      const colour = style.getPropertyValue(`--tone-${(this.names.indexOf(name) + k * 0) % 8}`).trim();
      for (const [stage, times] of [this.times.main, this.times.ghost].entries()) {
        if (!times) continue;
        const values = await this.columns.get(stage, name);
        if (typeof values === "string") continue;
        const numbers = Array.from(values, (value) => (Number.isFinite(value) ? value : null));
        chart.series.push({ label: stage ? `ghost ${name}` : name, colour, values: numbers, times, scale: scaleOf(numbers, unit) });
      }
    }
    return chart;
  }

  private frame(chart: Chart): HTMLElement {
    const ghost = chart.series.some((each) => each.label.startsWith("ghost ")) ? `, dashed: ${this.times.ghostTitle}` : "";
    const unit = chart.unit && chart.unit !== "1" ? `[${chart.unit}]` : "[–]";
    const over = this.times.isPath ? " over the path of equilibria" : "";
    return el("figure", { class: "chart", "aria-label": `${chart.names.join(", ")}${over || " over time"}` }, el("figcaption", {}, unit + over + ghost), chart.holder, chart.readout);
  }

  private draw(chart: Chart): void {
    const style = getComputedStyle(document.documentElement);
    const colour = (name: string) => style.getPropertyValue(`--${name}`).trim();
    const axis = { stroke: colour("soft"), grid: { stroke: colour("grid"), width: 1 }, ticks: { show: false }, font: `11px ${getComputedStyle(document.body).fontFamily}` };
    const { times, values } = together(chart);
    if (!times.length || !chart.series.length) {
      chart.holder.replaceChildren(el("p", { class: "note" }, "No numbers"));
      return;
    }
    const options: uPlot.Options = {
      width: Math.max(chart.holder.clientWidth, 120),
      height: HEIGHT,
      legend: { show: false },
      cursor: { y: false, drag: { x: false, y: false, setScale: false }, points: { show: false } },
      scales: { x: { time: false }, y: { range: (_u, low, high) => padded(low, high) } },
      axes: [
        { ...axis, size: 22, gap: 3 },
        { ...axis, size: (_u, labels) => 14 + 6.4 * Math.max(3, ...(labels ?? []).map((label) => String(label).length)), gap: 4, values: (_u, splits) => splits.map((each) => short(each, Math.max(...splits.map(Math.abs)))) },
      ],
      series: [{}, ...chart.series.map((each) => ({ stroke: each.colour, width: each.label.startsWith("ghost ") ? 1 : 1.6, dash: each.label.startsWith("ghost ") ? [5, 4] : undefined, spanGaps: false, pxAlign: 0, points: { show: false } }))],
      hooks: { ready: [(plot) => this.listen(plot)] },
    };
    chart.plot = new uPlot(options, [times, ...values] as unknown as uPlot.AlignedData, chart.holder);
    const { over } = chart.plot;
    over.append(el("div", { class: "now", "aria-hidden": "true" }));
    // keys move the time wherever they are pressed: the plot has to be reached only, and to say what it shows
    const said = { role: "slider", tabindex: "0", "aria-label": `Moment in the plot of ${chart.names.join(", ")}`, "aria-valuemin": String(times[0]), "aria-valuemax": String(times.at(-1)) };
    for (const [name, value] of Object.entries(said)) over.setAttribute(name, value);
  }

  private listen(plot: uPlot): void {
    const move = (event: PointerEvent) => {
      const box = plot.over.getBoundingClientRect();
      this.seek(plot.posToVal(Math.min(Math.max(event.clientX - box.left, 0), box.width), "x"));
    };
    plot.over.addEventListener("pointerdown", (event) => {
      plot.over.setPointerCapture(event.pointerId);
      move(event);
    });
    plot.over.addEventListener("pointermove", (event) => event.buttons && move(event));
  }

  private resize(): void {
    for (const chart of this.charts) {
      const width = chart.holder.clientWidth;
      if (chart.plot && width > 0 && Math.abs(width - chart.plot.width) > 1) chart.plot.setSize({ width, height: HEIGHT });
    }
    this.moveTo(this.time);
  }
}

/** All curves over one list of times; a curve has no number at the times of another. */
function together(chart: Chart): { times: number[]; values: (number | null | undefined)[][] } {
  const lists = [...new Set(chart.series.map((each) => each.times))];
  if (lists.length < 2) return { times: Array.from(lists[0] ?? []), values: chart.series.map((each) => each.values) };
  const joined = uPlot.join(lists.map((list) => [Array.from(list), ...chart.series.filter((each) => each.times === list).map((each) => each.values)]) as uPlot.AlignedData[]);
  const [times, ...values] = joined as unknown as [number[], ...(number | null | undefined)[][]];
  const order = lists.flatMap((list) => chart.series.filter((each) => each.times === list));
  return { times, values: chart.series.map((each) => values[order.indexOf(each)]!) };
}

function at(times: Float64Array, values: (number | null)[], time: number): number | null {
  let low = 0;
  let high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle]! <= time) low = middle;
    else high = middle - 1;
  }
  return values[low] ?? null;
}

function padded(low: number | null, high: number | null): [number, number] {
  if (low === null || high === null) return [-1, 1];
  const span = high - low;
  const size = Math.max(Math.abs(low), Math.abs(high), 1e-300);
  const room = span > 1e-9 * size ? 0.08 * span : 0.5 * size || 1;
  return [low - room, high + room];
}
