"""Rows that CalculiX makes itself: rotations of rigid groups, incompatible modes, beams; with CalculiX where it is installed."""

import shutil
import subprocess

import numpy as np
import pytest
import scipy.sparse as sp

from nivel.errors import ModelError
from nivel.flexible.foreign.matrix import FormatError
from nivel.flexible.foreign.read_mesh import read_mesh
from nivel.flexible.foreign.stress import internal_nodes, refuse_expanded, rigid_rows
from nivel.flexible.model.model import MatrixMass, from_matrix
from nivel.flexible.reduce import reduce

CELLS, SIZE = (6, 2, 2), (120.0, 20.0, 10.0)


def deck(ends=(), kind="C3D8I", extra=()):
    """A block of hexahedra, whose nodes at x = 0 are the set ROOT. extra : nodes at the middle of this face."""
    numbers = np.arange(1, np.prod(np.add(CELLS, 1)) + 1).reshape(np.add(CELLS, 1))
    lines = ["*NODE"]
    for (i, j, k), number in np.ndenumerate(numbers):
        lines.append(f"{number}, " + ", ".join(str(s * c / n) for s, c, n in zip(SIZE, (i, j, k), CELLS, strict=True)))
    lines += [f"{number}, 0., 10., 5." for number in extra]
    lines.append(f"*ELEMENT, TYPE={kind}, ELSET=E")
    corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
    for e, (i, j, k) in enumerate(np.ndindex(CELLS), start=1):
        lines.append(f"{e}, " + ", ".join(str(numbers[i + a, j + b, k + c]) for a, b, c in corners))
    lines += ["*NSET, NSET=ROOT", ", ".join(map(str, numbers[0].ravel())), *ends]
    lines += [
        "*MATERIAL, NAME=S",
        "*ELASTIC",
        "210000., 0.3",
        "*DENSITY",
        "7.85e-9",
        "*SOLID SECTION, ELSET=E, MATERIAL=S",
    ]
    return "\n".join([*lines, "*STEP", "*FREQUENCY, SOLVER=MATRIXSTORAGE", "*END STEP", ""])


def mesh(folder, **given):
    path = folder / "deck.inp"
    path.write_text(deck(**given), encoding="utf-8")
    return read_mesh(path)


RIGID = ["*RIGID BODY, NSET=ROOT, REF NODE=64, ROT NODE=65"]
FREE = ["*RIGID BODY, NSET=ROOT, REF NODE=64"]
COUPLED = ["*SURFACE, NAME=FACE", "1, S6", "2, S6", "3, S6", "4, S6"]
COUPLED += ["*COUPLING, CONSTRAINT NAME=C, REF NODE=64, SURFACE=FACE", "*KINEMATIC", "1, 3"]


@pytest.mark.parametrize(("ends", "extra"), [(RIGID, (64, 65)), (FREE, (64,)), (COUPLED, (64,))])
def test_rotations_of_a_group_are_directions_of_its_reference_node(tmp_path, ends, extra):
    labels = [(1, 1), (64, 1), (64, 2), (64, 3), (65, 1), (65, 2), (65, 3)]
    assert rigid_rows(labels, mesh(tmp_path, ends=ends, extra=extra))[1:] == tuple((64, k) for k in range(1, 7))


def test_a_group_of_a_node_that_does_not_exist_is_refused_with_its_line(tmp_path):
    with pytest.raises(FormatError, match=r"line \d+: \*RIGID BODY: there is no node 70"):
        rigid_rows([(1, 1)], mesh(tmp_path, ends=["*RIGID BODY, NSET=ROOT, REF NODE=70"]))
    with pytest.raises(FormatError, match=r"line \d+: \*RIGID BODY needs `REF NODE=`"):
        mesh(tmp_path, ends=["*RIGID BODY, NSET=ROOT"])


def test_incompatible_modes_are_rows_without_a_node_and_with_their_mass(tmp_path):
    """Of elements of this kind alone, beyond the last node."""
    labels = [(1, 1), (63, 2), (64, 1), (70, 3)]
    assert internal_nodes(labels, mesh(tmp_path)) == {64, 70}
    assert internal_nodes(labels, mesh(tmp_path, kind="C3D8")) == set()
    M = sp.csc_array(np.diag([2.0, 2.0, 2.0, 0.5]))  # of a node, and of a row without one
    mass = from_matrix(np.zeros((1, 3)), np.array([[0, 1, 2, -1, -1, -1]]), M)
    assert isinstance(mass, MatrixMass)
    np.testing.assert_array_equal(mass.full.toarray(), M.toarray())


@pytest.mark.parametrize("kind", ["M3D4", "B32R", "CPS8"])
def test_beams_and_plane_elements_of_calculix_are_refused_with_their_line(tmp_path, kind):
    with pytest.raises(FormatError, match=rf"line 65: {kind}: CalculiX computes with a solid in place"):
        refuse_expanded(mesh(tmp_path, kind=kind))


def test_decks_run_by_calculix_have_the_same_body(tmp_path):
    """Its rigid groups, and the same nodes tied here; with enough modes the frequencies of CalculiX itself."""
    if shutil.which("ccx") is None:
        pytest.skip("CalculiX, the program ccx, is not installed")
    found = {}
    for name, ends, extra, interface in (
        ("plain", (), (), "set: ROOT"),
        ("rigid", RIGID, (64, 65), "node: 64"),
        ("free", FREE, (64,), "node: 64"),
        ("coupled", COUPLED, (64,), "node: 64"),
    ):
        (tmp_path / f"{name}.inp").write_text(deck(ends=ends, extra=extra), encoding="utf-8")
        subprocess.run(["ccx", name], cwd=tmp_path, check=True, capture_output=True)
        files = f"stiffness: {name}.sti, mass: {name}.mas, freedoms: {name}.dof, nodes: {name}.inp"
        (tmp_path / f"{name}.yaml").write_text(
            f"format: 1\nname: {name}\nmatrices: {{format: calculix, {files}, units: {{length: mm, mass: t}}}}\n"
            f"interfaces: {{root: {{{interface}}}}}\nreduction: {{modes: 30}}\n",
            encoding="utf-8",
        )
        found[name] = reduce(tmp_path / f"{name}.yaml").body.frequencies[:4]
    for name in ("rigid", "free", "coupled"):
        np.testing.assert_allclose(found[name], found["plain"], rtol=1e-6)
    text = deck(ends=RIGID, extra=(64, 65)).replace("*FREQUENCY, SOLVER=MATRIXSTORAGE", "*FREQUENCY\n10")
    (tmp_path / "own.inp").write_text(text, encoding="utf-8")
    subprocess.run(["ccx", "own"], cwd=tmp_path, check=True, capture_output=True)
    rows = [line.split() for line in (tmp_path / "own.dat").read_text().splitlines()]
    own = [float(row[3]) for row in rows if len(row) == 5 and row[0].isdecimal()]
    np.testing.assert_allclose(found["rigid"], own[6:10], rtol=2e-3)
    (tmp_path / "membrane.inp").write_text(deck(kind="M3D8", ends=RIGID, extra=(64, 65)), encoding="utf-8")
    (tmp_path / "rigid.yaml").write_text(
        (tmp_path / "rigid.yaml").read_text().replace("nodes: rigid.inp", "nodes: membrane.inp"), encoding="utf-8"
    )
    with pytest.raises(ModelError, match=r"membrane.inp:67:1: matrices.nodes: M3D8: CalculiX computes with a solid"):
        reduce(tmp_path / "rigid.yaml")
