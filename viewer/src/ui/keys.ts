// What the keys do, and the page that says so.
import type { App } from "../app";
import { VIEWS } from "../stage/views";
import { el, iconButton } from "./dom";

const SAID: readonly [string, string][] = [
  ["space", "play and pause"],
  ["← →", "one frame; ten with shift"],
  ["home end", "to the start, to the end"],
  ["+ −", "faster, slower"],
  ["L", "repeat"],
  ["0 to 6", "first view, front, right, top, back, left, below"],
  ["F", "follow the chosen body; fit everything where none is chosen"],
  ["alt + arrows", "turn the view; with page up and down, zoom"],
  ["N", "names"],
  ["S, D", "structure, display"],
  ["P", "data and plots"],
  ["esc", "close, choose nothing"],
  ["?", "this list"],
];

const SAID_LIVE: readonly [string, string][] = [
  ["space", "run and pause"],
  ["R", "back to the start"],
  ...SAID.filter(([key]) => !/^(space|← →|home end|\+ −|L)$/.test(key)),
];

/** live : what the keys of a live machine do, or null; they come before those of the page. */
export function helpDialog(live: [string, string][] | null): HTMLDialogElement {
  const taken = new Set(live?.flatMap(([keys]) => keys.split(" ")));
  const page = live ? SAID_LIVE.filter(([keys]) => !keys.split(/,? /).some((key) => taken.has(key))) : SAID;
  const dialog: HTMLDialogElement = el(
    "dialog",
    { class: "help", "aria-label": "Keys and mouse" },
    el("header", {}, el("h2", {}, "Keys and mouse"), iconButton("close", "Close", () => dialog.close())),
    el("dl", {}, ...[...(live ?? []), ...page].flatMap(([key, what]) => [el("dt", {}, key), el("dd", {}, what)])),
    el("p", { class: "note" }, "Drag to turn, right button or two fingers to move, wheel or pinch to zoom, click a part to choose it, click a plot to go to its time. Of a live machine, shift and drag pulls a body."),
  );
  return dialog;
}

/** Whether the element needs the key for itself. */
function isTaken(target: EventTarget | null, key: string): boolean {
  if (!(target instanceof HTMLElement)) return false;
  if (target instanceof HTMLInputElement && (target.type === "search" || target.type === "text")) return key !== "Escape";
  if (target instanceof HTMLInputElement && target.type === "range") return !target.classList.contains("scrub") && /Arrow|Home|End|Page/.test(key);
  if (target instanceof HTMLSelectElement) return key !== "Escape";
  if (target instanceof HTMLButtonElement || target instanceof HTMLInputElement || target.tagName === "SUMMARY") return key === " " || key === "Enter";
  return false;
}

export function listenToKeys(app: App): void {
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || isTaken(event.target, event.key)) return;
    if (handle(app, event)) event.preventDefault();
  });
}

function handle(app: App, event: KeyboardEvent): boolean {
  const { key } = event;
  const step = event.shiftKey ? 10 : 1;
  if (event.altKey) return turn(app, key);
  const view = VIEWS[Number(key)];
  if (/^[0-6]$/.test(key) && view) return did(app.look(view));
  if (key === "?") return did(app.help());
  if (key === "Escape") return did(app.escape());
  if (/^f$/i.test(key)) return did(app.followOrFit());
  if (/^n$/i.test(key)) return did(app.toggleNames());
  if (/^s$/i.test(key)) return did(app.togglePanel("structure"));
  if (/^d$/i.test(key)) return did(app.togglePanel("display"));
  if (/^p$/i.test(key)) return did(app.togglePanel("data"));
  if (/^r$/i.test(key)) return did(app.reset());
  const { player, live } = app;
  if (live && key === " ") return did(live.toggle());
  if (!player) return false;
  if (key === " ") return did(player.toggle());
  if (key === "ArrowLeft") return did(player.step(-step));
  if (key === "ArrowRight") return did(player.step(step));
  if (key === "Home" || key === "End") {
    player.toggle(false);
    return did(player.seek(key === "Home" ? player.motion.start : player.motion.end));
  }
  if (key === "+" || key === "=") return did(player.faster(1));
  if (key === "-" || key === "−") return did(player.faster(-1));
  if (/^l$/i.test(key)) {
    player.loop = !player.loop;
    return did(player.onChange());
  }
  return false;
}

function turn(app: App, key: string): boolean {
  const angle = Math.PI / 24;
  const turns: Record<string, [number, number]> = { ArrowLeft: [-angle, 0], ArrowRight: [angle, 0], ArrowUp: [0, angle], ArrowDown: [0, -angle] };
  const by = turns[key];
  if (by) return did(app.world.orbit(...by));
  if (key === "PageUp") return did(app.world.zoom(0.87));
  if (key === "PageDown") return did(app.world.zoom(1.15));
  return false;
}

function did(_: void): true {
  return true;
}
