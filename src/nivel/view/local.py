"""Records of a page in which the machine itself lives, as machine code in a worker. `typescript.py` writes them for the page.

A place is a byte of the machine's memory, counted from its begin. A column is a number's place in a frame of the run.
"""

from nivel.lazy import Struct


class LocalLoop(Struct):
    """What the loop is called with. Codes are numbers in `LocalMachine.codes`, the others places.

    drive, advance, evaluate, correct, step, observe : codes. machine, history, session : records. y, rate, clock, counter : arrays of the
    history, `count` numbers in y and rate; time, accepted : numbers in clock. failed : what the last failure names.
    """

    drive: int
    advance: int
    evaluate: int
    correct: int
    step: int
    observe: int
    machine: int
    history: int
    session: int
    y: int
    rate: int
    count: int
    clock: int
    time: int
    accepted: int
    counter: int
    stopped: int
    failed: int


class LocalSession(Struct):
    """What the loop shares with its operator: places of its arrays, and the numbers in `control`. rows, width : of the ring of frames."""

    control: int
    target: int
    value: int
    frames: int
    rows: int
    width: int
    ticks: int
    shown: int


class LocalInput(Struct):
    """An input that a page moves. rest : where it goes when nobody operates."""

    name: str
    rest: float


class LocalNumber(Struct):
    """A word y of the memory that follows from parameters: y = sign |z|^power, or z where power is 1, with z = constant + Σ P(t)/Q(t).
    terms : (parameter, factors of the powers of t in P, those in Q); t = (x - centre)/width of the parameter x."""

    word: int
    constant: float
    power: float
    sign: float
    terms: list[tuple[int, list[float], list[float]]]


class LocalParameters(Struct):
    """Numbers that follow from parameters, which a page changes at the start. values : of the parameters. frames : centre and width of
    each. energy : place of the energies at the start."""

    numbers: list[LocalNumber]
    values: list[float]
    frames: list[tuple[float, float]]
    energy: int


class LocalFailure(Struct):
    """A status that ends a run, and what is said of it, with {} for one of the names."""

    status: int
    sentence: str
    names: list[str]


class LocalPicture(Struct):
    """Columns of what is drawn: first and last of positions, orientations and modal coordinates, and of the gauges. origin : from which
    positions are counted [m]."""

    position: tuple[int, int]
    orientation: tuple[int, int]
    modal: tuple[int, int]
    origin: tuple[float, float, float]
    gauges: list[int]
    traced: list[int]


class Watched(Struct):
    """A number that the light looks at in every frame: the sum of columns times factors, counted from the start, or where not `summed` the
    largest magnitude among them. It is compared with a scale: the largest of `floor`, of magnitudes of `against`, of those of `changes`
    counted from the start, and with `speed` above 0 that many times the largest speed.

    green, amber : shares of the scale below which it is green, and amber. text : what is said, with {} for the share.
    """

    text: str
    columns: list[int]
    factors: list[float]
    summed: bool
    against: list[int]
    changes: list[int]
    floor: float
    speed: float
    green: float
    amber: float


class Speeds(Struct):
    """What the largest speed of a frame is found from: |v| + |omega| reach of each body. slow : a speed [m/s] times the time [s] since the
    start, below which a machine is at rest."""

    velocity: int
    angular: int
    reach: list[float]
    slow: float


class LocalMachine(Struct):
    """A machine, its memory and machine code apart. bytes : of its memory. inner : (word, place whose address belongs there). outer :
    (word, code whose address belongs there). codes : names of functions of the module.

    tick : from input to input [s]. inputs : that the page moves; those of the hand follow. names : of all columns, with units.
    events : names, by number from 1 on. spent, done : statuses of a loop that has done its ticks, and whose run has ended.
    """

    bytes: int
    inner: list[tuple[int, int]]
    outer: list[tuple[int, int]]
    codes: list[str]
    tick: float
    loop: LocalLoop
    session: LocalSession
    inputs: list[LocalInput]
    parameters: LocalParameters
    bodies: int
    picture: LocalPicture
    names: list[str]
    failures: list[LocalFailure]
    events: list[str]
    spent: int
    done: int
    watched: list[Watched]
    speeds: Speeds
