"""Shells of CalculiX: their solids, plates against plate theory, joined parts against CalculiX itself where it is installed."""

import shutil
import subprocess
from itertools import product

import numpy as np
import pytest
import scipy.sparse as sp

from lanes import tail
from nivel.elements.beams.sections import Material
from nivel.errors import ModelError
from nivel.flexible.foreign.matrix import FormatError
from nivel.flexible.foreign.mesh import SHELLS
from nivel.flexible.foreign.read_mesh import read_mesh
from nivel.flexible.foreign.shells import expansion
from nivel.flexible.foreign.stress import blocks_of
from nivel.flexible.model.solid_elements import elasticity
from nivel.flexible.reduce import reduce

E, DENSITY = 210000.0, 7.85e-9  # N/mm², t/mm³
MIDDLES = {4: ((0, 1), (1, 2), (2, 3), (3, 0)), 3: ((0, 1), (1, 2), (2, 0))}


def flat(x, y):
    return x, y, 0.0


def arc(x, y, radius=30.0):
    return radius * np.sin(x / radius), y, radius * (1.0 - np.cos(x / radius))


def folded(x, y):
    """A right angle at x = 20."""
    return min(x, 20.0), y, max(x - 20.0, 0.0)


def deck(kind, *, cells=(4, 2), size=(40.0, 20.0), place=flat, poisson=0.3, section="1.", options="", more=()):
    """A strip of shells, whose node (x, y) is at `place`. ROOT : the nodes at x = 0, EDGE : those on the whole border."""
    quadratic = SHELLS[kind] > 4
    step = 2 if quadratic else 1
    numbers, elements = {}, []
    for i, j in np.ndindex(cells):
        square = [(step * (i + a), step * (j + b)) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        for part in [range(4)] if SHELLS[kind] % 4 == 0 else [(0, 1, 2), (0, 2, 3)]:
            own = [square[k] for k in part]
            if quadratic:
                own += [tuple(np.add(own[a], own[b]) // 2) for a, b in MIDDLES[len(own)]]
            elements.append([numbers.setdefault(each, len(numbers) + 1) for each in own])
    last = tuple(step * n for n in cells)
    lines = ["*NODE"]
    for at, number in numbers.items():
        x = place(*(length * k / n for length, k, n in zip(size, at, last, strict=True)))
        lines.append(f"{number}, " + ", ".join(repr(float(each)) for each in x))
    lines.append(f"*ELEMENT, TYPE={kind}, ELSET=E")
    lines += [", ".join(map(str, [k, *nodes])) for k, nodes in enumerate(elements, start=1)]
    for name, has in (
        ("ROOT", lambda at: at[0] == 0),
        ("EDGE", lambda at: 0 in at or at[0] == last[0] or at[1] == last[1]),
    ):
        lines += [f"*NSET, NSET={name}", *(f"{number}," for at, number in numbers.items() if has(at))]
    lines += ["*MATERIAL, NAME=S", "*ELASTIC", f"{E}, {poisson}", "*DENSITY", f"{DENSITY}"]
    lines += [f"*SHELL SECTION, ELSET=E, MATERIAL=S{options}", section, *more]
    return "\n".join([*lines, "*STEP", "*FREQUENCY, SOLVER=MATRIXSTORAGE", "*END STEP", ""])


def mesh_of(folder, text):
    path = folder / "deck.inp"
    path.write_text(text, encoding="utf-8")
    return read_mesh(path)


def model_file(folder, *, interfaces, reduction):
    files = "stiffness: deck.sti, mass: deck.mas, freedoms: deck.dof, nodes: deck.inp"
    path = folder / "deck.yaml"
    path.write_text(
        f"format: 1\nname: deck\nmatrices: {{format: calculix, {files}, units: {{length: mm, mass: t}}}}\n"
        f"interfaces: {{{interfaces}}}\nreduction: {{{reduction}}}\n",
        encoding="utf-8",
    )
    return path


def reduced(folder, interfaces, reduction):
    return reduce(model_file(folder, interfaces=interfaces, reduction=reduction)).body


def write_matrices(folder, text, poisson=0.3, digits=16):
    """Matrices of S8R as CalculiX writes them: those of C3D20R, strain at 2 × 2 × 2 points and mass at 3 × 3 × 3, by solids' nodes in
    the order of the nodes of the shells, by whose numbers the rows are named."""
    mesh = mesh_of(folder, text)
    found = expansion(mesh)
    layers = [(node, own) for node, owns in sorted(found.layers.items()) for own in owns]
    place = {own: k for k, (_, own) in enumerate(layers)}
    position = found.mesh.places[np.searchsorted(found.mesh.numbers, [own for _, own in layers])]
    (block,) = blocks_of(found.mesh, place, position).values()
    D = elasticity(Material.model_construct(youngs_modulus=E, poisson_ratio=poisson, density=DENSITY))
    count = block.nodes.shape[1]
    stiffness, mass = (np.zeros((len(block.nodes), 3 * count, 3 * count)) for _ in range(2))
    for gradients, volume in block.points:
        B = np.zeros((len(block.nodes), 6, count, 3))
        for a in range(3):
            B[:, a, :, a] = gradients[:, :, a]
        for row, (a, b) in enumerate(((0, 1), (1, 2), (2, 0)), start=3):
            B[:, row, :, a], B[:, row, :, b] = gradients[:, :, b], gradients[:, :, a]
        B = B.reshape(len(block.nodes), 6, -1)
        stiffness += np.einsum("eim,ij,ejn,e->emn", B, D, B, volume, optimize=True)
    gauss = ((-np.sqrt(0.6), 5 / 9), (0.0, 8 / 9), (np.sqrt(0.6), 5 / 9))
    for points in product(gauss, repeat=3):
        at, weight = np.array([x for x, _ in points]), np.prod([w for _, w in points])
        jacobian = np.einsum("ena,nb->eab", position[block.nodes], block.shape.gradients(at))
        N = np.kron(block.shape.functions(at)[None], np.eye(3))
        mass += DENSITY * np.einsum("e,im,in->emn", weight * np.linalg.det(jacobian), N, N)
    rows = (3 * block.nodes[:, :, None] + np.arange(3)).reshape(len(block.nodes), -1)
    i, j = np.repeat(rows, 3 * count, axis=1).ravel(), np.tile(rows, (1, 3 * count)).ravel()
    for name, each in (("sti", stiffness), ("mas", mass)):
        matrix = sp.coo_array(sp.triu(sp.csc_array((each.ravel(), (i, j)))))
        np.savetxt(
            folder / f"deck.{name}",
            np.column_stack([matrix.row + 1, matrix.col + 1, matrix.data]),
            fmt=f"%d %d %.{digits}e",
        )
    (folder / "deck.dof").write_text("".join(f"{node}.{axis}\n" for node, _ in layers for axis in (1, 2, 3)))


@pytest.fixture(scope="module")
def square(tmp_path_factory):
    """Folder of a square plate of 100 mm and 1 mm thickness."""
    folder = tmp_path_factory.mktemp("square")
    write_matrices(folder, deck("S8R", cells=(10, 10), size=(100.0, 100.0)))
    return folder


def plate_frequencies(values, side=0.1, thickness=1e-3, poisson=0.3):
    """[Hz] of a square plate from ω a² √(ρ h / D)."""
    D = E * 1e6 * thickness**3 / 12.0 / (1.0 - poisson**2)
    return np.array(values) / (2.0 * np.pi * side**2) * np.sqrt(D / (DENSITY * 1e12 * thickness))


@pytest.mark.parametrize("kind", SHELLS)
def test_solids_have_the_volume_and_the_middle_of_the_shells(tmp_path, kind):
    """Area × thickness, none turned inside out; with OFFSET the nodes are that many thicknesses above the middle."""
    found = expansion(mesh_of(tmp_path, deck(kind, section="1.5", options=", OFFSET=0.5"))).mesh
    place = {int(number): k for k, number in enumerate(found.numbers)}
    ((solid, block),) = blocks_of(found, place, found.places).items()
    assert solid == {"S3": "C3D6", "S4": "C3D8I", "S4R": "C3D8R", "S6": "C3D15", "S8": "C3D20", "S8R": "C3D20R"}[kind]
    assert not len(block.inverted())
    assert block.volumes.sum() == pytest.approx(40.0 * 20.0 * 1.5, rel=1e-12)
    heights = np.unique(np.round(found.places[np.unique(block.nodes), 2], 12))
    np.testing.assert_allclose(heights, [-1.5, 0.0] if SHELLS[kind] <= 4 else [-1.5, -0.75, 0.0])


def test_nodes_of_a_curved_shell_are_above_and_below_along_the_radius(tmp_path):
    found = expansion(mesh_of(tmp_path, deck("S8R", place=arc)))
    position = dict(zip(found.mesh.numbers.tolist(), found.mesh.places, strict=True))
    checked = 0
    for node, layers in found.layers.items():
        radii = [np.hypot(position[own][0], position[own][2] - 30.0) for own in layers]
        if (
            len(layers) == 3 and 0.0 < position[node][0] < 30.0 * np.sin(40.0 / 30.0) - 1e-6
        ):  # between elements: by symmetry
            np.testing.assert_allclose(radii, [30.5, 30.0, 29.5], rtol=1e-12)
            checked += 1
    assert checked == 9


def test_knots_have_the_numbers_of_calculix(tmp_path):
    """Written by CalculiX 2.20 for two elements with a right angle between them: rows of turns at 23, 37, 57, stretches after them."""
    text = deck("S8R", cells=(2, 1), size=(40.0, 10.0), place=folded)
    found = expansion(mesh_of(tmp_path, text))
    assert {node: each[1:] for node, each in found.knots.items()} == {2: (23, 24), 3: (37, 38), 6: (57, 58)}
    assert all(len(each.nodes) == (4 if node == 6 else 6) for node, each in found.knots.items())


def test_mass_and_inertia_of_a_plate_are_exact(square):
    body = reduced(square, "", "{modes: 1, method: normal-modes}".strip("{}"))
    mass, a, t = 7850 * 0.1 * 0.1 * 1e-3, 0.1, 1e-3
    assert pytest.approx(mass, rel=1e-9) == body.invariants.I1
    np.testing.assert_allclose(body.invariants.I2 / mass, [0.05, 0.05, 0.0], atol=1e-12)
    about = mass * np.diag([(a**2 + t**2) / 12.0, (a**2 + t**2) / 12.0, a**2 / 6.0])
    c = np.array([0.05, 0.05, 0.0])
    np.testing.assert_allclose(
        body.invariants.I7, about + mass * (c @ c * np.eye(3) - np.outer(c, c)), atol=1e-9 * mass * a**2
    )


def test_frequencies_of_a_free_square_plate(square):
    """Leissa 1973, The free vibration of rectangular plates, J. Sound Vib. 31, table C21, whose Ritz values are up to 1 % too high."""
    ratio = reduced(square, "", "modes: 6, method: normal-modes").frequencies[:6] / plate_frequencies(
        [13.489, 19.789, 24.432, 35.024, 35.024, 61.526]
    )
    assert np.all((ratio > 0.985) & (ratio < 1.002)), ratio


def test_frequencies_of_a_clamped_square_plate(square):
    """Leissa 1973, table C1. The border is the set of the nodes of the shells, which stands for those above and below."""
    body = reduced(square, "edge: {set: EDGE}", "modes: 8, reference: edge")
    np.testing.assert_allclose(
        body.frequencies[:6], plate_frequencies([35.992, 73.413, 73.413, 108.27, 131.64, 132.24]), rtol=0.007
    )


def test_a_strip_bends_as_plate_theory_says(tmp_path):
    """Cantilever without Poisson contraction: w = F L³ / 3 E I + F L / (5/6 G A), σ = F (L - x) z / I."""
    write_matrices(tmp_path, deck("S8R", cells=(8, 2), size=(80.0, 10.0), poisson=0.0), poisson=0.0)
    root, tip = "root: {set: ROOT}", "tip: {plane: {point: [0.08, 0, 0], normal: [1, 0, 0]}}"
    body = reduced(tmp_path, f"{root}, {tip}", "modes: 4, reference: root")
    end = next(each for each in body.interfaces if each.name == "tip")
    force, length, area, second = 10.0, 0.08, 1e-5, 0.01 * 1e-9 / 12.0
    amplitudes = end.phi[2] * force / body.eigenvalues
    bent = force * length**3 / (3.0 * E * 1e6 * second)
    sheared = force * length / (5.0 / 6.0 * E * 1e6 / 2.0 * area)
    assert end.phi[2] @ amplitudes == pytest.approx(bent + sheared, rel=2e-3)
    assert body.stress is not None
    stress = body.stress.modes[:, 0] @ amplitudes
    x, _, z = body.position[body.stress.station_node].T
    inner = (x > 0.02) & (x < 0.06)
    expected = -force * (length - x) * z / second
    np.testing.assert_allclose(stress[inner], expected[inner], atol=5e-3 * np.abs(expected).max())


def test_a_node_of_shells_is_an_interface(square):
    """It moves as the mean of the nodes above and below; several stand for all of them, as a plane through them does."""
    body = reduced(square, "corner: {node: 1}", "modes: 4")
    places = {int(number): k for k, number in enumerate(body.node_ids)}
    around = np.flatnonzero(np.linalg.norm(body.position[:, :2], axis=1) < 1e-9)
    outer = around[np.abs(body.position[around, 2]) > 1e-9]
    assert len(around) == 4
    assert len(outer) == 2
    np.testing.assert_allclose(body.interfaces[0].phi, body.modes[outer, :3].mean(axis=0), atol=1e-9)
    np.testing.assert_allclose(body.modes[places[1], :3], body.interfaces[0].phi)
    by_set = reduced(square, "root: {set: ROOT}", "modes: 4").frequencies
    by_plane = reduced(square, "root: {plane: {point: [0, 0, 0], normal: [1, 0, 0]}}", "modes: 4").frequencies
    np.testing.assert_allclose(by_set, by_plane, rtol=1e-7)


REFUSED = {
    "nodal": (
        "*SHELL SECTION, ELSET=E",
        "*SHELL SECTION, NODAL THICKNESS, ELSET=E",
        "NODAL THICKNESS: thickness by nodes",
    ),
    "composite": (
        "*SHELL SECTION, ELSET=E",
        "*SHELL SECTION, COMPOSITE, ELSET=E",
        "COMPOSITE: layers cannot be followed",
    ),
    "no section": (
        "*SHELL SECTION, ELSET=E",
        "*SHELL SECTION, ELSET=F",
        r"shell 1 has no thickness; write `\*SHELL SECTION",
    ),
    "normal": ("*MATERIAL", "*NORMAL\n1, 1, 0., 0., 1.\n*MATERIAL", r"\*NORMAL is not followed"),
    "solid": (
        "*MATERIAL",
        "*ELEMENT, TYPE=C3D4\n99, 1, 2, 3, 4\n*MATERIAL",
        "node 1 belongs to the shell 1 and to a solid",
    ),
    "offset": (
        "*SHELL SECTION, ELSET=E",
        "*SHELL SECTION, OFFSET=SPOS, ELSET=E",
        "needs a number .* got thickness `1.`, OFFSET `SPOS`",
    ),
    "missing": ("1, 1, 2, 3, 4", "1, 1, 2, 3, 40", "shell 1 has the node 40, which does not exist"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_cannot_be_expanded_is_refused_with_its_line(tmp_path, case):
    old, new, message = REFUSED[case]
    text = deck("S4")
    assert old in text
    with pytest.raises(FormatError, match=rf"line \d+: .*{message}"):
        expansion(mesh_of(tmp_path, text.replace(old, new, 1)))


def test_a_step_of_thickness_across_no_axis_is_refused(tmp_path):
    step = ["*ELSET, ELSET=HALF", "1, 2", "*SHELL SECTION, ELSET=HALF, MATERIAL=S", "2."]
    assert expansion(mesh_of(tmp_path, deck("S4", cells=(2, 2), more=step))).knots
    with pytest.raises(FormatError, match=r"different thickness, offset or sense meet at node 2 \(element"):
        expansion(mesh_of(tmp_path, deck("S4", cells=(2, 2), more=step, place=lambda x, y: (0.8 * x, y, 0.6 * x))))


def test_nodes_that_the_deck_ties_are_refused(square, tmp_path):
    for name in ("sti", "mas", "inp"):
        shutil.copy(square / f"deck.{name}", tmp_path)
    rows = (square / "deck.dof").read_text().split()
    (tmp_path / "deck.dof").write_text("\n".join("2000.1" if row == "1.1" else row for row in rows))
    with pytest.raises(
        ModelError, match="node 1 of shells has 0 rows of direction 1, and its 3 nodes through the thickness"
    ):
        reduced(tmp_path, "", "modes: 1")


CASES = {  # what a strip is like: smooth, with nodes off the middle; with a step of thickness and a right angle
    "curved": {"place": arc, "options": ", OFFSET=0.3"},
    "joined": {
        "place": folded,
        "more": ("*ELSET, ELSET=THICK, GENERATE", "1, 2", "*SHELL SECTION, ELSET=THICK, MATERIAL=S", "2."),
    },
}


def by_calculix(folder, text):
    """[Hz] of the elastic modes by CalculiX itself; it writes the matrices too."""
    for name, each in (("deck", text), ("own", text.replace("*FREQUENCY, SOLVER=MATRIXSTORAGE", "*FREQUENCY\n12"))):
        (folder / f"{name}.inp").write_text(each, encoding="utf-8")
        subprocess.run(["ccx", name], cwd=folder, check=True, capture_output=True)
    rows = [line.split() for line in (folder / "own.dat").read_text().splitlines()]
    return [float(row[3]) for row in rows if len(row) == 5 and row[0].isdecimal()][6:]


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("kind", tail(["S3", "S4", "S6", "S8", "S8R"], ["S4", "S8R"]))
def test_frequencies_are_those_of_calculix(tmp_path, kind, case):
    """Of the free body, with the matrices that CalculiX wrote, and by itself from the same deck."""
    if shutil.which("ccx") is None:
        pytest.skip("CalculiX, the program ccx, is not installed")
    text = deck(kind, **CASES[case])
    own = by_calculix(tmp_path, text)
    found = reduced(tmp_path, "", "modes: 6, method: normal-modes")
    np.testing.assert_allclose(found.frequencies[:6], own[:6], rtol=1e-5)
    assert found.stress is not None
    assert len(found.triangles)


def test_a_branch_is_that_of_calculix(tmp_path):
    """A rib on the middle of a strip."""
    if shutil.which("ccx") is None:
        pytest.skip("CalculiX, the program ccx, is not installed")
    rib = ["*NODE", "900, 10., 0., 10.", "901, 10., 10., 10.", "*ELEMENT, TYPE=S4, ELSET=E", "90, 2, 900, 901, 3"]
    own = by_calculix(tmp_path, deck("S4", cells=(2, 1), size=(20.0, 10.0), more=rib))
    found = reduced(tmp_path, "", "modes: 6, method: normal-modes")
    np.testing.assert_allclose(found.frequencies[:6], own[:6], rtol=1e-5)
    assert pytest.approx(3 * 7850 * 1e-2 * 1e-2 * 1e-3, rel=1e-9) == found.invariants.I1


def test_a_rigid_group_of_the_deck_holds_the_nodes_of_shells(tmp_path):
    """As a hinge, if they are on a line: with the reference node on it frequencies are those of CalculiX; beside it nothing holds it."""
    if shutil.which("ccx") is None:
        pytest.skip("CalculiX, the program ccx, is not installed")
    group = ["*NODE", "500, 0., 10., 0.", "501, 0., 10., 0.", "*RIGID BODY, NSET=ROOT, REF NODE=500, ROT NODE=501"]
    text = deck("S8R", more=group)
    own = by_calculix(tmp_path, text)
    body = reduced(tmp_path, "root: {node: 500}", "modes: 6, method: normal-modes")
    np.testing.assert_allclose(body.frequencies[:6], own[:6], rtol=1e-5)
    assert not body.interfaces[0].turns
    by_calculix(tmp_path, text.replace("500, 0., 10.", "500, -3., 10."))
    with pytest.raises(
        ModelError, match=r"RIGID BODY turns about the straight line .* `interfaces: {NAME: {set: ROOT}}`"
    ):
        reduced(tmp_path, "root: {node: 500}", "modes: 6")


def test_thin_shells_whose_matrices_have_too_few_digits_are_told(tmp_path):
    """With 13 digits after the point, as CalculiX writes them; not with 16. Thinner still, they are refused."""
    text = deck("S8R", cells=(6, 6), size=(100.0, 100.0), section="0.1")
    path = model_file(tmp_path, interfaces="", reduction="modes: 6, method: normal-modes")
    for digits in (16, 13):
        write_matrices(tmp_path, text, digits=digits)
        (tmp_path / "deck.inp").write_text(text, encoding="utf-8")
        told = [each for each in reduce(path).findings.statements if "too few digits" in each]
        assert len(told) == (digits == 13)
    text = text.replace("\n0.1\n", "\n0.01\n")
    write_matrices(tmp_path, text, digits=13)
    (tmp_path / "deck.inp").write_text(text, encoding="utf-8")
    with pytest.raises(ModelError, match="the stiffness matrix has too few digits for a body as thin as this"):
        reduce(path)
