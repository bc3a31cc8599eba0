"""Joints: degrees of freedom, redundant constraints, how far joints are open, and how fast their parts move against each other."""

from nivel.judge.after.report import Check
from nivel.judge.after.subject import Equilibria, Motion, Positions, Recorded, Run, Scales
from nivel.lazy import Struct
from nivel.results.motion import worst_row
from nivel.results.trust import Item, Threshold, Verdict, number


class Freedom(Struct):
    """Degrees of freedom of velocities, and of positions where that is another number. modes : of flexible bodies among them. drivers :
    motions that are prescribed. circuit : whether there are no bodies, and a circuit is all."""

    velocities: int | None = None
    positions: int | None = None
    modes: int = 0
    drivers: int = 0
    circuit: bool = False


def _look_at_freedom(subject: Run | Equilibria) -> Freedom:
    prepared = subject.prepared
    redundancy, drivers = prepared.redundancy, prepared.drivers
    if not prepared.motion.system.bodies:
        return Freedom(0, circuit=True)
    if isinstance(subject, Equilibria):
        return Freedom(redundancy.degrees_of_freedom, drivers=drivers)
    modes = len(prepared.motion.system.modes)
    return Freedom(redundancy.degrees_of_freedom, redundancy.position_freedoms, modes, drivers)


def _look_at_driven(subject: Positions) -> Freedom:
    return Freedom(0, drivers=subject.prepared.drivers)


def _say_freedom(found: Freedom) -> Item | None:
    count = found.velocities
    if count is None:
        return None
    if found.circuit:
        return Item("degrees_of_freedom", "green", "Freedom: a circuit without bodies (green)")
    if count < 1 and found.drivers:
        prescribed = "the driver prescribes" if found.drivers == 1 else f"{found.drivers} drivers prescribe"
        return Item("degrees_of_freedom", "green", f"Freedom: 0 degrees of freedom, {prescribed} every motion (green)")
    if count < 1:
        said = "Freedom: 0 degrees of freedom: nothing can move (green with 1 or more)"
        return Item("degrees_of_freedom", "amber", said)
    degrees = "1 degree of freedom" if count == 1 else f"{count} degrees of freedom"
    if found.positions is not None and found.positions > count:
        degrees += f" of velocities, {found.positions} of positions, as wheels roll without slip"
    modes = f", with {found.modes} modes of flexible bodies" if found.modes else ""
    return Item("degrees_of_freedom", "green", f"Freedom: {degrees}{modes} (green with 1 or more)")


class Redundancy(Struct):
    """Rows that repeat others, and the joints whose reactions depend on which of them are kept."""

    rows: tuple[str, ...] = ()
    joints: tuple[str, ...] = ()


def _look_at_redundancy(subject: Run | Equilibria | Positions) -> Redundancy:
    redundancy = subject.prepared.redundancy
    return Redundancy(tuple(redundancy.redundant_rows), tuple(redundancy.non_unique_joints))


def _say_redundancy(found: Redundancy) -> Item:
    if not found.rows:
        said = "Redundancy: no redundant constraints, every reaction is unique (green if none)"
        return Item("redundancy", "green", said)
    count = len(found.rows)
    repeats = "1 constraint row repeats others" if count == 1 else f"{count} constraint rows repeat others"
    unsure = (
        f"how {', '.join(found.joints)} share the load is not unique: `nivel check` lists the unique components, and the range "
        "of the others"
        if found.joints
        else "the reactions are unique"
    )
    rows = ", ".join(found.rows)
    text = f"Redundancy: {repeats} ({rows}). They do not change the motion; {unsure} (green if none, amber otherwise)"
    return Item("redundancy", "amber", text)


CLOSED = 1e-12  # of the size, or of the speed: violations below it are round-off
OPENING = Threshold(
    1e-6,
    1e-4,
    "For a machine of one metre, 1e-6 is a micrometre, less than the play of a good bearing. 1e-4 is a tenth of a millimetre, the play "
    "of a worn bearing: above it the joint is visibly open.",
)
RATES = Threshold(
    1e-5,
    1e-3,
    "If the parts of a joint move apart at 1e-3 of the machine's speed, the energy error has the same order. At 1e-5 it is below the "
    "green limit of the energy balance.",
)
# shares of the largest speed by which rates of constraints may be violated in kinematics
GREEN, AMBER = 1e-9, 1e-6
VELOCITIES = "Velocities fit the joints"


class Violation(Struct):
    """The constraint row that is violated most, when [s], and by how much, in the units m, rad or 1 (of rates per second)."""

    value: float
    row: str
    time: float
    units: str
    scales: Scales


def look_at_opening(subject: Recorded) -> Violation:
    """The joint that is open most."""
    worst, units = subject.opening
    return Violation(worst.value, worst.row, worst.time, units, subject.scales)


def look_at_rates(subject: Motion | Positions) -> Violation:
    """The same at velocity level."""
    size, speed = subject.scales.size, subject.scales.speed
    worst, units = worst_row(subject.result, "constraint_rate_violation", {"m": 1.0 / speed, "1": size / speed})
    return Violation(worst.value, worst.row, worst.time, f"{units}/s", subject.scales)


def say_opening(found: Violation) -> Item | None:
    """How far joints are open; nothing of machines without any."""
    if not found.row:
        return None
    length, size = found.units == "m", found.scales.size
    fraction = found.value / (size if length else 1.0)
    if found.value == 0.0:
        return OPENING.item("violation", "Joints: closed exactly", fraction)
    if fraction < CLOSED:
        return OPENING.item("violation", "Joints: closed to round-off", fraction, found.time, found.row)
    value = f"{number(found.value)} m, " if length else ""
    angle = " rad" if found.units == "rad" else " as a cosine"
    scale = f" of the {found.scales.size_kind} {number(size)} m" if length else angle
    said = f"Joints: open by at most {value}{number(fraction)}{scale}, row {found.row} at t = {found.time:.6g} s"
    return OPENING.item("violation", said, fraction, found.time, found.row)


def say_rates(found: Violation) -> Item | None:
    """How fast the parts of joints move against each other."""
    if not found.row:
        return None
    length, at_rest = found.units == "m/s", found.scales.at_rest
    scale = found.scales.speed if length else found.scales.speed / found.scales.size
    fraction = found.value / scale
    if fraction < CLOSED:
        said = "Joint rates: exact to round-off" + ("; the machine is at rest" if at_rest else "")
        return RATES.item("rate_violation", said, fraction, found.time, found.row)
    against = f"the largest speed {'' if length else 'over size '}{number(scale)} {found.units}"
    if at_rest:
        against = f"{number(scale)} {found.units}, the lower limit: the machine is at rest"
    said = f"Joint rates: off by at most {number(found.value)} {found.units}, {number(fraction)} of {against}"
    where = f"row {found.row} at t = {found.time:.6g} s"
    return RATES.item("rate_violation", f"{said}, {where}", fraction, found.time, found.row)


def _say_velocities(found: Violation) -> Item:
    rate = found.value * (1.0 if found.units == "m/s" else found.scales.size) / found.scales.speed
    said = f"Velocities: rates of constraints are violated by at most {number(rate)} of the largest speed"
    verdict: Verdict = "green" if rate <= GREEN else "amber" if rate <= AMBER else "red"
    return Item("velocities", verdict, f"{said} (green up to {GREEN:g})", time=found.time)


CHECKS = (
    Check("scales", Recorded, lambda subject: subject.scales, lambda _: None, 0),
    Check("degrees_of_freedom", (Run, Equilibria), _look_at_freedom, _say_freedom, 50, (), "Freedom"),
    Check("degrees_of_freedom", Positions, _look_at_driven, lambda _: None, 50),
    Check("redundancy", (Run, Positions), _look_at_redundancy, _say_redundancy, 60, (), "Redundancy", apart=True),
    Check("redundancy", Equilibria, _look_at_redundancy, _say_redundancy, 60, (), "Redundancy"),
    Check("violation", Recorded, look_at_opening, say_opening, 20, (), "Joints closed", OPENING),
    Check("rate_violation", Motion, look_at_rates, say_rates, 30, (), "Joint rates", RATES),
    Check("rate_violation", Positions, look_at_rates, _say_velocities, 30, (), VELOCITIES, line="velocities"),
)
