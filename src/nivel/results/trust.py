"""Verdicts of a result: what checks have found, the thresholds that it is held against, and the verdict in words."""

from __future__ import annotations  # types of fields are read as text

import json
import math
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Final, Literal, NamedTuple

import numpy as np

from nivel.lazy import Struct, field, fields, is_dataclass, replace

Verdict = Literal["green", "amber", "red"]
NOT_VERIFIED: Final = "not verified"  # in place of green
ROUND_OFF: Final = 1e-14  # of the size: an error below it is none
ERRORS: Final = ("accuracy", "parts", "quantities", "verified")  # lines whose numbers are estimates of errors
ROUNDED: Final = 1e-9  # of the range of a number beside positions: what equations and sums round to


class Threshold(Struct):
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

    def item(self, name: str, text: str, value: float, time: float | None = None, row: str = "") -> Item:
        """The line of a number that is held against this threshold."""
        return Item(name, self.verdict(value), f"{text} ({self})", value, self.green, self.amber, row, time)

    def __str__(self) -> str:
        beyond = f"amber below {self.amber:.0e}" if math.isfinite(self.amber) else "amber otherwise"
        return f"green below {self.green:.0e}, {beyond}".replace("e-0", "e-")


class Item(Struct):
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


class Key(NamedTuple):
    """A number of a check under a name of its own: name of the check, of its field, type, and value where the check has found nothing."""

    check: str
    field: str
    type: str
    absent: Any = None


# names that the JSON of every result has, and attributes of `Trust`; other numbers stand in `found` alone
KEYS: Final = {
    "energy_error_max": Key("energy", "error", "float", 0.0),
    "energy_error_time": Key("energy", "time", "float", 0.0),
    "energy_scale": Key("energy", "scale", "float", 0.0),
    "energy_scale_kind": Key("energy", "scale_kind", "str", ""),
    "unresolved_force": Key("energy", "force", "str", ""),
    "unresolved_work": Key("energy", "force_work", "float", 0.0),
    "unresolved_time": Key("energy", "force_time", "float", 0.0),
    "size": Key("scales", "size", "float", 1.0),
    "size_kind": Key("scales", "size_kind", "str", "machine's size"),
    "speed": Key("scales", "speed", "float", 1.0),
    "at_rest": Key("scales", "at_rest", "bool", False),
    "constraint_violation_max": Key("violation", "value", "float", 0.0),
    "constraint_violation_row": Key("violation", "row", "str", ""),
    "constraint_violation_time": Key("violation", "time", "float", 0.0),
    "constraint_violation_units": Key("violation", "units", "str", "m"),
    "constraint_rate_violation_max": Key("rate_violation", "value", "float", 0.0),
    "constraint_rate_violation_row": Key("rate_violation", "row", "str", ""),
    "constraint_rate_violation_time": Key("rate_violation", "time", "float", 0.0),
    "constraint_rate_violation_units": Key("rate_violation", "units", "str", "m/s"),
    "degrees_of_freedom": Key("degrees_of_freedom", "velocities", "int | None"),
    "position_freedoms": Key("degrees_of_freedom", "positions", "int | None"),
    "modes": Key("degrees_of_freedom", "modes", "int", 0),
    "drivers": Key("degrees_of_freedom", "drivers", "int", 0),
    "redundant_rows": Key("redundancy", "rows", "tuple[str, ...]", ()),
    "non_unique_joints": Key("redundancy", "joints", "tuple[str, ...]", ()),
    "undetermined_efforts": Key("shared_friction", "efforts", "tuple[str, ...]", ()),
    "accuracy_estimate": Key("accuracy", "error", "float | None"),
    "accuracy_body": Key("accuracy", "body", "str", ""),
    "accuracy_time": Key("accuracy", "time", "float | None"),
    "accuracy_refinement": Key("accuracy", "refinement", "str", ""),
    "accuracy_blind": Key("accuracy", "blind", "str", ""),
    "accuracy_parted": Key("accuracy", "parted", "float | None"),
    "elements_estimate": Key("elements", "error", "float | None"),
    "elements_body": Key("elements", "body", "str", ""),
    "elements_time": Key("elements", "time", "float | None"),
    "verified_until": Key("verified", "until", "float | None"),
    "verified_by": Key("verification", "by", "tuple[str, ...]", ()),
    "not_verified": Key("verification", "lacks", "tuple[str, ...]", ()),
    "verification_ended": Key("verified", "ended", "str", ""),
    "neglected_share": Key("neglected", "share", "float | None"),
    "neglected_body": Key("neglected", "body", "str", ""),
    "neglected_names": Key("neglected", "names", "tuple[str, ...]", ()),
    "neglected_time": Key("neglected", "time", "float | None"),
}


class Trust(Struct):
    """The verdict on a result, its lines, and the numbers behind them in SI units.

    found : what each check has found, by its name: a mapping of its numbers, or a tuple of those. `KEYS` has names for some of
    them, which are attributes too: `energy_error_max`, `constraint_violation_row` (as in the machine, `hinge.s.x`), `accuracy_estimate`.
    Times are in seconds; violations in `…_units`: m, rad or 1 (a cosine).
    """

    verdict: Verdict
    outcome: str
    found: Mapping[str, Any] = field(default_factory=dict)
    items: tuple[Item, ...] = ()

    def __getattr__(self, name: str) -> Any:
        """A number of KEYS."""
        if name not in KEYS:
            raise AttributeError(f"'Trust' has no attribute '{name}'", name=name, obj=self)
        key = KEYS[name]
        found = self.found.get(key.check)
        return key.absent if found is None else found.get(key.field, key.absent)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *KEYS]

    def to_json(self) -> str:
        """JSON text; NaN and infinities stand as the strings "nan", "inf", "-inf"."""
        flat = {"verdict": self.verdict, "outcome": self.outcome, "verified": self.verified, "light": self.light}
        flat |= {name: getattr(self, name) for name in KEYS}
        flat["items"] = [{each.name: getattr(item, each.name) for each in fields(Item)} for item in self.items]
        found = storable(self.found, lambda value: {"number": str(value)})  # texts may look like numbers there
        return json.dumps({**storable(flat, str), "found": found}, ensure_ascii=False)

    @classmethod
    def from_json(cls, text: str) -> Trust:
        """Read what `to_json` wrote, or an earlier version, which has the names of KEYS alone; those of later versions are passed over."""
        data = json.loads(text)
        items = tuple(Item(**_known(Item, each)) for each in data["items"])
        found = _untagged(data["found"]) if "found" in data else _of_keys(data, items)
        trust = cls(data["verdict"], data["outcome"], found, items)
        for each in (*items, trust):
            _refuse_other_types(each, {field.name: str(field.type) for field in fields(each)})
        _refuse_other_types(trust, {name: key.type for name, key in KEYS.items()})
        return trust

    @property
    def verified(self) -> bool:
        """Whether something beside the computation itself has examined the whole of it: `verified_by` says what; nothing is
        `not_verified`. Files of earlier versions know it of runs alone."""
        if self.verified_until is not None:
            return False
        if "verification" not in self.found:
            return self.accuracy_estimate is not None
        return bool(self.verified_by) and not self.not_verified

    @property
    def light(self) -> str:
        """The verdict as it is shown: `not verified` where it would be green, and not everything was examined."""
        return NOT_VERIFIED if self.verdict == "green" and not self.verified else self.verdict

    @property
    def headline(self) -> str:
        """How exact the result is, in a sentence: of a run what a second run says of bodies and of the number that is worst beside, or that
        there was none; of other analyses what has examined them, and what nothing has. Where a line is red the first thing said is not a
        small number."""
        if self.accuracy_estimate is None:
            return self._examined()
        return f"{self._exactness()}{self._not_unique()}{self._lacks()}"

    def _exactness(self) -> str:
        """What a second run says."""
        assert self.accuracy_estimate is not None
        agree = f"two runs agree within {number(self.accuracy_estimate)} m"
        if self.accuracy_parted is not None:
            return f"of unknown error: two runs go different ways from t = {self.accuracy_parted:.6g} s on, and {self.accuracy_blind}"
        if self.accuracy_blind:
            return f"of unknown error: {agree}, but {self.accuracy_blind}"
        if doubt := self._doubt():
            return f"of unknown error: {agree}, but the line {doubt} is red"
        until = (
            f" up to t = {self.verified_until:.6g} s, not verified beyond" if self.verified_until is not None else ""
        )
        if (self.found.get("degrees_of_freedom") or {}).get("circuit"):
            return f"{self._of_circuit()}{until}"
        by_elements = self.elements_estimate or 0.0
        total, larger = self.accuracy_estimate + by_elements, by_elements > self.accuracy_estimate
        body, time = (self.elements_body, self.elements_time) if larger else (self.accuracy_body, self.accuracy_time)
        where = f"; largest at {body}" if body else ""
        when = f", t = {time:.6g} s" if time is not None else ""
        cause = f"; {number(by_elements)} m of it by the elements of beams" if larger else ""
        motion = f"within {number(total)} m of the exact motion of this model{until}{where}{when}{cause}"
        exact = total < ROUND_OFF * self.size and "unexamined" not in self.found
        rest = self._worst_of_rest()
        if not rest:
            return f"exact for this model, except for round-off{until}" if exact else motion
        name, error = rest["quantity"], amount(rest["largest"], rest["units"])
        bodies = f"bodies exact, except for round-off{until}" if exact else f"bodies {motion}"
        red = {item.name for item in self.items if item.verdict == "red"}
        if exact or (red and "accuracy" not in red):
            return f"{name} {'off by up to' if red else 'within'} {error} ({rest['name']} most); {bodies}"
        return f"{motion}; {name} within {error} ({rest['name']} most)"

    def _not_unique(self) -> str:
        """Numbers that the equations do not determine, of which no error can be stated."""
        names = [f"reactions of {', '.join(self.non_unique_joints)}"] if self.non_unique_joints else []
        names += self.undetermined_efforts
        return f"; not unique: {' and '.join(names)}" if names else ""

    def _of_circuit(self) -> str:
        """Errors of a circuit without bodies: pressures and flows first."""
        found = {each["quantity"]: each for each in self.found.get("quantities", ()) if each["error"] > 0.0}
        usual = [found.pop(name) for name in ("pressures", "flows") if name in found]
        usual += [each for each in found.values() if each["error"] > ROUNDED * each["extent"]]
        said = [
            f"{each['quantity']} within {amount(each['largest'], each['units'])} ({each['name']} most)"
            for each in usual[:3]
        ]
        return " and ".join(said) if said else "exact for this model, except for round-off"

    def _examined(self) -> str:
        """What has examined a result, and what of it nothing has."""
        if not self.verified_by:
            return f"{NOT_VERIFIED}: {' and '.join(self.not_verified)}" if self.not_verified else NOT_VERIFIED
        by = f"by {' and '.join(self.verified_by)}"
        return f"verified in part: {by}{self._lacks()}" if self.not_verified else f"verified {by}"

    def _lacks(self) -> str:
        return f"; {NOT_VERIFIED}: {' and '.join(self.not_verified)}" if self.not_verified else ""

    @property
    def told(self) -> str:
        """`amber, within 1e-3 m of …`: the light and the headline in a line; without a light where that would be green by mistake."""
        return told(self.light, self.headline)

    def _doubt(self) -> str:
        """The title of a red line that is no estimate of an error; empty where there is none."""
        known = (*ERRORS, "mesh") if self.elements_estimate is not None else ERRORS
        red = [item for item in self.items if item.verdict == "red" and item.name not in known]
        return red[0].text.partition(":")[0] if red else ""

    def _worst_of_rest(self) -> Mapping[str, Any]:
        """The number beside positions that is wrong most on its own scale; empty where all are exact except for round-off."""
        worst = max(self.found.get("quantities", ()), key=lambda each: each["error"] / each["extent"], default={})
        return worst if worst and worst["error"] > ROUNDED * worst["extent"] else {}

    def of_derived(self, *lacks: str) -> Trust:
        """The trust report of numbers that were computed from the result: the same, of which also `lacks` is not verified, in words."""
        if not lacks:
            return self
        by = self.verified_by or ((self.accuracy_refinement,) if self.accuracy_refinement else ())
        found = {**self.found, "verification": {"by": by, "lacks": (*self.not_verified, *lacks)}}
        return replace(self, found=found)

    def attributes(self) -> dict[str, str | int]:
        """Attributes of a dataset: the light as `verdict`, whether all was `verified` (0 or 1), the `headline`; `trust`, all as JSON."""
        return {
            "verdict": self.light,
            "verified": int(self.verified),
            "headline": self.headline,
            "trust": self.to_json(),
        }

    def summary(self) -> dict[str, Any]:
        """Keys of the summary of an analysis for programs."""
        facts = {"verdict": self.verdict, "light": self.light, "verified": self.verified, "headline": self.headline}
        return {**facts, "trust": json.loads(self.to_json())}

    def told_lines(self, *known: str) -> list[str]:
        """What a terminal is told: light and headline, and the lines that are not green, but for those that it knows already."""
        left = [item for item in self.items if item.verdict != "green" and item.name not in known]
        return [f"trust: {self.told}", *(f"  {item.text}" for item in left)]

    def lines(self) -> list[str]:
        """One line per item: its verdict and its statement."""
        return [f"{item.verdict:>5}  {item.text}" for item in self.items]

    def __str__(self) -> str:
        return "\n".join(self.lines())


def told(light: str, headline: str) -> str:
    """Light and headline in a line."""
    return headline if light == NOT_VERIFIED else f"{light}, {headline}"


def amount(value: float, units: str) -> str:
    """A number with its units as in a sentence: pressures in bar, nothing for plain numbers."""
    if units == "Pa" and abs(value) >= 100.0:
        return f"{number(value / 1e5)} bar"
    return number(value) if units == "1" else f"{number(value)} {units}"


def worst(items: Iterable[Item]) -> Verdict:
    """The verdict of the whole: that of its worst item."""
    found = [item.verdict for item in items]
    return "red" if "red" in found else "amber" if "amber" in found else "green"


def number(value: float, digits: int = 3, extreme: int = 2) -> str:
    """So many significant digits for the sizes one can picture, `extreme` ones for what is tiny or huge."""
    if value == 0.0 or not math.isfinite(value):
        return f"{value:g}"
    if 1e-3 <= abs(value) < 1e6:
        return f"{value:.{digits}g}" if abs(value) < 10.0**digits else f"{value:.0f}"
    mantissa, exponent = f"{value:.{extreme - 1}e}".split("e")
    return f"{float(mantissa):g}e{int(exponent)}"


def quantity(value: float, unit: str, digits: int = 3, extreme: int = 2) -> str:
    """A number with its unit as people say it: 94 kJ, 1.25 MJ, 812 J. digits, extreme : as of `number`."""
    for factor, prefix in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if factor <= abs(value) < 1e12:
            return f"{value / factor:.{digits}g} {prefix}{unit}"
    return f"{number(value, digits, extreme)} {unit}"


def plain(value: Any) -> Any:
    """Records as mappings, sequences as tuples, numbers of NumPy as those of Python."""
    if is_dataclass(value) and not isinstance(value, type):
        return {each.name: plain(getattr(value, each.name)) for each in fields(value)}
    if isinstance(value, list | tuple):
        return tuple(plain(each) for each in value)
    return value.item() if isinstance(value, np.generic) else value


def _of_keys(data: dict[str, Any], items: tuple[Item, ...]) -> dict[str, Any]:
    """What checks have found, of names of KEYS."""
    found: dict[str, dict[str, Any]] = {}
    for name, key in KEYS.items():
        if name in data:
            value = _number(data[name], key.type)
            found.setdefault(key.check, {})[key.field] = tuple(value) if isinstance(value, list) else value
    if "accuracy" in found:  # versions without this key say it in the line alone
        said = next((each.text for each in items if each.name == "accuracy"), "").partition(
            "both may have the same error: "
        )[2]
        found["accuracy"]["blind"] = said.rpartition(" (green")[0]
    return found


def _known(record: type[Any], data: dict[str, Any]) -> dict[str, Any]:
    """The entries that the record has; numbers that JSON cannot hold are read back."""
    types = {field.name: str(field.type) for field in fields(record)}
    return {key: _number(value, types[key]) for key, value in data.items() if key in types}


def _number(value: Any, kind: str) -> Any:
    return float(value) if value in ("nan", "inf", "-inf") and "float" in kind else value


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
    "Mapping[str, Any]": (dict,),
}


def _refuse_other_types(record: Item | Trust, types: Mapping[str, str]) -> None:
    for name, kind in types.items():
        value = getattr(record, name)
        names = value if isinstance(value, tuple) and "str" in kind else ()
        if not isinstance(value, TYPES[kind]) or not all(isinstance(each, str) for each in names):
            raise TypeError(f"{name} is {type(value).__name__}")
        if kind == "Verdict" and value not in ("green", "amber", "red"):
            raise ValueError(f"{name} is {value!r}")


def storable(value: Any, instead: Callable[[float], Any]) -> Any:
    """The same for JSON, which knows neither NaN nor infinity: `instead` gives what stands for these."""
    if isinstance(value, Mapping):
        return {key: storable(each, instead) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [storable(each, instead) for each in value]
    return instead(value) if isinstance(value, float) and not math.isfinite(value) else value


def _untagged(value: Any) -> Any:
    if isinstance(value, dict):
        if value.keys() == {"number"}:
            return float(value["number"])
        return {key: _untagged(each) for key, each in value.items()}
    return tuple(_untagged(each) for each in value) if isinstance(value, list) else value
