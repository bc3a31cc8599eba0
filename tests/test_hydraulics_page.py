"""The page of hydraulics: its machine works, and no component, key or signal is missing. The examples run green."""

import re
import shutil
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import nivel
from circuits import circuit, history
from nivel.api import Machine
from nivel.elements.circuits import COMPONENTS
from nivel.elements.circuits.accumulators import beyond
from nivel.elements.circuits.actuators import Cushion
from nivel.elements.circuits.composed import CHECK_OPENS_AT, CHECK_RANGE
from nivel.elements.circuits.edges import Edge
from nivel.elements.circuits.fluids import GRADES, Fluid, Gas
from nivel.elements.circuits.line_friction import CRITICAL, RESISTANCE, loss
from nivel.elements.circuits.nitrogen import gas_state
from nivel.elements.circuits.pistons import (
    COULOMB,
    SEAL,
    STATIC,
    STRIBECK,
    STROKE,
    TRANSITION,
    VISCOUS,
    PistonFriction,
    friction_force,
)
from nivel.elements.circuits.pumps import ripple
from nivel.elements.circuits.smooth import ramp, root_flow, step
from nivel.elements.circuits.spool_valves import conductances
from nivel.elements.circuits.volumes import EXPONENT, FIXED, GAS, PRECHARGE, room
from nivel.files import parse_machine

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "docs" / "hydraulics.md").read_text(encoding="utf-8")
WORDS = set(re.findall(r"`([\w/-]+)`", PAGE))
KNOWN = {"name", "type", "ports", "markers", "bodies", "points"}


def test_the_machine_of_the_page_runs():
    text = re.search(r"```yaml\n(format: 1.*?)```", PAGE, re.DOTALL)
    assert text is not None
    result = Machine.from_record(parse_machine(text.group(1))).simulate(duration=0.3)
    assert result.outcome == "done"


@pytest.mark.parametrize(
    "record", [*COMPONENTS.records, Fluid, Gas, PistonFriction, Cushion], ids=lambda each: each.__name__
)
def test_every_key_of_a_component_is_on_the_page(record):
    assert not set(record.model_fields) - KNOWN - WORDS
    if "type" in record.model_fields:
        assert record.model_fields["type"].default in WORDS


@pytest.mark.parametrize("path", sorted((ROOT / "examples" / "hydraulics").glob("*.yaml")), ids=lambda path: path.stem)
def test_an_example_runs_green(path):
    result = nivel.load(path).simulate(
        **({"duration": 1.0} if path.stem == "loader-crane" else {})
    )  # its cycle has tests of its own
    assert result.outcome == "done"
    assert [item for item in result.trust.items if item.verdict != "green"] == []


def test_the_boom_of_the_crane_bends_by_one_word(tmp_path):
    """Bent or rigid it stands on the same pressure, of nearly the same weight."""
    from nivel.flexible.body.body_file import write_body
    from nivel.flexible.reduce import reduce

    folder = tmp_path / "hydraulics"
    shutil.copytree(ROOT / "examples" / "hydraulics", folder, ignore=shutil.ignore_patterns("*.nc"))
    write_body(reduce(folder / "booms" / "boom.yaml").body, folder / "booms" / "boom.nc")
    settings = {
        "coordinates": "relative",
        "integrator": "radau",
        "tolerance": 1e-5,
        "duration": 0.1,
        "start": "equilibrium",
    }
    stiff, bent = (
        nivel.load(folder / "loader-crane.yaml", {"include": f"booms/{word}.yaml"}).simulate(**settings)
        for word in ("rigid", "flexible")
    )
    assert bent.trust.verdict == "green"
    pressures = [float(np.mean(each.array("hydraulics.lift.pressure_A"))) for each in (stiff, bent)]
    assert pressures[1] == pytest.approx(pressures[0], rel=0.03)
    assert np.all(bent.array("modal_coordinate")[:, 0] != 0.0)


def formula_of(row: str, begin: str, end: str, **names: float) -> float:
    """The value of a formula as it stands on the page, from `begin` up to `end` in the row of a component."""
    (line,) = re.findall(rf"^\| {re.escape(row)} \|.*$", PAGE, re.MULTILINE)
    text = begin + line.partition(begin)[2].partition(end)[0]
    text = text.partition(" = ")[2] or text
    text = (
        text.replace("√(", "sqrt(").replace("ρ₀", "rho").replace("ρ_l", "rho_l").replace("Δp", "dp").replace("₀", "0")
    )
    for sign, power in (("²", "**2"), ("³", "**3"), ("⁴", "**4"), ("⁶", "**6"), ("^", "**")):
        text = text.replace(sign, power)
    text = re.sub(r"(?<=\d)(?=t\b)", "*", text)
    text = re.sub(r"(?<=[\w)]) (?=[\w(])", "*", text)
    text = re.sub(r"\b(sqrt|exp|tanh|tan)\*\(", r"\1(", text)
    known = {each: getattr(np, each) for each in ("sqrt", "exp", "tanh", "tan")}
    return eval(text, {"__builtins__": {}}, {**known, **names})


def test_the_friction_of_cylinders_is_the_formula_of_the_page():
    numbers = np.zeros(STROKE + 1)
    numbers[[COULOMB, SEAL, STATIC, STRIBECK, TRANSITION, VISCOUS]] = 120.0, 3e-4, 1.4, 0.03, 0.006, 900.0
    names = {"F_c": 120.0, "b": 3e-4, "s": 1.4, "v_s": 0.03, "v_t": 0.006, "d": 900.0}
    for v in (-0.2, -0.004, 0.0, 0.01, 0.7):
        for difference in (-2e7, 0.0, 4e4, 1e6):
            page = formula_of("`friction` of a cylinder", "(F_c + b", ": F_c", v=v, dp=difference, **names)
            assert friction_force(numbers, v, difference) == pytest.approx(page, rel=1e-12, abs=1e-9)


def test_the_edge_of_an_area_is_the_formula_of_the_page():
    fluid = Fluid(name="oil", density=850.0, air=0.01)
    density = formula_of("edge of a spool valve", "ρ₀ = (1", " with", rho_l=850.0, air=0.01)
    assert fluid.mixed_density == pytest.approx(density, rel=1e-12)
    edge = Edge(area={"of": "position", "points": [0, 1], "values": [0, 3e-5]})
    valve = SimpleNamespace(curves_of=lambda edge: [edge.area], transition=5e4)
    _, (curve,) = conductances(valve, edge, density)
    page = formula_of("edge of a spool valve", "K = C A", ",", C=0.65, A=3e-5, rho=density)
    assert curve.values[-1] == pytest.approx(page, rel=1e-12)


def test_openings_and_flows_are_the_formulas_of_the_page():
    """S of poppets, R of spools, the root of a restriction, the loss of a pipe."""
    for t in (0.0, 0.2, 0.7, 1.0):
        assert step(t) == pytest.approx(formula_of("check, relief, …", "S = 3t²", ";", t=t), abs=1e-15)
        width = 0.02
        page = formula_of("directional valve", "r (t³", " with", r=width, t=t)
        assert ramp(t * width, width) == pytest.approx(page, abs=1e-15)
    assert ramp(0.3, 0.02) == formula_of("directional valve", "R(z) = z", " beyond", z=0.3, r=0.02)
    for dp in (-3e5, -10.0, 0.0, 2e4, 2e7):
        page = formula_of("restriction", "Q = K", ", K", K=2e-8, x=0.4, c=5e4, G=1e-13, dp=dp)
        assert 2e-8 * 0.4 * root_flow(dp, 5e4, 0) + 1e-13 * dp == pytest.approx(page, rel=1e-12, abs=1e-18)
    numbers = np.zeros(8)
    numbers[[RESISTANCE, CRITICAL]] = 3e4, 1e-4
    for flow in (-1e-3, 0.0, 9e-5, 4e-4):
        page = formula_of("pipe", "Δp = R", ":", R=3e4 * 870.0, Q=flow, Q_c=1e-4)
        assert loss(numbers, 1.0, 870.0, flow) == pytest.approx(page, rel=1e-12, abs=1e-9)


def test_check_valves_of_brake_valves_are_those_of_the_page():
    (line,) = re.findall(r"^\| brake valve \|.*$", PAGE, re.MULTILINE)
    (found,) = re.findall(r"S\(\(p_VA - p_A - ([\de.]+)\)/([\de.]+)\)", line)
    assert tuple(map(float, found)) == (CHECK_OPENS_AT, CHECK_RANGE)


def test_accumulators_are_the_formulas_of_the_page():
    """Oil beside an ideal gas above and below its precharge, nitrogen, and a piston that rubs."""
    v0, dead, p0, n = 2e-3, 3e-5, 6e6, 1.3
    numbers = np.zeros(40)
    numbers[[FIXED, GAS, PRECHARGE, EXPONENT]] = dead, v0, p0, n
    width = formula_of("accumulator", "w = min", ":", min=min, V_d=dead, V0=v0)
    for p in (3e6, 5.95e6, 6e6, 9e6, 3e7):
        y = formula_of("accumulator", "y = 1 - (p", ",", p0=p0, p=p, n=n)
        lower = formula_of("accumulator", "V₀ (R(y", " in place", V0=v0, y=y, w=width, R=lambda z: ramp(z, width))
        assert room(numbers, p)[0] == pytest.approx(v0 * y if p >= p0 else lower, rel=1e-12, abs=1e-15)
    (line,) = re.findall(r"^\| accumulator with `gas: nitrogen` \|.*$", PAGE, re.MULTILINE)
    constants = {
        name.replace("₀", "0"): float(value)
        for name, value in re.findall(r"(?<![\w₀])([RABCabcαγ]₀?) = ([\d.e-]+\d)", line)
    }
    for density, warmth in ((0.5, 260.0), (4.0, 300.0), (14.0, 400.0)):
        page = formula_of(
            "accumulator with `gas: nitrogen`", "p = ρ R", " (Benedict", **{"ρ": density}, T=warmth, **constants
        )
        assert gas_state(density, warmth)[0] == pytest.approx(1e3 * page, rel=1e-12)
    for drop in (-3e5, 0.0, 4e4, 9e5):
        page = formula_of("`piston_friction` F of an accumulator", "Δp - F", " in", F=5e4, sgn=np.sign, dp=drop)
        assert beyond(drop, 5e4) == pytest.approx(
            page if abs(drop) > 6e4 else 0.0, abs=1e-9 + 0.05 * 5e4 * (abs(drop) > 0)
        )


def test_the_ripple_is_the_formula_of_the_page():
    for pistons in (5, 7, 9):
        page = formula_of("displacement with z = `pistons`", "δ = π", " |", z=pistons, **{"π": np.pi})
        assert ripple(pistons) == (2 * pistons, pytest.approx(page / 2, rel=1e-14))


def test_coolers_pilots_and_warm_gas_are_the_formulas_of_the_page():
    rated = {"flow": "60 L/min", "pressure_drop": "5 bar"}
    hydraulics = {
        "tank": {"type": "reservoir", "volume": "40 L", "oil": "30 L"},
        "supply": {"type": "volume", "volume": "0.5 L"},
        "cold": {"type": "volume", "volume": "0.4 L"},
        "pump": {"type": "pump", "ports": {"A": "tank", "B": "supply"}, "displacement": "20 cm^3/rev", "speed": "1500 rpm"},
        "relief": {
            "type": "pilot-relief-valve", "ports": {"P": "supply", "T": "tank"}, "opens_at": "60 bar", "lag": 0, **rated,
        },
        "gas": {
            "type": "accumulator", "ports": {"A": "supply"}, "volume": "1 L", "precharge": "40 bar", "thermal_time": "2 s",
            "start": "50 bar", **rated,
        },
        "cooler": {
            "type": "cooler", "ports": {"A": "supply", "B": "cold"}, "heat_conductance": 300, "coolant_temperature": 283.15, **rated,
        },
        "out": {"type": "orifice", "ports": {"A": "cold", "B": "tank"}, "flow": "20 L/min", "pressure_drop": "70 bar"},
    }  # fmt: skip
    oil = {"oil": {"grade": "HLP 46", "isothermal": False, "air": 0}}
    result = circuit(hydraulics, fluids=oil).simulate(
        duration=1.0, output_interval=1e-3, integrator="radau", tolerance=1e-9, verify=False
    )
    known = lambda name: history(result, f"hydraulics.{name}")  # noqa: E731
    density = sum(history(result, f"state.{name}.mass") / size for name, size in (("supply", 5e-4), ("cold", 4e-4))) / 2
    names = {
        "ṁ": density * known("cooler.flow"),
        "c": GRADES["HLP 46"].at(313.15).heat_capacity,
        "H": 300.0,
        "T_c": 283.15,
    }
    heat = formula_of("cooler", "heat = ṁ c", ", H", T_in=known("supply.temperature"), **names)
    np.testing.assert_allclose(known("cooler.heat")[10:], heat[10:], rtol=1e-6)
    at = {
        "p_X": known("relief.pressure_X"),
        "p_P": known("supply.pressure"),
        "p_T": known("tank.pressure"),
        "S": np.vectorize(step),
    }
    for name, begin, end in (("pilot_position", "S((p_X", ";"), ("position", "S((p_P", ",")):
        page = formula_of("pilot-operated", begin, end, setting=6e6, pilot_range=3e5, spring=2e5, range=3e5, **at)
        np.testing.assert_allclose(known(f"relief.{name}"), page, rtol=1e-9, atol=1e-12)
        assert 0.0 < page[-1] < 1.0
    p, charge, row = known("gas.pressure"), history(result, "state.gas.charge"), "accumulator with `thermal_time` τ"
    left = (charge / p) ** (1 / 1.4)  # V/V₀ by p V^γ = P V₀^γ
    warmth = formula_of(row, "p V/(p₀", ",", p=p, V=left, p0=4e6, V0=1.0)
    np.testing.assert_allclose(known("gas.temperature") / 293.15, warmth, rtol=1e-12)
    rate = formula_of(row, "Ṗ = P (", ",", P=charge, T0=1.0, T=warmth, **{"τ": 2.0})
    np.testing.assert_allclose(
        np.gradient(charge, result.time)[10:-10], rate[10:-10], rtol=1e-3, atol=1e-3 * abs(rate).max()
    )
