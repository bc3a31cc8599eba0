// A stick on the page: a knob that is dragged within a square and goes back when it is let go.
import { el } from "./dom";

const REACH = 38; // pixels of the knob to each side

export class Stick {
  readonly element: HTMLElement;
  private readonly knob = el("i", {});

  constructor(
    side: "left" | "right",
    label: string[],
    private readonly moved: (stick: string, value: number) => void,
  ) {
    const stick = el("div", { class: "stick", role: "application", "aria-label": label.join(", ") }, this.knob);
    this.element = el("figure", {}, stick, el("figcaption", {}, ...label.map((each) => el("span", {}, each))));
    const to = (x: number, y: number) => {
      this.knob.style.transform = `translate(${x * REACH}px, ${-y * REACH}px)`;
      this.moved(`${side}-x`, x);
      this.moved(`${side}-y`, y);
    };
    const drag = (event: PointerEvent) => {
      const box = stick.getBoundingClientRect();
      const limited = (value: number) => Math.min(Math.max(value, -1), 1);
      to(limited((event.clientX - box.left - box.width / 2) / REACH), limited((box.top + box.height / 2 - event.clientY) / REACH));
    };
    stick.addEventListener("pointerdown", (event) => {
      stick.setPointerCapture(event.pointerId);
      drag(event);
    });
    stick.addEventListener("pointermove", (event) => event.buttons && drag(event));
    for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) stick.addEventListener(end, () => to(0, 0));
  }
}
