// The page: one machine in the picture, perhaps ghosts of it, and what controls them.
import { Columns } from "./columns";
import type { Connection, Frame, Moved, Samples } from "./connection";
import type { FromServer, Stage } from "./generated/records";
import { Motion } from "./motion";
import type { Opened } from "./package";
import { Player } from "./player";
import { Actor, type Picked } from "./stage/actor";
import { Arrows } from "./stage/arrows";
import { Colours } from "./stage/colours";
import { cloudNow, cloudOf } from "./stage/cloud";
import type { Extra } from "./stage/extras";
import { Compass } from "./stage/compass";
import { Labels } from "./stage/labels";
import { Follower } from "./stage/follower";
import { Hand } from "./stage/hand";
import { Handled } from "./stage/handled";
import { listenToPicks } from "./stage/picking";
import { Traces } from "./stage/traces";
import { surroundings } from "./stage/surroundings";
import { Terrain } from "./stage/terrain";
import { Trails } from "./stage/trails";
import { Violations } from "./stage/violations";
import type { View } from "./stage/views";
import { World } from "./stage/world";
import { Coordinates } from "./ui/coordinates";
import { Display } from "./ui/display";
import { el, short, enlarging } from "./ui/dom";
import { Circuit } from "./ui/circuit";
import { diagram } from "./ui/diagram";
import { Inspector } from "./ui/inspector";
import { Legend } from "./ui/legend";
import { helpDialog, listenToKeys } from "./ui/keys";
import { Live } from "./ui/live";
import { Panels, type PanelName } from "./ui/panels";
import { Plots } from "./ui/plots";
import { Timeline } from "./ui/timeline";
import { Tree } from "./ui/tree";

const NOTED = 4000; // ms that a note is shown
const IDLE = 400; // ms without a frame after which nothing moves
const FIRST = 8; // joint coordinates of which the first that moves is plotted
const FEW_NAMES = 14; // a machine of more bodies starts without names

export class App {
  readonly stage: Stage;
  readonly world: World;
  readonly actor: Actor;
  readonly ghosts: { actor: Actor; motion: Motion }[] = [];
  readonly motion: Motion | null;
  readonly terrains: Terrain[];
  readonly player: Player | null = null;
  readonly arrows: Arrows;
  readonly colours: Colours;
  readonly traces: Traces;
  readonly violations: Violations;
  readonly labels: Labels;
  private readonly compass: Compass;
  readonly plots: Plots;
  private readonly follower: Follower;
  private readonly handled: Handled;
  private readonly legend = new Legend();
  private readonly timeline: Timeline | null = null;
  private readonly tree: Tree;
  private readonly inspector: Inspector;
  private readonly circuit: Circuit | null;
  private readonly coordinates: Coordinates | null = null;
  readonly live: Live | null = null;
  private trails: Trails | null = null;
  private hand: Hand | null = null;
  private readonly panels: Panels;
  private readonly dialog: HTMLDialogElement;
  private readonly status = el("p", { class: "status", role: "status" });
  private picked: Picked | null = null;
  private latest: Frame | null = null;
  private noted = 0;
  private came = 0; // ms: when the last frame came

  constructor(
    opened: Opened,
    private readonly connection: Connection | null,
    alone = false,
  ) {
    const { content, arrays } = opened;
    const [stage, ...others] = content.stages;
    if (!stage) throw new Error("there is no machine to show");
    this.stage = stage;
    const holder = el("main", { class: "view" });
    const names = el("div", { class: "labels", "aria-hidden": "true" });
    document.body.replaceChildren(holder);
    document.title = `${stage.name} – nivel`;
    this.motion = stage.motion ? new Motion(stage, arrays) : null;
    this.world = new World(holder, stage);
    this.actor = new Actor(stage, arrays, this.world.look, this.motion, false);
    for (const other of others) {
      const motion = new Motion(other, arrays);
      const ghost = new Actor(other, arrays, this.world.look, motion, true);
      ghost.root.position.set(...other.origin).sub({ x: stage.origin[0], y: stage.origin[1], z: stage.origin[2] });
      this.ghosts.push({ actor: ghost, motion });
      this.world.scene.add(ghost.root);
    }
    if (this.motion) {
      const ghosts = this.ghosts.flatMap(({ actor, motion }) => cloudOf(actor, motion).map((point) => point.add(actor.root.position)));
      this.world.see([...cloudOf(this.actor, this.motion), ...ghosts]);
    }
    this.colours = new Colours(this.actor);
    this.arrows = new Arrows(this.actor, this.world.look);
    this.traces = new Traces(this.actor, this.motion, this.world.look);
    this.violations = new Violations(this.actor, this.world.look);
    this.labels = new Labels(this.actor, names);
    this.labels.shown.body = stage.bodies.length <= FEW_NAMES && content.mode !== "live";
    this.follower = new Follower(this.world, this.actor);
    this.handled = new Handled(this.world, this.actor, (body) => this.follower.toggle(body));
    if (stage.surroundings.length) this.world.scene.add(surroundings(stage, arrays));
    this.terrains = stage.terrains.map((each) => new Terrain(each, arrays, this.actor));
    for (const { mesh, heaps } of this.terrains) this.world.scene.add(mesh, ...heaps);
    this.world.scene.add(this.actor.root, this.arrows.root, this.traces.root, this.violations.root);
    this.compass = new Compass(this.world);
    holder.append(names, this.compass.element, this.legend.element);
    const columns = new Columns(opened, connection);
    const ghostTime = this.ghosts[0]?.motion.time ?? null;
    const times = { main: this.motion?.time ?? new Float64Array(), ghost: ghostTime, ghostTitle: others[0]?.title ?? "", isPath: !!this.motion?.load };
    this.plots = new Plots(columns, times, (time) => this.goTo(time), () => this.inspector?.refresh(), (time) => this.motion?.says(time, short) ?? short(time));
    this.circuit = stage.circuit ? new Circuit(stage.circuit, columns, this.plots) : null;
    this.inspector = new Inspector(stage, columns, this.plots, this.traces, {
      follow: () => this.followOrFit(),
      isFollowed: (picked) => this.follower.name === picked.name,
      change: () => this.refreshFrame(),
      canPlay: content.mode === "playback",
    });
    this.tree = new Tree(stage, (picked) => this.choose(picked));
    if (this.motion && content.mode === "playback") {
      this.player = new Player(this.motion);
      this.timeline = new Timeline(this.player, stage.moments);
      this.player.onChange = () => this.timeline?.refresh();
      this.player.onTime = () => this.showTime();
    }
    if (content.mode === "machine" && connection) {
      this.coordinates = new Coordinates(
        stage.coordinates,
        (coordinate, value) => {
          this.handled.move(coordinate);
          connection?.send({ type: "move", coordinate, value });
        },
        () => this.reset(),
      );
    }
    if (content.mode === "live" && connection) {
      this.trails = new Trails(this.actor, content.traced, content.gauges.length);
      this.world.scene.add(this.trails.root);
      this.actor.show("signs", false);
      const live = new Live(content.controls, content.gauges, (message) => connection.send(message), alone, content.parameters);
      const hand = new Hand(this.world, this.actor, (message) => {
        if (message.on && !live.operator.driving) live.take(true);
        connection.send(message);
      });
      live.onHand = (on) => (hand.isOut = on);
      this.actor.root.add(hand.object);
      this.live = live;
      this.hand = hand;
    }
    if (this.circuit) this.inspector.put(this.circuit.element);
    if (stage.diagram.length) {
      const blocks = diagram(stage.diagram);
      this.inspector.put(el("section", { class: "circuits" }, el("h3", {}, "Block diagram"), enlarging("Large", blocks)));
    }
    this.dialog = helpDialog(this.live?.keys ?? null);
    const data = el("div", {}, this.live?.panel ?? null, this.coordinates?.element ?? null, this.inspector.element);
    const display = new Display(this).element;
    this.panels = new Panels(stage, others, this.world, { structure: this.tree.element, data, display }, this.timeline?.element ?? this.live?.bar ?? null, this.status, () => this.dialog.showModal());
    document.body.append(...this.panels.elements, this.dialog);
    this.panels.settle(!!this.coordinates || !!this.live, !this.live);
    if (this.live) this.panels.rename("data", "Controls and data");
    this.world.onBeforeRender = (now) => this.beforeRender(now);
    this.world.onEdges = (on) => this.actor.show("edges", on);
    this.world.onRecolour = () => this.recolour();
    listenToPicks(this.world, this.actor, this.arrows.root, (picked) => this.choose(picked));
    listenToKeys(this);
    if (this.player) this.showTime();
    else if (this.motion) this.motion.sample(this.motion.start, this.actor.frame);
    this.refreshFrame();
    if (this.live) this.handled.watchAll();
    this.world.now = () => cloudNow(this.actor);
    if (content.mode === "machine" || this.live) this.world.around = () => cloudNow(this.actor);
    if (this.player) void this.plotFirst(columns);
  }

  /** Plot the first joint coordinate that moves by more than round-off. */
  private async plotFirst(columns: Columns): Promise<void> {
    const some = columns.list().filter((column) => /\.(angle|displacement)$/.test(column.name)).slice(0, FIRST);
    const ways = await Promise.all(some.map(async (column) => way(await columns.get(0, column.name))));
    const first = some[ways.findIndex((each) => each > 1e-6 * Math.max(...ways))] ?? some[0];
    if (first) void this.plots.show([first.name]);
  }

  // --- time ---

  goTo(time: number): void {
    this.player?.toggle(false);
    this.player?.seek(time);
  }

  /** Show the frame of the player's time. */
  private showTime(): void {
    const { player, motion } = this;
    if (!player || !motion) return;
    motion.sample(player.time, this.actor.frame);
    this.actor.time = player.time;
    for (const each of this.terrains) each.goTo(player.time);
    for (const ghost of this.ghosts) {
      ghost.motion.sample(player.time, ghost.actor.frame);
      ghost.actor.time = player.time;
      ghost.actor.apply();
    }
    this.world.running = player.playing;
    this.refreshFrame();
    this.timeline?.tick();
    this.plots.moveTo(player.time);
    this.inspector.moveTo(player.frame);
    this.circuit?.moveTo(player.frame);
  }

  /** A frame from the server; it is acknowledged when it is drawn. */
  take(frame: Frame): void {
    this.latest = frame;
    this.came = performance.now();
    this.world.running = true;
    this.world.invalidate();
  }

  /** Samples from the server: curves and paths are the same on every page, however many frames it shows. */
  sample(samples: Samples): void {
    this.live?.sample(samples);
    this.trails?.add(samples);
  }

  /** Ground of a machine that lives has moved. */
  deform(moved: Moved): void {
    this.terrains[moved.terrain]?.take(moved);
    this.world.invalidate();
  }

  message(message: FromServer): void {
    if (message.type === "note") this.note(message.text);
    if (message.type === "status") this.live?.update(message);
    if (message.type === "moved") this.coordinates?.update(message.values, this.stage.coordinates, message.problem);
  }

  /** Save the frames of a machine that lives in the page. */
  saveTable(text: Uint8Array): void {
    const link = el("a", { href: URL.createObjectURL(new Blob([text as BlobPart], { type: "text/csv" })), download: `${this.stage.name}.csv` });
    link.click();
    URL.revokeObjectURL(link.href);
  }

  say(text: string): void {
    clearTimeout(this.noted);
    this.status.textContent = text;
  }

  /** Say something that is soon out of date. */
  private note(text: string): void {
    this.say(text);
    this.noted = window.setTimeout(() => this.say(""), NOTED);
  }

  private beforeRender(now: number): void {
    this.player?.advance(now);
    if (this.came && now - this.came > IDLE) this.world.running = false;
    if (this.latest) {
      this.actor.frame.set(this.latest.values.subarray(0, this.actor.frame.length));
      this.live?.show(this.latest.time, this.latest.values.subarray(this.actor.frame.length));
      // the next one may travel while this one is drawn
      this.connection?.send({ type: "shown", frame: this.latest.number });
      this.latest = null;
      this.refreshFrame();
      if (this.live) this.colours.spread();
      this.hand?.update();
      this.handled.keepInSight();
    }
    const { clientWidth, clientHeight } = this.world.holder;
    for (const actor of [this.actor, ...this.ghosts.map((ghost) => ghost.actor)]) actor.look(this.world.camera, clientHeight);
    this.labels.update(this.world.camera, clientWidth, clientHeight, !this.world.running);
    this.compass.update();
  }

  /** Everything that depends on the frame that is shown. */
  refreshFrame(): void {
    this.actor.apply();
    for (const each of this.terrains) each.update();
    this.legend.show(this.colours.scales());
    this.follower.update();
    this.arrows.update();
    this.violations.update();
    this.traces.update(this.player?.frame ?? 0);
    this.world.invalidate();
  }

  // --- what is chosen and shown ---

  choose(picked: Picked | null): void {
    this.picked = picked;
    this.actor.mark(picked, this.world.look);
    this.tree.select(picked);
    this.inspector.select(picked);
    if (picked) this.panels.offer("data");
    this.refreshFrame();
  }

  followOrFit(): void {
    if (this.picked?.kind === "body") this.follower.toggle(this.picked.name);
    else {
      this.follower.stop();
      this.world.fitNow();
    }
    this.inspector.refresh();
  }

  look(view: View): void {
    this.follower.stop();
    this.world.view(view);
    this.inspector.refresh();
  }

  /** Change something of the picture. */
  change(what: () => void): void {
    what();
    this.refreshFrame();
  }

  show(what: "signs" | Extra, on: boolean): void {
    this.change(() => this.actor.show(what, on));
  }

  name(kind: "body" | "joint" | "force", on: boolean): void {
    this.change(() => (this.labels.shown[kind] = on));
  }

  /** Colour beams, or flexible bodies, by one of their quantities; whether there is such a one. */
  colour(quantity: string): boolean {
    const { ofBeams, ofBodies, all } = this.colours;
    if (ofBeams.includes(quantity)) this.change(() => this.colours.beams(quantity));
    if (ofBodies.includes(quantity)) this.change(() => this.colours.bodies(quantity));
    return all.includes(quantity);
  }

  /** The picture alone, without controls. */
  bare(side: View, fine: boolean): void {
    if (fine) this.world.drawFinely();
    document.body.classList.add("bare");
    this.panels.close();
    this.world.keepFree({ left: 0, top: 0, right: 0, bottom: 0 });
    this.world.view(side, false);
  }

  toggleNames(): void {
    this.name("body", !this.labels.shown.body);
  }

  showGhosts(on: boolean): void {
    this.change(() => this.ghosts.forEach((ghost) => (ghost.actor.root.visible = on)));
  }

  togglePanel(name: PanelName): void {
    this.panels.toggle(name);
  }

  help(): void {
    this.dialog.showModal();
  }

  escape(): void {
    if (this.dialog.open) this.dialog.close();
    else if (this.picked) this.choose(null);
    else this.panels.closeTop();
  }

  /** A machine moved by hand goes back to its assembled position. */
  reset(): void {
    if (this.live) {
      this.live.say("reset");
      return;
    }
    this.connection?.send({ type: "reset" });
  }

  private recolour(): void {
    const { look } = this.world;
    this.actor.recolour(look);
    for (const ghost of this.ghosts) ghost.actor.recolour(look);
    this.arrows.recolour(look);
    this.traces.recolour(look);
    this.violations.recolour(look);
    this.actor.mark(this.picked, look);
  }
}

/** How far the numbers of a column go; 0 where it cannot be read. */
function way(values: Float32Array | string): number {
  if (typeof values === "string") return 0;
  let low = Infinity;
  let high = -Infinity;
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return Math.max(high - low, 0);
}
