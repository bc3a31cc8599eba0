// Written by `python -m nivel.view.typescript` from records.py and local.py. Do not edit.

export const PROTOCOL = 1;
export const PACKAGE = 1;
export const FRAME = 2;
export const SAMPLES = 4;
export const COLUMN = 3;
export const TABLE = 5;
export const MOVES = 6;

/** An element, or all components of circuits that neither act on bodies nor read signals. kind : how it is drawn. words : what it is. joins : numbers of the boxes that it connects or acts on. reads : numbers of those whose signals it reads. line, lines : where its lines in the machine file begin, and their text; 0 and empty where it does not stand there. */
export interface DiagramBox {
  name: string;
  kind: string;
  words: string;
  joins: number[];
  reads: number[];
  line: number;
  lines: string;
}

/** An array in the block of bytes. kind : f4, f8, u4 or u2, little-endian. start : its first byte. The bytes are shuffled, which compresses better: the first bytes of all numbers, then the second bytes, and so on. */
export interface Packed {
  kind: "f4" | "f8" | "u4" | "u2";
  shape: number[];
  start: number;
}

/** Numbers rounded to 65536 even steps: low[i] + step[i] * numbers[i, …]. */
export interface Steps {
  numbers: Packed;
  low: number[];
  step: number[];
}

/** A solid in the body frame with its centre at `centre`. size : box: along x, y, z; cylinder, capsule: radius, length; tube: outer, inner radius, length; sphere: radius; ellipsoid: semi-axes; extrusion: length; a capsule's length is that of its straight part. along : the axis of round bars and extrusions. outline : of an extrusion, corners in the two axes that follow `along`. vertices (n, 3), triangles (m, 3) : of a mesh. colour : empty, that of the body. */
export interface Part {
  kind: "box" | "cylinder" | "tube" | "sphere" | "ellipsoid" | "capsule" | "extrusion" | "mesh";
  centre: [number, number, number];
  size: number[];
  along: "x" | "y" | "z";
  outline: [number, number][];
  vertices: Packed | null;
  triangles: Packed | null;
  colour: string;
}

/** A body. links : points of its frame to which automatic links lead from the centre of mass. held : where joints hold it. automatic : it is drawn as a ball with links where it has no parts; not so where it deforms or is part of a sweep. */
export interface Body {
  name: string;
  colour: string;
  centre_of_mass: [number, number, number];
  parts: Part[];
  links: [number, number, number][];
  held: [number, number, number][];
  automatic: boolean;
  facts: [string, string][];
}

/** Von Mises stress [Pa] of a flexible body: that of Σ q_k modes[k] at stations, the largest of those of a vertex. modes (modes, 6, stations) : xx, yy, zz, xy, yz, zx. stations (n, 2) : of each vertex the first, and the one after the last; equal where its stress is not known. high : the largest of the motion. */
export interface Stress {
  modes: Steps;
  stations: Packed;
  high: number;
}

/** A mesh that deforms: a vertex is vertices + Σ q_k modes[k], in the body's frame; q are modal coordinates of the frame. vertices (n, 3), triangles (m, 3), modes (modes, n, 3). first : place of its first modal coordinate among those of the frame. field : (modes, n) what the colours show is Σ q_k field[k], or without it the length of the displacement; low, high : ends of the colours, in `unit`. */
export interface Flexible {
  body: number;
  name: string;
  vertices: Packed;
  triangles: Packed;
  modes: Packed;
  first: number;
  low: number;
  high: number;
  unit: string;
  quantity: string;
  field: Packed | null;
  stress: Stress | null;
}

/** A joint: points and axes on its two bodies, in their frames. slot : direction of a slot in the second body. place : at which of the two points its sign stands. rod : it is a massless link between them. violation : places of the two vectors of its constraint violation among those of the frame: how far the second point is from where it should be, and how far the second frame is turned, in axes of the first marker turned into global ones; -1 without. */
export interface Joint {
  name: string;
  kind: string;
  bodies: [number, number];
  points: [[number, number, number], [number, number, number]];
  axes: [[number, number, number], [number, number, number]];
  x_axes: [[number, number, number], [number, number, number]] | null;
  slot: [number, number, number] | null;
  place: 0 | 1;
  rod: boolean;
  violation: number;
  facts: [string, string][];
}

/** How a rope runs around wheels at its points. carrier : number of the point whose body carries their `axis`, in its frame. radii : of each point, positive where the rope runs right-handed about the axis, 0 without a wheel. arcs : angles [rad] on the wheels as the bodies are placed. fixed : directions in which the rope is fixed on a drum at its first and last point, in the frames of their bodies. */
export interface Winding {
  axis: [number, number, number];
  carrier: number;
  radii: number[];
  arcs: number[];
  fixed: [[number, number, number], [number, number, number]];
}

/** A force element, or a driver. points : of the two ends, or the one where it acts, or of the joint that it works on; none where that is not known. axis : of a coil or of what works on a joint, or normal of a contact's plane; in the first body's frame, a normal in the second's. look : what is drawn between the ends, or at the first of them: `turn` and `slide` drive a joint about and along its axis, a `ring` holds it, a `dot` is where something acts on one body, a `rope` goes from point to point, of which it may have more than two, or around wheels as `winding` says. sizes : of a hydraulic cylinder: radii of its barrel and rod, length of its barrel [m]. Of a `track`, whose points are both ends of its belt and its sprocket, and whose axis points away from the ground: radius of the sprocket, width and thickness of the shoes. */
export interface Force {
  name: string;
  kind: string;
  bodies: number[];
  points: [number, number, number][];
  axis: [number, number, number] | null;
  look: "nothing" | "spring" | "damper" | "spring-damper" | "cylinder" | "coil" | "bushing" | "plane" | "turn" | "slide" | "ring" | "dot" | "rope" | "track";
  facts: [string, string][];
  sizes: number[];
  winding: Winding | null;
}

/** A pitch circle on a body, in its frame. */
export interface Wheel {
  body: number;
  centre: [number, number, number];
  axis: [number, number, number];
  radius: number;
}

/** The pitch line of a rack on a body, in its frame: as far as `half` to both sides of a point. */
export interface Track {
  body: number;
  point: [number, number, number];
  along: [number, number, number];
  half: number;
}

/** A point of a body, in its frame. */
export interface End {
  body: number;
  point: [number, number, number];
}

/** A gear, belt, rack or other equation between joint coordinates. belt : how one runs about the two wheels. joined : points that a line joins where no wheels are known. */
export interface Coupling {
  name: string;
  kind: string;
  wheels: Wheel[];
  tracks: Track[];
  joined: End[];
  belt: "none" | "open" | "crossed";
  facts: [string, string][];
}

/** A section drawn along a line through frames of bodies, in their order, which bends with them: a beam, a hose, a rope. bodies : two or more. points, axes : in the frame of each body where the line passes, and its direction there. section : corners (y, z) of the section, counter-clockwise, in axes of which x is the line's direction and y, z are `across` of each body and what completes it. hollow : corners of the hole, or none. smooth : between two frames the line is a cubic that leaves and arrives along their axes (Hermite), else straight. */
export interface Sweep {
  name: string;
  colour: string;
  bodies: number[];
  points: [number, number, number][];
  axes: [number, number, number][];
  across: [number, number, number][];
  section: [number, number][];
  hollow: [number, number][];
  smooth: boolean;
}

/** Soil in a bucket, about a point of its frame. half : from there to the end of its edge. slot : of the volumes that are carried. */
export interface Load {
  slot: number;
  body: number;
  point: [number, number, number];
  half: [number, number, number];
}

/** Ground that deforms: `heights` [m] of nodes in rows along x over a plane through `corner`; cells have the sides `along` and `across`. Nodes move by whole steps [m]. time (k,) [s] : of moments, none where moves come as messages; ends (k,) : numbers of moves up to each. nodes (n,) : that move, each as what is added to the one before; moves (n,) : steps, negative ones behind 65536. carried (k, slots): m³. */
export interface Terrain {
  name: string;
  corner: [number, number, number];
  along: [number, number, number];
  across: [number, number, number];
  step: number;
  loads: Load[];
  heights: Packed;
  time: Packed;
  ends: Packed;
  nodes: Packed;
  moves: Packed;
  carried: Packed;
}

/** What colours of beams can show, from `low` to `high` in the motion. rows : one of the numbers of a point, or the length of several. A point has 12: strains (stretch, two shears), twist and two curvatures; then force and moment of the section in its axes. */
export interface Quantity {
  name: string;
  unit: string;
  rows: number[];
  low: number;
  high: number;
}

/** What points along a sweep feel. sweep : its place in the stage. places (p,) : numbers of frames of bodies, with fractions, ascending. strain (6, n, p) : of the frames of `Sections.time`. stiffness (6, 6) : force and moment of a point are stiffness times its strain. */
export interface Felt {
  sweep: number;
  places: number[];
  strain: Steps;
  stiffness: number[][];
}

/** What the sections of beams feel at some frames of the motion, `time` (n,), and what of it colours can show. */
export interface Sections {
  time: Packed;
  quantities: Quantity[];
  beams: Felt[];
}

/** A vector of the frames drawn as an arrow at a point of a body. vector : its number among the vectors of the frame. place : number of another one that is the point of space where it stands at each moment, in place of `point`; -1 where there is none. source : reactions of joints, or what is applied: forces and drivers. owner : name of the element. largest, typical : greatest length in the whole motion, and the root of its mean square. */
export interface Arrow {
  owner: string;
  source: "reaction" | "applied";
  kind: "force" | "torque";
  body: number;
  point: [number, number, number];
  vector: number;
  largest: number;
  typical: number;
  place: number;
}

/** A named point of a body, to be traced; x_axis, axis : of its frame, x and z, in the body's. */
export interface Marker {
  name: string;
  body: number;
  point: [number, number, number];
  x_axis: [number, number, number];
  axis: [number, number, number];
}

/** Floats of a frame: 7 a body (position, Euler parameters scalar first), then modal coordinates, then vectors of 3. */
export interface Layout {
  bodies: number;
  modes: number;
  vectors: number;
  width: number;
}

/** Where to look from at first: unit vectors. flat : the machine lies in a plane, which is seen along its normal. */
export interface Viewpoint {
  right: [number, number, number];
  up: [number, number, number];
  towards: [number, number, number];
  flat: boolean;
}

/** A variable that can be plotted: one number a frame. owner : element that it belongs to, empty for the whole machine. values : where the package has it; else it is asked for. */
export interface Column {
  name: string;
  unit: string;
  owner: string;
  values: Packed | null;
}

/** Something that happened: an event of the run. */
export interface Moment {
  name: string;
  time: number;
}

/** A joint coordinate that may be moved by hand, between low and high. free : it can move at all. */
export interface Coordinate {
  name: string;
  joint: string;
  unit: string;
  value: number;
  low: number;
  high: number;
  free: boolean;
}

/** time (n,) of the frames, frames (width, n). load (n,) : of equilibria the load factor, while time is the place along their path. total : frames of the result; every `stride`th is here. */
export interface Motion {
  time: Packed;
  frames: Packed;
  total: number;
  stride: number;
  load: Packed | null;
}

/** Everything that is drawn of one machine. origin : the point of the global frame from which all positions are counted. up : direction against gravity. low, high : corners of the box around the whole motion. size : a length to measure signs by. surroundings : solids that stand on the ground, of which the machine knows nothing. diagram : blocks of the machine. notes : what the user has to know, for instance that the run failed. colourless : in sentences, what has no colours by stress, and why. circuit : SVG of its hydraulic circuits, empty without any; `data-pressure` of a text names the variable that it shows. */
export interface Stage {
  name: string;
  title: string;
  up: [number, number, number];
  viewpoint: Viewpoint;
  origin: [number, number, number];
  low: [number, number, number];
  high: [number, number, number];
  size: number;
  layout: Layout;
  bodies: Body[];
  joints: Joint[];
  forces: Force[];
  markers: Marker[];
  arrows: Arrow[];
  drivers: Force[];
  couplings: Coupling[];
  sweeps: Sweep[];
  surroundings: Part[];
  terrains: Terrain[];
  flexible: Flexible[];
  sections: Sections | null;
  colourless: string[];
  columns: Column[];
  moments: Moment[];
  coordinates: Coordinate[];
  circuit: string;
  diagram: DiagramBox[];
  notes: string[];
  motion: Motion | null;
}

/** An input of a live machine, and what moves it. stick, raises, lowers : empty where there is none. axis, button : -1 likewise. label : its name for people. hold : it stays where it is left, and does not go back to rest. dead_zone, exponent, reverse : of the axis of a gamepad. */
export interface Control {
  name: string;
  label: string;
  unit: string;
  description: string;
  low: number;
  high: number;
  rest: number;
  hold: boolean;
  look: "slider" | "button";
  stick: string;
  raises: string;
  lowers: string;
  axis: number;
  button: number;
  reverse: boolean;
  dead_zone: number;
  exponent: number;
}

/** A number that a live machine shows. In a frame the gauges stand behind what `Layout` says, then the values of the controls. label : its name for people. low, high : ends of its scale, where they are known. limit : magnitude beyond which it warns. */
export interface Gauge {
  name: string;
  label: string;
  unit: string;
  low: number | null;
  high: number | null;
  limit: number | null;
}

/** A number of a machine that is in the page, which may be changed before it begins. least : the smallest value that it takes. */
export interface Parameter {
  name: string;
  unit: string;
  value: number;
  least: number;
}

/** All that the page shows. mode : playback of whole motions, a machine moved by hand, or frames as they come. stages : the first is the machine, others are drawn as ghosts over it. controls, gauges, parameters : of a live machine. traced : numbers of the bodies whose markers leave their paths in the picture of a live machine. Such a one is sampled at equal times, however many frames a page shows. A sample is its time, the gauges, 7 numbers of each of these bodies as in a frame, and the modal coordinates. */
export interface Package {
  protocol: number;
  mode: "playback" | "machine" | "live";
  stages: Stage[];
  controls: Control[];
  gauges: Gauge[];
  traced: number[];
  parameters: Parameter[];
}

/** From the server: a sentence for the user. */
export interface Note {
  type: "note";
  text: string;
}

/** From the server, after a move: values of all coordinates now, and why it could not be made, or an empty text. */
export interface Moved {
  type: "moved";
  values: number[];
  problem: string;
}

/** From the server: why a column that was asked for does not come. */
export interface Refused {
  type: "refused";
  request: number;
  problem: string;
}

/** From the server, some times a second: how a live machine is. time : simulated [s]. speed : simulated over real time. driver : who operates it. watches : why this page can only watch, or empty. operated : its inputs follow an operator. computing, late : 99th percentiles of a tick [µs]. tick : [µs]. overruns : ticks that ended after the next deadline, `own` of them by their own computing. dropped : messages refused. light : what the trust report would say if the run ended now; reasons : in sentences, why it is not green. */
export interface Status {
  type: "status";
  mode: string;
  time: number;
  speed: number;
  driver: "you" | "other" | "nobody" | "program";
  watches: string;
  operated: boolean;
  computing: number;
  late: number;
  tick: number;
  overruns: number;
  own: number;
  dropped: number;
  text: string;
  light: "green" | "amber" | "red";
  reasons: string[];
}

/** From the page: the frame with this number is on the screen; the next may come. */
export interface Shown {
  type: "shown";
  frame: number;
}

/** From the page: send the column `name` of a stage under this request number. */
export interface Want {
  type: "want";
  request: number;
  stage: number;
  name: string;
}

/** From the page: move a joint coordinate to a value. */
export interface Move {
  type: "move";
  coordinate: string;
  value: number;
}

/** From the page: put the machine back as it was assembled. */
export interface Reset {
  type: "reset";
}

/** From the page that operates a live machine, again and again: wanted values of all controls. */
export interface Drive {
  type: "drive";
  values: number[];
}

/** From the page that operates, again and again while it holds a body (on 1): the point of it, in its frame, and where that is pulled, counted from the origin of the stage [m]. Once when it lets go (on 0). */
export interface Hold {
  type: "hold";
  body: number;
  point: number[];
  towards: number[];
  on: number;
}

/** From the page: it wants to operate the machine (on 1), or lets go of it (0). */
export interface Take {
  type: "take";
  on: number;
}

/** From the page that operates: run, pause, step, reset, save, restore, or speed with its number. Where the machine is in the page, table, too. */
export interface Command {
  type: "command";
  word: string;
  number: number;
}

/** From the page, where the machine is in it: another value of a parameter, with which the machine begins anew. */
export interface Adjust {
  type: "adjust";
  parameter: number;
  value: number;
}

/** What the loop is called with. Codes are numbers in `LocalMachine.codes`, the others places. drive, advance, evaluate, correct, step, observe : codes. machine, history, session : records. y, rate, clock, counter : arrays of the history, `count` numbers in y and rate; time, accepted : numbers in clock. failed : what the last failure names. */
export interface LocalLoop {
  drive: number;
  advance: number;
  evaluate: number;
  correct: number;
  step: number;
  observe: number;
  machine: number;
  history: number;
  session: number;
  y: number;
  rate: number;
  count: number;
  clock: number;
  time: number;
  accepted: number;
  counter: number;
  stopped: number;
  failed: number;
}

/** What the loop shares with its operator: places of its arrays, and the numbers in `control`. rows, width : of the ring of frames. */
export interface LocalSession {
  control: number;
  target: number;
  value: number;
  frames: number;
  rows: number;
  width: number;
  ticks: number;
  shown: number;
}

/** An input that a page moves. rest : where it goes when nobody operates. */
export interface LocalInput {
  name: string;
  rest: number;
}

/** A word y of the memory that follows from parameters: y = sign |z|^power, or z where power is 1, with z = constant + Σ P(t)/Q(t). terms : (parameter, factors of the powers of t in P, those in Q); t = (x - centre)/width of the parameter x. */
export interface LocalNumber {
  word: number;
  constant: number;
  power: number;
  sign: number;
  terms: [number, number[], number[]][];
}

/** Numbers that follow from parameters, which a page changes at the start. values : of the parameters. frames : centre and width of each. energy : place of the energies at the start. */
export interface LocalParameters {
  numbers: LocalNumber[];
  values: number[];
  frames: [number, number][];
  energy: number;
}

/** A status that ends a run, and what is said of it, with {} for one of the names. */
export interface LocalFailure {
  status: number;
  sentence: string;
  names: string[];
}

/** Columns of what is drawn: first and last of positions, orientations and modal coordinates, and of the gauges. origin : from which positions are counted [m]. */
export interface LocalPicture {
  position: [number, number];
  orientation: [number, number];
  modal: [number, number];
  origin: [number, number, number];
  gauges: number[];
  traced: number[];
}

/** A number that the light looks at in every frame: the sum of columns times factors, counted from the start, or where not `summed` the largest magnitude among them. It is compared with a scale: the largest of `floor`, of magnitudes of `against`, of those of `changes` counted from the start, and with `speed` above 0 that many times the largest speed. green, amber : shares of the scale below which it is green, and amber. text : what is said, with {} for the share. */
export interface Watched {
  text: string;
  columns: number[];
  factors: number[];
  summed: boolean;
  against: number[];
  changes: number[];
  floor: number;
  speed: number;
  green: number;
  amber: number;
}

/** What the largest speed of a frame is found from: |v| + |omega| reach of each body. slow : a speed [m/s] times the time [s] since the start, below which a machine is at rest. */
export interface Speeds {
  velocity: number;
  angular: number;
  reach: number[];
  slow: number;
}

/** A machine, its memory and machine code apart. bytes : of its memory. inner : (word, place whose address belongs there). outer : (word, code whose address belongs there). codes : names of functions of the module. tick : from input to input [s]. inputs : that the page moves; those of the hand follow. names : of all columns, with units. events : names, by number from 1 on. spent, done : statuses of a loop that has done its ticks, and whose run has ended. */
export interface LocalMachine {
  bytes: number;
  inner: [number, number][];
  outer: [number, number][];
  codes: string[];
  tick: number;
  loop: LocalLoop;
  session: LocalSession;
  inputs: LocalInput[];
  parameters: LocalParameters;
  bodies: number;
  picture: LocalPicture;
  names: string[];
  failures: LocalFailure[];
  events: string[];
  spent: number;
  done: number;
  watched: Watched[];
  speeds: Speeds;
}

export type FromServer = Note | Moved | Refused | Status;

export type FromPage = Shown | Want | Move | Reset | Drive | Hold | Take | Command | Adjust;
