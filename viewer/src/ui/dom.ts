// Elements of the page in few words.
type Child = Node | string | null | undefined | false;
type Attributes = Record<string, string | number | boolean | ((event: any) => void) | undefined>;

export function el<K extends keyof HTMLElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === false) continue;
    if (typeof value === "function") element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? "" : String(value));
  }
  element.append(...children.filter((child): child is Node | string => child !== null && child !== undefined && child !== false));
  return element;
}

// 20 by 20, drawn with lines
const ICONS = {
  play: '<path d="M6.5 4.2v11.6l9-5.8z" fill="currentColor" stroke-linejoin="round"/>',
  pause: '<path d="M6.8 4.5v11M13.2 4.5v11" stroke-width="2.6"/>',
  back: '<path d="M13.5 5l-6 5 6 5zM6 5v10" />',
  forward: '<path d="M6.5 5l6 5-6 5zM14 5v10"/>',
  loop: '<path d="M4 9.5a5 5 0 0 1 5-5h5.5M12 2l2.7 2.5L12 7M16 10.5a5 5 0 0 1-5 5H5.5M8 18l-2.7-2.5L8 13"/>',
  tree: '<path d="M4 4.5h6M4 4.5v11h4M4 10h4M11 10h5M11 15.5h5"/>',
  plot: '<path d="M3.5 3.5v13h13M6 13l3.2-4.5 2.6 2.6L16 5.5"/>',
  eye: '<path d="M2 10s3-5 8-5 8 5 8 5-3 5-8 5-8-5-8-5z"/><circle cx="10" cy="10" r="2.4"/>',
  cube: '<path d="M10 2.8l6.2 3.5v7.4L10 17.2l-6.2-3.5V6.3zM3.8 6.3L10 9.9l6.2-3.6M10 9.9v7.3"/>',
  help: '<circle cx="10" cy="10" r="7.2"/><path d="M7.8 7.8a2.2 2.2 0 1 1 3.2 2c-.7.4-1 .8-1 1.6M10 14.2v.1"/>',
  close: '<path d="M5.5 5.5l9 9M14.5 5.5l-9 9"/>',
  fit: '<path d="M3.5 7V3.5H7M13 3.5h3.5V7M16.5 13v3.5H13M7 16.5H3.5V13"/>',
  target: '<circle cx="10" cy="10" r="5.2"/><path d="M10 2v4M10 14v4M2 10h4M14 10h4"/>',
  path: '<path d="M3 15c3-9 6-9 7-4s4 4 7-6"/><circle cx="17" cy="5" r="1.6" fill="currentColor"/>',
  reset: '<path d="M4.5 10a5.5 5.5 0 1 0 1.8-4.1M6.5 2.5v3.7h3.7"/>',
} as const;
export type IconName = keyof typeof ICONS;

export function icon(name: IconName): SVGSVGElement {
  const holder = document.createElement("template");
  holder.innerHTML = `<svg viewBox="0 0 20 20" width="20" height="20" fill="none" stroke="currentColor" stroke-width="1.6" stroke-linecap="round" stroke-linejoin="round" aria-hidden="true">${ICONS[name]}</svg>`;
  return holder.content.firstElementChild as SVGSVGElement;
}

/** A button with an icon; `label` is what it is called, and shown as a hint with its key. */
export function iconButton(name: IconName, label: string, onclick: () => void, key = ""): HTMLButtonElement {
  return el("button", { type: "button", class: "icon-button", "aria-label": label, title: key ? `${label} (${key})` : label, onclick }, icon(name));
}

/** Swap the icon and name of a button. */
export function renew(button: HTMLButtonElement, name: IconName, label: string, key = ""): void {
  if (button.getAttribute("aria-label") === label) return;
  button.replaceChildren(icon(name));
  button.setAttribute("aria-label", label);
  button.title = key ? `${label} (${key})` : label;
}

/** A button that shows `content` in a dialog over the whole page; closed, it is where it was. */
export function enlarging(label: string, content: HTMLElement): HTMLButtonElement {
  const large = el("dialog", { class: "large-diagram" }, el("form", { method: "dialog" }, el("button", { class: "chip" }, icon("close"), "Close"))) as HTMLDialogElement;
  const mark = document.createComment("");
  const enlarge = () => {
    content.replaceWith(mark);
    large.append(content);
    large.showModal();
  };
  large.addEventListener("close", () => mark.replaceWith(content));
  document.body.append(large);
  return el("button", { type: "button", class: "chip", onclick: enlarge }, icon("fit"), label);
}

export function toggle(label: string, checked: boolean, onchange: (on: boolean) => void): HTMLLabelElement {
  const input = el("input", { type: "checkbox", role: "switch", checked });
  input.addEventListener("change", () => onchange(input.checked));
  return el("label", { class: "toggle" }, input, el("span", {}, label));
}

/** One of some words; the empty one is shown as `nothing`. */
export function choice(label: string, words: readonly string[], nothing: string, onchange: (word: string) => void): HTMLLabelElement {
  const select = el("select", {}, ...words.map((word) => el("option", { value: word }, word || nothing)));
  select.addEventListener("change", () => onchange(select.value));
  return el("label", { class: "choice" }, el("span", {}, label), select);
}

/** A name that goes on in the next line after a dot or underscore, not within a word. */
export function breakable(name: string): (Node | string)[] {
  return name.split(/(?<=[._-])/).flatMap((piece, k) => (k ? [document.createElement("wbr"), piece] : [piece]));
}

const ROUND_OFF = 1e-9; // share of its scale below which a number is zero
const SMALLEST = 1e-3; // scale of a quantity that is round-off throughout, in its SI unit or degrees
const COMMON = ["m", "rad", "deg", "m/s", "rad/s", "m/s^2", "rad/s^2", "N", "N m"]; // units of such quantities

/** The scale of numbers of a unit: the largest of them, or what is usual in the unit. */
export function scaleOf(values: Iterable<number | null>, unit: string): number {
  let scale = COMMON.includes(unit) ? SMALLEST : 0;
  for (const value of values) if (value !== null && Math.abs(value) > scale) scale = Math.abs(value); // passes over NaN
  return Number.isFinite(scale) ? scale : 0;
}

/** A number as people read it: five digits; round-off of its scale is 0. */
export function short(value: number, scale = 0): string {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size <= ROUND_OFF * scale) return "0";
  const text = size >= 1e-3 && size < 1e6 ? String(+value.toPrecision(5)) : value.toExponential(2).replace(/\.?0+e/, "e").replace("e+", "e");
  return text.replace(/^-/, "−").replace("e-", "e−");
}

const PREFIXED = ["N", "N m", "Pa", "J", "W"]; // units that take prefixes
const PREFIXES: readonly [number, string][] = [[1e9, "G"], [1e6, "M"], [1e3, "k"]];

/** Numbers with one unit for all of them, whose prefix suits the largest. scale : of more than these. */
export function measured(values: readonly number[], unit: string, scale = scaleOf(values, unit)): { texts: string[]; unit: string } {
  const size = Math.max(...values.map(Math.abs));
  const [factor, prefix] = (PREFIXED.includes(unit) && PREFIXES.find(([each]) => size >= each)) || [1, ""];
  return { texts: values.map((value) => short(+(value / factor).toPrecision(4), scale / factor)), unit: unit === "1" ? "" : prefix + unit };
}
