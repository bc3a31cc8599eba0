// What is shown, and from where: the panel behind the eye.
import { FAMILIES, type Family } from "../stage/arrows";
import type { View } from "../stage/views";
import type { App } from "../app";
import { choice, el, short, toggle } from "./dom";

const SIDES: readonly [View, string, string][] = [
  ["first", "First", "0"],
  ["front", "Front", "1"],
  ["right", "Right", "2"],
  ["top", "Top", "3"],
  ["back", "Back", "4"],
  ["left", "Left", "5"],
  ["below", "Below", "6"],
];
const NAMES: Record<Family, string> = {
  "applied-force": "Applied forces",
  "applied-torque": "Applied torques",
  "reaction-force": "Reaction forces",
  "reaction-torque": "Reaction torques",
};

export class Display {
  readonly element: HTMLElement;

  constructor(private readonly app: App) {
    const sides = SIDES.map(([view, name, key]) => el("button", { type: "button", class: "chip", title: `${name} (${key})`, onclick: () => app.look(view) }, name));
    this.element = el(
      "div",
      { class: "display" },
      section("Look from", el("div", { class: "chips" }, ...sides)),
      this.colours(),
      section("Show", ...this.shown()),
      this.arrows(),
      this.violations(),
      this.flexible(),
      this.ghost(),
    );
  }

  private shown(): HTMLElement[] {
    const { app } = this;
    const { stage } = app.actor;
    return [
      toggle("Names of bodies", app.labels.shown.body, (on) => app.name("body", on)),
      toggle("Names of joints", app.labels.shown.joint, (on) => app.name("joint", on)),
      ...(stage.forces.length + stage.drivers.length + stage.couplings.length ? [toggle(stage.couplings.length ? "Names of forces and couplings" : "Names of forces", app.labels.shown.force, (on) => app.name("force", on))] : []),
      toggle("Joint symbols", !app.live, (on) => app.show("signs", on)),
      ...(stage.joints.length ? [toggle("Joint axes", false, (on) => app.show("axes", on)), toggle("Joint frames", false, (on) => app.show("joints", on))] : []),
      ...(stage.markers.length ? [toggle("Marker frames", false, (on) => app.show("markers", on))] : []),
      toggle("Body frames", false, (on) => app.show("triads", on)),
      toggle("Centres of mass", false, (on) => app.show("centres", on)),
      toggle("Grid", true, (on) => app.change(() => app.world.floor.setGrid(on))),
      toggle("Shadows", true, (on) => app.world.setShadows(on)),
    ];
  }

  private arrows(): HTMLElement | null {
    const { app } = this;
    const known = FAMILIES.filter((family) => app.arrows.has(family));
    if (!known.length) return null;
    const round = (value: number) => short(+value.toPrecision(2));
    const size = round(app.actor.stage.size * 0.1);
    const scaleNote = el("p", { class: "note" });
    const say = () => {
      const units = (["force", "torque"] as const).filter((kind) => app.arrows.unit(kind) > 0);
      const worth = units.map((kind) => `${round(app.arrows.unit(kind))} ${kind === "force" ? "N" : "N m"}`);
      scaleNote.textContent = `${size} m of arrow: ${worth.join(", ")}`;
    };
    const slider = range("Length of arrows", -1, 2, 0, (value) => {
      app.change(() => (app.arrows.scale = 10 ** value));
      say();
    });
    say();
    const toggles = known.map((family) =>
      toggle(NAMES[family], app.arrows.shown.has(family), (on) => app.change(() => (on ? app.arrows.shown.add(family) : app.arrows.shown.delete(family)))),
    );
    for (const [k, family] of known.entries()) toggles[k]!.classList.add(family);
    return section("Arrows", ...toggles, slider, scaleNote);
  }

  private violations(): HTMLElement | null {
    const { app } = this;
    if (!app.violations.isKnown || !app.motion) return null;
    const factor = el("output", {});
    const proposed = Math.log10(app.violations.proposed(app.motion));
    const set = (value: number) => {
      const shown = 10 ** Math.round(value);
      app.change(() => (app.violations.exaggeration = shown));
      factor.textContent = `× ${short(shown)}`;
    };
    const slider = range("Exaggeration", Math.min(0, proposed - 4), Math.max(proposed + 3, 3), proposed, set, 1);
    set(proposed);
    return section("Open joints", toggle("Constraint violations", false, (on) => app.change(() => (app.violations.on = on))), slider, el("p", { class: "note" }, "Exaggerated ", factor));
  }

  private colours(): HTMLElement | null {
    const { app } = this;
    const { ofBeams, ofBodies } = app.colours;
    const missing = app.actor.stage.colourless.map((text) => el("p", { class: "note" }, text));
    const beams = ofBeams.length ? choice("Beams by", ["", ...ofBeams], "nothing", (name) => app.change(() => app.colours.beams(name))) : null;
    const bodies = ofBodies.length ? choice("Bodies by", ofBodies, "", (name) => app.change(() => app.colours.bodies(name))) : null;
    return beams || bodies || missing.length ? section("Colours", beams, bodies, ...missing) : null;
  }

  private flexible(): HTMLElement | null {
    const { app } = this;
    if (!app.actor.deforming.length) return null;
    const factor = el("output", {}, "× 1");
    const slider = range("Exaggerate the deformation", 0, 3, 0, (value) => {
      for (const each of app.actor.deforming) each.exaggeration = 10 ** value;
      factor.textContent = `× ${short(10 ** value)}`;
      app.refreshFrame();
    });
    return section("Deformation", slider, el("p", { class: "note" }, "Drawn ", factor));
  }

  private ghost(): HTMLElement | null {
    const { app } = this;
    if (!app.ghosts.length) return null;
    return section("Second result", toggle(app.ghosts.map((each) => each.actor.stage.title).join(", "), true, (on) => app.showGhosts(on)), ...app.ghosts.flatMap((each) => each.actor.stage.notes.map((note) => el("p", { class: "note" }, note))));
  }
}

function section(title: string, ...content: (Node | null)[]): HTMLElement {
  return el("section", {}, el("h3", {}, title), ...content);
}

function range(label: string, min: number, max: number, value: number, oninput: (value: number) => void, step: number | "any" = "any"): HTMLLabelElement {
  const input = el("input", { type: "range", min, max, step, value });
  input.addEventListener("input", () => oninput(Number(input.value)));
  return el("label", { class: "range" }, el("span", {}, label), input);
}
