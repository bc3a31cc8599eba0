"""Valves that are composed of edges and poppets: each has the flow of its closed form at rest, and keeps the mass of its fluid."""

import math

import numpy as np
import pytest

from circuits import BAR, LITRE_PER_MINUTE, PA, between, circuit, density, history, steady
from test_characteristics import RATED, K, root, step

K2 = 20 * LITRE_PER_MINUTE / math.sqrt(7 * BAR)
AT_REST = {"integrator": "radau", "tolerance": 1e-9, "duration": 0.2}


def mass_flow(flow, a, b):
    """[kg/s] of a volume flow at the mean density of two pressures [Pa]."""
    return 0.5 * (density(a) + density(b)) * flow


def at_rest(valve, names, **pressures):
    """What these outputs are where the states inside have come to rest, and the balance of mass then."""
    hydraulics = between(valve, **{port: p * BAR for port, p in pressures.items()})
    result = circuit(hydraulics).simulate(**AT_REST)
    items = {item.name: item for item in result.trust.items}
    assert items["fluid mass"].fraction < 1e-8
    assert items["hydraulics"].fraction < 1e-6
    return [float(history(result, f"hydraulics.valve.{name}")[-1]) for name in names]


@pytest.mark.parametrize(("p", "ls"), [(30, 20), (30, 15), (29, 25)])
def test_an_unloading_valve_stands_a_margin_above_its_load(p, ls):
    valve = {"type": "unloading-valve", **RATED, "opens_at": "12 bar", "lag": 0}
    (flow,) = steady(between(valve, P=p * BAR, T=2 * BAR, LS=ls * BAR), "valve.flow")
    assert flow == pytest.approx(K * step((p - ls - 12) / 3) * root((p - 2) * BAR), rel=1e-8, abs=1e-18)


def test_a_pilot_unloads_a_pump():
    valve = {"type": "unloading-valve", **RATED, "opens_at": "50 bar", "lag": 0}
    (flow,) = steady(between(valve, P=30 * BAR, T=2 * BAR, X=52 * BAR), "valve.flow")
    assert flow == pytest.approx(K * step((52 - PA / BAR - 50) / 3) * root(28 * BAR), rel=1e-8)


@pytest.mark.parametrize(("p", "drain"), [(99, None), (105, None), (107, 4.0)])
def test_a_sequence_valve_opens_above_its_drain(p, drain):
    valve = {"type": "sequence-valve", **RATED, "opens_at": "100 bar"}
    more = {} if drain is None else {"T": drain * BAR}
    (flow,) = steady(between(valve, P=p * BAR, A=20 * BAR, **more), "valve.flow")
    behind = PA / BAR if drain is None else drain
    assert flow == pytest.approx(K * step((p - behind - 100) / 10) * root((p - 20) * BAR), rel=1e-8, abs=1e-18)


def test_a_sequence_valve_lets_fluid_return():
    valve = {"type": "sequence-valve", **RATED, "opens_at": "100 bar", "free_return": True}
    (back,) = steady(between(valve, P=10 * BAR, A=20 * BAR), "valve.check_flow")
    assert back == pytest.approx(K * root(10 * BAR), rel=1e-8)


@pytest.mark.parametrize(("a", "b", "x"), [(50, 20, 30), (20, 50, 33), (50, 20, 60)])
def test_a_cartridge_opens_by_its_areas_both_ways(a, b, x):
    valve = {"type": "cartridge-valve", **RATED, "area_share": 0.6}
    (flow,) = steady(between(valve, A=a * BAR, B=b * BAR, X=x * BAR), "valve.flow")
    opening = step((0.6 * a + 0.4 * b - x - 2) / 3)
    assert flow == pytest.approx(K * opening * root((a - b) * BAR), rel=1e-8, abs=1e-18)


@pytest.mark.parametrize(("a", "b"), [(30, 10), (10, 30), (20.1, 20)])
def test_a_shuttle_passes_the_higher_side(a, b):
    valve = {"type": "shuttle-valve", **RATED}
    of_a, of_b = steady(between(valve, A=a * BAR, B=b * BAR, C=15 * BAR), "valve.flow_A", "valve.flow_B")
    share = step(0.5 + (a - b) / 0.5)
    assert of_a == pytest.approx(K * share * root((a - 15) * BAR), rel=1e-8, abs=1e-18)
    assert of_b == pytest.approx(K * (1 - share) * root((b - 15) * BAR), rel=1e-8, abs=1e-15)


@pytest.mark.parametrize(("a", "b"), [(30, 10), (10, 30), (17, 10), (12, 10)])
def test_a_flushing_valve_passes_the_lower_side_where_both_differ_enough(a, b):
    """Open from 4 to 10 bar: shut in the middle, half open at 7."""
    valve = {"type": "flushing-valve", **RATED, "opens_at": "4 bar", "opening_range": "6 bar"}
    of_a, of_b = steady(between(valve, A=a * BAR, B=b * BAR, C=5 * BAR), "valve.flow_A", "valve.flow_B")
    assert of_a == pytest.approx(K * step((b - a - 4) / 6) * root((a - 5) * BAR), rel=1e-8, abs=1e-18)
    assert of_b == pytest.approx(K * step((a - b - 4) / 6) * root((b - 5) * BAR), rel=1e-8, abs=1e-18)


@pytest.mark.parametrize("over", [3.0, 6.5, 8.0, 10.0])
def test_a_priority_valve_gives_the_rest_to_the_others(over):
    valve = {"type": "priority-valve", **RATED, "lag": 0}
    hydraulics = between(valve, P=100 * BAR, CF=(40 + over) * BAR, EF=60 * BAR, LS=40 * BAR)
    first, rest = steady(hydraulics, "valve.flow_CF", "valve.flow_EF")
    share = step(0.5 - (over - 7) / 4)
    assert first == pytest.approx(K * share * root((60 - over) * BAR), rel=1e-8, abs=1e-18)
    assert rest == pytest.approx(K * (1 - share) * root(40 * BAR), rel=1e-8, abs=1e-15)


@pytest.mark.parametrize(("a", "b"), [(150, 20), (20, 150), (30, 25)])
def test_cross_port_relief_bounds_both_lines_and_refills_them(a, b):
    valve = {"type": "cross-port-relief", **RATED, "opens_at": "100 bar", "check_flow": "20 L/min"}
    names = ("flow_AB", "flow_BA", "flow_TA", "flow_TB")
    found = steady(between(valve, A=a * BAR, B=b * BAR, T=22 * BAR), *(f"valve.{name}" for name in names))
    wanted = [
        K * step((a - b - 100) / 20) * root((a - b) * BAR),
        K * step((b - a - 100) / 20) * root((b - a) * BAR),
        K2 * step((22 - a - 0.2) / 1) * root((22 - a) * BAR),
        K2 * step((22 - b - 0.2) / 1) * root((22 - b) * BAR),
    ]
    assert found == pytest.approx(wanted, rel=1e-8, abs=1e-18)


def test_a_brake_valve_lets_back_what_the_other_side_drives():
    valve = {"type": "brake-valve", **RATED, "lag": 0}
    hydraulics = between(valve, VA=20 * BAR, VB=2 * BAR, A=18 * BAR, B=60 * BAR)
    names = ("flow_A", "flow_B", "check_flow_A", "check_flow_B")
    found = steady(hydraulics, *(f"valve.{name}" for name in names))
    back = K * step((20 - PA / BAR - 10) / 15) * root(58 * BAR)
    assert found == pytest.approx([0.0, back, K * step((2 - 0.5) / 3) * root(2 * BAR), 0.0], rel=1e-8, abs=1e-18)


@pytest.mark.parametrize(("p", "a"), [(100, 20), (200, 150)])
def test_a_flow_control_holds_its_margin(p, a):
    """The flow through the orifice is that through the compensator: K s root(p_M - p_A) = K S root(p_P - p_M), an equation of p_M."""
    valve = {"type": "flow-control", **RATED, "setting": 0.5, "lag": "1 ms"}
    flow, through, inner = at_rest(valve, ("flow", "compensator_flow", "pressure_M"), P=p, A=a)
    over = inner / BAR - a
    assert flow == pytest.approx(0.5 * K * root(over * BAR), rel=1e-8)
    assert through == pytest.approx(K * step(0.5 - (over - 7) / 2) * root((p - a - over) * BAR), rel=1e-7)
    assert mass_flow(flow, inner, a * BAR) == pytest.approx(mass_flow(through, p * BAR, inner), rel=1e-7)
    assert 6.5 < over < 8.0


def test_a_flow_control_of_three_ways_sends_the_rest_to_the_tank():
    valve = {"type": "flow-control", **RATED, "setting": 0.25, "lag": 0}
    flow, rest = steady(between(valve, P=37.5 * BAR, A=30 * BAR, T=2 * BAR), "valve.flow", "valve.bypass_flow")
    assert flow == pytest.approx(0.25 * K * root(7.5 * BAR), rel=1e-8)
    assert rest == pytest.approx(K * step(0.5 + (7.5 - 7) / 2) * root(35.5 * BAR), rel=1e-8)


@pytest.mark.parametrize("combines", [False, True])
def test_a_divider_keeps_its_ratio_whatever_the_loads_are(combines):
    valve = {"type": "flow-divider", **RATED, "share": 0.6, "combines": combines, "lag": "1 ms"}
    p, a, b = (50, 20, 40) if not combines else (20, 60, 40)
    names = ("flow_A", "flow_B", "orifice_flow_A", "orifice_flow_B", "pressure_M", "pressure_N")
    of_a, of_b, first, second, m, n = at_rest(valve, names, P=p, A=a, B=b)
    assert of_a / (of_a + of_b) == pytest.approx(0.6, rel=0.01)
    assert first == pytest.approx(0.6 * K * root(p * BAR - m), rel=1e-8)
    way = -1.0 if combines else 1.0
    opening = step(0.5 + way * (m - n) / BAR)
    assert of_a == pytest.approx(0.6 * K * opening * root(m - a * BAR), rel=1e-6)
    assert mass_flow(first, p * BAR, m) == pytest.approx(mass_flow(of_a, m, a * BAR), rel=1e-6)
    assert mass_flow(second, p * BAR, n) == pytest.approx(mass_flow(of_b, n, b * BAR), rel=1e-6)


@pytest.mark.parametrize("p", [95, 108, 115])
def test_a_pilot_relief_valve_opens_by_the_flow_of_its_pilot(p):
    valve = {"type": "pilot-relief-valve", **RATED, "opens_at": "100 bar", "lag": "1 ms"}
    flow, orifice, pilot, x = at_rest(valve, ("flow", "orifice_flow", "pilot_flow", "pressure_X"), P=p, T=2)
    k = 2 * LITRE_PER_MINUTE / math.sqrt(5 * BAR)
    assert orifice == pytest.approx(k * root(p * BAR - x), rel=1e-8, abs=1e-12)
    assert pilot == pytest.approx(2 * k * step((x / BAR - 102) / 3) * root(x - 2 * BAR), rel=1e-8, abs=1e-12)
    assert mass_flow(pilot, x, 2 * BAR) == pytest.approx(mass_flow(orifice, p * BAR, x), rel=1e-6, abs=1e-9)
    opening = step((p - x / BAR - 2) / 3)
    assert flow == pytest.approx(K * opening * root((p - 2) * BAR), rel=1e-5, abs=1e-12)
    assert (flow > 1e-12) == (p > 105)  # closed but for what the iteration leaves


@pytest.mark.parametrize("a", [60, 84, 95])
def test_a_pilot_reducing_valve_closes_by_the_flow_of_its_pilot(a):
    valve = {"type": "pilot-reducing-valve", **RATED, "pressure": "80 bar", "lag": "1 ms"}
    flow, x = at_rest(valve, ("flow", "pressure_X"), P=200, A=a, T=2)
    opening = step((5 - (a - x / BAR)) / 3)
    assert flow == pytest.approx(K * opening * root((200 - a) * BAR), rel=1e-5, abs=1e-9)
    assert (opening == 0.0) == (a == 95)


@pytest.mark.parametrize(("drain", "pilot"), [(None, 24.0), (0.6e-3, 14.0)])
def test_orifices_in_the_pilot_line_give_the_pilot_a_share_of_its_pressure(drain, pilot):
    """Alike orifices from X at 24 bar and to V at 4 bar halve the difference, but for the densities; T drains the spring chamber."""
    valve = {"type": "counterbalance-valve", **RATED, "opens_at": "120 bar", "lag": 0, "pilot_orifice": "0.6 mm"}
    valve |= {} if drain is None else {"drain_orifice": drain}
    flow, y, through = at_rest(valve, ("flow", "pressure_Y", "pilot_flow"), L=100, V=4, X=24, T=2)
    assert y / BAR == pytest.approx(pilot, rel=2e-3)
    control = 100 + 3 * y / BAR - 4 * 2 - 120
    assert flow == pytest.approx(K * step(control / 80) * root(96 * BAR), rel=1e-6, abs=1e-9)
    area = 0.65 * math.pi / 4 * 0.6e-3**2 * math.sqrt(2 / (0.995 * 870 + 0.005 * 1.2))
    assert through == pytest.approx(area * root(24 * BAR - y), rel=1e-6, abs=1e-10)


# --- sections ---
def section(**more):
    return {"type": "section", **RATED, "overlap": 0.0, "lag": "1 ms"} | more


def opening_of(u, r=0.02):
    return (abs(u) - 0.5 * r) / (1.0 - 0.5 * r)


@pytest.mark.parametrize(("u", "side"), [(0.5, "A"), (-0.3, "B")])
def test_a_compensator_before_the_spool_holds_the_drop_over_it(u, side):
    loads = {"A": 50.0, "B": 3.0} if u > 0 else {"A": 3.0, "B": 70.0}
    names = ("compensator_flow", "flow_MA", "flow_MB", "flow_AT", "flow_BT", "pressure_M")
    through, a, b, at, bt, m = at_rest(section(command=u), names, P=100, T=2, LS=loads[side], **loads)
    flow, back, low = (a, bt, loads["B"]) if u > 0 else (b, at, loads["A"])
    over = m / BAR - loads[side]
    assert flow == pytest.approx(K * opening_of(u) * root(over * BAR), rel=1e-8)
    assert mass_flow(through, 100 * BAR, m) == pytest.approx(mass_flow(flow, m, loads[side] * BAR), rel=1e-6)
    assert through == pytest.approx(2 * K * step(0.5 - (over - 7) / 4) * root(100 * BAR - m), rel=1e-5)
    assert back == pytest.approx(K * opening_of(u) * root((low - 2) * BAR), rel=1e-8)
    assert 6.0 < over < 9.0


def test_margins_that_are_a_share_fall_together():
    """p_M - p_LS settles near a share of p_P - p_LS, be the pump saturated or not."""
    for p, load in ((80, 60), (66, 60)):
        (m,) = at_rest(section(command=0.6, saturation_share=0.5), ("pressure_M",), P=p, T=2, A=load, B=3, LS=load)
        over = m / BAR - load
        assert abs(over - 0.5 * (p - load)) < 2.0  # within half the range of the compensator


def test_a_compensator_behind_the_spool_brings_it_to_the_highest_load():
    names = ("flow_PM", "compensator_flow", "flow_CA", "pressure_M", "pressure_C")
    valve = section(command=0.5, compensation="post", margin="1 bar")
    metered, through, out, m, c = at_rest(valve, names, P=100, T=2, A=30, B=3, LS=80)
    over = m / BAR - 80
    assert -1.5 < over < 3.5
    assert metered == pytest.approx(K * opening_of(0.5) * root(100 * BAR - m), rel=1e-8)
    assert through == pytest.approx(2 * K * step(0.5 + (over - 1) / 4) * root(m - c), rel=1e-5)
    assert out == pytest.approx(4 * K * opening_of(0.5) * root(c - 30 * BAR), rel=1e-6)
    assert mass_flow(metered, 100 * BAR, m) == pytest.approx(mass_flow(through, m, c), rel=1e-6)


def test_sections_with_post_compensation_share_what_the_pump_gives():
    """A pump of 30 L/min for wishes of 40 and 20 L/min: flows stay in the ratio of the openings, with loads of 120 and 40 bar."""
    hydraulics = {
        "tank": {"type": "tank", "pressure": "1 bar"},
        "high": {"type": "tank", "pressure": "120 bar"},
        "low": {"type": "tank", "pressure": "40 bar"},
        "line": {"type": "volume", "volume": "0.5 L"},
        "ls": {"type": "load-sensing", "valves": ["one", "two"]},
        "pump": {"type": "flow-source", "ports": {"A": "tank", "B": "line"}, "flow": "30 L/min"},
        "relief": {
            "type": "relief-valve", "ports": {"P": "line", "T": "tank"}, "opens_at": "250 bar",
            "opening_range": "10 bar", **RATED,
        },
        "one": section(
            command=0.8, compensation="post", margin="1 bar", opening_range="1 bar", pressure_drop="20 bar",
            ports={"P": "line", "T": "tank", "A": "high", "B": "tank", "LS": "ls"},
        ),
        "two": section(
            command=0.4, compensation="post", margin="1 bar", opening_range="1 bar", pressure_drop="20 bar",
            ports={"P": "line", "T": "tank", "A": "low", "B": "tank", "LS": "ls"},
        ),
    }  # fmt: skip
    result = circuit(hydraulics).simulate(duration=0.3, step=1e-3)
    one, two = (float(history(result, f"hydraulics.{name}.flow_PM")[-1]) for name in ("one", "two"))
    line = float(history(result, "hydraulics.line.pressure")[-1])
    behind = [float(history(result, f"hydraulics.{name}.pressure_M")[-1]) for name in ("one", "two")]
    taken = mass_flow(one, line, behind[0]) + mass_flow(two, line, behind[1])
    assert taken == pytest.approx(density(BAR) * 30 * LITRE_PER_MINUTE, rel=1e-4)
    assert one / two == pytest.approx(opening_of(0.8) / opening_of(0.4), rel=0.1)
    assert next(item for item in result.trust.items if item.name == "fluid mass").fraction < 1e-8
    assert np.isfinite(history(result, "hydraulics.ls.pressure")).all()
