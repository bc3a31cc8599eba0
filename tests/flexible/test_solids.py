"""Solids meshed with tetrahedra: mass, inertia, stress and frequencies against closed forms."""

import subprocess
import sys
import weakref

import numpy as np
import pytest

from models import STEEL, bar, block, reduced
from needing import needs
from nivel.errors import ModelError
from nivel.flexible.body.recovery import hot_spots, stress, von_mises
from nivel.flexible.model.model_file import parse_model
from nivel.flexible.reduce import source_model
from nivel.flexible.reduction import factor
from nivel.flexible.reduction.bases import inertia_loads
from nivel.flexible.reduction.free_body import FreeBody
from nivel.flexible.reduction.ties import with_interfaces

pytestmark = pytest.mark.covering

needs("gmsh", "skfem")

E, RHO, SIDE = 210e9, 7850.0, 0.1
ROOT = "root: {plane: {point: [0, 0, 0], normal: [1, 0, 0]}}"
TIP = "tip: {plane: {point: [1, 0, 0], normal: [1, 0, 0]}, tie: average}"


def assembled(text):
    located = parse_model(text)
    model, sets = source_model(located, lambda *_: None)
    return with_interfaces(model, located, sets)[0]


@pytest.fixture(scope="module")
def cantilever():
    return reduced(block(interfaces=f"{ROOT}, {TIP}", reduction="modes: 10, reference: root, inertia_modes: true"))[0]


SHAPES = {
    "box": (
        "[{type: box, from: [0, 0, 0], to: [0.3, 0.2, 0.1]}]",
        0.3 * 0.2 * 0.1,
        [0.15, 0.1, 0.05],
        np.array([0.2**2 + 0.1**2, 0.3**2 + 0.1**2, 0.3**2 + 0.2**2]) / 12,
    ),
    "cylinder": (
        "[{type: cylinder, from: [0, 0, 0], to: [0.4, 0, 0], radius: 0.1}]",
        np.pi * 0.1**2 * 0.4,
        [0.2, 0, 0],
        np.array([0.1**2 / 2, 0.1**2 / 4 + 0.4**2 / 12, 0.1**2 / 4 + 0.4**2 / 12]),
    ),
    "sphere": (
        "[{type: sphere, centre: [1, 0, 0], radius: 0.1}]",
        4 / 3 * np.pi * 1e-3,
        [1, 0, 0],
        np.full(3, 0.4 * 0.01),
    ),
    "tube": (
        "[{type: cylinder, from: [0, 0, 0], to: [0.4, 0, 0], radius: 0.1}, "
        "{type: cylinder, from: [-1, 0, 0], to: [1, 0, 0], radius: 0.08, cut: true}]",
        np.pi * (0.1**2 - 0.08**2) * 0.4,
        [0.2, 0, 0],
        np.array([(0.1**2 + 0.08**2) / 2, *[(0.1**2 + 0.08**2) / 4 + 0.4**2 / 12] * 2]),
    ),
    "cone": (
        "[{type: cone, from: [0, 0, 0], to: [0.3, 0, 0], radius: 0.1, end_radius: 0.05}]",
        np.pi * 0.3 / 3 * (0.01 + 0.005 + 0.0025),
        None,
        None,
    ),
}


@pytest.mark.parametrize("name", SHAPES)
def test_mass_and_inertia_of_a_mesh_are_those_of_the_shape(name):
    """Curved elements of second order: the volume of a round mesh misses by less than 1e-3."""
    parts, volume, centre, moments = SHAPES[name]
    text = f"format: 1\nmaterials: {{{STEEL}}}\nsolid: {{parts: {parts}, material: steel, element_size: 60 mm}}\nreduction: {{modes: 3}}"
    body, findings = reduced(text)
    exact = 1e-10 if name == "box" else 1e-3
    assert findings.volume == pytest.approx(volume, rel=1e-6)
    assert body.mass == pytest.approx(RHO * volume, rel=exact)
    if centre is not None:
        np.testing.assert_allclose(body.centre_of_mass, centre, atol=1e-3 * 0.1)
        np.testing.assert_allclose(np.diag(body.inertia), RHO * volume * moments, rtol=2 * exact)


def test_frequencies_of_a_slender_block_are_those_of_a_timoshenko_beam():
    """The same bar of beam elements, free: bending, twisting and stretching within 0.6 %."""
    solid, _ = reduced(block(size=0.035, reduction="modes: 9, method: normal-modes"))
    beam, _ = reduced(
        bar(length=1.0, width=SIDE, height=SIDE, elements=24, theory="timoshenko", interfaces="", reduction="modes: 9")
    )
    np.testing.assert_allclose(np.sort(solid.frequencies)[:7], np.sort(beam.frequencies)[:7], rtol=6e-3)


def test_static_deflection_and_stress_of_a_cantilever(cantilever):
    """δ = F L³/3EI + F L/κGA; σ = F (L - x) c / I at half the length, away from the clamp: within 2 %."""
    F, second = 1000.0, SIDE**4 / 12
    tip = cantilever.interface("tip")
    q = tip.phi.T @ [0, 0, F] / cantilever.eigenvalues
    shear = F / (10 * 1.3 / (12 + 11 * 0.3) * E / 2.6 * SIDE**2)
    assert (tip.phi @ q)[2] == pytest.approx(F / (3 * E * second) + shear, rel=0.02)
    assert (tip.psi @ q)[1] == pytest.approx(-F / (2 * E * second), rel=0.02)
    place = cantilever.position[cantilever.stress.station_node]
    values = stress(cantilever, q)[0]
    top = np.flatnonzero((abs(place[:, 2] - SIDE / 2) < 1e-9) & (abs(place[:, 0] - 0.5) < 0.25))
    assert len(top) > 20
    expected = -F * (1 - place[top, 0]) * SIDE / 2 / second
    np.testing.assert_allclose(values[top, 0], expected, atol=0.02 * np.abs(expected).max())
    assert np.median(np.abs(values[top, 0] / expected - 1)) < 0.01


def test_stress_of_a_rotating_bar(cantilever):
    """σ = ρ ω² (L² - x²) / 2 about z through the clamped end; the modal force is Q_v of the invariants."""
    from flexible_reference import quadratic_velocity

    omega = np.array([0, 0, 100.0])
    n = len(cantilever.eigenvalues)
    q = (
        quadratic_velocity(cantilever.invariants, np.eye(3), omega, np.zeros(n), np.zeros(n))[6:]
        / cantilever.eigenvalues
    )
    place = cantilever.position[cantilever.stress.station_node]
    values = stress(cantilever, q)[0]
    inside = np.flatnonzero((place[:, 0] > 0.15) & (place[:, 0] < 0.9))
    expected = RHO * 100.0**2 * (1 - place[inside, 0] ** 2) / 2
    np.testing.assert_allclose(values[inside, 0], expected, atol=0.02 * RHO * 1e4 / 2)
    tip = cantilever.interface("tip")
    assert (tip.phi @ q)[0] == pytest.approx(RHO * 1e4 / (3 * E), rel=0.02)  # ρ ω² L³ / 3 E


def test_inertia_modes_carry_the_static_answer_to_inertia():
    """Without them ten normal modes, few of which stretch the bar, miss the stress at its root."""
    body, _ = reduced(block(interfaces=ROOT, reduction="modes: 4, reference: root"))
    from flexible_reference import quadratic_velocity

    n = len(body.eigenvalues)
    force = quadratic_velocity(body.invariants, np.eye(3), np.array([0, 0, 100.0]), np.zeros(n), np.zeros(n))[6:]
    place = body.position[body.stress.station_node]
    inside = (place[:, 0] > 0.15) & (place[:, 0] < 0.4)
    got = stress(body, force / body.eigenvalues)[0, inside, 0]
    expected = RHO * 1e4 * (1 - place[inside, 0] ** 2) / 2
    assert np.abs(got / expected - 1).max() > 0.05


def test_strain_energy_of_stresses_is_that_of_the_stiffness(rng):
    """½ ∫ σ : ε dV by our own elements against ½ uᵀ K u of scikit-fem."""
    model = assembled(block(length=0.4, size=0.1))
    u = 1e-4 * np.sin(7 * model.position + rng.normal(size=3)).ravel()[:, None]
    elements = model.elements
    (its,) = elements.blocks
    nodes = u[elements.freedoms[its.nodes]][..., 0]
    energy = 0.0
    D = its.elasticity[0, 0]
    for gradients, volume in its.points:
        g = np.einsum("enb,ena->eab", gradients, nodes)
        e = np.stack(
            [
                g[:, 0, 0],
                g[:, 1, 1],
                g[:, 2, 2],
                g[:, 0, 1] + g[:, 1, 0],
                g[:, 1, 2] + g[:, 2, 1],
                g[:, 2, 0] + g[:, 0, 2],
            ]
        )
        energy += 0.5 * np.einsum("e,ae,ab,be->", volume, e, D, e)
    assert energy == pytest.approx(0.5 * (u.T @ (model.stiffness @ u)).item(), rel=1e-10)


def test_linear_displacements_give_exact_stress_and_turn():
    """Patch test: any linear field has constant stress at every node, and a turn of half its curl."""
    model = assembled(block(length=0.4, size=0.15))
    G = 1e-3 * np.array([[1.0, 0.4, -0.2], [0.1, -0.5, 0.3], [0.6, -0.1, 0.2]])
    u = (model.position @ G.T).ravel()[:, None]
    lame, mu = E * 0.3 / (1.3 * 0.4), E / 2.6
    sigma = lame * np.trace(G) * np.eye(3) + mu * (G + G.T)
    expected = [sigma[0, 0], sigma[1, 1], sigma[2, 2], sigma[0, 1], sigma[1, 2], sigma[2, 0]]
    np.testing.assert_allclose(
        model.elements.stress(u)[:, :, 0], np.tile(expected, (len(model.position), 1)), rtol=1e-8
    )
    curl = [G[2, 1] - G[1, 2], G[0, 2] - G[2, 0], G[1, 0] - G[0, 1]]
    np.testing.assert_allclose(
        model.elements.turn(u)[:, :, 0], np.tile(np.array(curl) / 2, (len(model.position), 1)), rtol=1e-8
    )


@pytest.mark.parametrize("tie", ["rigid", "average"])
def test_tied_surface_carries_force_and_torque(tie):
    """Equilibrium: the load on a reference node is that on the body, whatever the tie; rigid motions stay rigid."""
    model = assembled(
        block(length=0.4, size=0.1, interfaces=f"tip: {{plane: {{point: [0.4, 0, 0], normal: [1, 0, 0]}}, tie: {tie}}}")
    )
    node = model.names["tip"]
    R = model.rigid_modes()
    motion = model.node_motion(R)
    np.testing.assert_allclose(model.stiffness @ R, 0, atol=1e-6 * np.abs(model.stiffness).max())
    for k in range(3):
        np.testing.assert_allclose(motion[node, :, k], np.eye(6)[k], atol=1e-10)
        np.testing.assert_allclose(motion[node, 3:, 3 + k], np.eye(3)[k], atol=1e-10)
        np.testing.assert_allclose(motion[:, :3, 3 + k], np.cross(np.eye(3)[k], model.position), atol=1e-10)


def test_average_tie_is_softer_than_a_rigid_one():
    """A rigid face keeps its shape: frequencies of the body with rigid ends are higher."""
    both = [
        reduced(
            block(
                interfaces=f"root: {{plane: {{point: [0, 0, 0], normal: [1, 0, 0]}}, tie: {tie}}}", reduction="modes: 3"
            )
        )[1].full
        for tie in ("average", "rigid")
    ]
    assert np.all(np.array(both[1][:4]) > np.array(both[0][:4]) * (1 - 1e-9))


def test_hot_spot_of_a_bent_bar_is_at_its_root(cantilever):
    tip = cantilever.interface("tip")
    q = tip.phi.T @ [0, 0, 1000.0] / cantilever.eigenvalues
    history = np.outer(np.sin(np.linspace(0, 2 * np.pi, 9)), q)
    spots = hot_spots(cantilever, history, count=3)
    assert spots[0].position[0] < 0.06
    assert spots[0].index in (2, 6)
    assert spots[0].value == pytest.approx(von_mises(stress(cantilever, q)[0]).max())
    assert abs(spots[0].signed) == pytest.approx(spots[0].value, rel=0.2)
    assert spots[0].value > spots[1].value > spots[2].value


def test_inertia_loads_add_up_to_mass_times_acceleration():
    model = assembled(block(length=0.4, size=0.15))
    body = FreeBody.of(model)
    loads, m, c = inertia_loads(body), RHO * 0.4 * 0.01, np.array([0.2, 0, 0])
    R = model.rigid_modes()
    np.testing.assert_allclose(R[:, :3].T @ loads["acceleration"], -m * np.eye(3), atol=1e-9)
    about = -m * np.cross(np.eye(3), c).T
    np.testing.assert_allclose(R[:, :3].T @ loads["angular_acceleration"], about, atol=1e-9)
    np.testing.assert_allclose((R[:, :3].T @ loads["centrifugal"])[:, 2], m * c, atol=1e-9)  # ω_z² pulls outwards
    np.testing.assert_allclose((R[:, :3].T @ loads["centrifugal"])[:, 3], [0, -m * 0.2, 0], atol=1e-9)  # ω_x ω_y


def test_parts_that_do_not_touch_are_refused():
    parts = "[{type: box, from: [0, 0, 0], to: [1, 1, 1]}, {type: box, from: [2, 0, 0], to: [3, 1, 1]}]"
    text = f"format: 1\nmaterials: {{{STEEL}}}\nsolid: {{parts: {parts}, material: steel, element_size: 1}}"
    with pytest.raises(ModelError, match="falls into 2 pieces"):
        reduced(text)


STEP = """
import gmsh, sys
gmsh.initialize(interruptible=False)
gmsh.option.setNumber("General.Terminal", 0)
gmsh.model.occ.addBox(0, 0, 0, 300, 100, 50)
gmsh.model.occ.synchronize()
gmsh.write(sys.argv[1])
"""


def test_step_file_gives_the_body_of_its_shape(tmp_path):
    """STEP files are in millimetres. Written by another process: the unit of the CAD kernel is one for a whole process."""
    subprocess.run([sys.executable, "-c", STEP, str(tmp_path / "part.step")], check=True, capture_output=True)
    text = f"format: 1\nmaterials: {{{STEEL}}}\nsolid: {{file: part.step, material: steel, element_size: 60 mm}}\nreduction: {{modes: 3}}"
    body, _ = reduced(text, tmp_path)
    assert body.mass == pytest.approx(RHO * 0.3 * 0.1 * 0.05)
    np.testing.assert_allclose(body.centre_of_mass, [0.15, 0.05, 0.025], atol=1e-9)


def test_mesh_that_would_fill_the_memory_is_refused():
    text = block(size=0.06).replace("element_size: 0.06", "element_size: 0.1 mm")
    with pytest.raises(ModelError, match=r"would make 8e\+10 elements; give a larger"):
        reduced(text)


def test_one_factor_is_kept_at_a_time(monkeypatch):
    """Factors are most of the memory of a reduction. Nothing asks SuperLU for L or U, which are copies."""
    alive, most = weakref.WeakSet(), []

    class Watched:
        def __init__(self, lu):
            self.solve = lu.solve

    def watched(*given, **options):
        lu = Watched(true(*given, **options))
        alive.add(lu)
        most.append(len(alive))
        return lu

    true = factor.spl.splu
    monkeypatch.setattr(factor.spl, "splu", watched)
    text = block(interfaces=f"{ROOT}, {TIP}", reduction="modes: 4, inertia_modes: true, stiffening: true")
    body = reduced(text.replace("element_size: ", "element_size: 2*"))[0]
    assert len(body.stiffening) > 3
    assert most == [1, 1, 1]
