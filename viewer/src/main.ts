// Where the page begins: its data are in it, or come from the server that it came from.
import { App } from "./app";
import { Connection, type Link } from "./connection";
import { hasMachine, startMachine } from "./local/link";
import { inflate, openPackage } from "./package";
import type { View } from "./stage/views";
import "./style.css";

const LOST = 3; // attempts in vain after which the program counts as gone

function complain(text: string): void {
  const message = document.createElement("p");
  message.className = "complaint";
  message.setAttribute("role", "alert");
  message.textContent = text;
  document.body.replaceChildren(message);
}

function inWords(error: unknown): string {
  const text = error instanceof Error ? error.message : String(error);
  return /WebGL/i.test(text) ? "This browser shows no three-dimensional pictures (WebGL is missing or switched off)." : `The machine cannot be shown: ${text}.`;
}

/** What programs that drive the page use: tests, `nivel view --still` and `--export film.mp4`. */
interface Remote {
  app: App;
  /** Hide all controls and look from a side; fine : draw smoothly, however slowly. */
  bare(side: View, fine: boolean): void;
  /** First and last time. */
  span(): [number, number];
  /** Show a moment; done when it is on the screen. */
  pose(time: number): Promise<void>;
  /** Pictures drawn so far. */
  frames(): number;
}
declare global {
  interface Window {
    nivel?: Remote;
  }
}

function present(app: App): void {
  window.nivel = {
    app,
    bare: (side, fine) => app.bare(side, fine),
    span: () => [app.motion?.start ?? 0, app.motion?.end ?? 0],
    pose: (time) => {
      app.goTo(time);
      return new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done())));
    },
    frames: () => app.world.frameCount,
  };
}

/** The server that the page came from. */
function server(): Link {
  const token = new URLSearchParams(location.search).get("token");
  const address = `${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/stream${token ? `?token=${encodeURIComponent(token)}` : ""}`;
  const socket = new WebSocket(address);
  socket.binaryType = "arraybuffer";
  return socket as Link;
}

/** alone : the machine is in the page, and no server is asked for it. */
function connect(link: () => Link, alone: boolean): void {
  let app: App | null = null;
  const connection = new Connection(link, {
    onPackage(bytes) {
      try {
        app = new App(openPackage(bytes), connection, alone);
        present(app);
      } catch (error) {
        complain(inWords(error));
        throw error;
      }
    },
    onFrame: (frame) => app?.take(frame),
    onSamples: (samples) => app?.sample(samples),
    onMoves: (moved) => app?.deform(moved),
    onMessage: (message) => app?.message(message),
    onTable: (text) => app?.saveTable(text),
    onOther: () => location.reload(),
    onState: (connected, failures) => {
      if (!connected) app?.live?.lose();
      app?.say(connected ? "" : failures < LOST ? "The connection was lost; it is tried again." : "The program that shows this page has ended; what is here stays.");
    },
  });
}

async function start(): Promise<void> {
  if (hasMachine()) {
    const link = await startMachine(complain);
    connect(() => link, true);
    return;
  }
  const embedded = document.getElementById("package");
  if (!embedded?.textContent?.trim()) {
    connect(server, false);
    return;
  }
  try {
    const app = new App(openPackage(await inflate(embedded.textContent)), null);
    embedded.remove();
    present(app);
    // asked for by the address of an exported page, or by the frame of a report
    if (location.hash === "#play" || window.name === "play") app.player?.toggle(true);
  } catch (error) {
    complain(inWords(error));
    throw error;
  }
}

void start();
