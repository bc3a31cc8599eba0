"""Where modes end: a bar that spins fast without geometric stiffness, or bends by more than a little, is not green."""

import numpy as np
import pytest

import simulating
from models import bar, reduced
from nivel.flexible.body.body_file import write_body

LENGTH, HEIGHT, MODULUS, DENSITY = 2.0, 0.03, 210e9, 7850.0
SPEED = 0.5 * float(np.sqrt(MODULUS * 0.02**2 / 12 / DENSITY)) * (1.87510407 / LENGTH) ** 2  # half the lowest frequency


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    at = tmp_path_factory.mktemp("bars")
    for stiffening in ("true", "false"):
        body, _ = reduced(bar(elements=8, reduction=f"modes: 4, reference: root, stiffening: {stiffening}"))
        write_body(body, at / f"{stiffening}.nc")
    return at


def spun(folder, stiffening, share):
    machine = {
        "name": "spun",
        "bodies": {"bar": {"flexible": {"file": str(folder / f"{stiffening}.nc"), "modes": 4, "damping_ratio": 0.1}}},
        "joints": {"shaft": {"type": "revolute", "bodies": ["ground", "bar"], "interface": "root", "axis": [0, 0, 1]}},
        "drivers": {"motor": {"coordinate": "shaft.angle", "value": f"{share * SPEED!r}*time"}},
        "simulation": {"duration": 0.02, "step": 1e-4, "integrator": "generalised-alpha"},
    }
    return {item.name: item for item in simulating.simulate(machine).trust.items}


def test_a_bar_that_spins_fast_without_geometric_stiffness_is_red(folder):
    """Half the lowest frequency: a quarter of its square."""
    item = spun(folder, "false", 1.0)["stiffening"]
    assert (item.verdict, item.row) == ("red", "bar")
    assert item.fraction == pytest.approx(0.25, rel=0.05)
    assert "stiffening: true" in item.text


@pytest.mark.parametrize(("stiffening", "share"), [("true", 1.0), ("false", 0.1)])
def test_geometric_stiffness_or_a_slow_spin_is_green(folder, stiffening, share):
    assert "stiffening" not in spun(folder, stiffening, share)


@pytest.mark.parametrize(("force", "verdict"), [(1.0, None), (10.0, "amber"), (60.0, "red")])
def test_bending_that_is_not_small_is_told(folder, force, verdict):
    """F L³/(3 E I), against the length."""
    stiffness = 3.0 * MODULUS * 0.02 * HEIGHT**3 / 12 / LENGTH**3 * (0.02 / HEIGHT) ** 2
    machine = {
        "name": "bent",
        "bodies": {"bar": {"flexible": {"file": str(folder / "false.nc"), "modes": 4, "damping_ratio": 0.5}}},
        "joints": {"wall": {"type": "fixed", "bodies": ["ground", "bar"], "interface": "root"}},
        "markers": {"tip": {"body": "bar", "interface": "tip"}},
        "forces": {"push": {"type": "force", "marker": "tip", "vector": [0, f"{20 * force} N", 0]}},
        "simulation": {"duration": 1.0, "step": 1e-3, "integrator": "generalised-alpha", "start": "equilibrium"},
    }
    items = {item.name: item for item in simulating.simulate(machine).trust.items}
    if verdict is None:
        assert "bending" not in items
    else:
        assert items["bending"].verdict == verdict
        assert items["bending"].fraction == pytest.approx(20 * force / stiffness / LENGTH, rel=0.1)
