// Bodies, joints, forces, drivers and couplings as a list to choose from.
import type { Stage } from "../generated/records";
import type { Picked } from "../stage/actor";
import { breakable, el } from "./dom";

const FEW = 14; // longer lists get a field to search

export class Tree {
  readonly element: HTMLElement;
  private readonly buttons = new Map<string, HTMLButtonElement>();

  constructor(stage: Stage, choose: (picked: Picked | null) => void) {
    const sections: [string, Picked["kind"], { name: string; note: string; colour?: string }[]][] = [
      ["Bodies", "body", stage.bodies.map((body) => ({ name: body.name, note: "", colour: body.colour }))],
      ["Joints", "joint", stage.joints.map((joint) => ({ name: joint.name, note: joint.kind }))],
      ["Forces", "force", stage.forces.map((force) => ({ name: force.name, note: force.kind }))],
      ["Drivers", "driver", stage.drivers.map((driver) => ({ name: driver.name, note: "" }))],
      ["Couplings", "coupling", stage.couplings.map((coupling) => ({ name: coupling.name, note: coupling.kind }))],
    ];
    const search = el("input", { type: "search", class: "search", placeholder: "Find a part", "aria-label": "Find a part" });
    search.addEventListener("input", () => this.filter(search.value));
    const total = sections.reduce((count, [, , items]) => count + items.length, 0);
    const lists = sections
      .filter(([, , items]) => items.length)
      .map(([title, kind, items]) =>
        el(
          "section",
          { class: "branch" },
          el("h3", {}, `${title} `, el("span", { class: "count" }, String(items.length))),
          el("ul", {}, ...this.rows(kind === "body" ? groups(stage) : new Map(), items, (item) => this.button(kind, item, choose))),
        ),
      );
    this.element = el("div", { class: "tree" }, total > FEW && search, ...lists);
  }

  select(picked: Picked | null): void {
    for (const [key, button] of this.buttons) {
      const on = !!picked && key === `${picked.kind} ${picked.name}`;
      button.setAttribute("aria-pressed", String(on));
      if (!on) continue;
      const group = button.closest("details");
      if (group) group.open = true;
      button.scrollIntoView({ block: "nearest" });
    }
  }

  /** Rows of items; those of one group stand in a list of their own, which is closed at first. */
  private rows<T>(groupOf: Map<number, string>, items: T[], button: (item: T) => HTMLButtonElement): HTMLLIElement[] {
    const lists = new Map<string, { list: HTMLUListElement; count: HTMLElement }>();
    return items.flatMap((item, k) => {
      const row = el("li", {}, button(item));
      const group = groupOf.get(k);
      if (group === undefined) return [row];
      const known = lists.get(group);
      if (known) {
        known.list.append(row);
        known.count.textContent = String(known.list.childElementCount);
        return [];
      }
      const made = { list: el("ul", {}, row), count: el("span", { class: "count" }, "1") };
      lists.set(group, made);
      return [el("li", {}, el("details", {}, el("summary", {}, ...breakable(group), " ", made.count), made.list))];
    });
  }

  private button(kind: Picked["kind"], item: { name: string; note: string; colour?: string }, choose: (picked: Picked | null) => void): HTMLButtonElement {
    const dot = el("i", { class: `dot ${kind}` });
    if (item.colour) dot.style.background = item.colour;
    const pick = () => choose(button.getAttribute("aria-pressed") === "true" ? null : { kind, name: item.name });
    const label = item.note ? `${item.name}, ${item.note}` : item.name;
    const button: HTMLButtonElement = el("button", { type: "button", "aria-label": label, "aria-pressed": "false", onclick: pick }, dot, el("span", { class: "name" }, ...breakable(item.name)), el("small", {}, item.note));
    this.buttons.set(`${kind} ${item.name}`, button);
    return button;
  }

  private filter(text: string): void {
    const wanted = text.trim().toLowerCase();
    for (const button of this.buttons.values()) {
      button.parentElement!.hidden = !button.textContent!.toLowerCase().includes(wanted);
    }
    for (const group of this.element.querySelectorAll("details")) {
      const found = [...group.querySelectorAll("li")].some((row) => !row.hidden);
      group.parentElement!.hidden = !found;
      group.open = found && wanted !== "";
    }
  }
}

/** Names of what bodies are parts of, by the numbers of the bodies. */
function groups(stage: Stage): Map<number, string> {
  return new Map(stage.sweeps.flatMap((sweep) => sweep.bodies.map((body) => [body, sweep.name] as const)));
}
