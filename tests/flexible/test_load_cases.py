"""Load cases of a flexible body of a run: their balance, their cards, and the stress that CalculiX has with them."""

import shutil
import subprocess
from itertools import pairwise

import numpy as np
import pytest

import nivel
from nivel.errors import ModelError
from nivel.flexible.body.body_file import write_body
from nivel.flexible.reduce import reduce

FINE = 6  # elements along the bar


def bar():
    """A deck of a bar of 120 mm along x with a square section of 20 mm, elements C3D20R, [mm, t]."""
    grid = [(i, j, k) for i in range(2 * FINE + 1) for j in range(3) for k in range(3)]
    grid = [each for each in grid if sum(n % 2 for n in each) <= 1]
    number = {each: n for n, each in enumerate(grid, 1)}
    lines = ["*NODE, NSET=ALL", *(f"{n}, {10 * i}, {10 * j - 10}, {10 * k - 10}" for (i, j, k), n in number.items())]
    corners = ((0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2))
    edges = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))
    places = [*corners, *(tuple((a + b) // 2 for a, b in zip(corners[p], corners[q], strict=True)) for p, q in edges)]
    lines.append("*ELEMENT, TYPE=C3D20R, ELSET=BAR")
    for e in range(FINE):
        own = [str(number[i + 2 * e, j, k]) for i, j, k in places]
        lines += [", ".join([str(e + 1), *own[:10]]) + ",", ", ".join(own[10:])]
    ends = {name: [n for (i, *_), n in number.items() if i == at] for name, at in (("ROOT", 0), ("TIP", 2 * FINE))}
    lines += [f"*NSET, NSET={name}\n" + ",\n".join(map(str, each)) for name, each in ends.items()]
    lines += ["*MATERIAL, NAME=STEEL", "*ELASTIC", "210000., .3", "*DENSITY", "7.85e-9"]
    return "\n".join([*lines, "*SOLID SECTION, ELSET=BAR, MATERIAL=STEEL", ""])


MACHINE = """
format: 1
name: swing
gravity: [0, 0, -9.81]
bodies: {bar: {flexible: bar.nc}}
markers: {end: {body: bar, interface: tip}}
joints: {hinge: {type: revolute, bodies: [ground, bar], interface: root, axis: [0, 1, 0]}}
forces: {pull: {type: force, marker: end, vector: [0, 40, 300*sin(400*time)]}}
simulation: {duration: 10 ms, output_interval: 0.5 ms}
"""


@pytest.fixture(scope="module")
def swung(tmp_path_factory):
    """The run of a bar that swings, and its folder."""
    if shutil.which("ccx") is None:
        pytest.skip("CalculiX, the program ccx, is not installed")
    folder = tmp_path_factory.mktemp("loads")
    (folder / "model.inp").write_text(bar() + "*STEP\n*FREQUENCY, SOLVER=MATRIXSTORAGE\n*END STEP\n", encoding="utf-8")
    subprocess.run(["ccx", "model"], cwd=folder, check=True, capture_output=True)
    files = "stiffness: model.sti, mass: model.mas, freedoms: model.dof, nodes: model.inp"
    text = f"""format: 1
name: bar
matrices: {{format: calculix, {files}, units: {{length: mm, mass: t}}}}
interfaces: {{root: {{set: ROOT}}, tip: {{set: TIP}}}}
reduction: {{modes: 6}}
recovery: {{loads: true}}
"""
    (folder / "bar.yaml").write_text(text, encoding="utf-8")
    write_body(reduce(folder / "bar.yaml").body, folder / "bar.nc")
    (folder / "swing.yaml").write_text(MACHINE, encoding="utf-8")
    return nivel.load(folder / "swing.yaml").simulate(verify=False, out=folder / "swing.nc"), folder


def test_loads_balance_each_other_and_are_those_of_inertia_and_interfaces(swung):
    """Their work along the modes is Φᵀ K Φ q = diag(λ) q, of interfaces and inertia by the equations of motion."""
    body = swung[0].recover()
    loads = body.load_case(body.worst_time)
    force, place = loads[:, :3], body.body.position
    moment = np.cross(place, force).sum(axis=0)
    size = np.abs(force).sum()
    assert np.abs(force.sum(axis=0)).max() <= 1e-14 * size
    assert np.abs(moment).max() <= 1e-14 * size * np.ptp(place)
    q = body.q[body.frame(body.worst_time)]
    work = np.einsum("nak,na->k", np.nan_to_num(body.body.modes), loads)
    np.testing.assert_allclose(work, body.body.eigenvalues * q, atol=1e-9 * np.abs(body.body.eigenvalues * q).max())


def test_calculix_has_the_stress_of_the_run_with_them(swung):
    result, folder = swung
    body = result.recover()
    body.write_load_cases(folder / "case.inp", [body.worst_time])
    (folder / "check.inp").write_text(bar() + "*INCLUDE, INPUT=case.inp\n", encoding="utf-8")
    subprocess.run(["ccx", "check"], cwd=folder, check=True, capture_output=True)
    found, reading = {}, False
    for line in (folder / "check.frd").read_text(encoding="ascii").splitlines():
        reading = line[5:11].strip() == "STRESS" if line.startswith(" -4") else reading and not line.startswith(" -3")
        if reading and line.startswith(" -1"):
            found[int(line[3:13])] = [1e6 * float(line[13 + 12 * k : 25 + 12 * k]) for k in range(6)]
    own = body.stress()[body.frame(body.worst_time)]
    nodes = body.body.node_ids[body.body.stress.station_node]
    other = np.array([found[int(node)] for node in nodes])
    assert np.abs(own - other).max() <= 0.01 * np.abs(other).max()


def test_cards_of_nastran_have_the_same_loads(swung, tmp_path):
    body = swung[0].recover()
    time = body.worst_time
    lines = body.write_load_cases(tmp_path / "case.bdf", [0.0, time]).read_text(encoding="ascii").splitlines()
    loads = np.zeros((len(body.body.node_ids), 3))
    for first, second in pairwise(lines):
        if first.startswith("FORCE*") and int(first[8:24]) == 2:
            k = int(np.flatnonzero(body.body.node_ids == int(first[24:40]))[0])
            loads[k] = [float(second[8 + 16 * n : 24 + 16 * n]) for n in range(3)]
    wanted = body.load_case(time)[:, :3]
    np.testing.assert_allclose(loads, wanted, atol=1e-9 * np.abs(wanted).max())
    assert sum(line.startswith("SPC1") for line in lines) == 6


def test_a_body_without_loads_says_what_to_do(swung, tmp_path):
    result, folder = swung
    (folder / "plain.yaml").write_text((folder / "bar.yaml").read_text().replace("loads: true", "loads: false"))
    plain = reduce(folder / "plain.yaml").body
    write_body(plain, tmp_path / "plain.nc")
    with pytest.raises(ModelError, match=r"recovery: \{loads: true\}"):
        result.recover("bar", file=tmp_path / "plain.nc").load_case(0.0)
    with pytest.raises(ModelError, match=r"\.inp"):
        result.recover("bar").write_load_cases(tmp_path / "case.txt")
