"""What a flexible body lacks: modes that are left out and the mesh, estimated at reduction and by the loads of a run."""

import numpy as np
import pytest

import simulating
from models import bar, block, reduced
from needing import needs
from nivel.flexible.body.body_file import read_body, write_body
from nivel.judge.after.checks.modes import response
from nivel.results.scales import rotated

LENGTH, WIDTH, HEIGHT, MODULUS, DENSITY = 2.0, 0.02, 0.03, 210e9, 7850.0
EI = MODULUS * HEIGHT * WIDTH**3 / 12  # bent along y
SPEED = float(np.sqrt(EI / (DENSITY * WIDTH * HEIGHT))) / LENGTH**2  # times (βL)² of a mode [rad/s]
LOAD = 5.0


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    at = tmp_path_factory.mktemp("bars")
    kinds = {
        "fixed": "modes: 12",
        "few": "modes: 1",
        "free": "modes: 3, method: normal-modes",
        "held": "modes: 2, reference: root",
    }
    for name, reduction in kinds.items():
        write_body(reduced(bar(elements=16, reduction=reduction))[0], at / f"{name}.nc")
    write_body(reduced(bar(elements=2, reduction="modes: 12"))[0], at / "coarse.nc")
    return at


def cantilever(folder, name, force, modes=None, **simulation):
    """A bar held at its root under a force at its tip; its trust lines by name, and the displacement of the tip [m] along y."""
    flexible = {"file": str(folder / f"{name}.nc"), "damping_ratio": 0.05, **({"modes": modes} if modes else {})}
    machine = {
        "name": name,
        "bodies": {"bar": {"flexible": flexible}},
        "joints": {"wall": {"type": "fixed", "bodies": ["ground", "bar"], "interface": "root"}},
        "markers": {"tip": {"body": "bar", "interface": "tip"}},
        "forces": {"push": {"type": "force", "marker": "tip", "vector": [0, force, 0]}},
        "simulation": {"duration": 0.2, "step": 5e-4, "integrator": "generalised-alpha", **simulation},
    }
    result = simulating.simulate(machine)
    body = read_body(folder / f"{name}.nc")
    body = body.keeping(np.sort(np.argsort(body.eigenvalues)[:modes])) if modes else body
    tip = body.interface("tip")
    place = tip.position + result.array("modal_coordinate") @ tip.phi.T
    y = result.array("position")[:, 0, 1] + rotated(result.array("orientation")[:, 0], place)[:, 1]
    return {item.name: item for item in result.trust.items}, y


@pytest.mark.parametrize(("name", "modes"), [("fixed", 4), ("fixed", 8), ("free", None)])
def test_energy_of_modes_left_out_is_what_the_deflection_lacks(folder, name, modes):
    """At rest under a load F at the tip both energies are F/2 times a deflection, that of the whole bar F L³/(3 EI)."""
    items, y = cantilever(folder, name, LOAD, modes, start="equilibrium", duration=2e-3)
    lacks = LOAD * LENGTH**3 / (3.0 * EI) / y[0] - 1.0
    assert items["modes"].verdict == "red"
    assert (items["modes"].row, items["modes"].fraction) == ("bar", pytest.approx(lacks, rel=1e-3))


def test_a_body_with_correction_modes_lacks_nothing_under_a_slow_load(folder):
    """Also with a mesh of two elements: the deflection under forces at nodes is exact."""
    for name in ("fixed", "few", "held", "coarse"):
        items, y = cantilever(folder, name, LOAD, start="equilibrium", duration=2e-3)
        assert y[0] == pytest.approx(LOAD * LENGTH**3 / (3.0 * EI), rel=1e-4)
        assert not {"modes", "mesh"} & set(items)


@pytest.mark.parametrize(("name", "line"), [("few", "modes"), ("held", "modes"), ("coarse", "mesh"), ("fixed", None)])
def test_a_load_near_the_third_frequency_is_told_of_bodies_that_do_not_have_it(folder, name, line):
    force = f"{20 * LOAD}*sin({7.8547574**2 * SPEED!r}*time)"
    items, _ = cantilever(folder, name, force)
    assert {"modes", "mesh"} & set(items) == ({line} if line else set())


def test_modes_left_out_answer_as_equations_of_vibration_do():
    """q̈ + ω² q = t: q = t/ω² - sin(ωt)/ω³; the load is straight, so any step is exact."""
    omega, time = np.array([3.0, 40.0]), np.array([0.0, 0.1, 0.15, 0.4, 1.0])
    q = response(time, time[:, None] * np.ones(2), omega, 0.0)
    exact = time[:, None] / omega**2 - np.sin(np.outer(time, omega)) / omega**3
    assert q == pytest.approx(exact, abs=1e-14)


@pytest.mark.parametrize("coordinates", ["absolute", "relative", "independent"])
def test_modal_accelerations_are_derivatives_of_rates(folder, coordinates):
    """Central differences of a vibration: off by (ω h)²/6, ω of the fastest mode that moves."""
    machine = {
        "name": "swing",
        "gravity": [0, -9.81, 0],
        "bodies": {"bar": {"flexible": {"file": str(folder / "fixed.nc"), "modes": 2}}},
        "joints": {"pin": {"type": "revolute", "bodies": ["ground", "bar"], "interface": "root", "axis": [0, 0, 1]}},
        "simulation": {"duration": 0.02, "step": 2e-4, "integrator": "rk4", "coordinates": coordinates},
    }
    result = simulating.simulate(machine)
    rate, acceleration = result.array("modal_rate"), result.array("modal_acceleration")
    by_differences = (rate[2:] - rate[:-2]) / 4e-4
    scale = np.abs(acceleration).max()
    assert scale > 1.0
    assert np.abs(by_differences - acceleration[1:-1]).max() < 2e-3 * scale


def test_the_mesh_of_a_frame_is_judged_by_one_that_is_twice_as_fine():
    """Frequencies of a free bar: Euler and Bernoulli, βL = 4.7300407."""
    body, findings = reduced(bar(elements=3, reduction="modes: 4, method: normal-modes"))
    too_high = findings.full[0] / (4.7300407**2 * SPEED / (2.0 * np.pi)) - 1.0
    assert body.mesh_error.dynamic
    assert 0.5 < 0.5 * body.mesh_error.share[0] / too_high < 2.0
    assert "The mesh makes" in findings.statements[-1]


def test_a_mesh_whose_strain_is_even_has_no_error():
    """A linear field of displacements has the same strain everywhere, whatever the elements."""
    needs("gmsh", "skfem", "meshio")
    from nivel.flexible.model.model_file import parse_model
    from nivel.flexible.reduce import source_model

    model, _ = source_model(parse_model(block(size=0.1)), lambda _text, _share: None)
    x = model.position
    stretched, bent = np.zeros((2, *x.shape))
    stretched[:, 0], bent[:, 0], bent[:, 2] = x[:, 0], x[:, 0] ** 2 * x[:, 2], -(x[:, 0] ** 3)
    fields = np.zeros((model.count, 2))
    fields[model.freedoms[:, :3]] = np.stack([stretched, bent], axis=-1)
    even, uneven = model.elements.energy_error(fields)
    assert even < 1e-20
    assert uneven > 1e-6


@pytest.mark.full
@pytest.mark.parametrize("size", [0.2, 0.05])
def test_the_mesh_of_a_solid_is_judged_by_how_uneven_its_strain_is(size):
    """Against a mesh of elements of a quarter of the height."""
    needs("gmsh", "skfem", "meshio")
    fine = reduced(block(size=0.025, reduction="modes: 3, method: normal-modes"))[1].full[0]
    body, findings = reduced(block(size=size, reduction="modes: 3, method: normal-modes"))
    assert 0.4 < 0.5 * body.mesh_error.share[0] / (findings.full[0] / fine - 1.0) < 2.5


def statics(folder, name, kept, **asked):
    """Equilibrium and vibrations of the bar held at its root; lines that are not green by what they begin with, and frequencies [Hz]."""
    flexible = {"file": str(folder / f"{name}.nc"), **({"modes": kept} if kept else {})}
    machine = {
        "name": name,
        "gravity": [0, 0, 0],
        "bodies": {"bar": {"flexible": flexible}},
        "joints": {"wall": {"type": "fixed", "bodies": ["ground", "bar"], "interface": "root"}},
        "markers": {"tip": {"body": "bar", "interface": "tip"}},
        "forces": {"push": {"type": "force", "marker": "tip", "vector": [0, LOAD, 0]}},
    }
    result = simulating.machine(machine).statics(duration=0, **asked)
    return result, [each for each in result.trust.items if each.name == "modes"]


@pytest.mark.parametrize(("modes", "verdict"), [(None, None), (4, "red"), (8, "red")])
def test_an_equilibrium_of_a_body_with_too_few_modes_is_red(folder, modes, verdict):
    """The energy that is missing is the deflection that is, of F L³/(3 EI)."""
    result, items = statics(folder, "fixed", modes)
    assert [each.verdict for each in items] == ([verdict] if verdict else [])
    body = read_body(folder / "fixed.nc")
    body = body.keeping(np.sort(np.argsort(body.eigenvalues)[:modes])) if modes else body
    tip = body.interface("tip")
    place = tip.position + result.array("modal_coordinate") @ tip.phi.T
    y = (result.array("position")[:, 0] + rotated(result.array("orientation")[:, 0], place))[0, 1]
    lacks = LOAD * LENGTH**3 / (3.0 * EI) / y - 1.0
    if items:
        assert items[0].fraction == pytest.approx(lacks, rel=1e-3)
    else:
        assert abs(lacks) < 1e-3


@pytest.mark.parametrize(
    ("name", "modes", "count"), [("fixed", None, 5), ("fixed", 8, 2), ("few", None, 4), ("few", None, 2)]
)
def test_vibrations_beyond_the_modes_of_a_body_are_told(folder, name, modes, count):
    """Frequencies of a cantilever bent along y, and along z, where it is one and a half times as stiff."""
    result, items = statics(folder, name, modes, modes=count)
    roots = np.array([1.8751041, 4.6940911, 7.8547574])
    exact = np.sort(np.concatenate([roots**2, 1.5 * roots**2]))[:count] * SPEED / (2.0 * np.pi)
    off = np.abs(result.array("natural_frequency")[0] / exact - 1.0).max()
    told = [each for each in items if "vibration" in each.text]
    assert bool(told) == (off > 2e-2)
    if told:
        assert told[0].verdict == "red"
        assert off < 10.0 * told[0].fraction


@pytest.mark.parametrize(
    ("root", "name", "told"), [(17.27876, "few", True), (1.8751041, "few", False), (7.8547574, "fixed", False)]
)
def test_a_load_that_vibrates_faster_than_the_modes_is_told_whatever_frames_show(folder, root, name, told):
    """Frames of 20 ms show nothing of 355 Hz, of which a body whose modes end at 40 Hz has no resonance."""
    force = f"{20 * LOAD}*sin({root**2 * SPEED!r}*time)"
    flexible = {"file": str(folder / f"{name}.nc"), "damping_ratio": 0.05}
    machine = {
        "name": name,
        "gravity": [0, 0, 0],
        "bodies": {"bar": {"flexible": flexible}},
        "joints": {"wall": {"type": "fixed", "bodies": ["ground", "bar"], "interface": "root"}},
        "markers": {"tip": {"body": "bar", "interface": "tip"}},
        "forces": {"push": {"type": "force", "marker": "tip", "vector": [0, force, 0]}},
        "simulation": {"duration": 0.2, "step": 5e-4, "integrator": "generalised-alpha", "output_interval": 0.02},
    }
    lines = [each for each in simulating.simulate(machine).trust.items if "push.vector.y vibrates" in each.text]
    assert bool(lines) == told
    assert all(each.verdict != "green" for each in lines)
