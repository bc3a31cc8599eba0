"""Machines with flexible bodies in examples/flexible: each runs, is green, and does what theory says."""

import runpy
import shutil
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import eigh
from scipy.optimize import minimize_scalar

import nivel
from lanes import tail
from models import bar, reduced
from needing import needs
from nivel.flexible.body.body_file import write_body
from nivel.flexible.reduce import reduce
from simulating import simulate

EXAMPLES = Path(__file__).parent.parent / "examples" / "flexible"
E, RHO = 210e9, 7850.0
# model of the body, and what a quick test changes in it
MACHINES = {
    "pendulum": ("pendulum-bar", {}),
    "spinning-blade": ("blade", {}),
    "slider-crank": ("connecting-rod", {}),
    "lever-spring": ("lever", {}),
    "crane": ("crane-boom", {"solid.element_size": "0.2", "reduction.modes": 10}),
    "swing": ("lug", {"solid.element_size": "0.2"}),
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("examples") / "flexible"
    shutil.copytree(EXAMPLES, folder, ignore=shutil.ignore_patterns("*.nc", "*.html"))
    return folder


def machine(folder, name, **overrides):
    """The machine of an example; its body is reduced where it was not yet."""
    model, changes = MACHINES[name]
    if model in ("crane-boom", "lug"):
        needs("gmsh", "meshio", "skfem")
    if not (folder / f"{model}.nc").exists():
        write_body(reduce(folder / f"{model}.yaml", overrides=changes).body, folder / f"{model}.nc")
    return nivel.load(folder / f"{name}.yaml", overrides=overrides)


def test_every_machine_is_here():
    found = {path.stem for path in EXAMPLES.glob("*.yaml") if "\nbodies:" in path.read_text(encoding="utf-8")}
    assert found == set(MACHINES)


@pytest.mark.parametrize("name", tail(MACHINES, ["pendulum", "spinning-blade", "lever-spring"]))
def test_example_runs_green(folder, name):
    result = machine(folder, name).simulate(out=folder / f"{name}-run.nc", force=True)
    assert result.outcome == "done"
    # the quick test's solids have elements of several times the length, and the run says so
    told = {item.name for item in result.trust.items if item.verdict != "green"}
    assert told == ({"mesh"} if name in ("crane", "swing") else set()), result
    if name == "lever-spring":  # matrices alone know no elements, so no stress
        with pytest.raises(nivel.ModelError, match="knows no stress"):
            result.recover().hot_spots()
        return
    # stressed, but steel would carry it
    assert 1e5 < result.recover().hot_spots(1)[0].value < 3e8


def crossings(time, values):
    """(k,) moments at which a history rises through zero."""
    k = np.flatnonzero((values[:-1] < 0.0) & (values[1:] >= 0.0))
    return time[k] - values[k] * (time[k + 1] - time[k]) / (values[k + 1] - values[k])


def ritz(speed, span=1.0, width=0.04, height=0.005, terms=8):
    """Lowest frequency [Hz] of flapping of a blade that turns with `speed` [rad/s]: w = Σ a_k x^k, k from 2, with the energies
    ½ ∫ E I w''² + ½ ∫ ½ ρ A Ω² (L² - x²) w'² and ½ ∫ ρ A ẇ². At Ω = 4 √(E I/(ρ A))/L² it is 5.585 times that unit, as in the tables of
    Wright, Smith, Thresher and Wang (1982)."""
    EI, rA = E * width * height**3 / 12, RHO * width * height
    K, M = np.zeros((terms, terms)), np.zeros((terms, terms))
    for i, j in product(range(terms), range(terms)):
        a, b = i + 2, j + 2
        tension = rA * speed**2 / 2 * a * b * (1 / (a + b - 1) - 1 / (a + b + 1))
        K[i, j] = EI * a * (a - 1) * b * (b - 1) / (a + b - 3) + tension
        M[i, j] = rA / (a + b + 1)
    assert span == 1.0
    return float(np.sqrt(eigh(K, M, eigvals_only=True)[0])) / (2 * np.pi)


@pytest.mark.parametrize("speed", [5.0, 29.86])
def test_spinning_stiffens_a_blade(folder, speed):
    unit = np.sqrt(E * 0.005**2 / 12 / RHO)
    assert 2 * np.pi * ritz(4 * unit) / unit == pytest.approx(5.585, abs=5e-4)
    result = machine(folder, "spinning-blade", **{"parameters.speed": f"{speed} rad/s"}).simulate()
    late = result.time > 0.2
    found = crossings(result.time[late], result.array("sensor.tip.z")[late])
    assert (len(found) - 1) / (found[-1] - found[0]) == pytest.approx(ritz(speed), rel=5e-3)


def test_rod_bends_by_its_own_inertia(folder):
    """Far below its lowest frequency the middle of a pinned rod is off its chord by 5 ρ A a L⁴/(384 E I): a is the acceleration of its
    middle across it; the part of the load that is odd about the middle bends the middle by nothing. Damped, in the third turn."""
    result = machine(folder, "slider-crank", **{"bodies.rod.flexible.damping_ratio": 0.3}).simulate()
    rod = result.recover("rod")
    u = rod.displacement("middle") - 0.5 * (rod.displacement("big_end") + rod.displacement("small_end"))
    crank, length, w = 0.15, 0.5, 10 * np.pi
    angle = np.pi / 2 + w * result.time
    sine, slope = crank * np.sin(angle) / length, crank * np.cos(angle) / length
    rest = np.sqrt(1 - sine**2)
    # x of the slider is r cos + L √(1 - (r sin/L)²), differentiated twice
    second = -(slope**2 - sine**2) / rest - (sine * slope) ** 2 / rest**3
    pin = -crank * w**2 * np.column_stack([np.cos(angle), np.sin(angle)])
    slider = np.column_stack([w**2 * (-crank * np.cos(angle) + length * second), np.zeros_like(angle)])
    across = np.einsum("ti,ti->t", 0.5 * (pin + slider), np.column_stack([sine, rest]))
    expected = -5 * RHO * 1e-4 * across * length**4 / (384 * E * 1e-8 / 12)
    late = result.time > 0.4
    assert np.abs(u[late, 1] - expected[late]).max() < 0.03 * np.abs(expected).max()
    # M = q L²/8 at the middle, W = b³/6, and a little of tension
    q = RHO * 1e-4 * np.abs(across[late]).max()
    stress = np.abs(rod.signed_principal("middle")[late]).max()
    assert stress == pytest.approx(q * length**2 / 8 / (1e-6 / 6), rel=0.1)


def test_files_of_the_lever_are_those_of_its_script(folder, tmp_path):
    write = runpy.run_path(str(EXAMPLES / "write_lever.py"))["write"]
    write(tmp_path)
    for path in (folder / "lever").iterdir():
        mine, new = (
            [line.replace(",", " ").split() for line in each.read_text().splitlines()]
            for each in (path, tmp_path / path.name)
        )
        assert len(mine) == len(new)
        if path.suffix in (".sti", ".mas"):
            np.testing.assert_allclose(np.array(mine, float), np.array(new, float), rtol=1e-9, atol=1e-12)
        else:
            assert mine == new


def lever_frequency(stiffness, arms=(0.4, 0.2), width=0.015, height=0.01, terms=4):
    """[rad/s] of two arms that turn together by θ at their corner, the second held at its end by a spring: each is off its tangent by
    Σ a_k x^k, k from 2."""
    EI, rA, count = E * height * width**3 / 12, RHO * width * height, 1 + 2 * terms
    K, M, end = np.zeros((count, count)), np.zeros((count, count)), np.zeros(count)
    for arm, length in enumerate(arms):
        of = {1: 0} | {k + 2: 1 + arm * terms + k for k in range(terms)}
        for (a, i), (b, j) in product(of.items(), of.items()):
            M[i, j] += rA * length ** (a + b + 1) / (a + b + 1)
            if min(a, b) > 1:
                K[i, j] += EI * a * (a - 1) * b * (b - 1) * length ** (a + b - 3) / (a + b - 3)
        end[:] = 0.0
        end[list(of.values())] = length ** np.array(list(of))
    return float(np.sqrt(eigh(K + stiffness * np.outer(end, end), M, eigvals_only=True)[0]))


def test_lever_swings_on_its_spring(folder):
    """Its free and its forced swinging, fitted to the run; the free one is a little slower than that of a rigid lever."""
    result = machine(folder, "lever-spring").simulate()
    y, t = result.array("sensor.end.y"), result.time
    expected = lever_frequency(6000.0)
    J = RHO * 1.5e-4 * (0.4**3 + 0.2**3) / 3
    assert 0.95 < expected / np.sqrt(6000.0 * 0.2**2 / J) < 0.99

    def left(speed):
        columns = np.column_stack([f(each * t) for each in (20.0, speed) for f in (np.sin, np.cos)])
        return np.linalg.norm(y - columns @ np.linalg.lstsq(columns, y, rcond=None)[0])

    found = minimize_scalar(left, bounds=(85, 95), method="bounded").x
    assert left(found) < 0.02 * np.linalg.norm(y)
    assert found == pytest.approx(expected, rel=2e-3)


def test_boom_at_rest_has_the_stress_of_its_section(folder):
    """M/W of what hangs to the right of a node on the upper wall, well away from the pins; the cylinder does not move."""
    overrides = {"bodies.boom.flexible.damping_ratio": 0.5, "parameters.stroke": "1e-6 m"}
    result = machine(folder, "crane", **overrides).simulate(duration=4)
    boom = result.recover()
    x, y, z = boom.body.position.T
    area, second = 0.16 * 0.26 - 0.14 * 0.24, (0.16 * 0.26**3 - 0.14 * 0.24**3) / 12
    upper = np.flatnonzero((z > 0.13 - 1e-6) & (np.abs(y) < 0.075) & (np.abs(x - 2.7) < 0.3))
    assert len(upper) > 3
    for node in upper:
        reach = 4.0 - x[node]
        moment = 9.81 * (400 * (3.88 - x[node]) + RHO * area * reach**2 / 2)
        number = int(boom.body.node_ids[node])
        late = boom.stress(number)[result.time > 3.5, 0, 0].mean()
        assert late == pytest.approx(moment * 0.13 / second, rel=0.08)


def test_the_lug_carries_what_hangs_on_it(folder):
    """Before it is pulled, the wall carries the weight of both. The lug is a plate, a strap and an eye with a bore."""
    result = machine(folder, "swing").simulate(duration=0.01, verify=False)
    reach = np.sqrt(16**2 - 4**2)  # of the corners of the strap from the middle of the eye
    common = 8 * reach + 16**2 * np.arccos(reach / 16) - 4 * reach
    seen = 250 * 8 + np.pi * 16**2 - common - np.pi * 10**2  # strap and eye, along the bore
    lug = 7850e-9 * (10 * 60 * 60 + 50 * seen)
    force = np.linalg.norm(result.array("joint_force")[0].reshape(-1, 3), axis=1)
    assert force == pytest.approx([9.81 * (20 + lug), 9.81 * 20], rel=5e-4)


def swinging(time, values, near):
    """[rad/s] of a history that is a constant and a sine."""

    def left(speed):
        columns = np.column_stack([np.ones_like(time), np.sin(speed * time), np.cos(speed * time)])
        return np.linalg.norm(values - columns @ np.linalg.lstsq(columns, values, rcond=None)[0])

    bounds = (0.85 * near, 1.1 * near)
    return minimize_scalar(left, bounds=bounds, method="bounded", options={"xatol": 1e-9}).x


def test_segments_on_springs_swing_as_modes_and_beams_do():
    """The frequency of a cantilever: segments are below it by what falls as the square of their length."""
    cantilever = runpy.run_path(str(EXAMPLES / "segments.py"))["cantilever"]
    near = 3.516 * np.sqrt(E * 0.03**2 / 12 / RHO) / 2.0**2
    found = []
    for count in (3, 6, 12):
        result = nivel.Machine.from_record(cantilever(count)).simulate()
        assert result.trust.verdict == "green"
        found.append(swinging(result.time, result.array("sensor.tip.z"), near))
    modes = 2 * np.pi * reduced(bar(reduction="modes: 6, reference: root", theory="timoshenko"))[0].frequencies
    # bending along z is the stiffer of the two first modes
    mode = modes[np.argmin(np.abs(modes - near))]
    settings = {"duration": 1.0, "step": 5e-4, "output_interval": 5e-3, "integrator": "generalised-alpha"}
    line = {"from": [0, 0, 0], "to": [2, 0, 0], "elements": 8, "order": 2}
    exact = simulate(
        {
            "name": "exact",
            "gravity": [0, 0, -0.1],
            "beams": {
                "bar": {
                    **line,
                    "section": {"type": "rectangle", "width": 0.02, "height": 0.03},
                    "material": {"youngs_modulus": E, "poisson_ratio": 0.3, "density": RHO},
                }
            },
            "joints": {"wall": {"type": "fixed", "bodies": ["ground", "bar.start"], "point": [0, 0, 0]}},
            "simulation": {**settings, "coordinates": "absolute"},
        }
    )
    beam = swinging(exact.time, exact.array("bar.end.position")[:, 2], near)
    assert beam == pytest.approx(mode, rel=5e-4)
    errors = 1.0 - np.array(found) / beam
    assert np.all(errors > 0.0)
    assert np.all(np.abs(np.log2(errors[:-1] / errors[1:]) - 2.0) < 0.15)
    assert (4 * found[2] - found[1]) / 3 == pytest.approx(mode, rel=1e-3)
