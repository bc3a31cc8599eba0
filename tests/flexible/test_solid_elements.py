"""Strain and stress of solid elements of all shapes, alone and beside each other, against exact fields; decks of hexahedra and wedges."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.io
import scipy.sparse as sp

from models import reduced
from nivel.elements.beams.sections import Material
from nivel.errors import ModelError
from nivel.flexible.body.recovery import stress
from nivel.flexible.foreign.mesh import SOLIDS, Mesh
from nivel.flexible.foreign.stress import blocks_of, first_inverted
from nivel.flexible.model.solid_elements import SolidElements, elasticity, surface

STEEL = Material(youngs_modulus=210e9, poisson_ratio=0.3, density=7850)
CUBE = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
PARTS = {  # corners of the cube that make elements
    "C3D8": [range(8)],
    "C3D6": [(0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7)],
    "C3D4": [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)],
}
LINEAR = {"C3D8": "C3D8", "C3D8I": "C3D8", "C3D8R": "C3D8", "C3D6": "C3D6", "C3D4": "C3D4"}
LINEAR |= {"C3D20": "C3D8", "C3D20R": "C3D8", "C3D15": "C3D6", "C3D10": "C3D4"}
MIDDLES = {
    "C3D8": ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)),
    "C3D6": ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)),
    "C3D4": ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)),
}


def mesh_of(kinds, warp=0.0, size=(1.0, 1.0, 1.0), cells=(2, 2, 2)):
    """A block of cells, those of each slice along x of the next kind; inner corners moved by `warp` of a cell."""
    numbers, places, elements = {}, [], {}
    rng = np.random.default_rng(5)
    grid = np.stack(np.meshgrid(*(np.arange(n + 1.0) for n in cells), indexing="ij"), axis=-1)
    inner = np.s_[1:-1, 1:-1, 1:-1]
    grid[inner] += warp * rng.uniform(-1, 1, size=grid[inner].shape)
    grid *= np.array(size) / cells

    def node(place):
        key = tuple(np.round(place, 9))
        if key not in numbers:
            numbers[key] = len(numbers) + 1
            places.append(place)
        return numbers[key]

    for cell in np.ndindex(cells):
        kind = kinds[cell[0] % len(kinds)]
        corners = [grid[tuple(np.add(cell, corner))] for corner in CUBE]
        for part in PARTS[LINEAR[kind]]:
            own = [corners[k] for k in part]
            if SOLIDS[kind] > len(own):
                own += [(own[i] + own[j]) / 2 for i, j in MIDDLES[LINEAR[kind]]]
            elements.setdefault(kind, []).append([node(place) for place in own])
    return Mesh(np.arange(1, len(places) + 1), np.array(places), elements=elements)


def solids_of(mesh):
    place = {int(number): k for k, number in enumerate(mesh.numbers)}
    freedoms = np.arange(3 * len(place)).reshape(-1, 3)
    blocks = blocks_of(mesh, place, mesh.places).values()
    return SolidElements(
        tuple(replace(block, elasticity=elasticity(STEEL)[None, None]) for block in blocks), freedoms, mesh.places
    )


@pytest.mark.parametrize(
    "kinds", [*([kind] for kind in LINEAR), ["C3D8", "C3D6"], ["C3D20R", "C3D15"], ["C3D8I", "C3D8"]]
)
def test_uniform_strain_is_exact_in_warped_elements(kinds):
    """The patch test, of one kind and of two beside each other; and volume and surface of the block, of which meshes make no difference."""
    elements = solids_of(mesh_of(kinds, warp=0.2))
    assert elements.volume == pytest.approx(1.0, rel=1e-12)
    slope = 1e-3 * np.array([[1.0, 2, -1], [0.5, -1, 3], [2, 0.3, 0.7]])
    moved = (elements.position @ slope.T).ravel()[:, None]
    strain = np.array([slope[0, 0], slope[1, 1], slope[2, 2], *(slope + slope.T)[[0, 1, 2], [1, 2, 0]]])
    wanted = elasticity(STEEL) @ strain
    np.testing.assert_allclose(elements.stress(moved)[:, :, 0], np.tile(wanted, (len(elements.stations), 1)), rtol=1e-9)
    turn = 0.5 * np.array([slope[2, 1] - slope[1, 2], slope[0, 2] - slope[2, 0], slope[1, 0] - slope[0, 1]])
    np.testing.assert_allclose(elements.turn(moved)[:, :, 0], np.tile(turn, (len(elements.position), 1)), atol=1e-12)
    p = elements.position[surface(elements.blocks)]
    area = 0.5 * np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    assert np.linalg.norm(area, axis=1).sum() == pytest.approx(6.0)
    assert np.einsum("ta,ta->", area, p[:, 0]) / 3.0 == pytest.approx(1.0)  # outwards: the volume by Gauss


@pytest.mark.parametrize("kinds", [["C3D20"], ["C3D15"], ["C3D10"], ["C3D8I"], ["C3D20R", "C3D15"]])
def test_pure_bending_is_exact(kinds):
    """Stress E κ z along x alone, of the displacement κ (x z, -ν y z, (-x² - ν (z² - y²)) / 2)."""
    mesh = mesh_of(kinds, size=(2.0, 1.0, 0.5))
    elements = solids_of(mesh)
    x, y, z = elements.position.T
    kappa, nu = 1e-3, STEEL.poisson_ratio
    moved = kappa * np.stack([x * z, -nu * y * z, -(x**2 + nu * (z**2 - y**2)) / 2], axis=1).ravel()[:, None]
    found = elements.stress(moved)[:, :, 0]
    wanted = np.zeros_like(found)
    wanted[:, 0] = STEEL.youngs_modulus * kappa * z[elements.stations]
    np.testing.assert_allclose(found, wanted, atol=1e-9 * np.abs(wanted).max())


def test_turned_inside_out():
    mesh = mesh_of(["C3D8"])
    first = mesh.elements["C3D8"][1]
    first[:4], first[4:] = first[4:], first[:4]
    place = {int(number): k for k, number in enumerate(mesh.numbers)}
    assert "1 of 8 elements C3D8 are turned inside out (the first is number 2" in first_inverted(
        blocks_of(mesh, place, mesh.places)
    )


def stiffness_and_mass(elements):
    """Matrices by the strains of unit displacements; a mass at each node."""
    D, count = elasticity(STEEL), elements.freedoms.size
    rows, columns, values, mass = [], [], [], np.zeros(len(elements.position))
    for block in elements.blocks:
        n = block.nodes.shape[1]
        unit = np.broadcast_to(np.eye(3 * n).reshape(n, 3, -1), (len(block.nodes), n, 3, 3 * n))
        K = np.zeros((len(block.nodes), 3 * n, 3 * n))
        for g, (_, volume) in zip(block.at_points(unit), block.points, strict=True):
            B = np.stack(
                [
                    g[:, 0, 0],
                    g[:, 1, 1],
                    g[:, 2, 2],
                    g[:, 0, 1] + g[:, 1, 0],
                    g[:, 1, 2] + g[:, 2, 1],
                    g[:, 2, 0] + g[:, 0, 2],
                ],
                axis=1,
            )
            K += np.einsum("eik,ij,ejl,e->ekl", B, D, B, volume)
        at = elements.freedoms[block.nodes].reshape(len(block.nodes), -1)
        rows.append(np.repeat(at, 3 * n, axis=1).ravel())
        columns.append(np.tile(at, 3 * n).ravel())
        values.append(K.ravel())
        np.add.at(mass, block.nodes, (block.volumes * STEEL.density / n)[:, None])
    K = sp.coo_array(
        (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=(count, count)
    ).tocsr()
    return K, sp.diags_array(np.repeat(mass, 3))


def written(folder, mesh, elements):
    for name, matrix in zip("km", stiffness_and_mass(elements), strict=True):
        scipy.io.mmwrite(folder / f"{name}.mtx", sp.coo_array(0.5 * (matrix + matrix.T)), symmetry="symmetric")
    lines = [
        "*NODE",
        *(f"{n}, {x!r}, {y!r}, {z!r}" for n, (x, y, z) in zip(mesh.numbers, mesh.places.tolist(), strict=True)),
    ]
    for kind, its in mesh.elements.items():
        lines.append(f"*ELEMENT, TYPE={kind}, ELSET=E")
        for k, element in enumerate(its, start=1):
            row = [str(each) for each in (k, *element)]
            lines += [
                ", ".join(row[:16]) + ("," if len(row) > 16 else ""),
                *([", ".join(row[16:])] if len(row) > 16 else []),
            ]
    lines += [
        "*MATERIAL, NAME=S",
        "*ELASTIC",
        "210e9, 0.3",
        "*DENSITY",
        "7850",
        "*SOLID SECTION, ELSET=E, MATERIAL=S",
        "",
    ]
    (folder / "mesh.inp").write_text("\n".join(lines), encoding="utf-8")


@pytest.mark.parametrize("kinds", [["C3D20"], ["C3D20R", "C3D15"], ["C3D8I"]])
def test_stress_of_decks_of_hexahedra_and_wedges(tmp_path, kinds):
    """A bar that is held at one end and bent by a force at the other: σ = F (L - x) z / I half way along it."""
    length, width, height = 1.0, 0.1, 0.1
    mesh = mesh_of(kinds, size=(length, width, height), cells=(10, 2, 2))
    written(tmp_path, mesh, solids_of(mesh))
    ends = ", ".join(
        f"{name}: {{plane: {{point: [{x}, 0, 0], normal: [1, 0, 0]}}}}" for name, x in (("root", 0.0), ("tip", length))
    )
    body, _ = reduced(
        "format: 1\nmatrices: {format: matrix-market, stiffness: k.mtx, mass: m.mtx, nodes: mesh.inp}\n"
        f"interfaces: {{{ends}}}\nreduction: {{modes: 6, reference: root}}\n",
        tmp_path,
    )
    assert body.stress is not None
    force = 1000.0
    tip = next(each for each in body.interfaces if each.name == "tip")
    q = tip.phi[2] * force / body.eigenvalues
    middle = np.flatnonzero(np.abs(body.position[body.stress.station_node, 0] - length / 2) < 1e-9)
    z = body.position[body.stress.station_node[middle], 2] - height / 2
    wanted = -force * (length / 2) * z / (width * height**3 / 12)
    found = stress(body, q[None], middle)[0]
    np.testing.assert_allclose(found[:, 0], wanted, atol=0.02 * np.abs(wanted).max())
    assert len(body.triangles)


def test_matrices_of_another_elasticity_than_the_deck_have_no_stress(tmp_path):
    """The energy of a uniform strain is held against that of the stiffness matrix."""
    mesh = mesh_of(["C3D8"], size=(1.0, 0.1, 0.1), cells=(4, 1, 1))
    written(tmp_path, mesh, solids_of(mesh))
    deck = tmp_path / "mesh.inp"
    deck.write_text(deck.read_text(encoding="utf-8").replace("210e9, 0.3", "180e9, 0.3"), encoding="utf-8")
    body, findings = reduced(
        "format: 1\nmatrices: {format: matrix-market, stiffness: k.mtx, mass: m.mtx, nodes: mesh.inp}\nreduction: {modes: 3}\n",
        tmp_path,
    )
    assert body.stress is None
    assert any(
        "stress is not known: in a uniform strain the elements of the deck store 0.8571 times" in note
        for note in findings.notes
    )


def test_a_single_element_of_one_point_is_refused_in_words(tmp_path):
    """Its mass at one point has no inertia: it was a traceback of a factor."""
    mesh = mesh_of(["C3D8R"], cells=(1, 1, 1))
    written(tmp_path, mesh, solids_of(mesh))
    mass = np.kron(np.full((8, 8), STEEL.density / 64.0), np.eye(3))  # N Nᵀ at the middle
    scipy.io.mmwrite(tmp_path / "m.mtx", sp.coo_array(mass), symmetry="symmetric")
    with pytest.raises(ModelError, match=r"the mass matrix has no inertia about the axis .* a single element C3D8R"):
        reduced(
            "format: 1\nmatrices: {format: matrix-market, stiffness: k.mtx, mass: m.mtx, nodes: mesh.inp}\n", tmp_path
        )
