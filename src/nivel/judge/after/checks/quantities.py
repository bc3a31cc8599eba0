"""Errors of all stored numbers beside positions: speeds, forces, pressures, flows, currents, signals, states and sensors."""

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from nivel.judge.after.checks import friction
from nivel.judge.after.flexible_bodies import MODAL, ModalBody, modal_bodies, point_ranges
from nivel.judge.after.report import ESTIMATE, Check
from nivel.judge.after.subject import Run
from nivel.known import Contact
from nivel.lazy import Struct, replace
from nivel.machine.core.vectors import Array
from nivel.machine.units.measure import measure
from nivel.machine.units.quantity import ANY, constant_tree, read_quantity
from nivel.machine.units.tree import ExpressionError
from nivel.machine.units.unit import KINDS
from nivel.results.estimate import Estimate, distances
from nivel.results.motion import common_frames
from nivel.results.scales import Readable
from nivel.results.trust import Item, Threshold, amount, number
from nivel.system.layout import Variable
from nivel.words.wording import seconds

THRESHOLD = Threshold(
    1e-2,
    1e-1,
    "Mean magnitude of the error of a number over the run, as a share of its own range. Below a hundredth it is hardly visible in a curve; "
    "above a tenth the curve is a different one. The line says the largest error too: a jump that comes a step early is one.",
)
# Of its largest magnitude, of that which size, speed and weight of the machine give it, and of the largest range in the same units: a
# number that changes by less is at rest, and has no range of its own. Numbers of one kind in one machine, as pressures, are compared with
# each other; those whose meaning is the user's are not.
AT_REST, OWN = 1e-3, 1e-6
# Of the largest magnitude in the same units: errors below are what sums and solutions of equations round to.
ROUNDED = 1e-9
# Positions and what is made of them have lines of their own, constraints and energies too.
ELSEWHERE = ("position", "orientation", "joint_coordinate", "constraint_", "axis_")
# Motions of the frames of bodies, and which of them are turns.
FRAME_MOTIONS = {"velocity": False, "angular_velocity": True, "acceleration": False, "angular_acceleration": True}
# Accelerations, and the rates by which their means from frame to frame are known.
RATES = {"acceleration": "velocity", "angular_acceleration": "angular_velocity", "joint_acceleration": "joint_rate"}
FLAGS = (".sticks", ".count")  # whole numbers, which jump
ENERGIES = ("kinetic_energy", "potential_energy", "dissipated_energy", "external_work", "energy_error", "total_energy")


class Group(Struct):
    """Numbers that have a line together, by the names of their variables and the units. at_rest : see AT_REST."""

    name: str
    holds: Callable[[str, str], bool]
    at_rest: float = AT_REST


class QuantityError(Struct):
    """The number of a group that is wrong most on its own scale. error : its largest one; mean : their mean magnitude; extent : its
    range in the run; largest : the largest error of all numbers of the group in these `units`. beams : what the elements of beams make
    wrong of it is not looked at here. points : of a flexible body, on the scale of the motion of its points. over : time [s] over which
    means are compared, of accelerations of undamped beams; above : the share of them that vibrates faster."""

    quantity: str
    name: str
    error: float
    mean: float
    extent: float
    units: str
    largest: float
    beams: bool = False
    points: bool = False
    over: float = 0.0
    above: float = 0.0

    @property
    def share(self) -> float:
        return self.mean / self.extent


def _starts(*starts: str) -> Callable[[str, str], bool]:
    return lambda name, _: name.startswith(starts)


def _circuit(*units: str) -> Callable[[str, str], bool]:
    return lambda name, unit: name.startswith("hydraulics.") and (not units or unit in units)


# in the order in which a variable is asked for
GROUPS = (
    Group("speeds", _starts("velocity", "angular_velocity", "joint_rate")),
    Group("accelerations", _starts("acceleration", "angular_acceleration", "joint_acceleration")),
    Group("reactions", _starts("joint_force", "joint_torque")),
    Group("pressures", _circuit("Pa")),
    Group("flows", _circuit("m^3/s", "kg/s")),
    Group("components of circuits", _circuit()),
    Group("currents", lambda _, unit: unit in ("A", "V"), OWN),
    Group("control signals", _starts("control."), OWN),
    Group("forces", _starts("force.", "driver.")),
    Group("sensors", _starts("sensor."), OWN),
    Group("user states", _starts("state."), OWN),
    Group("modes", _starts("modal_")),
    Group("other numbers", lambda *_: True, OWN),
)


class _Scales(Struct):
    """By variable, what its numbers are compared with at least: of points of flexible bodies, of contacts. shared : spans
    of time [s] in which variables have no error of their own."""

    points: dict[str, Array]
    contacts: dict[str, float]
    shared: dict[str, tuple[tuple[float, float], ...]]


@np.errstate(over="ignore", invalid="ignore", divide="ignore")
def look(run: Run) -> list[QuantityError]:
    """Of each group the number with the largest share of errors."""
    if run.estimate is None:
        return []
    shared: dict[str, tuple[tuple[float, float], ...]] = {}
    together = friction.look(run)
    for each in together.shared if together is not None else ():
        # how much each takes of a load that several hold is not unique, and has no error while they do
        shared |= {name: (*shared.get(name, ()), *each.spans) for name in each.efforts}
    points = _of_points(run.result, modal_bodies(run.machine))
    scales = _Scales(points, _of_contacts(run), shared)
    return [found for group in GROUPS if (found := _worst(run, run.estimate, group, scales)) is not None]


def say(found: QuantityError) -> Item:
    """How large the errors of a group are, on the scale of each number."""
    scale = "the range that points of the body have" if found.points else "its range"
    its = f"{amount(found.mean, found.units)} on average, {number(found.share)} of {scale}"
    within = f"{found.quantity} within {amount(found.largest, found.units)}"
    if found.over:
        within += f" as means over {seconds(found.over)}, since {number(found.above)} of them is faster vibration without damping"
    by = (
        ", by the steps alone: errors of the elements of beams come on top (estimated_error has both)"
        if found.beams
        else ""
    )
    said = f"Quantities: {within}; worst is {found.name}, {its}{by}"
    return THRESHOLD.item("quantities", said, found.share, row=found.name)


def _worst(run: Run, estimate: Estimate, group: Group, scales: _Scales) -> QuantityError | None:
    finite = [each for each in _errors(run, estimate, group, scales) if np.isfinite(each.share)]
    if not finite:
        return None
    worst = max(finite, key=lambda each: each.share)
    largest = max(each.error for each in finite if each.units == worst.units)
    return replace(worst, largest=largest, beams=bool(run.machine.beams))


def group_of(variable: Variable, components: frozenset[str]) -> str:
    """The group that a variable of a result belongs to; empty where its errors are told elsewhere."""
    name = variable.name
    if name.startswith(ELSEWHERE) or name in ENERGIES or name.endswith(("_local", *FLAGS)):
        return ""
    # masses and pressures of volumes, and sums of energies, of which pressures and balances speak
    if name.startswith("state.") and name.split(".")[1] in components | {"hydraulics"}:
        return ""
    return next(group.name for group in GROUPS if group.holds(name, variable.units))


def _errors(run: Run, estimate: Estimate, group: Group, scales: _Scales) -> Iterator[QuantityError]:
    result, components = run.result, frozenset(each.name for each in run.machine.hydraulics)
    states = {f"state.{state.name}": state.scale or 0.0 for state in run.machine.states}
    names = [each for each in estimate.mean if group_of(result.variables[each], components) == group.name]
    second = run.second.result if run.second is not None and not run.second.ended else None
    extents = {name: _joined(result.variables[name], least_range(result, second, name)) for name in names}
    sizes = {name: float(np.nanmax(np.abs(result.array(name)), initial=0.0)) for name in names}
    largest_of: dict[str, float] = {}  # by unit
    size_of: dict[str, float] = {}
    for name in names:
        units = result.variables[name].units
        largest_of[units] = max(largest_of.get(units, 0.0), float(np.max(extents[name], initial=0.0)))
        size_of[units] = max(size_of.get(units, 0.0), sizes[name])
    for name in names:
        mean, error = estimate.mean[name], estimate.values[name][-1]
        if name in scales.shared:
            off = errors_apart(run, estimate, name, scales.shared[name])
            if not len(off):
                continue
            mean, error = np.mean(off, axis=0), np.max(off, axis=0)
        variable = result.variables[name]
        largest, natural = largest_of[variable.units], _natural(run, variable.units)
        rounded = ROUNDED * max(natural, size_of[variable.units])
        magnitude = _joined(variable, np.max(np.abs(result.array(name)), axis=0, initial=0.0))
        slow = means(run, estimate, name) if second is not None else None
        if slow is not None:
            mean, error = slow.mean, slow.error
            extents[name] = np.minimum(extents[name], _joined(variable, slow.extent))
        extent = np.maximum(extents[name], AT_REST * np.maximum(magnitude, natural))
        extent = np.maximum(np.maximum(extent, group.at_rest * largest), states.get(name, 0.0))
        moved = np.broadcast_to(scales.points.get(name, 0.0), extent.shape)
        extent = np.maximum(extent, scales.contacts.get(name, 0.0))
        mean, error = _joined(variable, mean), _joined(variable, error)
        for k in np.flatnonzero(error > rounded):
            label = _label(variable, int(k), run)
            units = variable.units or ("rad/s" if label.endswith("angle") else "m/s" if name == "joint_rate" else "1")
            own = float(error[k])
            scale = max(float(extent[k]), float(moved[k]), rounded) or own
            found = QuantityError(
                group.name, label, own, float(mean[k]), scale, units, own, points=bool(moved[k] >= scale)
            )
            yield found if slow is None else replace(found, over=slow.over, above=slow.above)


class Means(NamedTuple):
    """Means of accelerations from frame to frame. mean, error : of their errors, the mean and the largest; extent : their range. over [s] :
    between frames; above : the share of the accelerations, by root mean squares, that is faster."""

    mean: Array
    error: Array
    extent: Array
    over: float
    above: float


def means(run: Run, estimate: Estimate, name: str) -> Means | None:
    """Those of undamped beams, by the rates in frames of both runs: steps follow the motion, and not the vibrations that nothing ends."""
    if name not in RATES or all(beam.damping for beam in run.machine.beams):
        return None
    second = run.finer.result
    here, there = common_frames(run.result.time, second.time)
    rate = RATES[name]
    if len(here) < 3 or rate not in run.result.variables or rate not in second.variables:
        return None
    over = np.diff(run.result.time[here])
    spans = over.reshape(-1, *[1] * (run.result.array(rate).ndim - 1))
    own, other = (np.diff(each, axis=0) / spans for each in (run.result.array(rate)[here], second.array(rate)[there]))
    whole, slow = (float(np.sqrt(np.nanmean(each**2))) for each in (run.result.array(name)[here], own))
    off = distances(own, other, estimate.factor)
    above = float(np.sqrt(max(0.0, 1.0 - (slow / whole) ** 2))) if whole > 0.0 else 0.0
    return Means(np.mean(off, axis=0), np.max(off, axis=0), np.ptp(own, axis=0), float(np.median(over)), above)


def errors_apart(run: Run, estimate: Estimate, name: str, spans: tuple[tuple[float, float], ...]) -> Array:
    """Errors in the frames that both runs have outside some spans of time and the frames beside them."""
    time, second = run.result.time, run.finer.result
    here, there = common_frames(time, second.time)
    within = np.zeros(len(time), dtype=bool)
    for first, last in spans:
        within[max(np.searchsorted(time, first) - 1, 0) : np.searchsorted(time, last) + 2] = True
    own = ~within[here]
    return distances(run.result.array(name)[here[own]], second.array(name)[there[own]], estimate.factor)


def least_range(result: Readable, second: Readable | None, name: str) -> Array:
    """Ranges of the numbers of a variable, the smaller one of both runs: a number that one run alone has in a frame is an error, and no
    scale of it."""
    values = result.array(name)
    extent = np.ptp(values, axis=0)
    if second is None or name not in second.variables or second.array(name).shape[1:] != values.shape[1:]:
        return extent
    here, there = common_frames(result.time, second.time)
    if len(here) < 2:
        return extent
    own, other = np.ptp(values[here], axis=0), np.ptp(second.array(name)[there], axis=0)
    return np.where(other < own, extent * other / np.where(own > 0.0, own, 1.0), extent)


def _of_contacts(run: Run) -> dict[str, float]:
    """Friction of a contact is compared with the most that it can be, as the others of a body share its load, and slip with the speed of
    the machine, as what sticks creeps a little."""
    out: dict[str, float] = {}
    for force in run.machine.forces:
        start = f"force.{force.name}."
        if isinstance(force, Contact) and force.friction > 0.0 and f"{start}normal_force" in run.result.variables:
            limit = force.static * float(np.nanmax(run.result.array(f"{start}normal_force"), initial=0.0))
            out |= {f"{start}friction_{part}": limit for part in ("force", "x", "y", "z")}
            out[f"{start}slip_speed"] = run.scales.speed
    return out


def _of_points(result: Readable, bodies: list[ModalBody]) -> dict[str, Array]:
    """By variable, for each of its numbers, what moves a point of a flexible body over the range of the motion of such points; 0 for all
    others. Stiff modes that hardly move are often wrong by as much as they move, and so is the frame, which is no point of the body.
    Neither matters where all points move far more."""
    if not bodies:
        return {}
    of_bodies = {name: np.zeros(len(result.coordinates["body"])) for name in FRAME_MOTIONS}
    of_modes = {name: np.zeros(len(result.coordinates["mode"])) for name in MODAL}
    for body in bodies:
        its, k = point_ranges(result, body), result.coordinates["body"].index(body.name)
        own = slice(body.first, body.last)
        for name, turns in FRAME_MOTIONS.items():
            moved = its.acceleration if name.endswith("acceleration") else its.speed
            of_bodies[name][k] = moved / body.extent if turns and body.extent else moved
        moving = body.reach > 0.0
        for name, scale in zip(MODAL, (its.modal, its.speed / body.reach, its.acceleration / body.reach), strict=True):
            of_modes[name][own] = np.where(moving, scale, 0.0)
    return of_bodies | of_modes


def _natural(run: Run, units: str) -> float:
    """Magnitude [units] that the size, the speed and the weight of a machine give its numbers; 0 where they give none."""
    size = run.scales.size
    # a machine at rest has the largest speed that counts as none
    speed = run.scales.speed / (AT_REST if run.scales.at_rest else 1.0)
    mass = float(np.sum(run.prepared.motion.system.record.bodies.mass))
    weight = 9.81 * mass
    known = {
        "m/s": speed,
        "rad/s": speed / size,
        "m/s^2": 9.81,
        "rad/s^2": 9.81 / size,
        "Pa": 1e5,
        "m^3/s": 1e-3,
        "kg/s": 1.0,
        # modes of unit mass, whose deflections are a thousandth of the size
        "kg^0.5 m": 1e-3 * size * mass**0.5,
        "kg^0.5 m/s": speed * mass**0.5,
        "kg^0.5 m/s^2": 9.81 * mass**0.5,
    }
    known |= {"N": weight, "N m": weight * size, "J": weight * size, "W": weight * speed, "A": 1.0, "V": 1.0}
    if units in known or units in ("1", "", "rad", "m"):
        return known.get(units, 1.0)
    try:  # a sensor has units of its own
        kind, unit = measure(constant_tree(f"1 {units}", {})), read_quantity(f"1 {units}", ANY, {})
    except ExpressionError:
        return 0.0
    same = [value for name, value in known.items() if measure(constant_tree(f"1 {name.replace(' ', '*')}", {})) == kind]
    return (same[0] if same else 1.0 if kind in (KINDS["angle"][2], KINDS["length"][2]) else 0.0) / unit


def _joined(variable: Variable, values: Array) -> Array:
    """One number of each vector, a flat array."""
    values = np.asarray(values, dtype=float)
    if variable.dims[-1] == "xyz":
        values = np.linalg.norm(values, axis=-1)
    return values.ravel()


def _label(variable: Variable, k: int, run: Run) -> str:
    dims = [dim for dim in variable.dims[1:] if dim != "xyz"]
    if not dims:
        return variable.name
    shape = tuple(len(run.result.coordinates[dim]) for dim in dims)
    places = np.unravel_index(k, shape)
    of = ".".join(run.result.coordinates[dim][place] for dim, place in zip(dims, places, strict=True))
    return f"{variable.name} of {of}"


CHECKS = (Check("quantities", (Run,), look, say, 325, (ESTIMATE,), "Quantities", THRESHOLD),)
