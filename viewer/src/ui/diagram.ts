// The machine as a block diagram, laid out by dagre. A click on a box shows its lines of the machine file.
import { Graph, layout } from "@dagrejs/dagre";
import type { DiagramBox } from "../generated/records";
import "./diagram.css";
import { el } from "./dom";

const HIGH = 38; // px of a box
const LETTER = 7.3; // px of one in a name
const LETTERS = 24; // of a name that are shown

const svg = (name: string, attributes: Record<string, string | number>, ...inner: (Element | string)[]): SVGElement => {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  element.append(...inner);
  return element;
};

/** A smooth line through the points. */
function smooth(points: { x: number; y: number }[]): string {
  const at = (k: number) => points[Math.min(k, points.length - 1)]!;
  let path = `M${at(0).x.toFixed(1)} ${at(0).y.toFixed(1)}`;
  for (let k = 1; k < points.length - 1; k += 1) {
    const [here, next] = [at(k), at(k + 1)];
    const end = k === points.length - 2 ? next : { x: (here.x + next.x) / 2, y: (here.y + next.y) / 2 };
    path += ` Q${here.x.toFixed(1)} ${here.y.toFixed(1)} ${end.x.toFixed(1)} ${end.y.toFixed(1)}`;
  }
  return path;
}

function drawn(box: DiagramBox, place: { x: number; y: number; width: number; height: number }): SVGElement {
  const { x, y, width, height } = place;
  const name = box.name.length > LETTERS ? `${box.name.slice(0, LETTERS - 1)}…` : box.name;
  const rect = svg("rect", { x: x - width / 2, y: y - height / 2, width, height, rx: box.kind === "joint" ? height / 2 : 6 });
  const texts = [svg("text", { x, y: box.words ? y - 2 : y + 4.5 }, name)];
  if (box.words) texts.push(svg("text", { class: "kind", x, y: y + 12.5 }, box.words));
  const said = `${box.name}${box.line ? `, line ${box.line}` : ""}`;
  return svg("g", { class: box.kind, ...(box.line ? { tabindex: 0, role: "button", "aria-label": said } : {}) }, svg("title", {}, said), rect, ...texts);
}

/** The picture with the lines below it. */
export function diagram(boxes: DiagramBox[]): HTMLElement {
  const graph = new Graph({ multigraph: true });
  graph.setGraph({ rankdir: "LR", nodesep: 14, ranksep: 44, marginx: 6, marginy: 6 });
  boxes.forEach((box, number) => {
    if (number === 0 && !boxes.some((each) => each.joins.includes(0))) return; // nothing stands on the ground
    const wide = LETTER * Math.max(Math.min(box.name.length, LETTERS), 0.86 * box.words.length) + 24;
    graph.setNode(String(number), { width: Math.max(wide, 64), height: HIGH });
  });
  // from the ground on outwards; signals go to their readers
  boxes.forEach((box, number) => {
    const [first, ...others] = box.joins;
    if (box.kind === "joint" && first !== undefined) graph.setEdge(String(first), String(number), { kind: "join", weight: 4 }, "join");
    for (const other of box.kind === "joint" ? others : box.joins) graph.setEdge(String(number), String(other), { kind: "join", weight: box.kind === "joint" ? 4 : 1 }, "join");
    for (const other of box.reads) graph.setEdge(String(other), String(number), { kind: "signal", weight: 1 }, "signal");
  });
  layout(graph);
  const { width = 0, height = 0 } = graph.graph() as { width?: number; height?: number };
  const tip = svg("marker", { id: "signal-tip", viewBox: "0 0 7 7", refX: 7, refY: 3.5, markerWidth: 7, markerHeight: 7, orient: "auto" }, svg("path", { d: "M0 0 7 3.5 0 7z", class: "tip" }));
  const lines = graph.edges().map((edge) => {
    const { points, kind } = graph.edge(edge) as unknown as { points: { x: number; y: number }[]; kind: string };
    return svg("path", { class: kind, d: smooth(points), "data-from": edge.v, "data-to": edge.w, ...(kind === "signal" ? { "marker-end": "url(#signal-tip)" } : {}) });
  });
  const picture = svg("svg", { class: "block-diagram", viewBox: `0 0 ${width.toFixed(0)} ${height.toFixed(0)}`, width: width.toFixed(0), role: "group", "aria-label": "block diagram of the machine" }, svg("defs", {}, tip), ...lines);
  const text = el("pre", { class: "lines", hidden: true });
  for (const number of graph.nodes()) {
    const box = boxes[Number(number)]!;
    const shape = drawn(box, graph.node(number) as { x: number; y: number; width: number; height: number });
    const mark = (on: boolean) => lines.filter((line) => [line.getAttribute("data-from"), line.getAttribute("data-to")].includes(number)).forEach((line) => line.classList.toggle("marked", on));
    shape.addEventListener("pointerenter", () => mark(true));
    shape.addEventListener("pointerleave", () => mark(false));
    const show = () => {
      for (const each of picture.querySelectorAll(".chosen")) each.classList.remove("chosen");
      shape.classList.add("chosen");
      text.hidden = !box.line;
      text.textContent = box.lines.split("\n").map((line, k) => `${String(box.line + k).padStart(4)}  ${line}`).join("\n");
    };
    shape.addEventListener("click", show);
    shape.addEventListener("keydown", (event) => {
      if (event.key === "Enter" || event.key === " ") show();
    });
    picture.append(shape);
  }
  return el("div", { class: "blocks" }, el("div", { class: "diagram" }, picture), text);
}
