// A stick on the page: a knob that is dragged within a square and goes back when it is let go.
import { el } from "./dom";

const REACH = 38; // pixels of the knob to each side

export class Stick {
  readonly element: HTMLElement;
  private readonly knob = el("i", {});

  constructor(
    side: "left" | "right",
    label: string,
    private readonly moved: (stick: string, value: number) => void,
  ) {
    this.element = el("div", { class: "stick", role: "application", "aria-label": label, title: label }, this.knob);
    const to = (x: number, y: number) => {
      this.knob.style.transform = `translate(${x * REACH}px, ${-y * REACH}px)`;
      this.moved(`${side}-x`, x);
      this.moved(`${side}-y`, y);
    };
    const drag = (event: PointerEvent) => {
      const box = this.element.getBoundingClientRect();
      const limited = (value: number) => Math.min(Math.max(value, -1), 1);
      to(limited((event.clientX - box.left - box.width / 2) / REACH), limited((box.top + box.height / 2 - event.clientY) / REACH));
    };
    this.element.addEventListener("pointerdown", (event) => {
      this.element.setPointerCapture(event.pointerId);
      drag(event);
    });
    this.element.addEventListener("pointermove", (event) => event.buttons && drag(event));
    for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) this.element.addEventListener(end, () => to(0, 0));
  }
}
