"""Spool valves from catalogues: flows over position and difference of pressure, notches, solenoids, hysteresis, delays."""

import math

import numpy as np
import pytest

from circuits import BAR, LITRE_PER_MINUTE, between, circuit, history, steady
from nivel.api import load
from nivel.elements.circuits.edges import Notch
from nivel.files import parse_machine
from test_characteristics import root

CORNER = 0.5 * BAR


def over(points, values):
    return {"of": "position", "points": points, "values": values}


def valve(edges, **more):
    return {"type": "spool-valve", "edges": edges, **more}


@pytest.mark.parametrize("u", [-1.0, -0.55, 0.0, 0.1, 0.3, 0.7, 1.0])
def test_every_edge_has_its_own_curve(u):
    edges = {
        "PA": {"flow": over([0.1, 0.4, 1], [0, "10 L/min", "60 L/min"]), "pressure_drop": "8 bar"},
        "BT": {"area": over([0.2, 1], [0, "30 mm^2"]), "discharge_coefficient": 0.7},
        "PB": {"flow": over([-1, -0.3], ["45 L/min", 0]), "pressure_drop": "8 bar", "leakage": 1e-12},
        "AT": {"flow": over([-1, 1], ["20 L/min", 0]), "pressure_drop": "5 bar"},
    }
    pressures = {"P": 100, "T": 2, "A": 60, "B": 30}
    hydraulics = between(valve(edges, command=u), **{port: p * BAR for port, p in pressures.items()})
    found = steady(hydraulics, *(f"valve.flow_{pair}" for pair in edges))
    k = {
        "PA": np.interp(u, [0.1, 0.4, 1], [0, 10, 60]) * LITRE_PER_MINUTE / root(8 * BAR),
        "BT": 0.7 * np.interp(u, [0.2, 1], [0, 30e-6]) * math.sqrt(2 / (0.995 * 870 + 0.005 * 1.2)),
        "PB": np.interp(u, [-1, -0.3], [45, 0]) * LITRE_PER_MINUTE / root(8 * BAR),
        "AT": np.interp(u, [-1, 1], [20, 0]) * LITRE_PER_MINUTE / root(5 * BAR),
    }
    leak = {"PB": 1e-12}
    wanted = []
    for pair, size in k.items():
        drop = (pressures[pair[0]] - pressures[pair[1]]) * BAR
        wanted.append(size * root(drop) + leak.get(pair, 0.0) * drop)
    assert found == pytest.approx(wanted, rel=1e-8, abs=1e-18)


@pytest.mark.parametrize("drop", [1.0, 5.0, 12.0, 20.0, 80.0])
def test_a_flow_that_saturates_follows_its_curves_over_both(drop):
    """Q at 5, 20 and 60 bar of a spool whose flow forces close it: between them K is a straight line, outside it is that of the last."""
    drops, full = [5.0, 20.0, 60.0], [30.0, 50.0, 60.0]
    curves = [over([0, 0.5, 1], [0, f"{0.3 * q} L/min", f"{q} L/min"]) for q in full]
    edges = {"PA": {"flows": curves, "pressure_drops": [f"{p} bar" for p in drops]}}
    hydraulics = between(valve(edges, command=0.75), P=(10 + drop) * BAR, A=10 * BAR)
    (flow,) = steady(hydraulics, "valve.flow_PA")
    at = [0.65 * q * LITRE_PER_MINUTE / root(p * BAR) for q, p in zip(full, drops, strict=True)]
    assert flow == pytest.approx(np.interp(drop, drops, at) * root(drop * BAR), rel=1e-8)
    if drop in drops:
        assert flow == pytest.approx(0.65 * full[drops.index(drop)] * LITRE_PER_MINUTE, rel=1e-8)


@pytest.mark.parametrize(("shape", "size", "area"), [
    ("rectangle", {"width": 0.004}, lambda s: 0.004 * s),
    ("triangle", {"angle": math.radians(60)}, lambda s: s * s * math.tan(math.radians(30))),
    ("bore", {"diameter": 0.003}, lambda s: 1.5e-3**2 * (2 * math.acos(1 - s / 1.5e-3) - math.sin(2 * math.acos(1 - s / 1.5e-3))) / 2),
])  # fmt: skip
def test_notches_have_the_areas_of_their_shapes(shape, size, area):
    notch = Notch(shape=shape, number=4, **size)
    for s in (0.2e-3, 1e-3, 2e-3):
        assert notch.area(s) == pytest.approx(4 * area(s), rel=1e-10)


def test_notches_make_the_flow_of_an_edge():
    notches = [{"shape": "rectangle", "width": "4 mm", "number": 2, "begins": 0.25}]
    hydraulics = between(valve({"PA": {"notches": notches}}, command=0.75, stroke="8 mm"), P=20 * BAR, A=10 * BAR)
    (flow,) = steady(hydraulics, "valve.flow_PA")
    area = 2 * 4e-3 * 0.5 * 8e-3
    assert flow == pytest.approx(0.65 * area * math.sqrt(2 / 865.656) * root(10 * BAR), rel=1e-5)


SOLENOID = {
    "force": {"of": "current", "points": [0, 0.2, 0.8], "values": [0, "10 N", "70 N"]},
    "spring": "10 N/mm",
    "preload": "20 N",
}
METERED = {"PA": {"flow": over([0, 1], [0, "40 L/min"]), "pressure_drop": "8 bar"}}


@pytest.mark.parametrize(("current", "force"), [(0.2, 10), (0.5, 40), (0.7, 60)])
def test_a_solenoid_holds_the_spool_where_its_force_is_that_of_spring_and_flow(current, force):
    """F(i) = F₀ + k x + Q √Δp √(2 ρ) cos 69°, in newtons: 20 N and 10 N/mm over a stroke of 4 mm."""
    built = valve(METERED, current=current, solenoid=SOLENOID, stroke="4 mm", frequency="60 Hz")
    result = circuit(between(built, P=110 * BAR, A=10 * BAR)).simulate(duration=0.2, step=1e-3)
    u = float(history(result, "hydraulics.valve.position")[-1])
    flow = float(history(result, "hydraulics.valve.flow_PA")[-1])
    centred = 20 * u / math.hypot(u, 0.005)
    jet = flow * root(100 * BAR) * math.sqrt(2 * (0.995 * 870 + 0.005 * 1.2)) * math.cos(math.radians(69))
    assert force == pytest.approx(centred + 40 * u + jet, rel=1e-5, abs=1e-4)
    assert flow == pytest.approx(u * 40 * LITRE_PER_MINUTE / root(8 * BAR) * root(100 * BAR), rel=1e-8, abs=1e-15)
    assert jet > 1.0 or force == 10


def test_the_dead_band_of_a_command_does_nothing():
    for command, position in ((0.1, 0.0), (0.2, 0.0), (0.6, 0.5), (1.0, 1.0)):
        (u,) = steady(between(valve(METERED, command=command, dead_band=0.2), P=20 * BAR, A=10 * BAR), "valve.position")
        assert u == pytest.approx(position, abs=1e-12)


def triangle(**more):
    """Positions of a valve at commands of one half, on the way up and on the way down."""
    command = {"of": "time", "times": [0, 1, 2], "values": [0, 1, 0]}
    built = valve(METERED, command=command, frequency="50 Hz", **more)
    result = circuit(between(built, P=20 * BAR, A=10 * BAR)).simulate(duration=2, step=1e-3)
    u, t = history(result, "hydraulics.valve.position"), np.asarray(result.time)
    return [float(np.mean(u[np.abs(t - at) < 0.026])) for at in (0.5, 1.5)]


def test_hysteresis_is_the_distance_of_both_curves():
    up, down = triangle(hysteresis=0.08)
    assert down - up == pytest.approx(0.08 + 2 * triangle_lag(), abs=1.5e-3)


def triangle_lag():
    """How far a spool of 50 Hz and ζ = 0.8 with a play of 1 ms is behind a ramp of 1/s."""
    return 2 * 0.8 / (2 * math.pi * 50) + 1e-3


def test_dither_takes_the_hysteresis_away():
    up, down = triangle(hysteresis=0.08, dither={"amplitude": 0.1, "frequency": "100 Hz"})
    assert down - up < 0.04


def test_friction_of_a_spool_makes_hysteresis_of_its_current():
    """Twice the friction of 2 N over the stiffness of 10 N/mm and the stroke of 4 mm: 0.1 of the stroke."""
    current = {"of": "time", "times": [0, 1, 2], "values": [0, 0.8, 0]}
    closed = {"PA": {"flow": over([0, 1], [0, "0.01 L/min"]), "pressure_drop": "8 bar"}}
    built = valve(closed, current=current, solenoid={**SOLENOID, "friction": "2 N"}, stroke="4 mm", frequency="60 Hz")
    result = circuit(between(built, P=20 * BAR, A=10 * BAR)).simulate(duration=2, step=1e-3)
    u, t = history(result, "hydraulics.valve.position"), np.asarray(result.time)
    up, down = (float(np.interp(at, t, u)) for at in (0.6, 1.4))
    assert down - up == pytest.approx(0.1, rel=0.25)
    assert down - up > 0.09


@pytest.mark.parametrize("type_", ["spool-valve", "directional-valve"])
def test_a_valve_that_switches_has_its_delays(type_):
    command = {"of": "time", "times": [0, 0.01, 0.0101, 0.2, 0.2001], "values": [0, 0, 1, 1, 0]}
    switching = {"on_delay": "20 ms", "off_delay": "40 ms", "time": "10 ms"}
    built = valve(METERED, command=command, switching=switching)
    if type_ == "directional-valve":
        built = {
            "type": type_,
            "ways": "2/2",
            "command": command,
            "switching": switching,
            "flow": "40 L/min",
            "pressure_drop": "8 bar",
        }
    result = circuit(between(built, P=20 * BAR, A=10 * BAR)).simulate(
        duration=0.3, integrator="radau", tolerance=1e-7, output_interval=2e-4
    )
    u, t = history(result, "hydraulics.valve.position"), np.asarray(result.time)
    rising = t[np.searchsorted(u[: len(u) // 2], [0.001, 0.5, 0.999])]
    assert rising == pytest.approx([0.03, 0.035, 0.04], abs=6e-4)
    late = u[len(u) // 2 :][::-1]
    falling = t[len(u) - 1 - np.searchsorted(late, [0.999, 0.5, 0.001])]
    assert falling == pytest.approx([0.24, 0.245, 0.25], abs=8e-4)


def test_curves_are_read_from_a_file(tmp_path):
    (tmp_path / "curve.csv").write_text("spool [1],PA [L/min]\n0,0\n0.5,12\n1,40\n")
    text = """format: 1
bodies: {block: {mass: 1, inertia: [1, 1, 1]}}
hydraulics:
  high: {type: tank, pressure: 18 bar}
  low: {type: tank, pressure: 10 bar}
  valve: {type: spool-valve, ports: {P: high, A: low}, command: 0.75,
    edges: {PA: {flow: {csv: curve.csv, of: position}, pressure_drop: 8 bar}}}
simulation: {duration: 1 ms, step: 1 ms}
"""
    (tmp_path / "machine.yaml").write_text(text)
    built = load(tmp_path / "machine.yaml")
    assert history(built.simulate(), "hydraulics.valve.flow_PA")[-1] == pytest.approx(26 * LITRE_PER_MINUTE, rel=1e-8)
    again = parse_machine(built.to_yaml())
    assert again.hydraulics[2].edges["PA"].flow(0.5) == pytest.approx(12 * LITRE_PER_MINUTE)


def test_the_slopes_of_spools_and_edges_keep_the_order_of_the_step():
    """The special integrator against Radau: the error falls with the square of the step."""
    edges = {**METERED, "AT": {"flow": over([-1, 1], ["20 L/min", "2 L/min"]), "pressure_drop": "5 bar"}}
    built = valve(
        edges, command={"of": "time", "times": [0, 0.01, 0.05], "values": [0, 0, 0.9]}, frequency="20 Hz", hysteresis=0.05,
        ports={"P": "high", "A": "line", "T": "low"},
    )  # fmt: skip
    hydraulics = {
        "high": {"type": "tank", "pressure": "80 bar"},
        "low": {"type": "tank", "pressure": "2 bar"},
        "line": {"type": "volume", "volume": "0.3 L", "start": "10 bar"},
        "valve": built,
    }
    machine = circuit(hydraulics)
    exact = machine.simulate(integrator="radau", tolerance=1e-9, duration=0.1, output_interval=2e-3)

    def error(step):
        found = machine.simulate(integrator="extrapolated-euler", step=step, duration=0.1, output_interval=2e-3)
        difference = history(found, "hydraulics.line.pressure") - history(exact, "hydraulics.line.pressure")
        return float(np.max(np.abs(difference)))

    coarse, fine = error(2e-4), error(1e-4)
    assert coarse < 0.1 * BAR
    assert coarse / fine > 2.5
