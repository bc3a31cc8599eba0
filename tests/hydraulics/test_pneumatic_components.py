"""Tubes, ejectors, cushions and walls of gas against closed forms."""

import math
from functools import cache

import numpy as np
import pytest

from circuits import BAR, circuit, history
from nivel.looks.circuit.characteristics import valve_charts
from simulating import slide

RHO_N, T_N, KAPPA = 1.185, 293.15, 1.4
R = 1e5 / (RHO_N * T_N)
CV = R / (KAPPA - 1.0)
SOUND = math.sqrt(KAPPA * R * T_N)
AIR = {"air": {"type": "ideal-gas"}}
CALM = {"air": {"type": "ideal-gas", "isothermal": True}}
ROOM = {"type": "tank", "pressure": "1 bar"}
LENGTH = 6.0


def tube(pressure, segments=20, **more):
    """A tube of 8 mm from a tank to a closed end."""
    own = {
        "type": "tube",
        "ports": {"A": "inlet", "B": "end"},
        "diameter": "8 mm",
        "length": LENGTH,
        "segments": segments,
        **more,
    }
    return circuit(
        {
            "inlet": {"type": "tank", "pressure": pressure},
            "end": {"type": "volume", "volume": 1e-9, "start": "1 bar"},
            "tube": {**own, "start": "1 bar"},
        },
        fluids=AIR,
    )


def test_a_closed_tube_sounds_with_a_quarter_of_a_wave_and_three():
    """f = c/(4 L), 3 c/(4 L), …, c = √(κ R T)."""
    model = tube("1 bar").linearise()
    found = sorted(abs(each.eigenvalue) for each in model.modes if each.eigenvalue.imag)[:2]
    quarter = 2.0 * math.pi * SOUND / (4.0 * LENGTH)
    assert found == pytest.approx([quarter, 3.0 * quarter], rel=4e-3)
    assert {"hydraulics.tube.pressure_1", "hydraulics.tube.pressure_20", "hydraulics.end.pressure"} <= {*model.states}


def test_pressure_arrives_at_the_end_of_a_tube_after_its_sonic_delay():
    """Half of the reflected front is there at L/c."""
    step = {"of": "time", "times": [0, 1e-3, 1.5e-3], "values": ["1 bar", "1 bar", "1.02 bar"]}
    result = tube(step, 40).simulate(integrator="radau", tolerance=1e-6, duration=0.03, output_interval=1e-4)
    p, t = history(result, "hydraulics.end.pressure"), np.asarray(result.time)
    first = int(np.argmax(p > 1.02 * BAR))  # a closed end doubles the front of 0.02 bar
    arrived = np.interp(1.02 * BAR, p[first - 1 : first + 1], t[first - 1 : first + 1])
    assert arrived - 1.25e-3 == pytest.approx(LENGTH / SOUND, rel=0.02)


def test_a_steady_tube_loses_what_laminar_flow_does():
    """p_A² - p_B² = 2 · 128 μ L R T ṁ/(π d⁴) of gas at one temperature."""
    hydraulics = {
        "inlet": {"type": "tank", "pressure": "1.002 bar"},
        "outlet": ROOM,
        "tube": {
            "type": "tube",
            "ports": {"A": "inlet", "B": "outlet"},
            "diameter": "4 mm",
            "length": 10,
            "segments": 4,
        },
    }
    result = circuit(hydraulics, fluids=CALM).simulate(duration=1.5, step=2e-3)
    flow = history(result, "hydraulics.tube.flow_B")[-1] * RHO_N
    exact = math.pi * 0.004**4 * (100200.0**2 - 100000.0**2) / (2.0 * 128.0 * 18.2e-6 * 10.0 * R * T_N)
    assert flow == pytest.approx(exact, rel=1e-3)


VACUUMS, FLOWS = [0.0, 0.4 * BAR, 0.8 * BAR], [1e-3, 5e-4, 0.0]
EJECTOR = {
    "type": "ejector", "sonic_conductance": 2e-9, "vacuums": VACUUMS, "suction_flows": FLOWS, "drive": "3 bar",
}  # fmt: skip


@pytest.mark.parametrize(
    ("supply", "vacuum", "flow"),
    [
        (6, 0.0, 1e-3),
        (6, 0.2, 7.5e-4),
        (6, 0.4, 5e-4),
        (6, 0.6, 2.5e-4),
        (6, 0.9, 0.0),
        (6, -0.1, 1e-3),
        (2.5, 0.4, 2.5e-4),
    ],
)
def test_an_ejector_draws_the_flow_of_its_catalogue(supply, vacuum, flow):
    """At half of `drive` it draws a half: S(1/2) = 1/2; the jet is choked, Q = C p₁."""
    hydraulics = {
        "supply": {"type": "tank", "pressure": supply * BAR},
        "cup": {"type": "tank", "pressure": (1.0 - vacuum) * BAR},
        "room": ROOM,
        "jet": {**EJECTOR, "ports": {"P": "supply", "A": "cup", "R": "room"}},
    }
    result = circuit(hydraulics, fluids=AIR).simulate(duration=1e-3, step=1e-3, integrator="rk4")
    assert history(result, "hydraulics.jet.suction_flow")[-1] == pytest.approx(flow, rel=1e-9, abs=1e-15)
    if supply == 6:
        assert history(result, "hydraulics.jet.flow")[-1] == pytest.approx(2e-9 * 6 * BAR, rel=1e-9)


def test_an_ejector_empties_a_cup_as_an_exponential():
    """V ṗ/(R T) = -ρ_N Q₀ (1 - (p_R - p)/Δ): p - (p_R - Δ) falls with ρ_N R T Q₀/(V Δ)."""
    volume, greatest = 1e-3, 0.85 * BAR
    hydraulics = {
        "supply": {"type": "tank", "pressure": 6 * BAR},
        "cup": {"type": "volume", "volume": volume, "start": 1 * BAR},
        "room": ROOM,
        "jet": {
            **EJECTOR, "ports": {"P": "supply", "A": "cup", "R": "room"}, "vacuums": [0, greatest], "suction_flows": [1e-3, 0],
        },
    }  # fmt: skip
    result = circuit(hydraulics, fluids=CALM).simulate(
        integrator="radau", tolerance=1e-9, duration=2.0, output_interval=0.1
    )
    p, t = history(result, "hydraulics.cup.pressure"), np.asarray(result.time)
    rate = RHO_N * R * T_N * 1e-3 / (volume * greatest)
    assert p == pytest.approx(1 * BAR - greatest * (1.0 - np.exp(-rate * t)), rel=1e-6)
    balance = {item.name: item for item in result.trust.items}["fluid mass"]
    assert balance.fraction < 1e-8


BORE, ROD, STROKE, TRANSFER = 0.05, 0.02, 0.4, 80.0
RAM = {
    "type": "cylinder", "piston": BORE, "rod": ROD, "stroke": STROKE, "retracted_length": 0.5, "dead_volume_A": 1e-5,
    "dead_volume_B": 1e-5, "bodies": ["ground", "block"], "points": [[0, 0, 0], [0.6, 0, 0]],
}  # fmt: skip


def moved(hydraulics, mass):
    """A cylinder 100 mm out, on a block."""
    block = {"mass": mass, "inertia": [1, 1, 1], "position": [0.6, 0, 0]}
    return circuit(
        hydraulics, fluids=AIR, bodies={"block": block}, joints={"rail": slide("ground", "block", point=[0.6, 0, 0])}
    )


def test_walls_of_a_chamber_exchange_heat_by_their_area():
    """Ṫ = -h A (T - T₀)/(m c_v), A = 2 A_K + π D s of the piston side, and with the rod of the other; the mass is too large to move."""
    area, ring = 0.25 * math.pi * BORE**2, 0.25 * math.pi * (BORE**2 - ROD**2)
    ram = {**RAM, "heat_transfer": TRANSFER, "start_A": ring / area * 5 * BAR, "start_B": 5 * BAR}
    ram["start_A"] = (5 * BAR - 101325.0) * ring / area + 101325.0
    model = moved({"ram": ram}, 1e12).linearise()
    wanted = []
    for its, inner, s, p in ((area, 0.0, 0.1, ram["start_A"]), (ring, ROD, STROKE - 0.1, 5 * BAR)):
        volume = 1e-5 + its * s
        walls = 2.0 * its + math.pi * (BORE + inner) * volume / its
        wanted.append(-TRANSFER * walls / (p * volume / (R * T_N) * CV))
    found = [each.eigenvalue.real for each in model.modes if each.eigenvalue.real < -1e-3 and not each.eigenvalue.imag]
    assert sorted(found) == pytest.approx(sorted(wanted), rel=1e-6)


def test_walls_of_a_volume_are_its_surface():
    box = {"type": "volume", "volume": "1 L", "start": "6 bar"}
    walls = {"one": {"heat_transfer": 50, "surface": "0.06 m^2"}, "two": {"heat_conductance": 3.0}}
    boxes = {name: {**box, **more} for name, more in walls.items()}
    gap = {"type": "orifice", "ports": {"A": "one", "B": "two"}, "sonic_conductance": 1e-9, "opening": 0}
    model = circuit({**boxes, "gap": gap}, fluids=AIR).linearise()
    mass = 6 * BAR * 1e-3 / (R * T_N)
    found = [each.eigenvalue.real for each in model.modes if not each.structural]
    assert found == pytest.approx([-3.0 / (mass * CV)] * 2, rel=1e-9)


@cache
def cushioned():
    """A piston that runs into a cushion of its end."""
    cushion = {
        "length": 0.03,
        "least_opening": 0.05,
        "sonic_conductance": 2e-8,
        "critical_ratio": 0.4,
        "port_volume": 1e-5,
    }
    room = {"room": ROOM, "supply": {"type": "tank", "pressure": "6 bar"}}
    ports = {"out": ("ram.A", "room"), "in": ("supply", "ram.B")}
    valves = {
        name: {"type": "orifice", "ports": {"A": a, "B": b}, "sonic_conductance": 2e-8}
        for name, (a, b) in ports.items()
    }
    ram = {**RAM, "cushion_A": cushion, "start_A": "2 bar", "start_B": "5 bar", "points": [[0, 0, 0], [0.6, 0, 0]]}
    return moved({**room, **valves, "ram": ram}, 15.0).simulate(
        integrator="radau", tolerance=1e-7, duration=0.25, output_interval=2e-3
    )


def test_a_cushion_throttles_the_exhaust_by_the_place_of_the_piston():
    """ṁ by ISO 6358 with C (x_min + (1 - x_min) S(s/l)), from what is in the chamber to what is at its port."""
    result = cushioned()
    s, a, b, T = (
        history(result, f"hydraulics.ram.{name}")
        for name in ("position", "pressure_A", "pressure_port_A", "temperature_A")
    )
    flow = history(result, "hydraulics.ram.cushion_flow_A")
    t = np.clip(s / 0.03, 0.0, 1.0)
    opening = 0.05 + 0.95 * t * t * (3.0 - 2.0 * t)
    x = (1.0 - b / a) / 0.6
    outward = (x > 0.05) & (x < 0.99)
    exact = 2e-8 * opening * a * np.sqrt(np.clip(x * (2.0 - x), 0.0, None)) * np.sqrt(T_N / T)
    assert np.sum(outward & (t < 1.0)) > 10
    assert flow[outward] == pytest.approx(exact[outward], rel=1e-3)


def test_a_cushion_lets_gas_in_past_a_check_valve_that_little_opens():
    """The check valve beside it, open from 0.05 bar, wholly at 0.25 bar."""
    result = cushioned()
    assert history(result, "hydraulics.ram.speed").min() < -0.3
    end = history(result, "hydraulics.ram.position")
    assert -1e-3 < end.min() < 0.01


def test_the_curves_of_valves_of_gas_are_those_of_iso_6358():
    record = {
        "fluids": [{"name": "air", "type": "ideal-gas", "density": 1.185}],
        "hydraulics": [
            {
                "name": "gap",
                "type": "orifice",
                "ports": {"A": "a", "B": "b"},
                "sonic_conductance": 1e-8,
                "critical_ratio": 0.25,
            },
            {"name": "jet", **EJECTOR, "ports": {"P": "a", "A": "b", "R": "c"}},
        ],
    }
    gap, jet = valve_charts(record)
    curve = gap.curves[0]
    assert curve.y[0] == pytest.approx(1e-8 * 7e5 * 6e4)
    x = (1.0 - 0.5) / 0.75
    assert np.interp(3.5, curve.x, curve.y) == pytest.approx(1e-8 * 7e5 * 6e4 * math.sqrt(x * (2.0 - x)), rel=1e-3)
    assert list(jet.curves[0].x) == pytest.approx([0.0, 0.4, 0.8])
    assert list(jet.curves[0].y) == pytest.approx([60.0, 30.0, 0.0])


FAULTS = {
    "one flow less": (
        {"suction_flows": [1e-3, 0.0]},
        "2 to 5 points were expected, as many flows as vacuums, got 2 and 3",
    ),
    "a vacuum that falls": ({"vacuums": [0.0, 8e4, 4e4]}, "vacuums that rise were expected"),
    "flow to the end": (
        {"suction_flows": [1e-3, 5e-4, 1e-4]},
        "flows that fall to 0 at the greatest vacuum were expected",
    ),
}


@pytest.mark.parametrize("case", FAULTS)
def test_a_fault_of_an_ejector_says_what_would_be_right(case):
    change, message = FAULTS[case]
    hydraulics = {
        "supply": {"type": "tank", "pressure": 6 * BAR},
        "room": ROOM,
        "cup": {"type": "volume", "volume": "1 L"},
        "jet": {**EJECTOR, "ports": {"P": "supply", "A": "cup", "R": "room"}, **change},
    }
    with pytest.raises(Exception, match=message):
        circuit(hydraulics, fluids=AIR)


def test_a_shuttle_of_gas_passes_the_higher_side():
    """Q = C p₁ where it is choked; nothing goes on to the lower side."""
    hydraulics = {name: {"type": "tank", "pressure": p * BAR} for name, p in (("high", 6), ("low", 3), ("end", 1))}
    shuttle = {"type": "shuttle-valve", "sonic_conductance": 1e-8}
    hydraulics["one"] = {**shuttle, "ports": {"A": "high", "B": "low", "C": "end"}}
    hydraulics["other"] = {**shuttle, "ports": {"A": "low", "B": "high", "C": "end"}}
    result = circuit(hydraulics, fluids=AIR).simulate(duration=1e-3, step=1e-3, integrator="rk4")
    for name, open_side, closed in (("one", "A", "B"), ("other", "B", "A")):
        assert history(result, f"hydraulics.{name}.flow_{open_side}")[-1] == pytest.approx(1e-8 * 6 * BAR, rel=1e-9)
        assert history(result, f"hydraulics.{name}.flow_{closed}")[-1] == 0.0
