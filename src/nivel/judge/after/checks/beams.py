"""Beams: what the size of their elements makes wrong of a run, of equilibria and of vibrations about these; states near buckling."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Final

import numpy as np

from nivel.analysis.assembly.equations import rotation_between
from nivel.judge.after.other_elements import Compared, ElementErrors, Pair
from nivel.judge.after.report import FRAMES, OTHERS, STEPS, Check
from nivel.judge.after.subject import Equilibria, Run
from nivel.lazy import Struct
from nivel.machine.core.orientation import euler_parameters_from_matrix
from nivel.machine.core.vectors import Array
from nivel.machine.machine_record import MachineRecord
from nivel.results.motion import common_frames
from nivel.results.scales import Readable, largest_mechanical_energy, machine_size
from nivel.results.trust import Item, Threshold, number

MOST_FRAMES = 200  # that are looked at, at most
MESH = Threshold(
    1e-2,
    1e-1,
    "Displacements are too small by about the share of the energy that the elements miss. Stiffness is known to about a hundredth; a "
    "tenth is visible.",
)


class BeamMesh(Struct):
    """A beam of elements of this order, 1 or 2: nodes, their names from start to end; length (n,) [m] between them; stiffness (3,) [N m²]
    for twist and both curvatures; unstressed (n, 3) rotation vectors of each node against the one before."""

    name: str
    nodes: tuple[str, ...]
    length: Array
    stiffness: Array
    unstressed: Array
    order: int = 1


class Coarse(Struct):
    """A beam whose elements miss the share `share` of the largest energy of the machine, or of their own where that is larger, most at
    `time` [s]."""

    beam: str
    share: float
    time: float
    elements: int
    order: int


def _look_at_mesh(run: Run) -> Coarse | None:
    return coarsest(run.result, meshes(run.machine))


def _say_mesh(coarse: Coarse) -> Item:
    advice = "use twice as many, or `order: 2`" if coarse.order == 1 else "use twice as many"
    said = (
        f"Mesh: the {coarse.elements} elements of {coarse.beam} miss {number(coarse.share)} of the largest energy at "
        f"t = {coarse.time:.6g} s, because the curvature changes within them; {advice}"
    )
    return MESH.item("mesh", said, coarse.share, coarse.time, coarse.beam)


def meshes(machine: MachineRecord) -> list[BeamMesh]:
    """The beams whose elements are linear or quadratic."""
    out = []
    for beam in machine.beams:
        if beam.order <= 2 and beam.model != "ancf-cable":
            axes = beam.frames(beam.shares)[1]
            theta = np.array([euler_parameters_from_matrix(each) for each in axes])
            length, stiffness = beam.line.length * np.diff(beam.shares), np.diag(beam.properties.stiffness)[3:]
            out.append(BeamMesh(beam.name, beam.node_names, length, stiffness, turns(theta), beam.order))
    return out


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def coarsest(result: Readable, beams: Sequence[BeamMesh]) -> Coarse | None:
    """The beam whose elements miss most."""
    found, energy = None, largest_mechanical_energy(result)
    stride = max(1, len(result.time) // MOST_FRAMES)
    names = result.coordinates.get("body", ())
    for beam in beams:
        count = len(beam.length) // beam.order
        theta = result.array("orientation")[::stride, [names.index(each) for each in beam.nodes]]
        curvature = (turns(theta) - beam.unstressed) / beam.length[:, None]
        own = np.nan_to_num(0.5 * (curvature**2 * beam.stiffness).sum(axis=2) @ beam.length)
        missed = np.nan_to_num(0.5 * (_missed(beam, curvature) * beam.stiffness).sum(axis=(1, 2)))
        k = int(np.argmax(missed))
        share = float(missed[k]) / max(energy, float(own.max()), 1e-300)
        if found is None or share > found.share:
            found = Coarse(beam.name, share, float(result.time[k * stride]), count, beam.order)
    return found


def _missed(beam: BeamMesh, curvature: Array) -> Array:
    """(t, elements, 3) [1/m] integral of the square of what elements do not have of curvatures (t, n, 3), means between nodes."""
    if len(beam.length) == beam.order:
        return _alone(beam, curvature)
    if beam.order == 1:
        middle = np.cumsum(beam.length) - 0.5 * beam.length
        return np.gradient(curvature, middle, axis=1) ** 2 * beam.length[:, None] ** 3 / 12.0
    length = beam.length[::2] + beam.length[1::2]
    slope = 2.0 * (curvature[:, 1::2] - curvature[:, ::2]) / length[:, None]
    change = np.gradient(slope, np.cumsum(length) - 0.5 * length, axis=1)
    return change**2 * length[:, None] ** 5 / 720.0


def _alone(beam: BeamMesh, curvature: Array) -> Array:
    """The same of one element without neighbours: as of a cantilever, a linear one under a load at its end, a quadratic one under an even
    load, whose part is a fifteenth of that of the slope."""
    length = float(beam.length.sum())
    if beam.order == 1:
        return curvature**2 * length / 3.0
    slope = 2.0 * (curvature[:, 1:] - curvature[:, :1]) / length
    return slope**2 * length**3 / 12.0 / 15.0


def turns(theta: Array) -> Array:
    """(…, n - 1, 3) [rad] rotation vectors of frames with Euler parameters (…, n, 4) against the one before each, in its axes."""
    return rotation_between(theta[..., :-1, :], theta[..., 1:, :])


SOFT: Final = 0.5  # of the lowest stiffness of the machine as drawn: below it loads have taken much of it


class OtherStability(Struct):
    """At `time` [s] the number of unstable directions is another with other elements, `words` says which."""

    time: float
    words: str


class Softened(Struct):
    """At `time` [s] loads have taken the share `taken` of the lowest stiffness; what is left is wrong by the share `off` of it, infinite
    where finer elements leave nothing."""

    time: float
    taken: float
    off: float


def _look_at_buckling(subject: Equilibria) -> OtherStability | Softened | None:
    """Whether finer elements have the states, and how soft they are."""
    compared, result = subject.elements, subject.result
    if compared is None or compared.result is None or compared.why:
        return None
    if not compared.by_arc:
        first, second = common_frames(result.time, compared.result.time)
        counts = result.array("unstable_directions")[first], compared.result.array("unstable_directions")[second]
        other = np.flatnonzero(counts[0] != counts[1])
        if len(other):
            return OtherStability(float(result.time[first][other[0]]), compared.pair.words)
    own, its = compared.own, compared.its
    if own is None or its is None or not 0.0 < own.last < SOFT * own.drawn or not its.last > 0.0:
        return None
    exact = own.last - compared.pair.factor * (own.last - its.last)
    off = abs(own.last / exact - 1.0) if exact > 0.0 else float("inf")
    return Softened(float(result.time[-1]), 1.0 - own.last / own.drawn, off)


def _say_buckling(found: OtherStability | Softened) -> Item:
    at, advice = f"at t = {found.time:.6g} s", "use twice as many `elements`"
    if isinstance(found, OtherStability):
        said = (
            f"Mesh: {at} the stability is another with {found.words} elements: the machine is near buckling; {advice}"
        )
        return Item("mesh", "red", f"{said} (green if it is the same, red otherwise)", time=found.time)
    if not np.isfinite(found.off):
        said = f"Mesh: {at} finer elements take all that loads leave of the stiffness: the machine is at its buckling load; {advice}"
        return Item("mesh", "red", f"{said} (green if it stays, red otherwise)", time=found.time)
    said = (
        f"Mesh: {at} loads have taken {number(found.taken)} of the lowest stiffness, near buckling; what is left is off by about "
        f"{number(found.off)} of it; {advice}"
    )
    return MESH.item("mesh", said, found.off, found.time)


SMALL: Final = 0.1  # of the largest motion: what moves by less is compared with that
LEAST_MOTION: Final = 1e-5  # of the size, or of a radian: what moves by less is compared with that
# of the largest torque, over the size: forces below are compared with that; torques likewise
LEAST_REACTION: Final = 1e-3
ROUND_OFF: Final = 1e-13  # of the stiffness EA: reactions below are none


class Farthest(Struct):
    """The largest error of a place by elements [m], of which body and when [s]."""

    error: float
    body: str
    time: float


class Unfinished(Struct):
    """The machine with other elements, `words` says which, did not come to its end, `why`. needed : it is one of equilibria, which are not
    sure then."""

    words: str
    why: str
    needed: bool


class Off(Struct):
    """What is wrong most against its scale. error, scale [units] at `time` [s]; beams : whose elements do it."""

    name: str
    error: float
    scale: float
    units: str
    time: float
    beams: tuple[str, ...]
    words: str
    order: int

    @property
    def share(self) -> float:
        return self.error / self.scale


def _look_farthest(subject: Run | Equilibria) -> Farthest | None:
    errors = _compared(subject).errors
    if errors is None or "position" not in errors.values:
        return None
    off = np.linalg.norm(errors.values["position"], axis=-1)
    k, body = np.unravel_index(int(np.argmax(off)), off.shape)
    return Farthest(float(off[k, body]), subject.result.coordinates["body"][body], float(errors.time[k]))


def _say_farthest(found: Farthest) -> Item:
    where = f", most at {found.body}, t = {found.time:.6g} s" if found.error else ""
    said = f"Elements: places are within about {number(found.error)} m of those with finer elements of beams{where}"
    return Item("elements", "green", f"{said} (said, always green)", row=found.body, time=found.time)


def look(subject: Run | Equilibria) -> list[Off | Unfinished]:
    """What elements make wrong most: of the motion, and of equilibria also of reactions and frequencies."""
    compared, out = _compared(subject), list[Off | Unfinished]()
    if compared.why or compared.errors is None:
        why = compared.why or "it has no state at the same time"
        out.append(Unfinished(compared.pair.words, why, isinstance(subject, Equilibria)))
    if compared.errors is None:
        return out
    found = [most_off(subject.result, compared.errors, compared.pair, compared.drawn)]
    if isinstance(subject, Equilibria):
        found += [_reactions(subject.result, compared), _vibrations(subject.result, compared)]
    return [*out, *(each for each in found if each is not None)]


def say(found: Off | Unfinished) -> Item:
    """What the elements make wrong, and what to do."""
    if isinstance(found, Unfinished):
        if found.needed:
            said = f"Mesh: with {found.words} elements of beams the equilibria are not found: {found.why}; use more `elements`"
            return Item("mesh", "red", f"{said} (green if they are found and agree, red otherwise)")
        said = f"Mesh: not judged to the end, because with {found.words} elements of beams {found.why}"
        return Item("mesh", "amber", f"{said} (green if judged, amber otherwise)")
    advice = "use twice as many `elements`" + (", or `order: 2`" if found.order == 1 else "")
    said = (
        f"Mesh: with {found.words} elements of {', '.join(found.beams)} the result differs: {found.name} is off by about "
        f"{number(found.error)} {found.units} at t = {found.time:.6g} s, {number(found.share)} of {number(found.scale)} {found.units}; "
        f"{advice}"
    )
    return MESH.item("mesh", said, found.share, found.time, found.name)


def _compared(subject: Run | Equilibria) -> Compared:
    assert subject.elements is not None
    return subject.elements


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def most_off(
    result: Readable, errors: ElementErrors, pair: Pair, drawn: Mapping[str, Array] | None = None
) -> Off | None:
    """What the elements make wrong most, as a share of its motion; of nodes, of the largest motion of their beam.

    drawn : of bodies, the place (3,) [m] from which they have moved; without it the first frame is that.
    """
    size, reach = machine_size(result)[0], _reach(result, pair.beams, drawn)
    found = [
        Off(name, error, scale, units, time, pair.beams, pair.words, pair.order)
        for name, error, scale, units, time in (
            *_places(result, errors, reach),
            *_joints(result, errors, max(SMALL * max(reach.values(), default=0.0), LEAST_MOTION * size), size),
        )
        if scale > 0.0
    ]
    return max(found, key=lambda each: each.share, default=None)


def _reach(result: Readable, beams: Iterable[str], drawn: Mapping[str, Array] | None) -> dict[str, float]:
    """How far each body moves [m]; every node as far as the one of its beam that moves farthest."""
    if "position" not in result.variables:
        return {}
    names, path = result.coordinates["body"], result.array("position")
    begin = path[0] if drawn is None else np.array([drawn.get(name, path[0, k]) for k, name in enumerate(names)])
    extent = np.linalg.norm(path - begin, axis=-1).max(axis=0)
    for beam in beams:
        nodes = [k for k, name in enumerate(names) if name.startswith(f"{beam}.")]
        extent[nodes] = extent[nodes].max(initial=0.0)
    return dict(zip(names, extent.tolist(), strict=True))


Judged = Iterator[tuple[str, float, float, str, float]]


def _places(result: Readable, errors: ElementErrors, reach: Mapping[str, float]) -> Judged:
    if "position" not in errors.values:
        return
    least = max(SMALL * max(reach.values(), default=0.0), LEAST_MOTION * machine_size(result)[0])
    off = np.linalg.norm(errors.values["position"], axis=-1)
    for b, name in enumerate(result.coordinates["body"]):
        k = int(np.argmax(off[:, b]))
        yield name, float(off[k, b]), max(reach[name], least), "m", float(errors.time[k])


def _joints(result: Readable, errors: ElementErrors, least: float, size: float) -> Judged:
    """Joint coordinates against their ranges, and their rates against the largest; least : [m] that counts as motion."""
    span = float(result.time[-1] - result.time[0]) or 1.0
    for variable in ("joint_coordinate", "joint_rate"):
        if variable not in errors.values:
            continue
        values, off, rate = result.array(variable), errors.values[variable], variable == "joint_rate"
        for j, name in enumerate(result.coordinates[result.variables[variable].dims[1]]):
            angle = name.rpartition(".")[2].startswith("angle")
            alone = rate or len(values) == 1
            extent = float(np.abs(values[:, j]).max() if alone else np.ptp(values[:, j]))
            floor = least / (size if angle else 1.0) / (span if rate else 1.0)
            k = int(np.argmax(off[:, j]))
            units = ("rad" if angle else "m") + ("/s" if rate else "")
            said = f"the rate of {name}" if rate else name
            yield said, float(off[k, j]), max(extent, floor), units, float(errors.time[k])


def _reactions(result: Readable, found: Compared) -> Off | None:
    """The reaction that is wrong most, against the largest."""
    errors = found.errors
    if errors is None or "joint_force" not in errors.values:
        return None
    size, names = machine_size(result)[0], result.coordinates["joint"]
    rounded = ROUND_OFF * max(beam.properties.stiffness[0, 0] for beam in found.pair.machine.beams)
    force, torque = (float(np.abs(result.array(name)).max(initial=0.0)) for name in ("joint_force", "joint_torque"))
    if max(force, torque / size) < rounded:
        return None
    force, torque = max(force, LEAST_REACTION * torque / size), max(torque, LEAST_REACTION * force * size)
    out, pair = [], found.pair
    for variable, scale, units in (("joint_force", force, "N"), ("joint_torque", torque, "N m")):
        off = errors.values[variable].max(axis=-1)
        for j, name in enumerate(names):
            k = int(np.argmax(off[:, j]))
            if name in found.unique:
                said = f"the {variable[6:]} of {name}"
                time = float(errors.time[k])
                out.append(Off(said, float(off[k, j]), scale, units, time, pair.beams, pair.words, pair.order))
    return max(out, key=lambda each: each.share, default=None)


def _vibrations(result: Readable, found: Compared) -> Off | None:
    """The frequency that is wrong most, of itself."""
    errors, pair = found.errors, found.pair
    if errors is None or "natural_frequency" not in errors.values:
        return None
    own = result.array("natural_frequency")[common_frames(result.time, errors.time)[0]]
    off = errors.values["natural_frequency"]
    with np.errstate(invalid="ignore", divide="ignore"):
        share = np.nan_to_num(np.where(own > 0.0, off / own, 0.0))
    k, j = np.unravel_index(int(np.argmax(share)), share.shape)
    if not share[k, j] > 0.0:
        return None
    name, time = f"the frequency of vibration {j + 1}", float(errors.time[k])
    return Off(name, float(off[k, j]), float(own[k, j]), "Hz", time, pair.beams, pair.words, pair.order)


CHECKS = (
    Check("elements", (Run, Equilibria), _look_farthest, _say_farthest, 275, (OTHERS, FRAMES), "Elements"),
    Check("element_size", (Run, Equilibria), look, say, 282, (OTHERS, FRAMES), "Mesh", MESH, line="mesh", quiet=True),
    Check("beam_mesh", Run, _look_at_mesh, _say_mesh, 280, (STEPS,), "Mesh", MESH, line="mesh", quiet=True),
    Check(
        "near_buckling", Equilibria, _look_at_buckling, _say_buckling, 284, (OTHERS, FRAMES), line="mesh", quiet=True
    ),
)
