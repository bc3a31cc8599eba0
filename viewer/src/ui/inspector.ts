// What is known of the chosen element: facts, its numbers at this moment, what can be plotted and traced.
import type { Columns } from "../columns";
import type { Column, Stage } from "../generated/records";
import type { Picked } from "../stage/actor";
import type { Traceable, Traces } from "../stage/traces";
import { breakable, el, icon, scaleOf, short } from "./dom";
import type { Plots } from "./plots";

const MOST_FOUND = 60; // variables that a search shows

interface Actions {
  follow(): void;
  isFollowed(picked: Picked): boolean;
  change(): void;
  canPlay: boolean;
}

export class Inspector {
  readonly element = el("div", { class: "inspector" });
  private readonly numbers: { element: HTMLElement; values: Float32Array | null; scale: number }[] = [];
  private picked: Picked | null = null;
  private frame = 0;
  private readonly head = el("div", { class: "chosen" });
  private readonly found = el("div", { class: "variables" });
  private readonly search = el("input", { type: "search", class: "search", placeholder: "Find a variable", "aria-label": "Find a variable" });

  constructor(
    private readonly stage: Stage,
    private readonly columns: Columns,
    private readonly plots: Plots,
    private readonly traces: Traces,
    private readonly actions: Actions,
  ) {
    this.search.addEventListener("input", () => this.list());
    this.element.append(this.head, plots.element);
    if (columns.list().length) this.element.append(el("section", { class: "all" }, el("h3", {}, "Variables"), this.search, this.found));
    this.select(null);
  }

  /** Show something between the plots and the variables. */
  put(element: HTMLElement): void {
    this.plots.element.after(element);
  }

  select(picked: Picked | null): void {
    this.picked = picked;
    this.describe();
    this.list();
  }

  /** Plots or traces changed. */
  refresh(): void {
    this.describe();
    this.list();
  }

  moveTo(frame: number): void {
    this.frame = frame;
    for (const { element, values, scale } of this.numbers) if (values) element.textContent = short(values[frame] ?? NaN, scale);
  }

  private describe(): void {
    const { picked } = this;
    if (!picked) {
      this.head.replaceChildren(el("p", { class: "note" }, "Choose a part in the picture or the list to see its data."));
      return;
    }
    const body = this.stage.bodies.findIndex((each) => each.name === picked.name);
    const { bodies, joints, forces, drivers, couplings } = this.stage;
    const records: readonly { name: string; facts: [string, string][] }[] = { body: bodies, joint: joints, force: forces, driver: drivers, coupling: couplings }[picked.kind];
    const record = records.find((each) => each.name === picked.name);
    const facts = record?.facts ?? [];
    const follow = picked.kind === "body" && el("button", { type: "button", class: "chip", "aria-pressed": String(this.actions.isFollowed(picked)), onclick: () => this.actions.follow() }, icon("target"), "Follow");
    const paths = this.actions.canPlay ? traceables(this.stage, picked, body) : [];
    const chips = paths.map((each) =>
      el("button", { type: "button", class: "chip", "aria-pressed": String(this.traces.has(each.key)), onclick: () => this.trace(each) }, icon("path"), `Trace ${each.label}`),
    );
    this.head.replaceChildren(
      el("h2", {}, ...breakable(picked.name)),
      el("dl", {}, ...facts.flatMap(([name, value]) => [el("dt", {}, name), el("dd", {}, value)])),
      el("div", { class: "chips" }, follow, ...chips),
    );
  }

  private trace(of: Traceable): void {
    this.traces.toggle(of);
    this.actions.change();
    this.describe();
  }

  private list(): void {
    const wanted = this.search.value.trim().toLowerCase();
    const all = this.columns.list();
    const own = (column: Column) => (this.picked ? column.owner === this.picked.name : column.owner === "");
    const chosen = wanted ? all.filter((column) => column.name.toLowerCase().includes(wanted)) : all.filter(own);
    this.numbers.length = 0;
    const rows = chosen.slice(0, MOST_FOUND).map((column) => this.row(column));
    const more = chosen.length - rows.length;
    this.found.replaceChildren(
      el("ul", {}, ...rows),
      more > 0 ? el("p", { class: "note" }, `and ${more} more: write more of the name`) : "",
      !rows.length ? el("p", { class: "note" }, wanted ? "No variable has this in its name." : "None of its own.") : "",
    );
    this.moveTo(this.frame);
  }

  private row(column: Column): HTMLElement {
    const number = el("output", {});
    const entry: (typeof this.numbers)[number] = { element: number, values: null, scale: 0 };
    this.numbers.push(entry);
    void this.columns.get(0, column.name).then((values) => {
      if (typeof values === "string") return;
      entry.values = values;
      entry.scale = scaleOf(values, column.unit);
      number.textContent = short(values[this.frame] ?? NaN, entry.scale);
    });
    const label = this.picked && column.owner === this.picked.name ? withoutOwner(column.name, column.owner) : column.name;
    return el(
      "li",
      {},
      el("button", { type: "button", "aria-pressed": String(this.plots.has(column.name)), title: `Plot ${column.name}`, "aria-label": `Plot ${column.name}`, onclick: () => this.plots.toggle(column.name) }, icon("plot"), el("span", { class: "name" }, ...breakable(label))),
      number,
      el("small", {}, column.unit === "1" ? "" : column.unit),
    );
  }
}

/** `force.x` of `hinge.force.x`, `magnitude` of `force.drive.magnitude`. */
function withoutOwner(name: string, owner: string): string {
  const prefix = ["", "force.", "driver.", "coupling."].map((kind) => `${kind}${owner}.`).find((each) => name.startsWith(each));
  return prefix ? name.slice(prefix.length) : name;
}

/** Points that can be traced for an element. */
function traceables(stage: Stage, picked: Picked, body: number): Traceable[] {
  if (picked.kind === "joint") {
    const joint = stage.joints.find((each) => each.name === picked.name);
    if (!joint) return [];
    const side = joint.bodies[joint.place] >= 0 ? joint.place : joint.bodies[0] >= 0 ? 0 : 1;
    return joint.bodies[side] < 0 ? [] : [{ key: `joint ${joint.name}`, label: "its point", body: joint.bodies[side], point: joint.points[side] }];
  }
  const record = stage.bodies[body];
  if (picked.kind !== "body" || !record) return [];
  const markers = stage.markers.filter((each) => each.body === body).map((each) => ({ key: `marker ${each.name}`, label: each.name, body, point: each.point }));
  return [{ key: `body ${record.name}`, label: "centre of mass", body, point: record.centre_of_mass }, ...markers];
}
