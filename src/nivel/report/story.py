"""The words and figures of the report around its plots."""

import json
import math
import re
from typing import Any

from nivel.judge.after.report import titles
from nivel.known import Result
from nivel.lazy import Struct
from nivel.report.deflections import beam_nodes
from nivel.results.frames.summary import in_words
from nivel.results.trust import NOT_VERIFIED, Trust, Verdict
from nivel.words.wording import counted, set_in_motion

SHOWN_CHANGES = 6  # bodies that the assembly changed; more are counted
SHOWN_EVENTS = 20  # likewise
# counters of a run by the words of the table
COUNTERS = {
    "unconserved": "steps that do not keep the energy",
    "guarded": "parts of steps that were not extrapolated",
    "pressure_difference": "largest difference of pressures in a step",
    "partitions": "new choices of independent coordinates",
    "rejected": "rejected steps",
}
ROUND_OFF = 1e-14  # m, rad or per second: smaller changes are not told
DECADES = 16  # of a gauge, down from 1: round-off of double precision

HEADLINES: dict[str, tuple[Verdict, str]] = {
    "done": ("green", "Yes, to its end"),
    "interrupted": ("amber", "Interrupted"),
    "failed": ("red", "No, it stopped"),
    "running": ("amber", "Never closed"),
}
VERDICTS: dict[Verdict, str] = {
    "green": "Yes, everything is in the green",
    "amber": "With care: see what is amber",
    "red": "No: see what is red",
}
UNVERIFIED, IN_PART = "Not verified", "Verified in part"


class Headline(Struct):
    """The two answers on top: did it run, can I trust it. trust_text : how exact it is."""

    outcome: str
    outcome_verdict: Verdict
    outcome_text: str
    trust: str
    trust_verdict: Verdict
    trust_text: str


class Gauge(Struct):
    """A number on a logarithmic scale from 1e-16 to 1, in percent of the scale's length."""

    value: float
    green: float
    amber: float


class TrustLine(Struct):
    """An item of the trust report: its name, its statement without the name, and its gauge where it is a number."""

    name: str
    verdict: Verdict
    text: str
    gauge: Gauge | None


def headline(result: Result) -> Headline:
    """What happened and whether to believe it, in a few words."""
    verdict, outcome = HEADLINES.get(result.outcome, ("red", result.outcome))
    reached = _reached(result)
    seconds = result.timing.get("loop_seconds")
    took = f", computed in {_took(float(seconds))}" if seconds else ""
    if result.stopped_by:
        took += f", until the event {result.stopped_by}"
    text = {
        "running": f"{reached}. The run is still going on, or it was killed; everything up to its last block is here.",
        "interrupted": f"{reached}{took}, then it was stopped by hand.",
        "failed": f"{reached}{took}. {_sentence(result.failure)}",
    }.get(result.outcome, f"{reached}{took}")
    believed = trusted(result.trust)
    return Headline(outcome, verdict, text, believed.answer, believed.tone, believed.text)


class Trusted(Struct):
    """Whether to believe a result: the answer and its colour, how exact it is, and the lines of its trust report."""

    answer: str
    tone: Verdict
    text: str
    lines: list[TrustLine]


def trusted(trust: Trust) -> Trusted:
    """What a trust report says. Of what was not verified there is no plain yes."""
    lines = trust_lines(trust)
    if trust.light != NOT_VERIFIED:
        return Trusted(VERDICTS[trust.verdict], trust.verdict, _breaking(_sentence(trust.headline)), lines)
    if trust.verified_by:
        return Trusted(IN_PART, "amber", _breaking(_sentence(trust.headline)), lines)
    left = f": {' and '.join(trust.not_verified)}" if trust.not_verified else ""
    said = f"nothing below is against it, but nothing says how exact it is{left}"
    return Trusted(UNVERIFIED, "amber", _breaking(_sentence(said)), lines)


def _reached(result: Result) -> str:
    time = result.time
    if not len(time):
        return "nothing was computed"
    if result.is_statics:
        return f"{counted(len(time), 'equilibrium', 'equilibria')} from t = {_seconds(float(time[0]))} to {_seconds(float(time[-1]))}"
    return f"{_seconds(float(time[-1] - time[0]))} simulated"


def facts(result: Result) -> list[str]:
    """What the machine is and how it was run, in a line; of what it may lack, only what it has."""
    count = {dim: len(result.coordinates.get(dim, ())) for dim in ("body", "joint")}
    nodes = beam_nodes(result)
    solid = count["body"] - sum(map(len, nodes.values()))
    out = [counted(solid, "body", "bodies")] if solid or not nodes else []
    out += [counted(len(nodes), "beam")] if nodes else []
    out.append(counted(count["joint"], "joint"))
    for section in ("coupling", "driver", "force", "sensor"):
        named = {name.split(".")[1] for name in result.variables if name.startswith(f"{section}.")}
        out += [counted(len(named), section)] if named else []
    degrees = result.trust.degrees_of_freedom
    if degrees is not None:
        out.append(counted(degrees, "degree of freedom", "degrees of freedom"))
    settings = result.settings
    if isinstance(settings.get("step"), int | float):
        out.append(f"step {_seconds(float(settings['step']))}")
    out += [str(settings[name]) for name in ("integrator", "formulation") if name in settings]
    if "stabilisation" in settings:
        out.append(f"stabilisation {settings['stabilisation']}")
    return out


def trust_lines(trust: Trust) -> list[TrustLine]:
    """The items of the trust report as the page shows them. The outcome stands above already."""
    names, out = titles(), []
    for item in trust.items:
        text = _breaking(item.text.split(": ", maxsplit=1)[-1])
        numbers = [each for each in (item.fraction, item.green, item.amber) if each is not None]
        gauge = Gauge(*map(_percent, numbers)) if len(numbers) == 3 else None
        if item.name != "outcome":
            out.append(TrustLine(names.get(item.name, item.name), item.verdict, text[:1].upper() + text[1:], gauge))
    return out


def settings_table(result: Result) -> list[tuple[str, str]]:
    """Every setting that was used."""
    units = {"duration": "s", "step": "s", "output_interval": "s"}
    return [(name.replace("_", " "), _shown(value, units.get(name, ""))) for name, value in result.settings.items()]


def timing_table(result: Result) -> list[tuple[str, str]]:
    """What the run took."""
    timing = result.timing
    out = []
    for name, value in timing.items():
        if "seconds" not in name and value:
            shown = f"{value / 1e5:.3g} bar" if name.startswith("pressure") else _shown(value, "")
            out.append((COUNTERS.get(name, name.replace("_", " ")), shown))
    taken = [(name, float(value)) for name, value in timing.items() if name.endswith("_seconds")]
    out += [(name.replace("_seconds", " time"), _took(value)) for name, value in taken]
    if timing.get("steps") and timing.get("loop_seconds"):
        out.append(("time per step", _took(timing["loop_seconds"] / timing["steps"])))
    out.append(("frames", str(len(result.time))))
    out.append(("nivel", str(result.attributes.get("nivel_version", ""))))
    return out


def assembly_lines(result: Result) -> list[str]:
    """What the assembly changed of the given start: each body it moved, then each initial velocity it changed."""
    assembly = json.loads(str(result.attributes.get("assembly", "{}")))
    followed = assembly.get("followed") or []
    if assembly.get("gap", 0.0) > ROUND_OFF:
        gap = f"open by up to {_amount(assembly['gap'], 'm or rad')} as given"
        why = f" to close the joints, {gap} (row {assembly['gap_row']})"
    else:
        why = " to reach the start values of joints"
    moved, changed = (
        sorted((each for each in assembly.get(key) or () if max(each[1:]) > ROUND_OFF), key=lambda each: -max(each[1:]))
        for key in ("moved", "velocity_change")
    )
    lines = [f"{name} was moved by {_both(d, 'm', a, 'rad')}{why}" for name, d, a in moved]
    speeds = [(name, _both(v, "m/s", w, "rad/s")) for name, v, w in changed if name not in followed]
    lines += [f"The velocity of {name} was changed by {amount} to fit the joints" for name, amount in speeds]
    if followed:
        lines.append(f"Start: {set_in_motion(followed)}")
    return lines if len(lines) <= SHOWN_CHANGES else [*lines[:SHOWN_CHANGES], f"and {len(lines) - SHOWN_CHANGES} more"]


def event_lines(result: Result) -> list[str]:
    """The events that came: each name with how often and when."""
    lines = [line.replace("e-", "e\u2011") for line in in_words(result.events, result.stopped_by)]
    return lines if len(lines) <= SHOWN_EVENTS else [*lines[:SHOWN_EVENTS], f"and {len(lines) - SHOWN_EVENTS} more"]


def _both(length: float, length_unit: str, angle: float, angle_unit: str) -> str:
    """A shift and a turn, or the one of them that there is."""
    parts = [_amount(value, unit) for value, unit in ((length, length_unit), (angle, angle_unit)) if value > ROUND_OFF]
    return " and ".join(parts) or _amount(0.0, length_unit)


def _amount(value: float, unit: str) -> str:
    return f"{value:.3g}\u00a0{unit}".replace("e-", "e\u2011")


def _breaking(text: str) -> str:
    """A text whose lines do not break within 1e-4, nor before a unit."""
    return re.sub(r"(?<=\d) (?=(m|s|J|m/s|1/s)\b)", "\u00a0", text.replace("e-", "e\u2011"))


def _percent(fraction: float) -> float:
    if not math.isfinite(fraction):
        return 100.0
    decades = math.log10(max(fraction, 10.0**-DECADES))
    return round(100.0 * min(max(1.0 + decades / DECADES, 0.0), 1.0), 2)


def _shown(value: Any, unit: str) -> str:
    if isinstance(value, dict):
        return ", ".join(f"{name} {_shown(each, '')}" for name, each in value.items())
    if isinstance(value, float):
        return _seconds(value) if unit == "s" else f"{value:.6g}"
    return "–" if value is None else str(value)


def _seconds(value: float) -> str:
    """A time in the unit that suits it."""
    if value == 0.0 or abs(value) >= 1.0:
        return f"{value:.6g} s"
    units = ((1e3, "ms"), (1e6, "µs"), (1e9, "ns"))
    factor, unit = next((each for each in units if abs(value) * each[0] >= 1.0), units[-1])
    return f"{value * factor:.4g} {unit}"


def _took(seconds: float) -> str:
    """A computing time, to three digits."""
    return _seconds(float(f"{seconds:.3g}"))


def _sentence(text: str) -> str:
    text = text[:1].upper() + text[1:]
    return text if not text or text.endswith((".", "!", "?")) else f"{text}."
