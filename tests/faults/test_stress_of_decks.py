"""Decks whose stress was wrong and green: engineering constants taken for E and ν, and a modulus by temperature taken at the first one."""

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

from nivel.flexible.foreign.read_mesh import read_mesh
from nivel.flexible.foreign.stress import blocks_of, elastic_blocks
from nivel.flexible.model.model_file import parse_model
from nivel.flexible.model.solid_elements import SolidElements
from nivel.flexible.reduce import reduce_model

HERE = Path(__file__).parent


@pytest.mark.parametrize(
    ("name", "modulus", "poisson"),
    [("engineering-constants", 135000.0, (0.3, 0.3)), ("modulus-of-temperature", 180000.0, (0.3, 0.3))],
)
def test_a_bar_that_is_pulled_has_the_stress_of_its_material(name, modulus, poisson):
    """σ = E ε along the bar and none across, where it becomes thinner by ν ε."""
    mesh = read_mesh(HERE / f"{name}.inp")
    place = {int(number): k for k, number in enumerate(mesh.numbers)}
    blocks = elastic_blocks(mesh, blocks_of(mesh, place, mesh.places), place, 1.0, 1.0)
    elements = SolidElements(blocks, np.arange(3 * len(place)).reshape(-1, 3), mesh.places)
    moved = (mesh.places * 1e-3 * np.array([1.0, -poisson[0], -poisson[1]])).ravel()[:, None]
    wanted = np.tile([1e-3 * modulus, 0, 0, 0, 0, 0], (len(place), 1))
    np.testing.assert_allclose(elements.stress(moved)[:, :, 0], wanted, atol=1e-9 * modulus)


def of_frd(path, word, columns):
    """By mode: {node: values} of the blocks `word` of a result file of CalculiX."""
    out, rows = [], None
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith(" -4"):
            rows = {} if line.split()[1] == word else None
            if rows is not None:
                out.append(rows)
        elif line.startswith(" -1") and rows is not None:
            rows[int(line[3:13])] = [float(line[13 + 12 * k : 25 + 12 * k]) for k in range(columns)]
    return out


def von_mises(s):
    xx, yy, zz, xy, yz, zx = np.moveaxis(s, 1, 0)
    return np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3.0 * (xy**2 + yz**2 + zx**2))


@pytest.mark.parametrize("name", ["engineering-constants", "modulus-of-temperature"])
def test_modal_stress_is_that_of_calculix(tmp_path, name):
    """Of the first four modes, at all nodes, from the matrices that CalculiX wrote, and in its own result file."""
    if shutil.which("ccx") is None:
        pytest.skip("CalculiX, the program ccx, is not installed")
    text = (HERE / f"{name}.inp").read_text(encoding="utf-8")
    (tmp_path / "bar.inp").write_text(text, encoding="utf-8")
    own = text.replace("*FREQUENCY, SOLVER=MATRIXSTORAGE\n10", "*FREQUENCY\n12\n*NODE FILE\nU\n*EL FILE\nS")
    (tmp_path / "own.inp").write_text(own, encoding="utf-8")
    for deck in ("bar", "own"):
        subprocess.run(["ccx", deck], cwd=tmp_path, check=True, capture_output=True)
    files = "stiffness: bar.sti, mass: bar.mas, freedoms: bar.dof, nodes: bar.inp, units: {length: mm, mass: t}"
    model = f"format: 1\nmatrices: {{format: calculix, {files}}}\nreduction: {{method: normal-modes, modes: 6}}\n"
    body = reduce_model(parse_model(model, f"{tmp_path}/model.yaml")).body
    assert body.stress is not None
    moved, stress = of_frd(tmp_path / "own.frd", "DISP", 3), of_frd(tmp_path / "own.frd", "STRESS", 6)
    for k in range(4):
        theirs = np.array([moved[k + 6][node] for node in body.node_ids.tolist()])
        mine = body.modes[:, :3, k]
        scale = np.vdot(mine, theirs) / np.vdot(
            mine, mine
        )  # mm in place of m: stress in N/mm² is 1e-3 N/m² of it, 1e6 to Pa
        wanted = von_mises(np.array([stress[k + 6][int(body.node_ids[node])] for node in body.stress.station_node]))
        found = von_mises(body.stress.modes[:, :, k]) * abs(scale) * 1e-9
        np.testing.assert_allclose(found, wanted, atol=1e-3 * wanted.max())
