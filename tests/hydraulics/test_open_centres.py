"""Sections of 6/3 ways, float, regeneration and holding: against the same equations by SciPy's Radau, and balances at rest."""

import json

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from circuits import BAR, LITRE_PER_MINUTE, circuit, density, history
from laws_anew import Circuit, Oil, ramp, rated, step
from test_characteristics import RATED, K, root

PUMP, HIGH, LOW, T = 40 * LITRE_PER_MINUTE, 90 * BAR, 40 * BAR, 2 * BAR
OVERLAP, CLOSES, FLOATS = 0.05, 0.7, 0.85
TANKS = {"tank": {"type": "tank", "pressure": T}, "high": {"type": "tank", "pressure": HIGH}}
LIKE = {"type": "section", **RATED}


def line(name, litres=0.5):
    return {name: {"type": "volume", "volume": f"{litres} L"}}


def supply(into="supply"):
    relief = {
        "type": "relief-valve",
        "ports": {"P": into, "T": "tank"},
        "opens_at": "160 bar",
        "opening_range": "10 bar",
    }
    pump = {"type": "flow-source", "ports": {"A": "tank", "B": into}, "flow": PUMP}
    return {**TANKS, **line(into), "pump": pump, "relief": {**relief, **RATED}}


def opening(z, full=1.0):
    """Of an edge whose full stroke is at `full`."""
    return ramp(z - OVERLAP) / (full - OVERLAP - 0.01)


def neutral(u):
    return 1.0 - step(abs(u) / CLOSES)


class Section:
    """The laws of the page, on a `Circuit` of pressures."""

    def __init__(
        self, at, name, u, feeds, A, B, out, bypass, *, floats=None, regenerates=None, until=100 * BAR, held=""
    ):
        m, side = f"{name}.M", {"A": A, "B": B}
        at.restrict(*bypass, K * neutral(u))
        for feed, size in feeds:
            at.poppet(feed, m, size, 0.5 * BAR, 3 * BAR)
        for each in held:
            inner = f"{name}.H{each}"
            at.poppet(inner, side[each], 4 * K, 0.5 * BAR, 3 * BAR)
            back = u if each == "B" else -u
            at.restrict(side[each], inner, 4 * K * ramp(back - 0.5 * OVERLAP) / (1 - 0.5 * OVERLAP - 0.01))
            side[each] = inner
        end = floats or 1.0
        shut = step((-u - end) / 0.02) if floats else 0.0
        at.restrict(m, side["A"], K * opening(u))
        at.restrict(m, side["B"], K * opening(-u, end) * (1 - shut))
        to = f"{name}.R" if regenerates else out
        at.restrict(side["B"], to, K * opening(u))
        at.restrict(side["A"], out, K * opening(-u, end))
        if regenerates:
            at.poppet(to, side["A"], 4 * K, 0.5 * BAR, 3 * BAR)
            at.restrict(to, out, 4 * K * step((at.over(side["A"], out) - until) / (4 * BAR)))
        if floats:
            joined = ramp(-u - floats) / (1 - floats)
            at.restrict(B, out, K * joined)
            at.restrict(*bypass, K * joined)


def compared(hydraulics, volumes, rates, corners=()):
    """Largest differences of pressures [share of range] between nivel and SciPy's Radau over 0.3 s.

    volumes : m³ of each node; rates(t, pressures) : a `Circuit` at these."""
    end = 0.3
    result = circuit(hydraulics).simulate(integrator="radau", tolerance=1e-10, duration=end, output_interval=5e-3)
    assert {item.name: item for item in result.trust.items}["fluid mass"].fraction < 1e-8
    owner = {name: name.replace(".", ".pressure_") if "." in name else f"{name}.pressure" for name in volumes}
    found = np.array([history(result, f"hydraulics.{each}") / BAR for each in owner.values()])
    t = np.asarray(result.time)

    def slopes(at, y):
        its = rates(at, dict(zip(volumes, y * BAR, strict=True)))
        return [its.rate(name, volume) for name, volume in volumes.items()]

    other, start = [found[:, 0]], found[:, 0]
    for a, b in zip((0.0, *corners), (*corners, end), strict=True):
        inside = t[(t > a + 1e-9) & (t < b + 1e-9)].clip(a, b)
        solved = solve_ivp(slopes, (a, b), start, "Radau", np.union1d(inside, b), rtol=1e-8, atol=1e-7, first_step=1e-8)
        other += [*solved.y.T[: len(inside)]]
        start = solved.y[:, -1]
    other = np.array(other).T
    span = np.maximum(np.ptp(other, axis=1), 1.0)
    return np.max(np.abs(found - other) / span[:, None], axis=1), result


@pytest.mark.parametrize("kind", ["parallel", "tandem", "priority", "series"])
def test_two_sections_of_an_open_centre_follow_the_equations_of_the_page(kind):
    """Pressures within 1e-6 of their ranges, two levers that move at once, and the mass of the fluid."""
    one, two = [0.0, 0.6], [0.2, -0.5]

    def wish(ends, t):
        return float(np.interp(t, [0.05, 0.15], ends))

    lower = {"low": {"type": "tank", "pressure": LOW}}
    like = {**LIKE, "open_centre": "tandem" if kind == "priority" else kind}
    ends = {"P": "supply"} if kind == "parallel" else {}
    out = {} if kind == "series" else {"T": "tank"}
    more = {"parallel_flow": "10 L/min"} if kind == "priority" else {}
    command = {"of": "time", "times": [0.05, 0.15]}
    hydraulics = {
        **supply(), **lower, **line("mid", 0.1),
        "boom": {
            **like, "command": {**command, "values": one}, "ports": {"N": "supply", "C": "mid", "A": "high", "B": "tank", **out, **ends},
        },
        "arm": {
            **like, **more, "command": {**command, "values": two},
            "ports": {"N": "mid", "C": "tank", "A": "tank", "B": "low", **out, **ends, **({"P": "supply"} if more else {})},
        },
    }  # fmt: skip

    def rates(t, p):
        at = Circuit(Oil(), **p, tank=T, high=HIGH, low=LOW)
        at.carry("tank", "supply", density(T) * PUMP)
        at.poppet("supply", "tank", K, 160 * BAR, 10 * BAR)
        feeds = (
            [[("supply", 4 * K)], [("supply", 4 * K)]]
            if kind == "parallel"
            else [[("supply", 4 * K)], [("mid", 4 * K)]]
        )
        if kind == "priority":
            feeds[1].append(("supply", rated(10, 7)))
        outs = ("mid", "tank") if kind == "series" else ("tank", "tank")
        Section(at, "boom", wish(one, t), feeds[0], "high", "tank", outs[0], ("supply", "mid"))
        Section(at, "arm", wish(two, t), feeds[1], "tank", "low", outs[1], ("mid", "tank"))
        return at

    volumes = {"supply": 0.5e-3, "mid": 0.1e-3, "boom.M": 2e-6, "arm.M": 2e-6}
    errors, _ = compared(hydraulics, volumes, rates, (0.05, 0.15))
    assert np.max(errors) < 1e-6, dict(zip(volumes, errors, strict=True))


def test_float_regeneration_and_holding_follow_the_equations_of_the_page():
    """One section with all of them between two volumes; its spool passes from raising through lowering to float."""
    values = [0.8, 0.8, -0.6, -1.0]
    times = [0.0, 0.06, 0.14, 0.24]
    section = {
        **LIKE, "open_centre": "parallel", "float_from": FLOATS, "regeneration": "A", "holding": "both",
        "regeneration_until": "50 bar", "command": {"of": "time", "times": times, "values": values},
        "ports": {"P": "supply", "N": "supply", "C": "tank", "T": "tank", "A": "ram", "B": "ring"},
    }  # fmt: skip
    leak = {"type": "orifice", "diameter": "1.5 mm"}
    hydraulics = {
        **supply(), **line("ram", 0.3), **line("ring", 0.2), "boom": section,
        "over": {**leak, "ports": {"A": "ram", "B": "ring"}}, "push": {**leak, "ports": {"A": "high", "B": "ring"}},
    }  # fmt: skip
    hole = 0.65 * np.pi / 4 * 1.5e-3**2 * np.sqrt(2 / (0.995 * 870 + 0.005 * 1.2))

    def rates(t, p):
        at = Circuit(Oil(), **p, tank=T, high=HIGH)
        at.carry("tank", "supply", density(T) * PUMP)
        at.poppet("supply", "tank", K, 160 * BAR, 10 * BAR)
        at.restrict("ram", "ring", hole)
        at.restrict("high", "ring", hole)
        how = {"floats": FLOATS, "regenerates": "A", "until": 50 * BAR, "held": "AB"}
        Section(
            at,
            "boom",
            float(np.interp(t, times, values)),
            [("supply", 4 * K)],
            "ram",
            "ring",
            "tank",
            ("supply", "tank"),
            **how,
        )
        return at

    small = dict.fromkeys(("boom.M", "boom.R", "boom.HA", "boom.HB"), 2e-6)
    opened = [
        0.06 + 0.08 * (0.8 - u) / 1.4 for u in (0.05, 0.025, -0.025, -0.05)
    ]  # where Radau begins anew with short steps
    corners = [0.06, *opened, 0.14, 0.2025, 0.24]
    errors, result = compared(hydraulics, {"supply": 0.5e-3, "ram": 0.3e-3, "ring": 0.2e-3, **small}, rates, corners)
    assert np.max(errors) < 1e-6, errors
    floats = np.asarray(result.time) > 0.27
    for name in ("ram", "ring", "supply"):
        assert np.max(history(result, f"hydraulics.{name}.pressure")[floats]) < 40 * BAR


def test_a_holding_poppet_keeps_the_load_to_the_last_gram_until_its_section_lowers():
    section = {
        **LIKE, "open_centre": "tandem", "holding": "A", "leakage": 1e-12,
        "command": {"of": "time", "times": [0.5, 0.6], "values": [0, -0.5]},
        "ports": {"N": "supply", "C": "tank", "T": "tank", "A": "ram", "B": "tank"},
    }  # fmt: skip
    load = {"ram": {"type": "volume", "volume": "1 L", "start": "120 bar"}}
    sources = supply()
    del sources["high"]
    result = circuit({**sources, **load, "boom": section}).simulate(duration=1, step=1e-3)
    mass, t = history(result, "state.ram.mass"), np.asarray(result.time)
    still = t < 0.5
    assert np.ptp(mass[still]) < 1e-14 * mass[0]
    assert mass[-1] < mass[0]


@pytest.mark.parametrize(("share", "range_"), [(1.0, 4), (1.0, 1), (0.7, 4)])
def test_what_the_section_of_the_highest_load_lacks_is_that_of_the_page(share, range_):
    """Two equal sections, LUDV: at rest their flows are those of the page, solved from its two equations by Brent's method."""
    ports, flow = {"P": "line", "T": "tank", "B": "tank", "LS": "ls"}, 60 * share * LITRE_PER_MINUTE
    like = {
        **LIKE,
        "compensation": "post",
        "margin": "7 bar",
        "opening_range": range_ * BAR,
        "command": 1.0,
        "ports": ports,
    }
    hydraulics = {
        **supply("line"), "low": {"type": "tank", "pressure": LOW}, "ls": {"type": "load-sensing", "valves": ["one", "two"]},
        "one": {**like, "ports": {**ports, "A": "high"}}, "two": {**like, "ports": {**ports, "A": "low"}},
    }  # fmt: skip
    hydraulics["pump"]["flow"] = flow
    result = circuit(hydraulics).simulate(integrator="radau", tolerance=1e-9, duration=1.0)
    found = [float(history(result, f"hydraulics.{name}.flow_PM")[-1]) for name in ("one", "two")]

    signal = brentq(lambda p: p - 0.5 * (0 + HIGH + np.sqrt((HIGH - 0) ** 2 + 1e8)), HIGH / 2, 2 * HIGH)
    signal = 0.5 * (signal + LOW + np.sqrt((signal - LOW) ** 2 + 1e8))

    def through(p, load):
        """(flow into it, pressure at M) of a section at the pressure p of the line, without the change of density."""

        def lacks(m):
            metered = K * root(p - m)
            opens = 2 * K * step((m - signal - 7 * BAR) / (range_ * BAR) + 0.5)
            behind = brentq(lambda c: 4 * K * root(c - load) - metered, load, p)
            return mass(metered, p, m) - mass(opens * root(m - behind), m, behind)

        m = brentq(lacks, load, p)
        return K * root(p - m), m

    def mass(q, a, b):
        return 0.5 * (density(a) + density(b)) * q

    def over(p):
        return sum(mass(*((q, p, m))) for q, m in (through(p, HIGH), through(p, LOW))) - density(T) * flow

    p = brentq(over, signal + 6 * BAR, 3 * HIGH)
    (high, at_high), (low, at_low) = through(p, HIGH), through(p, LOW)
    assert found == pytest.approx([high, low], rel=2e-4)
    assert high / low == pytest.approx(np.sqrt(1 - (at_high - at_low) / (p - at_low)), rel=0.01)
    assert 0.0 <= (at_high - at_low) / BAR <= range_ + 1.75


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"open_centre": "series", "float_from": 0.9}, "belongs to a section with a port T"),
        ({"open_centre": "tandem", "parallel_flow": "9 L/min"}, "from which it comes"),
        ({"open_centre": "parallel"}, "ports P, T are not connected"),
        ({"open_centre": "series", "bypass_closes": 0.02}, "more than the overlap was expected"),
    ],
)  # fmt: skip
def test_what_a_section_cannot_have_is_told_with_what_would_be_right(wrong, said):
    ports = {"N": "supply", "C": "tank", "A": "high", "B": "tank"}
    ports |= {"T": "tank"} if wrong["open_centre"] == "tandem" else {}
    with pytest.raises(Exception, match=said):
        circuit({**supply(), "boom": {**LIKE, "command": 0, "ports": ports, **wrong}})


def test_every_drawn_port_has_its_pin():
    from nivel.elements.circuits.sections import section

    data = json.loads(
        json.dumps({"open_centre": "parallel", "float_from": 0.8, "regeneration": "A", "holding": "both"})
    )
    symbol = section({**data, "ports": dict.fromkeys("PNCTAB", "x")})
    assert {*symbol.above, *symbol.below} == set("PNCTAB")
