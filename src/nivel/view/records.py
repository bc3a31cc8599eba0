"""Records of the messages between server and page. `typescript.py` writes these records for the page, name by name.

Lengths in metres, angles in radians, vectors in global axes unless the record says otherwise. A body is a number: its place in
`Stage.bodies`, -1 the ground.

Packed arrays lie one after the other in a block of bytes; `Packed` says where. Over a connection every binary message begins with a
little-endian 32-bit number that says what follows: see PACKAGE, FRAME and COLUMN.
"""

from typing import Final, Literal

from nivel.lazy import Struct, field
from nivel.looks.diagram import DiagramBox

Triple = tuple[float, float, float]
ForceLook = Literal[
    "nothing",
    "spring",
    "damper",
    "spring-damper",
    "cylinder",
    "coil",
    "bushing",
    "plane",
    "turn",
    "slide",
    "ring",
    "dot",
    "rope",
    "track",
]

PROTOCOL: Final = 1  # version of all that stands here
PACKAGE: Final = 1  # binary message: a package (package.py)
FRAME: Final = 2  # binary message: number of the frame (32 bits), its time (64-bit float), then its floats (frames.py)
SAMPLES: Final = 4  # binary message: floats of a sample (32 bits), then samples of 64-bit floats (frames.py)
TABLE: Final = 5  # binary message: a table as text, of a page in which the machine lives
# binary message: number of a terrain, numbers of loads and of moves (32 bits each), then volumes [m³] and nodes (32 bits), moves (16)
MOVES: Final = 6
COLUMN: Final = 3  # binary message: number of the request (32 bits), 4 bytes unused, then a column of 32-bit floats


class Packed(Struct):
    """An array in the block of bytes. kind : f4, f8, u4 or u2, little-endian. start : its first byte.

    The bytes are shuffled, which compresses better: the first bytes of all numbers, then the second bytes, and so on.
    """

    kind: Literal["f4", "f8", "u4", "u2"]
    shape: list[int]
    start: int


class Steps(Struct):
    """Numbers rounded to 65536 even steps: low[i] + step[i] * numbers[i, …]."""

    numbers: Packed
    low: list[float]
    step: list[float]


class Part(Struct):
    """A solid in the body frame with its centre at `centre`.

    size : box: along x, y, z; cylinder, capsule: radius, length; tube: outer, inner radius, length; sphere: radius; ellipsoid: semi-axes;
    extrusion: length; a capsule's length is that of its straight part. along : the axis of round bars and extrusions. outline : of an
    extrusion, corners in the two axes that follow `along`. vertices (n, 3), triangles (m, 3) : of a mesh. colour : empty, that of the body.
    """

    kind: Literal["box", "cylinder", "tube", "sphere", "ellipsoid", "capsule", "extrusion", "mesh"]
    centre: Triple
    size: list[float]
    along: Literal["x", "y", "z"] = "x"
    outline: list[tuple[float, float]] = field(default_factory=list)
    vertices: Packed | None = None
    triangles: Packed | None = None
    colour: str = ""


class Body(Struct):
    """A body. links : points of its frame to which automatic links lead from the centre of mass. held : where joints hold it.

    automatic : it is drawn as a ball with links where it has no parts; not so where it deforms or is part of a sweep.
    """

    name: str
    colour: str
    centre_of_mass: Triple
    parts: list[Part] = field(default_factory=list)
    links: list[Triple] = field(default_factory=list)
    held: list[Triple] = field(default_factory=list)
    automatic: bool = True
    facts: list[tuple[str, str]] = field(default_factory=list)


class Stress(Struct):
    """Von Mises stress [Pa] of a flexible body: that of Σ q_k modes[k] at stations, the largest of those of a vertex.

    modes (modes, 6, stations) : xx, yy, zz, xy, yz, zx. stations (n, 2) : of each vertex the first, and the one after the last; equal
    where its stress is not known. high : the largest of the motion.
    """

    modes: Steps
    stations: Packed
    high: float


class Flexible(Struct):
    """A mesh that deforms: a vertex is vertices + Σ q_k modes[k], in the body's frame; q are modal coordinates of the frame.

    vertices (n, 3), triangles (m, 3), modes (modes, n, 3). first : place of its first modal coordinate among those of the frame.
    field : (modes, n) what the colours show is Σ q_k field[k], or without it the length of the displacement; low, high : ends of
    the colours, in `unit`.
    """

    body: int
    name: str
    vertices: Packed
    triangles: Packed
    modes: Packed
    first: int
    low: float
    high: float
    unit: str
    quantity: str
    field: Packed | None = None
    stress: Stress | None = None


class Joint(Struct):
    """A joint: points and axes on its two bodies, in their frames. slot : direction of a slot in the second body.

    place : at which of the two points its sign stands. rod : it is a massless link between them.

    violation : places of the two vectors of its constraint violation among those of the frame: how far the second point is from where
    it should be, and how far the second frame is turned, in axes of the first marker turned into global ones; -1 without.
    """

    name: str
    kind: str
    bodies: tuple[int, int]
    points: tuple[Triple, Triple]
    axes: tuple[Triple, Triple]
    x_axes: tuple[Triple, Triple] | None = None
    slot: Triple | None = None
    place: Literal[0, 1] = 0
    rod: bool = False
    violation: int = -1
    facts: list[tuple[str, str]] = field(default_factory=list)


class Winding(Struct):
    """How a rope runs around wheels at its points. carrier : number of the point whose body carries their `axis`, in its frame.

    radii : of each point, positive where the rope runs right-handed about the axis, 0 without a wheel. arcs : angles [rad] on the
    wheels as the bodies are placed. fixed : directions in which the rope is fixed on a drum at its first and last point, in the
    frames of their bodies.
    """

    axis: Triple
    carrier: int
    radii: list[float]
    arcs: list[float]
    fixed: tuple[Triple, Triple]


class Force(Struct):
    """A force element, or a driver. points : of the two ends, or the one where it acts, or of the joint that it works on; none where
    that is not known. axis : of a coil or of what works on a joint, or normal of a contact's plane; in the first body's frame, a normal
    in the second's.

    look : what is drawn between the ends, or at the first of them: `turn` and `slide` drive a joint about and along its axis, a `ring`
    holds it, a `dot` is where something acts on one body, a `rope` goes from point to point, of which it may have more than two,
    or around wheels as `winding` says.

    sizes : of a hydraulic cylinder: radii of its barrel and rod, length of its barrel [m]. Of a `track`, whose points are both ends of
    its belt and its sprocket, and whose axis points away from the ground: radius of the sprocket, width and thickness of the shoes.
    """

    name: str
    kind: str
    bodies: list[int]
    points: list[Triple] = field(default_factory=list)
    axis: Triple | None = None
    look: ForceLook = "nothing"
    facts: list[tuple[str, str]] = field(default_factory=list)
    sizes: list[float] = field(default_factory=list)
    winding: Winding | None = None


class Wheel(Struct):
    """A pitch circle on a body, in its frame."""

    body: int
    centre: Triple
    axis: Triple
    radius: float


class Track(Struct):
    """The pitch line of a rack on a body, in its frame: as far as `half` to both sides of a point."""

    body: int
    point: Triple
    along: Triple
    half: float


class End(Struct):
    """A point of a body, in its frame."""

    body: int
    point: Triple


class Coupling(Struct):
    """A gear, belt, rack or other equation between joint coordinates. belt : how one runs about the two wheels.

    joined : points that a line joins where no wheels are known.
    """

    name: str
    kind: str
    wheels: list[Wheel] = field(default_factory=list)
    tracks: list[Track] = field(default_factory=list)
    joined: list[End] = field(default_factory=list)
    belt: Literal["none", "open", "crossed"] = "none"
    facts: list[tuple[str, str]] = field(default_factory=list)


class Sweep(Struct):
    """A section drawn along a line through frames of bodies, in their order, which bends with them: a beam, a hose, a rope.

    bodies : two or more. points, axes : in the frame of each body where the line passes, and its direction there. section : corners
    (y, z) of the section, counter-clockwise, in axes of which x is the line's direction and y, z are `across` of each body and what
    completes it. hollow : corners of the hole, or none. smooth : between two frames the line is a cubic that leaves and arrives along
    their axes (Hermite), else straight.
    """

    name: str
    colour: str
    bodies: list[int]
    points: list[Triple]
    axes: list[Triple]
    across: list[Triple]
    section: list[tuple[float, float]]
    hollow: list[tuple[float, float]] = field(default_factory=list)
    smooth: bool = True


class Load(Struct):
    """Soil in a bucket, about a point of its frame. half : from there to the end of its edge. slot : of the volumes that are carried."""

    slot: int
    body: int
    point: Triple
    half: Triple


class Terrain(Struct):
    """Ground that deforms: `heights` [m] of nodes in rows along x over a plane through `corner`; cells have the sides `along` and `across`.

    Nodes move by whole steps [m]. time (k,) [s] : of moments, none where moves come as messages; ends (k,) : numbers of moves up to each.
    nodes (n,) : that move, each as what is added to the one before; moves (n,) : steps, negative ones behind 65536. carried (k, slots): m³.
    """

    name: str
    corner: Triple
    along: Triple
    across: Triple
    step: float
    loads: list[Load]
    heights: Packed
    time: Packed
    ends: Packed
    nodes: Packed
    moves: Packed
    carried: Packed


class Quantity(Struct):
    """What colours of beams can show, from `low` to `high` in the motion. rows : one of the numbers of a point, or the length of several.

    A point has 12: strains (stretch, two shears), twist and two curvatures; then force and moment of the section in its axes.
    """

    name: str
    unit: str
    rows: list[int]
    low: float
    high: float


class Felt(Struct):
    """What points along a sweep feel. sweep : its place in the stage. places (p,) : numbers of frames of bodies, with fractions, ascending.

    strain (6, n, p) : of the frames of `Sections.time`. stiffness (6, 6) : force and moment of a point are stiffness times its strain.
    """

    sweep: int
    places: list[float]
    strain: Steps
    stiffness: list[list[float]]


class Sections(Struct):
    """What the sections of beams feel at some frames of the motion, `time` (n,), and what of it colours can show."""

    time: Packed
    quantities: list[Quantity]
    beams: list[Felt]


class Arrow(Struct):
    """A vector of the frames drawn as an arrow at a point of a body. vector : its number among the vectors of the frame. place : number of
    another one that is the point of space where it stands at each moment, in place of `point`; -1 where there is none.

    source : reactions of joints, or what is applied: forces and drivers. owner : name of the element. largest, typical : greatest
    length in the whole motion, and the root of its mean square.
    """

    owner: str
    source: Literal["reaction", "applied"]
    kind: Literal["force", "torque"]
    body: int
    point: Triple
    vector: int
    largest: float
    typical: float
    place: int = -1


class Marker(Struct):
    """A named point of a body, to be traced; x_axis, axis : of its frame, x and z, in the body's."""

    name: str
    body: int
    point: Triple
    x_axis: Triple = (1.0, 0.0, 0.0)
    axis: Triple = (0.0, 0.0, 1.0)


class Layout(Struct):
    """Floats of a frame: 7 a body (position, Euler parameters scalar first), then modal coordinates, then vectors of 3."""

    bodies: int
    modes: int
    vectors: int
    width: int


class Viewpoint(Struct):
    """Where to look from at first: unit vectors. flat : the machine lies in a plane, which is seen along its normal."""

    right: Triple
    up: Triple
    towards: Triple
    flat: bool


class Column(Struct):
    """A variable that can be plotted: one number a frame. owner : element that it belongs to, empty for the whole machine.

    values : where the package has it; else it is asked for.
    """

    name: str
    unit: str
    owner: str
    values: Packed | None = None


class Moment(Struct):
    """Something that happened: an event of the run."""

    name: str
    time: float


class Coordinate(Struct):
    """A joint coordinate that may be moved by hand, between low and high. free : it can move at all."""

    name: str
    joint: str
    unit: str
    value: float
    low: float
    high: float
    free: bool


class Motion(Struct):
    """time (n,) of the frames, frames (width, n). load (n,) : of equilibria the load factor, while time is the place along their path.

    total : frames of the result; every `stride`th is here.
    """

    time: Packed
    frames: Packed
    total: int
    stride: int
    load: Packed | None = None


class Stage(Struct):
    """Everything that is drawn of one machine. origin : the point of the global frame from which all positions are counted.

    up : direction against gravity. low, high : corners of the box around the whole motion. size : a length to measure signs by.
    surroundings : solids that stand on the ground, of which the machine knows nothing.
    diagram : blocks of the machine.
    notes : what the user has to know, for instance that the run failed. colourless : in sentences, what has no colours by stress, and why.
    circuit : SVG of its hydraulic circuits, empty without any; `data-pressure` of a text names the variable that it shows.
    """

    name: str
    title: str
    up: Triple
    viewpoint: Viewpoint
    origin: Triple
    low: Triple
    high: Triple
    size: float
    layout: Layout
    bodies: list[Body]
    joints: list[Joint]
    forces: list[Force]
    markers: list[Marker]
    arrows: list[Arrow]
    drivers: list[Force] = field(default_factory=list)
    couplings: list[Coupling] = field(default_factory=list)
    sweeps: list[Sweep] = field(default_factory=list)
    surroundings: list[Part] = field(default_factory=list)
    terrains: list[Terrain] = field(default_factory=list)
    flexible: list[Flexible] = field(default_factory=list)
    sections: Sections | None = None
    colourless: list[str] = field(default_factory=list)
    columns: list[Column] = field(default_factory=list)
    moments: list[Moment] = field(default_factory=list)
    coordinates: list[Coordinate] = field(default_factory=list)
    circuit: str = ""
    diagram: list[DiagramBox] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    motion: Motion | None = None


class Control(Struct):
    """An input of a live machine, and what moves it. stick, raises, lowers : empty where there is none. axis, button : -1 likewise.

    label : its name for people. hold : it stays where it is left, and does not go back to rest.
    dead_zone, exponent, reverse : of the axis of a gamepad.
    """

    name: str
    label: str
    unit: str
    description: str
    low: float
    high: float
    rest: float
    hold: bool
    look: Literal["slider", "button"]
    stick: str
    raises: str
    lowers: str
    axis: int
    button: int
    reverse: bool
    dead_zone: float
    exponent: float


class Gauge(Struct):
    """A number that a live machine shows. In a frame the gauges stand behind what `Layout` says, then the values of the controls.

    label : its name for people. low, high : ends of its scale, where they are known. limit : magnitude beyond which it warns.
    """

    name: str
    label: str
    unit: str
    low: float | None
    high: float | None
    limit: float | None


class Parameter(Struct):
    """A number of a machine that is in the page, which may be changed before it begins. least : the smallest value that it takes."""

    name: str
    unit: str
    value: float
    least: float


class Package(Struct):
    """All that the page shows. mode : playback of whole motions, a machine moved by hand, or frames as they come.

    stages : the first is the machine, others are drawn as ghosts over it. controls, gauges, parameters : of a live machine.

    traced : numbers of the bodies whose markers leave their paths in the picture of a live machine. Such a one is sampled at equal times,
    however many frames a page shows. A sample is its time, the gauges, 7 numbers of each of these bodies as in a frame, and the modal
    coordinates.
    """

    protocol: int
    mode: Literal["playback", "machine", "live"]
    stages: list[Stage]
    controls: list[Control] = field(default_factory=list)
    gauges: list[Gauge] = field(default_factory=list)
    traced: list[int] = field(default_factory=list)
    parameters: list[Parameter] = field(default_factory=list)


class Note(Struct):
    """From the server: a sentence for the user."""

    type: Literal["note"]
    text: str


class Moved(Struct):
    """From the server, after a move: values of all coordinates now, and why it could not be made, or an empty text."""

    type: Literal["moved"]
    values: list[float]
    problem: str


class Refused(Struct):
    """From the server: why a column that was asked for does not come."""

    type: Literal["refused"]
    request: int
    problem: str


class Status(Struct):
    """From the server, some times a second: how a live machine is.

    time : simulated [s]. speed : simulated over real time. driver : who operates it. watches : why this page can only watch, or empty.
    operated : its inputs follow an operator.
    computing, late : 99th percentiles of a tick [µs]. tick : [µs]. overruns : ticks that ended after the next deadline, `own` of them by
    their own computing. dropped : messages refused. light : what the trust report would say if the run ended now; reasons : in sentences,
    why it is not green.
    """

    type: Literal["status"]
    mode: str
    time: float
    speed: float
    driver: Literal["you", "other", "nobody", "program"]
    watches: str
    operated: bool
    computing: float
    late: float
    tick: float
    overruns: int
    own: int
    dropped: int
    text: str
    light: Literal["green", "amber", "red"]
    reasons: list[str]


class Shown(Struct):
    """From the page: the frame with this number is on the screen; the next may come."""

    type: Literal["shown"]
    frame: int


class Want(Struct):
    """From the page: send the column `name` of a stage under this request number."""

    type: Literal["want"]
    request: int
    stage: int
    name: str


class Move(Struct):
    """From the page: move a joint coordinate to a value."""

    type: Literal["move"]
    coordinate: str
    value: float


class Reset(Struct):
    """From the page: put the machine back as it was assembled."""

    type: Literal["reset"]


class Drive(Struct):
    """From the page that operates a live machine, again and again: wanted values of all controls."""

    type: Literal["drive"]
    values: list[float]


class Hold(Struct):
    """From the page that operates, again and again while it holds a body (on 1): the point of it, in its frame, and where that is
    pulled, counted from the origin of the stage [m]. Once when it lets go (on 0)."""

    type: Literal["hold"]
    body: int
    point: list[float]
    towards: list[float]
    on: int


class Take(Struct):
    """From the page: it wants to operate the machine (on 1), or lets go of it (0)."""

    type: Literal["take"]
    on: int


class Command(Struct):
    """From the page that operates: run, pause, step, reset, save, restore, or speed with its number. Where the machine is in the page,
    table, too."""

    type: Literal["command"]
    word: str
    number: float


class Adjust(Struct):
    """From the page, where the machine is in it: another value of a parameter, with which the machine begins anew."""

    type: Literal["adjust"]
    parameter: int
    value: float


FROM_SERVER: Final = (Note, Moved, Refused, Status)
FROM_PAGE: Final = (Shown, Want, Move, Reset, Drive, Hold, Take, Command)
WITHIN_PAGE: Final = (Adjust,)
