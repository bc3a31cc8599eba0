"""Verdicts of a result: the numbers, the thresholds they are held against, and the verdict in words."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable
from dataclasses import asdict, dataclass, fields
from typing import Any, Final, Literal

Verdict = Literal["green", "amber", "red"]


@dataclass(frozen=True)
class Threshold:
    """A number is green below `green`, amber below `amber`, red otherwise; NaN is red."""

    green: float
    amber: float
    reason: str

    def verdict(self, number: float) -> Verdict:
        if number < self.green:
            return "green"
        return "amber" if number < self.amber else "red"

    def shown(self, value: float) -> str:
        """A number in a sentence; with four digits where two would look like a threshold."""
        text = number(value)
        if float(text) not in (self.green, self.amber) or value in (self.green, self.amber):
            return text
        mantissa, exponent = f"{value:.3e}".split("e")
        return f"{mantissa}e{int(exponent)}"

    def __str__(self) -> str:
        beyond = f"amber below {self.amber:.0e}" if math.isfinite(self.amber) else "amber otherwise"
        return f"green below {self.green:.0e}, {beyond}".replace("e-0", "e-")


# Every threshold there is. Each number is a fraction, so the table holds for a watch and for a crane.
THRESHOLDS = {
    "energy": Threshold(
        1e-4,
        1e-2,
        "Friction and inertia of real machines are rarely known to 1 %. A larger energy error cannot be explained by uncertain data. "
        "1e-4 is two decades below: the error is not visible in any curve.",
    ),
    "violation": Threshold(
        1e-6,
        1e-4,
        "For a machine of one metre, 1e-6 is a micrometre, less than the play of a good bearing. 1e-4 is a tenth of a millimetre, the play "
        "of a worn bearing: above it the joint is visibly open.",
    ),
    "rate_violation": Threshold(
        1e-5,
        1e-3,
        "If the parts of a joint move apart at 1e-3 of the machine's speed, the energy error has the same order. At 1e-5 it is below the "
        "green limit of the energy balance.",
    ),
    "accuracy": Threshold(
        1e-4,
        1e-2,
        "1e-4 of a machine of one metre is a tenth of a millimetre, less than manufacturing tolerances. Above 1e-2 the curves of the run "
        "and of the exact motion are visibly different.",
    ),
    "neglected": Threshold(
        1e-3,
        1e-2,
        "Inertia of real bodies is rarely known to 1 %. Above this limit the neglected inertia invariants matter. 1e-3 is a decade below.",
    ),
}
# of what is told only where it is not green
CHECKS = {
    "loads": Threshold(
        1e-2,
        1e-1,
        "Loads of real machines are known to about a hundredth. If the steps miss a tenth of an impulse, the error is visible in every "
        "curve.",
    ),
    "sampling": Threshold(
        0.3,
        math.inf,
        "Between two samples the function leaves their values by this share of its range: a sine with less than three samples a period, or "
        "a pulse. The model itself samples, so its motion is still exact.",
    ),
    "steps": Threshold(
        0.3,
        math.inf,
        "The fastest rate of the machine times the step, reported if a run is red. Above 0.3 an explicit method does not resolve motions "
        "of this rate; above 1 to 3 it diverges.",
    ),
    "turn": Threshold(
        0.5,
        3.0,
        "Rotation in a step, in radians. At 0.5 the error of methods of order four is 2e-4 rad a turn. Near half a turn (3 rad) no method "
        "can determine the sense of the rotation.",
    ),
    "rounding": Threshold(
        1e-6,
        1e-3,
        "Half a unit in the last place of a coordinate, added in every step with the same sign, as a share of the machine's size. The "
        "limit is that of the constraint violation.",
    ),
    "parts": Threshold(
        1e-2,
        1e-1,
        "Error of a body or of a joint coordinate as a share of its own motion. Below a hundredth it is hardly visible in a curve; "
        "above a tenth the curve is a different one.",
    ),
    "stiffening": Threshold(
        1e-2,
        1e-1,
        "Centrifugal forces increase the stiffness of a slender body by about this share. Stiffness is known to about a hundredth; a tenth "
        "is visible.",
    ),
    "bending": Threshold(
        5e-2,
        2e-1,
        "A body that bends by the share x of its length becomes shorter by about x²/2 of its length: 1e-3 for x = 0.05, a fiftieth for "
        "x = 0.2. Linear modes do not include this.",
    ),
    "modes": Threshold(
        1e-2,
        1e-1,
        "Energy of the modes that are left out, as a share of the strain energy of the body (at least of that of a deflection of 1e-4 of "
        "its size). Displacements are too small by about this share. Stiffness is known to about a hundredth; a tenth is visible.",
    ),
    "mesh": Threshold(
        1e-2,
        1e-1,
        "Displacements are too small by about the share of the energy that the elements miss. Stiffness is known to about a hundredth; a "
        "tenth is visible.",
    ),
}
# what no second run of the same model and method sees, by the names of items
BLIND = {
    "loads": "their steps miss {row}",
    "contact": "their steps pass {row}",
    "turn": "{row} rotates too far in a step",
    "rounding": "{row} is so far from the origin that the motion in a step is below round-off",
    "damped": "their method damps vibrations",
    "singular": "at t = {time} s the motion may continue in more than one way",
}
# of states of equilibrium
RESIDUAL = Threshold(
    1e-8,
    1e-5,
    "Largest unbalanced force as a share of the largest load. Loads are rarely known to 1e-3; 1e-5 is two decades below. Newton's method "
    "ends far below 1e-8, unless the machine has both very stiff and very soft parts.",
)


EXTENT_FLOOR = 1e-12  # of the distance from the global origin: round-off of points that are one
REST = 1e-3  # of the size, travelled in the time of the run: a machine that stays below it is at rest
# of the potential energy, of a load times the size, of the energy of travelling by the size in the run: round-off of a machine at rest
# is below green
ENERGY_FLOOR = 1e-9
ROUND_OFF = 1e-14  # of the size: an error below it is none
CLOSED = 1e-12  # of the size: joints that are open by less are closed as well as a run closes them
OPENING_WORK = 1e5  # times the work of the loads over what closed joints are open by: it is a decade below green
POINT_SIZE = 1.0  # m: a single point that never moves has no size; said wherever it is used

RULES = {
    "energy_scale": "the largest of: the kinetic energy, the change of potential energy, the work of external forces, the dissipated "
    "energy. For a machine at rest the scale has lower limits: 1e-9 of the largest potential energy; 1e-9 (or the tolerance, at rest with "
    "chosen steps) of the largest load, without dampers, and the weight, times the size, and of the kinetic energy of moving by the size "
    "during the run; 1e5 times the work of these loads over the opening of the joints, if this is at most 1e-12 of the size. There is no "
    "fixed number of joules: if all energies are zero, an error of zero is the fraction zero",
    "size": "the diagonal of the box around all joint points, centres of mass and body origins in the first frame. "
    "If all of them are one point, the larger of: the diagonal of the box around its path, and twice the largest radius of gyration. If "
    "both are missing (a point mass, or one that moves by less than 1e-9 of what its loads would move it), 1 m by convention. "
    "Constraint rows that are cosines of angles are compared with 1",
    "speed": "the largest speed of any joint point, centre of mass or body origin (upper bound |v| + |ω| r, where r is the radius of "
    "gyration of a body without other points). If the machine moves at this speed by less than 1e-3 of its size during the run, it is at "
    "rest, and the speed that moves it by 1e-3 of its size is used. Rates of cosines of angles are compared with speed / size",
}


@dataclass(frozen=True)
class Item:
    """One line of the trust report.

    fraction : what is held against `green` and `amber`; None where the item is not a number.
    text : the whole statement for a machine designer, thresholds included.
    """

    name: str
    verdict: Verdict
    text: str
    fraction: float | None = None
    green: float | None = None
    amber: float | None = None
    row: str = ""
    time: float | None = None


@dataclass(frozen=True)
class Trust:
    """The numbers behind the verdicts, in SI units, and the verdicts.

    Rows are named as in the machine (`hinge.s.x`), times are in seconds. Violations are in `…_units`: m, rad or 1 (a
    cosine).
    size_kind : what `size` is, to be said after "the". at_rest : `speed` is not that of the machine, which is at rest,
    but the least speed that counts.
    accuracy_refinement : what the run was done again with to find `accuracy_estimate`; verified_until : up to which time [s], None where
    to the end; verification_ended : why not further. degrees_of_freedom : of velocities, None where the run did not
    live to tell; position_freedoms : of positions. modes : of flexible bodies, whose coordinates
    are freedoms that joints may take. neglected_share : the largest share of the mass matrix of a flexible body that is lacking because it
    moves without the inertia invariants `neglected_names`; None where none does. drivers : motions that are prescribed.
    undetermined_efforts : results that are not unique while a friction holds a joint at rest together with a driver or
    with other frictions.
    unresolved_force : that does so much work in a step of fixed size, unresolved_work [J] at unresolved_time, that the energy error may be
    its; empty where none does, or the energy is green.
    """

    verdict: Verdict
    outcome: str
    energy_error_max: float
    energy_error_time: float
    energy_scale: float
    energy_scale_kind: str
    size: float
    speed: float
    constraint_violation_max: float = 0.0
    constraint_violation_row: str = ""
    constraint_violation_time: float = 0.0
    constraint_violation_units: str = "m"
    constraint_rate_violation_max: float = 0.0
    constraint_rate_violation_row: str = ""
    constraint_rate_violation_time: float = 0.0
    constraint_rate_violation_units: str = "m/s"
    degrees_of_freedom: int | None = None
    position_freedoms: int | None = None
    drivers: int = 0
    redundant_rows: tuple[str, ...] = ()
    non_unique_joints: tuple[str, ...] = ()
    accuracy_estimate: float | None = None
    accuracy_body: str = ""
    accuracy_time: float | None = None
    accuracy_refinement: str = "half the step"
    verified_until: float | None = None
    verification_ended: str = ""
    size_kind: str = "machine's size"
    at_rest: bool = False
    modes: int = 0
    neglected_share: float | None = None
    neglected_body: str = ""
    neglected_names: tuple[str, ...] = ()
    neglected_time: float | None = None
    undetermined_efforts: tuple[str, ...] = ()
    unresolved_force: str = ""
    unresolved_work: float = 0.0
    unresolved_time: float = 0.0
    items: tuple[Item, ...] = ()

    def to_json(self) -> str:
        """JSON text; NaN and infinities stand as the strings "nan", "inf", "-inf"."""
        return json.dumps(_storable(asdict(self)), ensure_ascii=False)

    @classmethod
    def from_json(cls, text: str) -> Trust:
        """Read what `to_json` wrote; keys of later versions are passed over."""
        data = json.loads(text)
        data["items"] = tuple(Item(**_known(Item, each)) for each in data["items"])
        for name in ("redundant_rows", "non_unique_joints", "neglected_names", "undetermined_efforts"):
            data[name] = tuple(data.get(name, ()))
        for each in (*data["items"], known := cls(**_known(cls, data))):
            _refuse_other_types(each)
        return known

    @property
    def headline(self) -> str:
        """How exact the run is, in a sentence: what a second run says, or that there was none."""
        if self.accuracy_estimate is None:
            return "not verified"
        if blind := blindness(self.items):
            return f"of unknown error: two runs agree within {number(self.accuracy_estimate)} m, but {blind}"
        where = f"; largest at {self.accuracy_body}" if self.accuracy_body else ""
        when = f", t = {self.accuracy_time:.6g} s" if self.accuracy_time is not None else ""
        until = (
            f" up to t = {self.verified_until:.6g} s, not verified beyond" if self.verified_until is not None else ""
        )
        if self.accuracy_estimate < ROUND_OFF * self.size:
            return f"exact for this model, except for round-off{until}"
        return f"within {number(self.accuracy_estimate)} m of the exact motion of this model{until}{where}{when}"

    def lines(self) -> list[str]:
        """One line per item: its verdict and its statement."""
        return [f"{item.verdict:>5}  {item.text}" for item in self.items]

    def __str__(self) -> str:
        return "\n".join(self.lines())


def blindness(items: Iterable[Item]) -> str:
    """Why two runs may be wrong alike, in words; empty where nothing says so."""
    for item in items:
        if item.verdict != "green" and item.name in BLIND:
            return BLIND[item.name].format(row=item.row, time=f"{item.time or 0.0:.6g}")
    return ""


def worst(items: tuple[Item, ...]) -> Verdict:
    """The verdict of the whole: that of its worst item."""
    found = [item.verdict for item in items]
    return "red" if "red" in found else "amber" if "amber" in found else "green"


def number(value: float) -> str:
    """Two significant digits for what is tiny or huge, three for the sizes one can picture."""
    if value == 0.0 or not math.isfinite(value):
        return f"{value:g}"
    if 1e-3 <= abs(value) < 1e6:
        return f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"
    mantissa, exponent = f"{value:.1e}".split("e")
    return f"{float(mantissa):g}e{int(exponent)}"


def quantity(value: float, unit: str) -> str:
    """A number with its unit as people say it: 94 kJ, 1.25 MJ, 812 J."""
    for factor, prefix in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if factor <= abs(value) < 1e12:
            return f"{value / factor:.3g} {prefix}{unit}"
    return f"{number(value)} {unit}"


def _known(record: type[Any], data: dict[str, Any]) -> dict[str, Any]:
    """The entries that the record has; numbers that JSON cannot hold are read back."""
    names = {field.name: field.type for field in fields(record)}
    return {
        key: float(value) if value in ("nan", "inf", "-inf") and "float" in str(names[key]) else value
        for key, value in data.items()
        if key in names
    }


# of annotations of fields, the types of their values
TYPES: Final[dict[str, tuple[type, ...]]] = {
    "str": (str,),
    "Verdict": (str,),
    "bool": (bool,),
    "int": (int,),
    "int | None": (int, type(None)),
    "float": (int, float),
    "float | None": (int, float, type(None)),
    "tuple[str, ...]": (tuple,),
    "tuple[Item, ...]": (tuple,),
}


def _refuse_other_types(record: Item | Trust) -> None:
    """Raise TypeError where a value is none of its field's type."""
    for field in fields(record):
        value = getattr(record, field.name)
        names = value if isinstance(value, tuple) and "str" in str(field.type) else ()
        if not isinstance(value, TYPES[str(field.type)]) or not all(isinstance(name, str) for name in names):
            raise TypeError(f"{field.name} is {type(value).__name__}")
        if field.type == "Verdict" and value not in ("green", "amber", "red"):
            raise ValueError(f"{field.name} is {value!r}")


def _storable(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _storable(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_storable(each) for each in value]
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    return value
