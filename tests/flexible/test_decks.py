"""Decks as they come: their cards, and stress of the material that they have, against closed forms and against CalculiX."""

import json
from dataclasses import replace

import numpy as np
import pytest

from calculix_decks import CASES, ELASTIC, ORIENTATION, STRESSES, block, deck, displacement
from nivel.flexible.foreign.deck import CARDS, NO_STRESS, REFUSED, USED, WITHOUT_INFLUENCE
from nivel.flexible.foreign.matrix import FormatError
from nivel.flexible.foreign.read_mesh import read_mesh
from nivel.flexible.foreign.shells import expansion
from nivel.flexible.foreign.stress import UnknownStressError, blocks_of, elastic_blocks
from nivel.flexible.model.solid_elements import SolidElements
from test_shells import E
from test_shells import deck as shell_deck

# Dhondt, CalculiX CrunchiX User's Manual 2.20, section 7, and the keywords that its program reads beside these
CALCULIX = """AMPLITUDE, BASE MOTION, BEAM GENERAL SECTION, BEAM SECTION, BOUNDARY, BUCKLE, CFD, CFLUX, CHANGE CONTACT TYPE, CHANGE
FRICTION, CHANGE MATERIAL, CHANGE PLASTIC, CHANGE SOLID SECTION, CHANGE SURFACE BEHAVIOR, CLEARANCE, CLOAD, COMPLEX
FREQUENCY, CONDUCTIVITY, CONSTRAINT, CONTACT DAMPING, CONTACT FILE, CONTACT OUTPUT, CONTACT PAIR, CONTACT PRINT,
CONTROLS, CORRELATION LENGTH, COUPLED TEMPERATURE-DISPLACEMENT, COUPLING, CRACK PROPAGATION, CREEP, CYCLIC HARDENING,
CYCLIC SYMMETRY MODEL, DAMPING, DASHPOT, DEFORMATION PLASTICITY, DENSITY, DEPVAR, DESIGN RESPONSE, DESIGN VARIABLES,
DFLUX, DISTRIBUTING, DISTRIBUTING COUPLING, DISTRIBUTION, DISTRIBUTION TABLE, DLOAD, DSLOAD, DYNAMIC, ELASTIC,
ELECTRICAL CONDUCTIVITY, ELECTROMAGNETICS, ELEMENT, ELEMENT OUTPUT, EL FILE, EL PRINT, ELSET, END STEP, EQUATION,
EXPANSION, FEASIBLE DIRECTION, FILM, FILTER, FLUID CONSTANTS, FLUID SECTION, FREQUENCY, FRICTION, GAP, GAP CONDUCTANCE,
GAP HEAT GENERATION, GEOMETRIC CONSTRAINT, GEOMETRIC TOLERANCE, GREEN, HCF, HEADING, HEAT TRANSFER, HYPERELASTIC,
HYPERFOAM, INCLUDE, INITIAL CONDITIONS, INITIAL STRAIN INCREASE, KINEMATIC, MAGNETIC PERMEABILITY, MASS, MASS FLOW,
MATERIAL, MATRIX ASSEMBLE, MEMBRANE SECTION, MODAL DAMPING, MODAL DYNAMIC, MODEL CHANGE, MOHR COULOMB, MOHR COULOMB
HARDENING, MPC, NETWORK MPC, NO ANALYSIS, NODAL THICKNESS, NODE, NODE FILE, NODE OUTPUT, NODE PRINT, NORMAL, NSET,
OBJECTIVE, ORIENTATION, OUTPUT, PHYSICAL CONSTANTS, PLASTIC, PRE-TENSION SECTION, RADIATE, RANDOM FIELD, RATE DEPENDENT,
REFINE MESH, RESTART, RETAINED NODAL DOFS, RIGID BODY, ROBUST DESIGN, SECTION PRINT, SELECT CYCLIC SYMMETRY MODES,
SENSITIVITY, SHELL SECTION, SOLID SECTION, SPECIFIC GAS CONSTANT, SPECIFIC HEAT, SPRING, STATIC, STEADY STATE DYNAMICS,
STEP, SUBMODEL, SUBSTRUCTURE GENERATE, SUBSTRUCTURE MATRIX OUTPUT, SURFACE, SURFACE BEHAVIOR, SURFACE INTERACTION,
TEMPERATURE, TIE, TIME POINTS, TRANSFORM, UNCOUPLED TEMPERATURE-DISPLACEMENT, USER ELEMENT, USER MATERIAL, USER SECTION,
VALUES AT INFINITY, VIEWFACTOR, VISCO"""


def elements_of(folder, text, **change):
    (folder / "deck.inp").write_text(text, encoding="utf-8")
    mesh = read_mesh(folder / "deck.inp")
    place = {int(number): k for k, number in enumerate(mesh.numbers)}
    blocks = elastic_blocks(mesh, blocks_of(mesh, place, mesh.places), place, 1.0, 1.0)
    freedoms = np.arange(3 * len(place)).reshape(-1, 3)
    return SolidElements(tuple(replace(block, **change) for block in blocks), freedoms, mesh.places)


def test_every_card_of_calculix_has_its_effect():
    """Each card is used, without influence, a reason why stress is not known, or refused: one of these, and none is left out."""
    groups = (USED, WITHOUT_INFLUENCE, NO_STRESS.keys(), REFUSED.keys())
    names = [" ".join(name.split()) for name in CALCULIX.replace("\n", " ").split(",")]
    assert [name for name in names if sum(name in group for group in groups) != 1] == []
    assert len(CARDS) == sum(map(len, groups))


@pytest.mark.parametrize("name", CASES)
def test_stress_is_that_of_calculix(tmp_path, name):
    """All elasticities, axes, temperatures, sections; C3D8I with incompatible modes whose slopes CalculiX 2.20 does not scale."""
    elements = elements_of(tmp_path, deck(*CASES[name]), patched=False)
    found = elements.stress(displacement(block(CASES[name][0])[0]).ravel()[:, None])[::3, :, 0]
    wanted = np.array(json.loads(STRESSES.read_text(encoding="utf-8"))[name])
    np.testing.assert_allclose(found, wanted, atol=2e-4 * np.abs(wanted).max())


def tensor(D, axes):
    """(6, 6) of a stiffness in axes (3, 3), by its tensor of 81 components."""
    at = np.array([[0, 3, 5], [3, 1, 4], [5, 4, 2]])
    C = np.einsum("pi,qj,rk,sl,pqrs->ijkl", axes, axes, axes, axes, D[at[:, :, None, None], at[None, None]])
    pairs = ([0, 1, 2, 0, 1, 2], [0, 1, 2, 1, 2, 0])
    return C[pairs[0], pairs[1]][:, pairs[0], pairs[1]]


def orthotropic():
    """The stiffness of the engineering constants of the decks, from its compliance."""
    E, nu, G = (135000.0, 9000.0, 7000.0), (0.3, 0.25, 0.4), (5000.0, 3000.0, 4500.0)  # G12, G23, G13
    S = np.diag([1.0 / each for each in (*E, *G)])
    for (i, j), value in zip(((0, 1), (0, 2), (1, 2)), nu, strict=True):
        S[i, j] = S[j, i] = -value / E[i]
    return np.linalg.inv(S)


AXES = {
    "": np.eye(3),
    "rectangular": np.linalg.qr(np.array([[1.0, 0.4, 0.2], [-0.3, 1.0, 0.1], [0.0, 0.0, 1.0]]).T)[0].T,
}


@pytest.mark.parametrize("kind", ["C3D8", "C3D8I", "C3D8R", "C3D10", "C3D15", "C3D20", "C3D6"])
def test_uniform_strain_of_an_orthotropic_body_in_turned_axes(tmp_path, kind):
    """σ = C ε at every node, the tensor turned by hand."""
    shape = "C3D20R" if kind == "C3D20" else "C3D15" if kind == "C3D6" else kind
    text = deck(shape, "engineering", "rectangular", "", "")
    if kind == "C3D6":
        text = deck("C3D8", "engineering", "rectangular", "", "").replace("C3D8", "C3D6")
        lines = text.splitlines()
        start = lines.index("*ELEMENT, TYPE=C3D6, ELSET=E1")
        for k in range(start + 1, start + 4):
            number, a, b, c, _, e, f, g, _ = lines[k].split(",")
            lines[k] = ",".join((number, a, b, c, e, f, g))
        text = "\n".join(lines)
    elements = elements_of(tmp_path, text.replace("C3D20R", kind))
    slope = 1e-3 * np.array([[1.0, 2, -1], [0.5, -1, 3], [2, 0.3, 0.7]])
    strain = np.array([slope[0, 0], slope[1, 1], slope[2, 2], *(slope + slope.T)[[0, 1, 2], [1, 2, 0]]])
    axes = AXES["rectangular"]
    axes = axes * np.sign(np.diag(axes @ np.array([[1.0, 0.4, 0.2], [-0.3, 1.0, 0.1], [0.0, 0.0, 1.0]]).T))[:, None]
    wanted = tensor(orthotropic(), axes) @ strain
    found = elements.stress((elements.position @ slope.T).ravel()[:, None])[:, :, 0]
    np.testing.assert_allclose(found, np.tile(wanted, (len(found), 1)), rtol=1e-9, atol=1e-9 * np.abs(wanted).max())


def test_modulus_and_shear_across_the_fibres(tmp_path):
    """A bar pulled at 30° to its fibres: 1/E = c⁴/E₁ + s⁴/E₂ + (1/G₁₂ − 2 ν₁₂/E₁) s² c², and shear along them has G₁₂ alone."""
    text = deck("C3D8", "engineering", "rectangular", "", "").replace(
        ORIENTATION["rectangular"], "*ORIENTATION, NAME=AXES\n1., 0., 0., 0., 1., 0.\n3, 30."
    )
    elements = elements_of(tmp_path, text)
    c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
    modulus = 1.0 / (c**4 / 135000.0 + s**4 / 9000.0 + (1.0 / 5000.0 - 0.6 / 135000.0) * s**2 * c**2)
    axes = np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    stress = np.array([[1.0, 0, 0, 0, 0, 0], [*(2 * s * c * np.array([-1.0, 1.0])), 0, c * c - s * s, 0, 0]]).T
    strain = np.linalg.solve(tensor(orthotropic(), axes), stress)
    assert strain[0, 0] == pytest.approx(1.0 / modulus)
    local = np.array([-2 * s * c, 2 * s * c, 0, c * c - s * s, 0, 0]) @ strain[:, 1]
    assert local == pytest.approx(1.0 / 5000.0)
    e = strain / np.array([1, 1, 1, 2, 2, 2])[:, None]
    slopes = e[[0, 3, 5, 3, 1, 4, 5, 4, 2]].T.reshape(-1, 3, 3)
    moved = np.stack([(elements.position @ slope.T).ravel() for slope in slopes], axis=1)
    np.testing.assert_allclose(elements.stress(moved), np.tile(stress, (len(elements.stations), 1, 1)), atol=1e-9)


def test_axes_of_shells_are_projected_onto_them(tmp_path):
    """A strip that rises at 40° along x: x of the material is along it, z is its normal, with and without *ORIENTATION."""
    c, s = np.cos(np.radians(40.0)), np.sin(np.radians(40.0))
    text = shell_deck("S4", place=lambda x, y: (c * x, y, s * x)).replace(f"*ELASTIC\n{E}, 0.3", ELASTIC["engineering"])
    for more in ("", "*ORIENTATION, NAME=AXES, SYSTEM=CYLINDRICAL\n0., 500., 0., 0., 500., 1."):
        given = text if not more else more + "\n" + text.replace("MATERIAL=S", "MATERIAL=S, ORIENTATION=AXES")
        (tmp_path / "deck.inp").write_text(given, encoding="utf-8")
        mesh = expansion(read_mesh(tmp_path / "deck.inp")).mesh
        place = {int(number): k for k, number in enumerate(mesh.numbers)}
        (shells,) = elastic_blocks(mesh, blocks_of(mesh, place, mesh.places), place, 1.0, 1.0)
        assert shells.elasticity is not None
        for number, found in zip(mesh.element_numbers["C3D8I"], shells.elasticity[:, 0], strict=True):
            centre, normal = mesh.planes[number]
            along = np.array([1.0, 0, 0]) if not more else (centre - (0, 500, 0)) * (1, 1, 0)
            along = along - (along @ normal) * normal
            x = along / np.linalg.norm(along)
            np.testing.assert_allclose(normal, [-s, 0.0, c], atol=1e-12)
            wanted = tensor(orthotropic(), np.array([x, np.cross(normal, x), normal]))
            np.testing.assert_allclose(found, wanted, atol=1e-9 * wanted.max())


def test_steps_of_strain_between_materials_are_no_error_of_the_mesh(tmp_path):
    """Two bars in series, of which each has its uniform strain: between them strain has a step, and finer elements would add nothing."""
    text = (
        deck("C3D8R", "iso", "", "", "iso").replace("C3D8R", "C3D8").replace(ELASTIC["iso"], "*ELASTIC\n70000., .3", 1)
    )
    elements = elements_of(tmp_path, text)
    assert [part.blocks[0].material for part in elements.by_material] == ["M1", "M2"]
    x = elements.position[:, 0]
    border = elements.position[elements.by_material[0].stations, 0].max()
    moved = np.zeros((len(x), 3))
    moved[:, 0] = np.where(x <= border, 3e-3 * x, 3e-3 * border + 1e-3 * (x - border))
    moved = moved.ravel()[:, None]
    np.testing.assert_allclose(elements.energy_error(moved), 0.0, atol=1e-20)
    assert (
        elements.smoothing_energy(moved)[0] > 0.01 * elements.strain_energy(moved)[0]
    )  # over the step it would be large


PLAIN = deck("C3D8", "iso-t", "", "uniform", "")


def same_stress(folder, text):
    moved = displacement(block("C3D8")[0]).ravel()[:, None]
    wanted = elements_of(folder, PLAIN).stress(moved)
    np.testing.assert_allclose(elements_of(folder, text).stress(moved), wanted, rtol=1e-12)


def test_decks_as_they_come(tmp_path):
    """Lower case, blanks in keywords, comments, keywords that go on, Fortran's exponents, a node given twice, and *INCLUDE."""
    same_stress(tmp_path, PLAIN.lower())
    same_stress(
        tmp_path,
        "** a comment\n\n" + PLAIN.replace("*SOLID SECTION, ELSET=E1,", "* Solid Section, ElSet = e1 ,\n** more\n"),
    )
    same_stress(tmp_path, PLAIN.replace("210000.,", "2.1D+5,").replace("180000.", "1.8+5").replace("120000.", "120.d3"))
    twice = PLAIN.replace("*ELEMENT", "*NODE\n1, 0.5, 0, 0\n*ELEMENT", 1)
    with pytest.raises(AssertionError):
        same_stress(tmp_path, twice)
    first = PLAIN.splitlines()[1]
    same_stress(tmp_path, twice.replace("*ELEMENT", f"*NODE\n{first}\n*ELEMENT", 1))
    assert "node 1 stands at several places" in " ".join(read_mesh(tmp_path / "deck.inp").notes)
    nodes, rest = PLAIN.split("*ELEMENT", 1)
    (tmp_path / "Nodes.inc").write_text(nodes, encoding="utf-8")
    same_stress(tmp_path, f"*include, Input=Nodes.inc\n*ELEMENT{rest}")
    (tmp_path / "Nodes.inc").write_text(nodes.replace(first, "1, one, 0, 0"), encoding="utf-8")
    with pytest.raises(FormatError, match=r"line 2: this line of .NODE cannot be read") as error:
        read_mesh(tmp_path / "deck.inp")
    assert error.value.file == tmp_path / "Nodes.inc"


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("*MATERIAL", "*CYCLIC SYMMETRY MODEL\n*MATERIAL", "CYCLIC SYMMETRY MODEL: the matrices are those of a sector"),
        ("*MATERIAL", "*MATERAL", r"did you mean `\*MATERIAL`"),
        ("*MATERIAL", "*SPLINE\n*MATERIAL", "no card that is known here"),
        ("*NODE, NSET", "*INCLUDE, INPUT=none.inp\n*NODE, NSET", "line 1: .INCLUDE needs `INPUT=`"),
        ("*NODE, NSET", "*INCLUDE, INPUT=deck.inp\n*NODE, NSET", "does one include itself"),
        ("*MATERIAL, NAME=M1\n", "", "of no material"),
        ("210000., .3,", "210000., .9,", "no positive energy"),
        ("500.\n120000.", "0.\n120000.", "must ascend"),
        ("210000., .3,", "2e5e5, .3,", "cannot be read: `2e5e5"),
        ("*ELEMENT, TYPE=C3D8,", "*ELEMENT,", "needs `TYPE=`"),
        ("*ELEMENT", "*ASSEMBLY\n*NODE\n1, 0., 0., 7.\n*ELEMENT", "node 1 stands in a part and in the assembly"),
    ],
)
def test_what_cannot_be_followed_is_refused_with_its_line(tmp_path, old, new, words):
    assert old in PLAIN
    with pytest.raises(FormatError, match=words) as error:
        elements_of(tmp_path, PLAIN.replace(old, new, 1))
    assert error.value.line


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("*SOLID", "*PLASTIC\n200., 0.\n*SOLID", r"material M1: \*PLASTIC \(line \d+\) is no linear elasticity"),
        (ELASTIC["iso-t"], "*HYPERELASTIC\n1., 2., 3.", r"\*HYPERELASTIC .* is no linear elasticity"),
        ("*ELASTIC", "*ELASTIC, TYPE=LAMINA", "TYPE=LAMINA"),
        ("*ELASTIC", "*ELASTIC, DEPENDENCIES=1", "with DEPENDENCIES"),
        ("MATERIAL=M1", "MATERIAL=M3", r"no \*MATERIAL M3"),
        ("ELSET=E1, MAT", "ELSET=E2, MAT", "element 1 has no material"),
        ("*SOLID", "*TEMPERATURE\nNALL, 20.\n*SOLID", "changes temperatures in a step"),
        ("NALL, 260.", "NALL, 260., 5.", "gradients"),
        (
            "*SOLID",
            "*ORIENTATION, NAME=AXES\nLIST\n*ELASTIC, TYPE=ORTHO\n9., 1., 9., 1., 1., 9., 1., 1.\n1.\n*SOLID",
            r"\*ORIENTATION .* distribution",
        ),
        ("*SOLID", "*ELEMENT, TYPE=F3D8\n9, 1, 2, 3, 4, 5, 6, 7, 8\n*SOLID", "elements F3D8"),
    ],
)
def test_what_is_no_elasticity_has_no_stress_by_name(tmp_path, old, new, words):
    assert old in PLAIN
    text = PLAIN.replace(old, new, 1)
    with pytest.raises(UnknownStressError, match=words):
        elements_of(
            tmp_path, text if "LIST" not in new else text.replace("MATERIAL=M1", "MATERIAL=M1, ORIENTATION=AXES")
        )
