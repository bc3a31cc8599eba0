// A live machine: the bar that runs and pauses it, its controls, its gauges.
import type { Samples } from "../connection";
import type { Control, FromPage, Gauge, Parameter, Status } from "../generated/records";
import { Operator } from "../operator";
import { el, iconButton, renew, short } from "./dom";
import { Stick } from "./stick";
import { Strip } from "./strip";

const SPEEDS = [0.05, 0.1, 0.25, 0.5, 1] as const;
const SEATS = { you: "You operate", other: "Somebody operates", program: "A program operates", nobody: "Take the controls" };
const SPAN = 3; // values of a parameter on its slider, in those of the file
const DRAWN = 100; // ms between two pictures of the strips

interface Row {
  control: Control;
  slider: HTMLInputElement | null;
  output: HTMLElement;
}

export class Live {
  readonly bar: HTMLElement;
  readonly panel: HTMLElement;
  readonly operator: Operator;
  status: Status | null = null;
  /** Whether the mouse picks bodies up. */
  onHand: (on: boolean) => void = () => {};
  private readonly strips: Strip[];
  private readonly rows: Row[];
  private readonly run: HTMLButtonElement;
  private readonly seat: HTMLButtonElement;
  private readonly speed: HTMLSelectElement;
  private readonly clock = el("output", { class: "time", "aria-live": "off" });
  private readonly load = el("span", {});
  private readonly light = el("span", { class: "light", role: "img" });
  private readonly reasons = el("ul", { class: "reasons" });
  private readonly problem = el("p", { class: "problem", role: "status" });
  private readonly hint: HTMLElement;
  private readonly commands: (HTMLButtonElement | HTMLSelectElement)[]; // what a page that only watches may not use
  private readonly chosen: number[] = []; // values of the parameters
  private drawn = 0;
  private resumes = false; // whether this page operated when the connection was lost

  constructor(
    private readonly controls: Control[],
    private readonly gauges: Gauge[],
    private readonly send: (message: FromPage) => void,
    private readonly alone: boolean, // whether the machine is in the page, and no server is there to record it
    parameters: Parameter[],
  ) {
    this.operator = new Operator(controls, (values) => send({ type: "drive", values }), () => this.take(true));
    this.run = iconButton("play", "Run", () => this.toggle(), "space");
    this.run.classList.add("main-button");
    this.seat = el("button", { type: "button", class: "chip seat", onclick: () => this.take(this.status?.driver !== "you") }, "Take the controls");
    this.speed = el("select", { "aria-label": "Speed", title: "Simulated over real time" }, ...SPEEDS.map((each) => el("option", { value: each, selected: each === 1 }, `${each}×`)));
    this.speed.addEventListener("change", () => this.say("speed", Number(this.speed.value)));
    const hand = el("button", { type: "button", class: "chip", title: "Drag a body with the mouse; shift does it too", "aria-pressed": "false" }, "Pick up");
    hand.addEventListener("click", () => {
      const on = hand.getAttribute("aria-pressed") !== "true";
      hand.setAttribute("aria-pressed", String(on));
      this.onHand(on);
    });
    const step = iconButton("forward", "One tick", () => this.say("step"));
    const reset = iconButton("reset", "Back to the start", () => this.say("reset"));
    const save = el("button", { type: "button", class: "chip", onclick: () => this.say("save") }, "Save state");
    const restore = el("button", { type: "button", class: "chip", onclick: () => this.say("restore") }, "Restore");
    const table = el("button", { type: "button", class: "chip", title: "Save all frames of this motion as a table (CSV)", onclick: () => send({ type: "command", word: "table", number: 0 }) }, "Save table");
    this.commands = [this.run, step, reset, hand, save, restore, this.speed, this.seat];
    this.bar = el(
      "footer",
      { class: "timeline live-bar", role: "group", "aria-label": "Live" },
      el("div", { class: "transport" }, this.run, step, reset),
      el("div", { class: "clock" }, this.clock),
      el("span", { class: "of load" }, this.light, this.load),
      el("div", { class: "pace" }, hand, save, restore, alone ? table : null, this.speed, this.seat),
    );
    this.hint = el("p", { class: "note" }, hintOf(controls));
    this.rows = controls.map((control, k) => this.row(control, k));
    this.strips = gauges.map((gauge) => new Strip(gauge));
    const sticks = (["left", "right"] as const).filter((side) => controls.some((each) => each.stick.startsWith(side)));
    this.panel = el(
      "div",
      { class: "live" },
      this.problem,
      this.reasons,
      controls.length ? el("h3", {}, "Controls") : null,
      controls.length ? this.hint : null,
      sticks.length ? el("div", { class: "sticks" }, ...sticks.map((side) => new Stick(side, stickInWords(side, controls), (stick, value) => this.operator.deflect(stick, value)).element)) : null,
      el("ul", { class: "controls" }, ...this.rows.map((row) => row.output.closest("li")!)),
      parameters.length ? el("h3", {}, "Parameters") : null,
      parameters.length ? el("p", { class: "note" }, "With another value the machine goes back to its start.") : null,
      el("ul", { class: "controls" }, ...parameters.map((each, k) => this.parameter(each, k))),
      gauges.length ? el("h3", {}, "Gauges") : null,
      el("ul", { class: "strips" }, ...this.strips.map((each) => each.element)),
    );
  }

  toggle(): void {
    this.say(this.status?.mode === "running" ? "pause" : "run");
  }

  take(on: boolean): void {
    this.send({ type: "take", on: on ? 1 : 0 });
    if (!on) this.operator.rest();
    this.operator.driving = on && this.status?.driver !== "other";
  }

  /** A command; whoever gives one where nobody operates the machine operates it. */
  say(word: string, number = 0): void {
    if (this.status?.watches) return;
    if (!this.operator.driving && this.status?.driver !== "program") this.take(true);
    this.send({ type: "command", word, number });
  }

  /** The connection was lost: nobody operates from here until the server says so again; it is asked when it is back. */
  lose(): void {
    this.resumes ||= this.operator.driving;
    this.operator.driving = false;
  }

  /** What the keys do, for the page that says so. */
  get keys(): [string, string][] {
    return this.controls
      .filter((each) => each.lowers || each.raises)
      .map((each) => [[each.lowers, each.raises].filter(Boolean).map(keyInWords).join(" "), each.description ? `${each.label}: ${each.description}` : each.label]);
  }

  update(status: Status): void {
    this.status = status;
    this.operator.driving = status.driver === "you";
    if (this.resumes && status.driver === "nobody") this.take(true);
    this.resumes = false;
    const running = status.mode === "running";
    renew(this.run, running ? "pause" : "play", running ? "Pause" : "Run", "space");
    this.seat.textContent = SEATS[status.driver];
    this.seat.setAttribute("aria-pressed", String(status.driver === "you"));
    this.clock.textContent = `${status.time.toFixed(2)} s`;
    const share = (100 * status.computing) / status.tick;
    this.load.textContent = `${running ? "" : `${status.mode} · `}${short(+status.computing.toPrecision(2))} µs a tick, ${share.toPrecision(2)} %${status.overruns ? `, ${status.overruns} late` : ""}`;
    this.load.title = `99 % of the ticks are computed in at most this time, and begin at most ${short(+status.late.toPrecision(2))} µs after their deadlines. ${status.overruns} ended after the next deadline, ${status.own} of them by their own computing.`;
    this.problem.textContent = status.text;
    this.judge(status);
    this.allow(status);
    if (document.activeElement !== this.speed) this.speed.value = String(status.speed);
    this.hint.hidden = status.driver === "you" || status.driver === "program";
  }

  /** Whether the run can be trusted so far, and why not. */
  private judge(status: Status): void {
    this.light.dataset.verdict = status.light;
    const so = `Energy, joints, circuits and computing time are ${status.light} so far.`;
    this.light.title = [so, `Not verified: the errors of the steps are not examined${this.alone ? "" : "; nivel replay estimates them"}.`, ...status.reasons].join("\n");
    this.light.setAttribute("aria-label", `trust: ${status.light}, not verified`);
    const shown = status.text ? status.reasons.filter((each) => !each.includes(status.text)) : status.reasons;
    if (this.reasons.dataset.shown === shown.join("\n")) return;
    this.reasons.dataset.shown = shown.join("\n");
    this.reasons.dataset.verdict = status.light;
    this.reasons.replaceChildren(...shown.map((each) => el("li", {}, each)));
  }

  /** Disable what this page may not use now; the reason stands in the panel and in the tip of the bar. */
  private allow(status: Status): void {
    for (const each of this.commands) each.disabled = !!status.watches || (each === this.seat && status.driver === "program");
    for (const { slider } of this.rows) if (slider) slider.disabled = status.driver === "program";
    this.bar.title = status.watches;
    if (status.watches && !status.text) this.problem.textContent = `${status.watches[0]!.toUpperCase()}${status.watches.slice(1)}.`;
    this.problem.classList.toggle("watching", !!status.watches && !status.text);
  }

  /** Points of the curves. */
  sample({ width, values }: Samples): void {
    for (let row = 0; row < values.length; row += width) this.strips.forEach((strip, k) => strip.add(values[row]!, values[row + 1 + k]!));
  }

  /** Numbers behind a frame: gauges, then the values of the controls. */
  show(time: number, numbers: Float32Array): void {
    this.clock.textContent = `${time.toFixed(2)} s`;
    this.strips.forEach((strip, k) => strip.show(numbers[k] ?? NaN));
    if (!this.operator.driving) this.operator.follow(numbers.subarray(this.gauges.length));
    const now = performance.now();
    if (now - this.drawn < DRAWN) return;
    this.drawn = now;
    for (const strip of this.strips) strip.draw();
    this.rows.forEach((row, k) => {
      const value = numbers[this.gauges.length + k] ?? NaN;
      row.output.textContent = inWords(row.control, value);
      if (row.slider && document.activeElement !== row.slider) row.slider.value = String(this.operator.driving ? this.operator.values[k] : value);
    });
  }

  private parameter(parameter: Parameter, k: number): HTMLElement {
    const { name, unit, value, least } = parameter, [low, high] = span(parameter);
    const slider = el("input", { type: "range", min: low, max: high, step: "any", value, "aria-label": name });
    const number = el("input", { type: "number", step: "any", value, "aria-label": `${name}, as a number` });
    const take = (given: number) => {
      const taken = given >= least ? given : this.chosen[k]!;
      [slider.value, number.value] = [String(taken), String(+taken.toPrecision(6))];
      if (taken !== this.chosen[k]) this.send({ type: "adjust", parameter: k, value: taken });
      this.chosen[k] = taken;
    };
    this.chosen[k] = value;
    slider.addEventListener("input", () => (number.value = String(+Number(slider.value).toPrecision(6))));
    slider.addEventListener("change", () => take(Number(slider.value)));
    number.addEventListener("change", () => take(number.value ? Number(number.value) : value));
    return el("li", { class: "parameter" }, el("span", { class: "name" }, name), el("span", {}, number, ` ${unit}`), slider);
  }

  private row(control: Control, k: number): Row {
    const output = el("output", {}, inWords(control, control.rest));
    const keys = [control.lowers, control.raises].filter(Boolean).map((key) => el("kbd", {}, keyInWords(key)));
    const meant = control.description ? el("small", {}, control.description) : null;
    const name = el("span", { class: "name" }, control.label, ...keys, meant);
    if (control.look === "button") {
      const button = el("button", { type: "button", class: "chip" }, "Press");
      const press = () => this.operator.move(k, control.high);
      const release = () => this.operator.driving && this.operator.move(k, null);
      button.addEventListener("pointerdown", press);
      button.addEventListener("keydown", (event) => (event.key === " " || event.key === "Enter") && press());
      for (const end of ["pointerup", "pointerleave", "pointercancel", "keyup", "blur"]) button.addEventListener(end, release);
      el("li", {}, name, output, button);
      return { control, slider: null, output };
    }
    const slider = el("input", { type: "range", min: control.low, max: control.high, step: "any", value: control.rest, "aria-label": control.label });
    slider.addEventListener("input", () => this.operator.move(k, Number(slider.value)));
    slider.addEventListener("change", () => {
      this.operator.move(k, null);
      if (!control.hold) {
        slider.value = String(control.rest);
        slider.blur();
      }
    });
    el("li", {}, el("label", {}, name, output, slider));
    return { control, slider, output };
  }
}

/** Ends of the slider of a parameter: some times its value, or about zero. */
function span({ value, least }: Parameter): [number, number] {
  if (value < 0) return [SPAN * value, 0];
  const low = value ? 0 : -1;
  return [least > 0 ? value / SPAN ** 2 : Math.max(low, least), value ? SPAN * value : 1];
}

/** A value with its unit; of a lever from -1 to 1, the share of its way. */
function inWords({ unit, low, high }: Control, value: number): string {
  const scale = Math.max(Math.abs(low), Math.abs(high));
  if (!unit && scale === 1) return `${short(Math.round(100 * value))} %`;
  return `${short(+value.toPrecision(3), scale)} ${unit}`.trim();
}

const ARROWS: Record<string, string> = { ArrowLeft: "←", ArrowRight: "→", ArrowUp: "↑", ArrowDown: "↓", " ": "space" };

function keyInWords(key: string): string {
  return ARROWS[key] ?? key.toUpperCase();
}

/** How a machine that nobody operates is taken. */
function hintOf(controls: Control[]): string {
  const ways = [
    ...(controls.some((each) => each.raises || each.lowers) ? ["hold a key"] : []),
    "move a slider",
    ...(controls.some((each) => each.stick) ? ["a stick"] : []),
    ...(controls.some((each) => each.axis >= 0 || each.button >= 0) ? ["a gamepad"] : []),
  ];
  const said = ways.length > 1 ? `${ways.slice(0, -1).join(", ")} or ${ways.at(-1)}` : ways[0]!;
  return `To operate the machine, ${said}.`;
}

function stickInWords(side: string, controls: Control[]): string[] {
  return controls.filter((each) => each.stick.startsWith(side)).map((each) => `${each.stick.endsWith("x") ? "↔" : "↕"} ${each.label}`);
}
