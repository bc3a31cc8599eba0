"""Forces and parts at a joint coordinate: stops and friction of the joint, and dampers, springs, couplings, start values beside it."""

import math
from collections.abc import Iterable
from typing import Any, Final

from nivel.exchange.bodies import between
from nivel.exchange.mechanism import WORLD, Actuator, Array, Connection, Mechanism, Rope, Span, Tendon, Terms
from nivel.exchange.translation import number, triple
from nivel.machine.core.record import GROUND

STOP_FREQUENCY: Final = 10.0  # [Hz] of what a joint moves against its stop
RESTITUTION: Final = 0.2
LARGEST: Final = 1e6  # [rad or m] an end of the way beyond this is none

CREEPS: Final = "friction of a joint is dry friction that creeps as slowly as that of the model"
STOPS: Final = f"limits are stops: their stiffness lets what the joint moves vibrate at {STOP_FREQUENCY:g} Hz, restitution {RESTITUTION:g}"
HARD_STOPS: Final = (
    f"limits are stops with the stiffness that those of the model have under load, restitution {RESTITUTION:g}"
)
FRICTION: Final = "friction of a joint is dry friction with sticking, of the same effort in both directions"
ENDS: Final = f"limits of tendons are springs, with which what they move vibrates at {STOP_FREQUENCY:g} Hz"
EFFORT: Final = "limits of effort: give them as `limit` of a motor or servo"


def coordinate_of(each: Connection | Span, mechanism: Mechanism) -> str:
    """The joint coordinate of a connection in the machine file."""
    return f"{mechanism.names.name('joint', each.name)}.{each.coordinate}"


def parts_of(each: Connection, effective: float, mechanism: Mechanism) -> dict[str, Any]:
    """Keys of the joint: its stops and its friction. effective : inertia at the coordinate [kg m²] or mass [kg]."""
    out: dict[str, Any] = {}
    if not each.coordinate:
        return out
    notes, ends = mechanism.notes, _ends(each)
    if len(ends) == 2 and ends["lower"] >= ends["upper"]:
        notes.leave("limits whose lower end is not below the upper end", each.name, each.line)
    elif ends and effective > 0.0:
        stiffness = float(f"{each.hardness or effective * (2.0 * math.pi * STOP_FREQUENCY) ** 2:.3g}")
        out["stops"] = {key: number(value) for key, value in ends.items()}
        out["stops"] |= {"stiffness": stiffness, "restitution": RESTITUTION}
        notes.change(HARD_STOPS if each.hardness else STOPS, each.name, each.line)
    if each.friction > 0.0:
        law = {"model": "coulomb", "transition_speed": float(f"{each.creep:.6g}")} if each.creep else {}
        out["friction"] = {"effort": number(each.friction), **law} if law else number(each.friction)
        notes.change(CREEPS if each.creep else FRICTION, each.name, each.line)
    if each.effort is not None and 0.0 < each.effort < LARGEST:
        notes.leave(EFFORT, f"{each.name} {each.effort:g} {'N m' if each.coordinate == 'angle' else 'N'}", each.line)
    return out


def spring_of(each: Connection, mechanism: Mechanism) -> dict[str, dict[str, Any]]:
    """A spring or damper at the coordinate by the end of its name, or nothing."""
    if not each.coordinate or not (each.stiffness or each.damping):
        return {}
    spring = {"stiffness": each.stiffness, "damping": each.damping, "free_value": each.free}
    given = {key: number(value) for key, value in spring.items() if value}
    force = {"type": "joint-spring-damper", "coordinate": coordinate_of(each, mechanism), **given}
    return {"spring" if each.stiffness else "damper": force}


def _ends(each: Connection) -> dict[str, float]:
    given = (("lower", each.lower), ("upper", each.upper))
    return {key: value for key, value in given if value is not None and abs(value) < LARGEST}


def coupling_of(each: Connection, mechanism: Mechanism) -> dict[str, Any] | None:
    """The coupling of a joint that follows another one: coordinate - factor · other is held, or coordinate - function of the other."""
    if each.follows is not None:
        return _function_coupling(each, mechanism)
    if each.mimic is None:
        return None
    other = next((joint for joint in mechanism.connections if joint.name == each.mimic[0]), None)
    if other is None or not other.coordinate or not each.coordinate or each.mimic[1] == 0.0:
        mechanism.notes.leave(
            "joints that follow a joint without a coordinate, or by a factor of zero", each.name, each.line
        )
        return None
    return {
        "type": "linear",
        "coordinates": [coordinate_of(each, mechanism), coordinate_of(other, mechanism)],
        "factors": [1.0, -number(each.mimic[1])],
    }


def _function_coupling(each: Connection, mechanism: Mechanism) -> dict[str, Any] | None:
    """q = reference + a₀ + a₁ d + …, with the way d of the other joint, by Horner's rule."""
    assert each.follows is not None
    other = next(joint for joint in mechanism.connections if joint.name == each.follows[0])
    if not other.coordinate or not each.coordinate:
        mechanism.notes.leave("joints that follow a joint without a coordinate", each.name, each.line, acts=True)
        return None
    own, other_own = coordinate_of(other, mechanism), number(other.reference)
    way = f"({own} - {other_own!r})" if other_own else own
    first, *rest = each.follows[1]
    text = repr(number(rest[-1]))
    for factor in (*reversed(rest[:-1]), each.reference + first):
        text = f"{number(factor)!r} + {way}*({text})"
    return {"type": "function", "coordinate": coordinate_of(each, mechanism), "value": text}


def _following(each: Connection, other: Connection, coordinate: float) -> float:
    """Coordinate of a joint that follows another one by a polynomial."""
    assert each.follows is not None
    way = coordinate - other.reference
    return each.reference + sum(factor * way**k for k, factor in enumerate(each.follows[1]))


def start_values(mechanism: Mechanism) -> dict[str, float]:
    """Coordinates of joints at the start by name: as given, within the limits, and as joints follow each other."""
    starts: dict[str, float] = {}
    for each in mechanism.connections:
        if each.mimic is not None or each.follows is not None or not each.coordinate:
            continue
        ends = _ends(each)
        start = each.placed if each.start is None else each.start
        low, high = ends.get("lower", -math.inf), ends.get("upper", math.inf)
        if not low <= start <= high and low < high:
            start = 0.5 * (low + high) if math.isfinite(low) and math.isfinite(high) else min(max(start, low), high)
            mechanism.notes.change("zero is outside the limits: the joint starts within them", each.name, each.line)
        starts[each.name] = start
    for each in mechanism.connections:
        if each.mimic is not None and each.mimic[0] in starts:
            starts[each.name] = each.mimic[1] * starts[each.mimic[0]] + each.mimic[2]
        elif each.follows is not None and each.follows[0] in starts:
            other = next(joint for joint in mechanism.connections if joint.name == each.follows[0])
            starts[each.name] = _following(each, other, starts[other.name])
    return starts


def add_starts(mechanism: Mechanism, starts: dict[str, float], joints: dict[str, Any]) -> None:
    """Put start values into the data of joints, unless links stand there already."""
    if all(starts[each.name] == each.placed for each in mechanism.connections if each.name in starts):
        return
    for each in mechanism.connections:  # all of them: the assembly would move those that are left open
        if each.name in starts:
            joints[mechanism.names.name("joint", each.name)]["start"] = {each.coordinate: number(starts[each.name])}


def _length(terms: Terms, mechanism: Mechanism, suffix: str = "") -> str:
    """The length of joints as an expression, or its rate by the suffix `_rate`."""
    joints = mechanism.measured
    parts = [(factor, coordinate_of(joints[name], mechanism) + suffix) for name, factor in terms]
    text = " + ".join(each if factor == 1.0 else f"{number(factor)!r}*{each}" for factor, each in parts)
    return (text if len(parts) == 1 else f"({text})").replace("+ -", "- ")


def _within(text: str, ends: tuple[float, float] | None) -> str:
    return text if ends is None else f"min(max({text}, {number(ends[0])!r}), {number(ends[1])!r})"


def _sum(factors: Iterable[float], symbols: Iterable[str]) -> str:
    """Σ factor · symbol, without those of factor zero."""
    terms = [
        (symbol if factor == 1.0 and symbol else f"{number(factor)!r}*{symbol}" if symbol else repr(number(factor)))
        for factor, symbol in zip(factors, symbols, strict=True)
        if factor
    ]
    return " + ".join(terms).replace("+ -", "- ") or "0"


def actuated(actuator: Actuator, control: str, mechanism: Mechanism) -> dict[str, dict[str, Any]]:
    """Elements of an actuator by the section and the wanted name: its input, named `control`, its activation, and a motor on each joint."""
    given: dict[str, Any] = (
        {"range": [number(each) for each in actuator.control]} if actuator.control is not None else {}
    )
    if actuator.rest:
        own = abs(number(actuator.rest))
        given = ({"range": [-own, own]} if own > 1.0 and not given else given) | {"rest": number(actuator.rest)}
    out: dict[str, dict[str, Any]] = {"inputs": {control: given}, "states": {}, "forces": {}}
    signal = _within(f"{control}.value", actuator.control)
    if actuator.time is not None:
        state = mechanism.names.new(f"{actuator.name}_activation", "state")
        rate = f"({signal} - {state}.value)/{number(actuator.time)!r}" if actuator.time else signal
        out["states"][state] = {"rate": rate} | ({"start": number(actuator.rest)} if actuator.rest else {})
        signal = _within(f"{state}.value", actuator.activation)
    if len(actuator.terms) == 1:  # the numbers are those of the joint
        (_, factor), *_ = actuator.terms
        joint = actuator.terms[0][0]
        scales, terms = (factor, factor**2, factor**2), ((joint, 1.0),)
    else:
        factor, scales, terms = 1.0, (1.0, 1.0, 1.0), actuator.terms
    symbols = ("", _length(terms, mechanism), _length(terms, mechanism, "_rate"))
    gain = [a * b for a, b in zip(actuator.gain, scales, strict=True)]
    bias = [a * b for a, b in zip(actuator.bias, scales, strict=True)]
    curved = any(gain[1:])
    force = _sum(
        (1.0, *bias) if curved else (gain[0], *bias),
        (f"({_sum(gain, symbols)})*{signal}" if curved else signal, *symbols),
    )
    limit = None if actuator.limit is None else sorted(number(each * factor) for each in actuator.limit)
    same = limit is not None and limit[0] == -limit[1]
    if limit is not None and not (same and len(terms) == 1):
        force = _within(force, (limit[0], limit[1]))
    for joint, part in terms:
        connection = mechanism.measured[joint]
        motor: dict[str, Any] = {"type": "motor", "coordinate": coordinate_of(connection, mechanism)}
        motor["effort"] = force if part == 1.0 else f"{number(part)!r}*({force})"
        if limit is not None and same and len(terms) == 1:
            motor["limit"] = limit[1]
        out["forces"][actuator.name if len(terms) == 1 else f"{actuator.name}_{joint}"] = motor
        if gain[0] == 1.0 and not curved and len(terms) == 1:
            given["units"] = "N m" if connection.coordinate == "angle" else "N"
    return out


def span_joint(span: Span, mechanism: Mechanism) -> dict[str, Any]:
    """The joint that measures a span."""
    ends = [_global(link, point, mechanism) for link, point in span.ends]
    bodies, points = ([each[k] for each in ends] for k in (0, 1))
    return {"type": "variable-distance", "bodies": bodies, "points": points}


def rope_force(rope: Rope, mechanism: Mechanism) -> dict[str, Any]:
    """The force that a rope is; an end is as stiff as a stop against what stands at its own ends."""
    ends = [_global(link, point, mechanism) for link, point, _ in rope.way]
    bodies, points = ([each[k] for each in ends] for k in (0, 1))
    stiffness, damping = rope.stiffness, rope.damping
    if not stiffness:
        mass = between(mechanism, [rope.way[k][0] for k in (0, -1)])
        stiffness = mass * (2.0 * math.pi * STOP_FREQUENCY) ** 2
        ratio = -math.log(RESTITUTION) / math.hypot(math.pi, math.log(RESTITUTION))
        damping = 2.0 * ratio * math.sqrt(stiffness * mass)
    out = {"type": "rope", "bodies": bodies, "points": points, "length": number(rope.length)}
    if rope.axis is not None:
        out |= {"radii": [number(radius) for _, _, radius in rope.way], "axis": triple(rope.axis)}
    return out | {"stiffness": float(f"{stiffness:.6g}")} | ({"damping": float(f"{damping:.6g}")} if damping else {})


def _global(link: str, point: Array, mechanism: Mechanism) -> tuple[str, Any]:
    """The body of a link, and a point of it, global."""
    if link == WORLD:
        return GROUND, triple(point)
    place = mechanism.links[link].place
    return mechanism.body(link), triple(place.axes @ point + place.origin)


def pulled(tendon: Tendon, effective: float, mechanism: Mechanism) -> dict[str, Any]:
    """Motors of a tendon by the wanted name. effective : mass at its length [kg or kg m²]."""
    length, rate = _length(tendon.terms, mechanism), _length(tendon.terms, mechanism, "_rate")
    parts = []
    for stiffness, ends in (
        (tendon.stiffness, tendon.free),
        (effective * (2.0 * math.pi * STOP_FREQUENCY) ** 2, tendon.ends),
    ):
        if ends is not None and stiffness:
            low, high = (number(each) for each in ends)
            far = f"{length} - {high!r}" if low == high else f"{length} - {_within(length, (low, high))}"
            parts.append(f"{float(f'{stiffness:.6g}')!r}*({far})".replace("- -", "+ "))
            if ends is tendon.ends:
                mechanism.notes.change(ENDS, tendon.name)
    parts += [f"{number(tendon.damping)!r}*{rate}"] if tendon.damping else []
    joints = mechanism.measured
    return {
        f"{tendon.name}_{joint}": {
            "type": "motor",
            "coordinate": coordinate_of(joints[joint], mechanism),
            "effort": f"{number(-factor)!r}*({' + '.join(parts)})",
        }
        for joint, factor in tendon.terms
        if parts
    }
