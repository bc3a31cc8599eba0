"""Redundant joints between flexible bodies: modes count in the rank, what is left redundant is named and run knowingly."""

import numpy as np
import pytest
from scipy.linalg import block_diag

import flexible_reference as reference
from models import bar, reduced
from nivel import Body, Friction, Joint, MachineRecord
from nivel.analysis.assembly.penalties import mobility
from nivel.analysis.assembly.redundancy import modal_rows
from nivel.errors import ModelError
from nivel.flexible.body.body_file import write_body
from preparing import prepare
from running import run

pytestmark = pytest.mark.covering

ALONG = "reference: mean-axis, modes: given, shapes: [{y: x^2}, {y: x^3}, {y: x^4}]"
PAIRS = (("ground", "left"), ("left", "top"), ("top", "right"), ("ground", "right"))
SPACE, PLANE = "modes: 3", ALONG


def four_bar(folder, reduction, *, redundant=True, forces=(), lean=0.0):
    """A square of bars of 1 m on hinges along z, or on two of these, a spherical and a universal joint; its sides may lean [degrees]."""
    x, y = float(np.sin(np.radians(lean))), float(np.cos(np.radians(lean)))
    points = ((0, 0, 0), (x, y, 0), (1 + x, y, 0), (1, 0, 0))
    body, _ = reduced(bar(length=1.0, width=0.02, height=0.021, elements=8, reduction=reduction))
    write_body(body, folder / "rod.nc")
    flexible = {"file": str(folder / "rod.nc"), "damping_ratio": 0.02}
    places = (("left", (0, 0, 0), 90 - lean), ("top", points[1], 0), ("right", (1, 0, 0), 90 - lean))
    bodies = tuple(
        Body(name=name, flexible=flexible, position=place, orientation={"axis": (0, 0, 1), "angle": f"{angle} deg"})
        for name, place, angle in places
    )
    joints = []
    for k, (pair, point) in enumerate(zip(PAIRS, points, strict=True)):
        if redundant or k in (0, 3):
            joint = Joint(name=f"hinge{k}", type="revolute", bodies=pair, point=point, axis=(0, 0, 1))
        elif k == 1:
            joint = Joint(name="hinge1", type="spherical", bodies=pair, point=point)
        else:
            joint = Joint(name="hinge2", type="universal", bodies=pair, point=point, axes=((0, 1, 0), (0, 0, 1)))
        joints.append(joint)
    return MachineRecord(name="square", gravity=(3.0, -9.81, 0.0), bodies=bodies, joints=tuple(joints), forces=forces)


def test_modal_columns_are_those_of_the_kernels(tmp_path):
    """The diagonal of S = C_q M⁻¹ C_qᵀ, with M of the NumPy reference and C_q of bodies and modes."""
    machine = four_bar(tmp_path, SPACE)
    prepared = prepare(machine)
    prepared.absolute.evaluate(0.0, prepared.assembly.y)
    system = prepared.absolute.system
    modes = modal_rows(machine, system)
    body = modes.bending[0].reduced
    n = len(body.eigenvalues)
    columns = modes.columns(prepared.absolute) / (np.sqrt(body.mass) * system.size)
    rigid = prepared.absolute.jacobian()
    parts, blocks = [], []
    for k in range(3):
        parts += [rigid[:, 6 * k : 6 * k + 6], columns[:, n * k : n * k + n]]
        blocks.append(reference.mass_matrix(body.invariants, system.record.bodies.A[k], np.zeros(n)))
    J, M = np.hstack(parts), block_diag(*blocks)
    expected = np.einsum("ri,ri->r", J, np.linalg.solve(M, J.T).T)
    np.testing.assert_allclose(mobility(prepared.motion, prepared.start), expected, rtol=1e-9)
    assert np.abs(columns).max() > 0.1


def test_bodies_that_bend_out_of_the_plane_are_not_redundant(tmp_path):
    redundancy = prepare(four_bar(tmp_path, SPACE)).redundancy
    assert redundancy.redundant_rows == redundancy.non_unique_joints == ()
    rows, modes = (
        4 * 5,
        3 * len(reduced(bar(length=1.0, width=0.02, height=0.021, elements=8, reduction=SPACE))[0].eigenvalues),
    )
    assert redundancy.rank == rows
    assert redundancy.degrees_of_freedom == 3 * 6 + modes - rows


def test_bodies_that_bend_in_the_plane_only_are_redundant_out_of_it(tmp_path):
    redundancy = prepare(four_bar(tmp_path, PLANE)).redundancy
    assert len(redundancy.redundant_rows) == 3
    assert not any(row.endswith(("s.x", "s.y")) for row in redundancy.redundant_rows)
    assert set(redundancy.non_unique_joints) == {"hinge0", "hinge1", "hinge2", "hinge3"}
    assert redundancy.degrees_of_freedom == 1 + 3 * 3


def test_a_square_of_bars_with_one_bend_out_of_the_plane_is_singular(tmp_path):
    """A symmetric bend turns the ends of a bar against each other about its perpendicular bisector. Three lines in a plane take up the
    three constraints out of it unless they meet or are parallel: those of two sides of a square are one line, those of leaning ones two."""
    out = "reference: mean-axis, modes: given, shapes: [{z: x^2 - x}]"
    with pytest.raises(ModelError, match="starts in a singular position"):
        prepare(four_bar(tmp_path, out))
    assert prepare(four_bar(tmp_path, out, lean=20.0)).redundancy.redundant_rows == ()


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
@pytest.mark.parametrize("reduction", [SPACE, PLANE], ids=["space", "plane"])
@pytest.mark.parametrize(("integrator", "step"), [("rk4", 5e-5), ("generalised-alpha", 1e-3)])
def test_redundant_square_moves_like_the_determinate_one(tmp_path, reduction, integrator, step, coordinates):
    """Motion and reactions in the plane are unique whatever is redundant; nothing pushes out of the plane."""
    settings = {"integrator": integrator, "step": step, "duration": 0.2, "output_interval": 0.02}
    settings["coordinates"] = coordinates
    if integrator != "rk4":
        # what little is left of an iteration pushes against the stiffness out of the plane
        settings["corrector"] = {"tolerance": 1e-12}
    r = run(four_bar(tmp_path, reduction), **settings)
    plain = run(four_bar(tmp_path, reduction, redundant=False), **settings)
    assert r.finished.outcome == "done"
    assert np.ptp(r.joint_coordinate[:, 0]) > 0.05
    np.testing.assert_allclose(r.position, plain.position, atol=1e-7)
    scale = np.abs(plain.joint_force).max()
    np.testing.assert_allclose(r.joint_force[..., :2], plain.joint_force[..., :2], atol=1e-4 * scale)
    np.testing.assert_allclose(r.joint_force[..., 2], 0.0, atol=1e-7 * scale)
    assert np.abs(r.constraint_violation).max() < 1e-9


@pytest.mark.parametrize("reduction", [SPACE, PLANE], ids=["space", "plane"])
def test_redundant_square_in_independent_coordinates(tmp_path, reduction):
    """Also the reactions that are chosen of many are the same ones; where modes alone tell rows apart, some depend on the others."""
    settings = {"integrator": "rk4", "step": 5e-5, "duration": 0.1, "output_interval": 0.02}
    machine = four_bar(tmp_path, reduction)
    expected = run(machine, coordinates="absolute", **settings)
    r = run(machine, **settings, coordinates="independent")
    assert r.finished.outcome == "done"
    np.testing.assert_allclose(r.position, expected.position, atol=1e-8)
    scale = np.abs(expected.joint_force).max()
    np.testing.assert_allclose(r.joint_force, expected.joint_force, atol=1e-4 * scale)
    np.testing.assert_allclose(r.joint_torque, expected.joint_torque, atol=1e-4 * scale)
    assert np.abs(r.constraint_violation).max() < 1e-9
    system = r.prepared.motion.system
    dependent = system.record.partition.column[: int(system.record.control.rank[0])]
    assert np.any(dependent >= 6 * system.body_count) == (reduction is SPACE)


def test_friction_needs_a_unique_load(tmp_path):
    """As between rigid bodies, where the joint that loads it is loose; modes out of the plane make its reaction unique."""
    rub = Friction(
        name="rub", model="coulomb", coordinate="hinge0.angle", coefficient=0.1, radius=0.02, transition_speed=0.01
    )
    with pytest.raises(ModelError, match="the reaction of hinge0, which loads this friction, is not unique"):
        prepare(four_bar(tmp_path, PLANE, forces=(rub,)))
    prepare(four_bar(tmp_path, SPACE, forces=(rub,)))
