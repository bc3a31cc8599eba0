"""What is wrong with a model is named, with its place and with what to do."""

import numpy as np
import pytest
import scipy.io
import scipy.sparse as sp

from models import STEEL, bar, block, reduced
from needing import needs
from nivel.elements.beams.sections import Material, Rectangle, section_of
from nivel.errors import ModelError
from nivel.flexible.model.beam import Beam, mass_matrix, stiffness
from nivel.flexible.model.model_file import parse_model
from nivel.flexible.reduction.factor import Factor, NoStiffnessError


def faults_of(text, folder="."):
    with pytest.raises(ModelError) as caught:
        reduced(text, folder)
    return caught.value.faults


def message_of(text, folder="."):
    return "\n".join(str(fault) for fault in faults_of(text, folder))


def test_all_faults_of_a_file_at_once_with_their_places():
    text = """format: 1
parameters: {size: 3 kg}
materials:
  steel: {youngs_modulus: 210 mm, poisson_ratio: 0.7, density: 7850}
sections:
  bar: {type: rectangl, width: 1, height: 1}
  tube: {type: tube, outer_radius: 1 cm, inner_radius: 2 cm}
  round: {type: circle, radius: size}
frame:
  theory: bernoulli
  nodes: {a: [0, 0, 0], b: [1, 0]}
  beams: {bar: {nodes: [a, b], section: bar, material: steel, elements: 2.5}}
interfaces:
  root: {node: a, plane: {point: [0, 0, 0], normal: [1, 0, 0]}}
  tip: {node: b, tie: rigi}
reduction: {modes: -1, method: guyan, referenc: root}
"""
    found = {(fault.line, fault.path) for fault in faults_of(text)}
    assert found == {
        (4, "materials.steel.youngs_modulus"),
        (4, "materials.steel.poisson_ratio"),
        (6, "sections.bar"),
        (7, "sections.tube.inner_radius"),
        (8, "sections.round.radius"),
        (10, "frame.theory"),
        (11, "frame.nodes.b"),
        (12, "frame.beams.bar.elements"),
        (14, "interfaces.root"),
        (15, "interfaces.tip.tie"),
        (16, "reduction.modes.count"),
        (16, "reduction.method"),
        (16, "reduction.referenc"),
    }


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (("format: 1", ""), "`format: 1` is missing"),
        (("format: 1", "format: 2"), "reads format 1, not `2`"),
        (("poisson_ratio: 0.3", "poisson_ratio: 0.5"), "between -1 and 0.5"),
        (("density: 7850 kg/m^3", "density: 7.85e-9"), "a slip of a unit? Steel has 7850"),
        (("youngs_modulus: 210 GPa", "youngs_modulus: 210"), "a slip of a unit? Steel has 210 GPa"),
        (("section: bar", "section: baar"), "did you mean `bar`?"),
        (("nodes: [root, tip]", "nodes: [root, tipp]"), "did you mean `tip`?"),
        (("nodes: [root, tip]", "nodes: [root, root]"), "no length"),
        (("{node: tip}", "{node: tpi}"), "there is no node `tpi`"),
        (("{node: tip}", "{node: 99}"), "there is no node 99; the 17 nodes have numbers from 1 to 17"),
        (("{node: tip}", "{nodes: [16, 98, 99]}"), "there are no nodes 98, 99"),
        (("{node: tip}", "{node: root}"), "belongs to the interface `root` already"),
        (("{node: tip}", "{set: TIP}"), "the mesh has no node set `TIP`"),
        (("{node: tip}", "{plane: {point: [2.1, 0, 0], normal: [1, 0, 0]}}"), "the nearest is node 2, 0.1 m away"),
        (("{node: tip}", "{node: tip, at: [0, 0, 0]}"), "`at` belongs to a set of nodes"),
        (("modes: 8", "modes: {}"), "`count` or `up_to`"),
        (("modes: 8", "modes: 8, reference: rot"), "did you mean `root`?"),
        (("modes: 8", "modes: 8, held: [root.x, root.y]"), "six degrees of freedom were expected, got 2"),
        (("modes: 8", "modes: 8, held: [root.x, root.y, root.z, tip.x, tip.y, tip.z]"), "leave a rigid motion"),
        (("modes: 8", "modes: 8, held: [root.x, root.y, root.z, root.q, tip.y, tip.z]"), "got `root.q`"),
        (("modes: 8", "modes: given"), "`modes: given` and `shapes` belong together"),
        (("modes: 8", "modes: given, shapes: [{z: x^2 + fo}]"), "`fo`"),
        (("modes: 8", "modes: given, shapes: [{z: log(x)}]"), "outside the domain"),
        (("modes: 8", "modes: given, shapes: [{z: 0*x}]"), "zero at every node"),
        (("modes: 8", "modes: given, shapes: shapes.csv"), "there is no file"),
        (
            ("interfaces: {root: {node: root}, tip: {node: tip}}\nreduction: {modes: 8}", "reduction: {modes: 0}"),
            "no mode is left",
        ),
        (("modes: 8", "modes: given, shapes: [{z: x}]"), "no mode is left but rigid motions"),
        (("{node: tip}", "{node: true}"), "name or the number of a node"),
        (("{node: tip}", "{box: {from: [1, 0, 0], to: [2, 0, 0]}, tie: average}"), "lie on a line"),
        (("{node: tip}", "{plane: {point: [2, 0, 0], normal: [0, 0, 0]}}"), "length zero"),
        (("reduction:", "recovery: {nodes: [1, 77]}\nreduction:"), "there is no node 77"),
        (("reduction:", "expected_mass: 9 t\nreduction:"), "0.00105 times as much, about 1e-3"),
        (
            ("frame:", "solid: {material: steel, element_size: 1, file: a.step}\nframe:"),
            "one of `frame`, `solid` and `matrices`",
        ),
    ],
)
def test_fault_is_named(change, words):
    text = bar()
    assert change[0] in text
    assert words in message_of(text.replace(*change))


def test_file_that_is_no_model():
    assert "the file is empty" in message_of("")
    assert "a mapping with `format: 1` was expected; got a list" in message_of("[1, 2]")


def test_beams_that_are_not_joined_are_named():
    text = bar().replace(
        "nodes: {root: [0, 0, 0], tip: [2.0, 0.0, 0.0]}",
        "nodes: {root: [0, 0, 0], tip: [2, 0, 0], a: [0, 1, 0], b: [1, 1, 0]}",
    )
    text = text.replace(
        "elements: 16}}", "elements: 16}, other: {nodes: [a, b], section: bar, material: steel, elements: 2}}"
    )
    message = message_of(text)
    assert "2 parts that no stiffness joins: 17 nodes from node 1; 3 nodes from node 3." in message
    assert "Merge coincident nodes" in message


def test_node_without_beam_is_named():
    text = bar().replace("tip: [2.0, 0.0, 0.0]}", "tip: [2, 0, 0], lost: [0, 1, 0]}")
    assert "frame.nodes.lost: no beam ends at this node" in message_of(text)


def hinged(folder):
    """Two beams along x that share the displacement of their middle node 2; the second has its own turns there, of node 4."""
    it = Beam(
        0.5,
        section_of(Rectangle(width=0.02, height=0.03), 0.3),
        Material(youngs_modulus=210e9, poisson_ratio=0.3, density=7850),
        False,
    )
    rows = (
        [(1, a) for a in range(1, 7)]
        + [(2, a) for a in range(1, 7)]
        + [(3, a) for a in range(1, 7)]
        + [(4, a) for a in (4, 5, 6)]
    )
    place = {label: k for k, label in enumerate(rows)}
    K, M = np.zeros((21, 21)), np.zeros((21, 21))
    first = [place[n, a] for n in (1, 2) for a in range(1, 7)]
    second = [*(place[2, a] for a in (1, 2, 3)), *(place[4, a] for a in (4, 5, 6)), *(place[3, a] for a in range(1, 7))]
    for at in (first, second):
        K[np.ix_(at, at)] += stiffness(it)
        M[np.ix_(at, at)] += mass_matrix(it)
    for name, matrix in (("k", K), ("m", M)):
        scipy.io.mmwrite(folder / f"{name}.mtx", sp.coo_array(matrix), symmetry="symmetric")
    (folder / "rows.csv").write_text("node,direction\n" + "".join(f"{n},{a}\n" for n, a in rows))
    (folder / "nodes.csv").write_text("id,x,y,z\n1,0,0,0\n2,0.5,0,0\n3,1,0,0\n4,0.5,0,0\n")
    return "format: 1\nmatrices: {format: matrix-market, stiffness: k.mtx, mass: m.mtx, nodes: nodes.csv, freedoms: rows.csv}\n"


@pytest.mark.parametrize("interfaces", ["", "interfaces: {root: {node: 1}}\n"])
def test_mechanism_is_named_with_the_nodes_that_move(tmp_path, interfaces):
    message = message_of(hinged(tmp_path) + interfaces, tmp_path)
    assert "singular beyond the six rigid motions" in message
    assert "node" in message
    assert "3 (" in message or "4 (" in message or "1 (" in message
    assert "remove hinges" in message


@pytest.mark.parametrize(("axis", "share"), [(0, 0.6), (0, 1.5), (5, 0.13)])
def test_negative_energy_is_no_mechanism(tmp_path, axis, share):
    """A spring of negative stiffness from end to end of the two beams: they have K_ii / 2 along, K_ii / 8 in bending."""
    text = hinged(tmp_path)
    K = scipy.io.mmread(tmp_path / "k.mtx").toarray()
    for a in (3, 4, 5):
        i, j = 6 + a, 18 + a - 3
        K[[i, j], [i, j]] += 1e4
        K[[i, j], [j, i]] -= 1e4
    i, j, negative = axis, 12 + axis, share * K[axis, axis]
    K[[i, j], [i, j]] -= negative
    K[[i, j], [j, i]] += negative
    scipy.io.mmwrite(tmp_path / "k.mtx", sp.coo_array(K), symmetry="symmetric")
    message = message_of(text, tmp_path)
    assert "a motion of negative energy" in message
    assert "mechanism" not in message


@pytest.mark.parametrize(("links", "singular"), [(2000, False), (50, True)])
def test_a_pivot_of_round_off_is_told_from_a_soft_chain(links, singular):
    """A chain of springs is held at one end, and is soft: 1/A⁻¹ of its end is 1/links. One that is held nowhere is singular."""
    K = sp.lil_array(
        sp.diags_array([np.full(links, 2.0), -np.ones(links - 1), -np.ones(links - 1)], offsets=[0, 1, -1])
    )
    K[-1, -1] = 1.0
    if not singular:
        Factor(sp.csc_array(K))
        return
    K[0, 0] = 1.0
    with pytest.raises(NoStiffnessError) as caught:
        Factor(sp.csc_array(K * (1.0 / 3.0)))
    assert np.ptp(caught.value.motion) < 1e-3


def test_stiffening_of_matrices_needs_elements(tmp_path):
    text = hinged(tmp_path)
    K = scipy.io.mmread(tmp_path / "k.mtx").toarray()
    for a in (3, 4, 5):  # springs close the hinge
        i, j = 6 + a, 18 + a - 3
        K[[i, j], [i, j]] += 1e4
        K[[i, j], [j, i]] -= 1e4
    scipy.io.mmwrite(tmp_path / "k.mtx", sp.coo_array(K), symmetry="symmetric")
    assert reduced(text, tmp_path)[0].mass > 0
    assert "geometric stiffness needs the elements" in message_of(
        text + "reduction: {modes: 4, stiffening: true}\n", tmp_path
    )


def test_solid_interfaces():
    needs("gmsh")
    root = "root: {plane: {point: [0, 0, 0], normal: [1, 0, 0]}}"
    assert "the nearest is node" in message_of(
        block(interfaces="pin: {cylinder: {point: [0, 0, 0], axis: [0, 0, 1], radius: 3}}")
    )
    message = message_of(block(interfaces=f"{root}, side: {{plane: {{point: [0, 0.05, 0], normal: [0, 1, 0]}}}}"))
    assert "belongs to the interface `root` already" in message
    assert "lie on a line" in message_of(block(interfaces="edge: {box: {from: [0, 0.05, 0.05], to: [1, 0.05, 0.05]}}"))
    held = "reduction: {modes: 4, reference: corner}"
    text = block(interfaces="corner: {node: 1}").replace("reduction: {modes: 6}", held)
    assert "has no freedom `rx`; tie a surface" in message_of(text)
    assert "in this box" in message_of(
        block(interfaces=root.replace("]}}", "]}, within: {from: [5, 5, 5], to: [6, 6, 6]}}"))
    )


@pytest.mark.parametrize("missing", ["gmsh", "skfem", "meshio"])
def test_missing_extras_say_what_to_install(monkeypatch, missing):
    monkeypatch.setitem(__import__("sys").modules, missing, None)
    package = {"skfem": "scikit-fem"}.get(missing, missing)
    assert f"needs {package}: pip install 'nivel[flex]'" in message_of(block())


def test_step_file_that_does_not_exist_or_is_none(tmp_path):
    needs("gmsh")
    text = f"format: 1\nmaterials: {{{STEEL}}}\nsolid: {{file: part.step, material: steel, element_size: 0.1}}\n"
    assert "there is no file" in message_of(text, tmp_path)
    (tmp_path / "part.step").write_text("this is no STEP file")
    assert "cannot be made" in message_of(text, tmp_path)


def test_overrides_go_before_the_file():
    located = parse_model(bar(), overrides={"reduction.modes": 3, "sections.bar.height": "40 mm"})
    assert located.record.reduction.modes.count == 3
    assert located.record.sections["bar"].height == pytest.approx(0.04)
    with pytest.raises(ModelError, match="the section `secions` is not known; did you mean `sections`"):
        parse_model(bar(), overrides={"secions.bar.height": 1})


def test_limit_that_takes_in_too_many_modes():
    text = bar(elements=200, reduction="modes: {up_to: 1e12 Hz}")
    assert "more than 1000 normal modes lie below" in message_of(text)
