// What the colours in the picture mean.
import type { Scale } from "../stage/colours";
import { rampGradient } from "../stage/ramp";
import { el, measured } from "./dom";

export class Legend {
  readonly element = el("div", { class: "legend", role: "group", "aria-label": "Colours" });
  private said = "";
  private readonly nows: HTMLElement[] = [];

  show(scales: readonly Scale[]): void {
    const said = JSON.stringify(scales.map(({ now, ...rest }) => rest));
    if (said !== this.said) {
      this.nows.length = 0;
      this.element.replaceChildren(...scales.map((scale) => this.row(scale)));
      this.said = said;
    }
    scales.forEach((scale, k) => {
      const text = scale.now === null ? "" : inWords(scale);
      if (this.nows[k]!.textContent !== text) this.nows[k]!.textContent = text;
    });
  }

  private row({ quantity, unit, low, high }: Scale): HTMLElement {
    const bar = el("div", { class: "ramp" });
    bar.style.background = rampGradient();
    const { texts, unit: shown } = measured([low, high], unit);
    const now = el("span");
    this.nows.push(now);
    return el("div", { class: "scale" }, el("p", { class: "of" }, `${quantity}${shown ? ` [${shown}]` : ""}`), bar, el("p", { class: "ends" }, el("span", {}, texts[0]), now, el("span", {}, texts[1])));
  }
}

/** The largest at this moment, in the unit of the ends. */
function inWords({ low, high, now, unit }: Scale): string {
  return `now up to ${measured([low, high, now!], unit).texts[2]}`;
}
