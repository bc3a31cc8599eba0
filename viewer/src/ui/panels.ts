// The frame of the page: the bar on top, panels at the sides (sheets on a phone), playback at the bottom.
import type { Stage } from "../generated/records";
import type { World } from "../stage/world";
import { el, iconButton, type IconName } from "./dom";

export type PanelName = "structure" | "data" | "display";

const TITLES: Record<PanelName, string> = { structure: "Structure", data: "Data and plots", display: "Display" };
const ICONS: Record<PanelName, IconName> = { structure: "tree", data: "plot", display: "eye" };
const KEYS: Record<PanelName, string> = { structure: "S", data: "P", display: "D" };
const NARROW = 760; // pixels: below it panels are sheets, one at a time
const TOP = 60; // pixels above panels
const WIDE = 1080; // from here on both sides are open at first

export class Panels {
  readonly elements: HTMLElement[];
  private readonly panels: Record<PanelName, HTMLElement>;
  private readonly buttons: Record<PanelName, HTMLButtonElement>;
  private readonly bar: HTMLElement;
  private latest: PanelName = "data";

  constructor(
    stage: Stage,
    ghosts: readonly Stage[],
    private readonly world: World,
    contents: Record<PanelName, HTMLElement>,
    private readonly timeline: HTMLElement | null,
    status: HTMLElement,
    help: () => void,
  ) {
    const names = Object.keys(TITLES) as PanelName[];
    this.buttons = Object.fromEntries(names.map((name) => [name, iconButton(ICONS[name], TITLES[name], () => this.toggle(name), KEYS[name])])) as Record<PanelName, HTMLButtonElement>;
    this.panels = Object.fromEntries(names.map((name) => [name, this.panel(name, contents[name])])) as Record<PanelName, HTMLElement>;
    const legend = ghosts.map((ghost) => el("li", { class: "ghost" }, el("i", {}), ghostInWords(ghost, stage)));
    const notes = stage.notes.length + legend.length ? el("ul", { class: "notes" }, ...stage.notes.map((note) => el("li", {}, note)), ...legend) : null;
    this.bar = el(
      "header",
      { class: "top" },
      this.buttons.structure,
      el("div", { class: "title" }, el("h1", {}, stage.name), notes, status),
      el("nav", { "aria-label": "Panels" }, iconButton("fit", "Fit to the present position", () => world.fitNow(), "F"), this.buttons.display, this.buttons.data, iconButton("help", "Keys and mouse", help, "?")),
    );
    this.elements = [this.bar, ...names.map((name) => this.panels[name]), ...(timeline ? [timeline] : [])];
    document.body.classList.toggle("has-timeline", !!timeline);
    const watch = new ResizeObserver(() => this.arrange());
    watch.observe(this.bar); // what the program says comes and goes
    if (timeline) watch.observe(timeline); // a bar of a live machine has as many rows as it needs
    addEventListener("resize", () => {
      this.makeRoom();
      this.arrange();
    });
  }

  /** Open what has room at first; `move` : the machine is moved by hand, by sliders in the data panel; `structure` : there is room for the list of parts. */
  settle(move: boolean, structure = true): void {
    if (move) this.rename("data", "Joints and data");
    if (innerWidth >= WIDE && innerHeight > 480) {
      this.set("structure", structure);
      this.set("data", true);
    } else if (move) {
      this.set("data", true);
    }
    this.arrange();
    this.world.view("first", false);
  }

  toggle(name: PanelName): void {
    const on = this.panels[name].hidden === true;
    if (on) this.latest = name;
    if (on && innerWidth < NARROW) this.close();
    if (on && name === "data") this.set("display", false);
    if (on && name === "display") this.set("data", false);
    this.set(name, on);
    this.arrange();
  }

  /** Open a panel if that covers nothing else. */
  offer(name: PanelName): void {
    if (innerWidth < NARROW || !this.panels[name].hidden || !this.panels.display.hidden) return;
    this.toggle(name);
  }

  closeTop(): void {
    for (const name of ["display", "data", "structure"] as const) {
      if (!this.panels[name].hidden) {
        this.toggle(name);
        return;
      }
    }
  }

  close(): void {
    for (const name of Object.keys(this.panels) as PanelName[]) this.set(name, false);
  }

  /** Of sheets on a narrow page only the one that was opened last stays. */
  private makeRoom(): void {
    const open = this.open();
    if (innerWidth >= NARROW || open.length < 2) return;
    const keep = open.includes(this.latest) ? this.latest : open[0]!;
    for (const name of open) if (name !== keep) this.set(name, false);
  }

  private open(): PanelName[] {
    return (Object.keys(this.panels) as PanelName[]).filter((name) => !this.panels[name].hidden);
  }

  /** Give a panel another title. */
  rename(name: PanelName, title: string): void {
    this.panels[name].setAttribute("aria-label", title);
    this.panels[name].querySelector("h2")!.textContent = title;
    this.buttons[name].setAttribute("aria-label", title);
    this.buttons[name].title = `${title} (${KEYS[name]})`;
  }

  private set(name: PanelName, on: boolean): void {
    this.panels[name].hidden = !on;
    this.buttons[name].setAttribute("aria-pressed", String(on));
  }

  private arrange(): void {
    // notes of several lines under the title stand above the list of parts, not over it
    this.panels.structure.style.setProperty("--top", `${Math.max(TOP, this.bar.offsetHeight)}px`);
    document.body.style.setProperty("--foot", `${this.timeline?.offsetHeight ?? 0}px`);
    // in a picture without controls the bars have no height, and cover nothing wherever they are
    const free = { left: 0, top: this.bar.offsetHeight, right: 0, bottom: this.timeline?.offsetHeight ? innerHeight - this.timeline.getBoundingClientRect().top : 0 };
    for (const name of this.open()) {
      const box = this.panels[name].getBoundingClientRect();
      if (innerWidth < NARROW) free.bottom += box.height;
      else if (name === "structure") free.left = box.right;
      else free.right = innerWidth - box.left;
    }
    this.world.keepFree(free);
  }

  private panel(name: PanelName, content: HTMLElement): HTMLElement {
    const side = name === "structure" ? "left" : "right";
    return el(
      "aside",
      { class: `panel ${side} ${name}`, hidden: true, "aria-label": TITLES[name] },
      el("div", { class: "panel-head" }, el("h2", {}, TITLES[name]), iconButton("close", `Close ${TITLES[name].toLowerCase()}`, () => this.toggle(name))),
      el("div", { class: "panel-body" }, content),
    );
  }
}

/** What a ghost is of; of another machine that is said. */
export function ghostInWords(ghost: Stage, stage: Stage): string {
  const names = (of: Stage) => of.bodies.map((body) => body.name).join("\n");
  const same = ghost.name === stage.name && names(ghost) === names(stage);
  return `Ghost: ${ghost.title}${same ? "" : ghost.title === ghost.name ? ", another machine" : `, another machine: ${ghost.name}`}`;
}
