"""The page of hydraulics: its machine works, and no component, key or signal is missing. The examples run green."""

import re
import shutil
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import nivel
from nivel.api import Machine
from nivel.elements.circuits import COMPONENTS
from nivel.elements.circuits.actuators import Cushion
from nivel.elements.circuits.composed import CHECK_OPENS_AT, CHECK_RANGE
from nivel.elements.circuits.edges import Edge
from nivel.elements.circuits.fluids import Fluid, Gas
from nivel.elements.circuits.lines import CRITICAL, RESISTANCE, loss
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
from nivel.elements.circuits.smooth import ramp, root_flow, step
from nivel.elements.circuits.spool_valves import conductances
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
        text.replace("²", "**2").replace("√(", "sqrt(").replace("ρ₀", "rho").replace("ρ_l", "rho_l").replace("Δp", "dp")
    )
    for sign, power in (("³", "**3"), ("⁴", "**4"), ("⁶", "**6"), ("^", "**")):
        text = text.replace(sign, power)
    text = re.sub(r"(?<=\d)(?=t\b)", "*", text)
    text = re.sub(r"(?<=[\w)]) (?=[\w(])", "*", text)
    text = text.replace("sqrt*(", "sqrt(").replace("exp*(", "exp(").replace("tanh*(", "tanh(")
    known = {each: getattr(np, each) for each in ("sqrt", "exp", "tanh")}
    return float(eval(text, {"__builtins__": {}}, {**known, **names}))


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
