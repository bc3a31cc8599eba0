// The bar at the bottom: play, time, speed, and where in the motion it is.
import type { Moment } from "../generated/records";
import type { Motion } from "../motion";
import { SPEEDS, type Player } from "../player";
import { el, iconButton, renew } from "./dom";

const LOAD_DIGITS = 3; // of a load factor, behind the point

export class Timeline {
  readonly element: HTMLElement;
  private readonly play: HTMLButtonElement;
  private readonly slider: HTMLInputElement;
  private readonly now: HTMLElement;
  private readonly speed: HTMLSelectElement;
  private readonly loop: HTMLButtonElement;
  private readonly digits: number;

  constructor(
    private readonly player: Player,
    moments: Moment[],
  ) {
    const { motion } = player;
    const span = motion.end - motion.start;
    const needed = Math.ceil(-Math.log10((span || 1) / Math.max(motion.count - 1, 1)) + 0.001);
    this.digits = Math.min(Math.max(needed, motion.load ? LOAD_DIGITS : 1), 6);
    this.play = iconButton("play", "Play", () => player.toggle(), "space");
    this.play.classList.add("main-button");
    this.slider = el("input", { type: "range", class: "scrub", min: 0, max: 1, step: "any", value: 0, "aria-label": motion.load ? "Path of equilibria" : "Time" });
    this.slider.addEventListener("input", () => {
      const share = Number(this.slider.value); // to pause puts the slider back to where the motion is
      player.toggle(false);
      player.seek(motion.start + share * span);
    });
    this.now = el("output", { class: "time", "aria-live": "off" });
    this.speed = el("select", { "aria-label": "Speed", title: "Speed (+ and −)" }, ...SPEEDS.map((s) => el("option", { value: s }, `${s}×`)));
    this.speed.addEventListener("change", () => {
      player.speed = Number(this.speed.value);
      player.onChange();
    });
    this.loop = iconButton("loop", "Repeat", () => {
      player.loop = !player.loop;
      player.onChange();
    }, "L");
    const end = motion.load ? `${motion.count} states` : motion.says(motion.end, (value) => this.inWords(value));
    const track = el("div", { class: "track" }, this.slider, el("div", { class: "ticks", "aria-hidden": "true" }, ...ticks(moments, motion)));
    this.element = el(
      "footer",
      { class: "timeline", role: "group", "aria-label": "Playback" },
      el("div", { class: "transport" }, iconButton("back", "One frame back", () => player.step(-1), "←"), this.play, iconButton("forward", "One frame on", () => player.step(1), "→")),
      el("div", { class: "clock" }, this.now, el("span", { class: "of" }, ` / ${end}`)),
      track,
      el("div", { class: "pace" }, this.speed, this.loop),
    );
    this.refresh();
    this.tick();
  }

  private inWords(time: number): string {
    const text = time.toFixed(this.digits);
    return Number(text) === 0 ? text.replace("-", "") : text.replace("-", "−");
  }

  /** What changes by hand. */
  refresh(): void {
    const { player } = this;
    renew(this.play, player.playing ? "pause" : "play", player.playing ? "Pause" : "Play", "space");
    this.speed.value = String(player.speed);
    this.loop.setAttribute("aria-pressed", String(player.loop));
    this.play.disabled = player.motion.count < 2;
  }

  /** What changes with time. */
  tick(): void {
    const { start, end } = this.player.motion;
    const share = end > start ? (this.player.time - start) / (end - start) : 0;
    this.slider.value = String(share);
    this.slider.style.setProperty("--share", `${100 * share}%`);
    const text = this.player.motion.says(this.player.time, (value) => this.inWords(value));
    this.now.textContent = text;
    this.slider.setAttribute("aria-valuetext", text);
  }
}

function ticks(moments: Moment[], motion: Motion): HTMLElement[] {
  const { start } = motion;
  const span = motion.end - start;
  return moments
    .filter((each) => span > 0 && each.time >= start && each.time <= start + span)
    .map((each) => {
      const tick = el("i", { title: `${each.name}, ${motion.says(each.time, (value) => value.toPrecision(5))}` });
      tick.style.left = `${(100 * (each.time - start)) / span}%`;
      return tick;
    });
}
