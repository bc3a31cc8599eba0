"""(1 - s ∂f/∂y) x = r of the equations of motion, real and complex s, against ∂f/∂y by differences of f."""

from importlib import import_module

import numpy as np
import pytest

import machines
from nivel import Body, Bushing, Friction, Joint, MachineRecord, Marker, SpringDamper
from nivel.kernels.core.status import OK
from preparing import prepare
from unknowns import ROTATIONS


def sled():
    """A block with bristles on an inclined rail: a state of a force, and friction by the multipliers."""
    rub = Friction(
        name="rub",
        coordinate="rail",
        model="lugre",
        coefficient=0.25,
        static_coefficient=0.4,
        stribeck_speed=0.02,
        bristle_stiffness=100.0,
        bristle_damping=3.0,
    )
    return MachineRecord(
        name="sled",
        gravity=machines.GRAVITY,
        bodies=(Body(name="block", mass=2, inertia=(0.01, 0.02, 0.03), velocity=(0.1, 0.0, 0)),),
        joints=(Joint(name="rail", type="translational", bodies=("ground", "block"), point=(0, 0, 0), axis=(1, 0, 0)),),
        forces=(rub,),
    )


def loaded_tree():
    """Eight kinds of joints, and stiff springs and bushings between bodies that turn fast."""
    machine = machines.tree(np.random.default_rng(7))
    first, last = Marker(body="b0", position=(0.3, 0.1, 0)), Marker(body="b7", position=(0, 0.2, -0.4))
    return machine.replace(
        forces=(
            SpringDamper(name="spring", markers=(first, last), stiffness=900.0, damping=40.0, free_length=0.5),
            Bushing(
                name="bush",
                markers=(Marker(body="ground"), Marker(body="b4", position=(0.1, 0, 0))),
                stiffness=(300, 500, 400, 20, 30, 10),
                damping=(3, 5, 4, 2, 3, 1),
            ),
        )
    )


def loose():
    """Two free bodies with a spring."""
    rng = np.random.default_rng(3)
    ends = Marker(body="a", position=(0.3, 0.1, 0)), Marker(body="b", position=(0, 0.2, -0.4))
    return MachineRecord(
        name="loose",
        bodies=(machines.random_body("a", rng), machines.random_body("b", rng)),
        forces=(SpringDamper(name="spring", markers=ends, stiffness=900.0, damping=40.0, free_length=0.5),),
    )


def differences(motion, t, y):
    """∂f/∂y (ny, ny) by central differences."""
    out = np.zeros((len(y), len(y)))
    for j in range(len(y)):
        width = 1e-6 * max(1.0, abs(y[j]))
        for sign in (1, -1):
            moved = y.copy()
            moved[j] += sign * width
            out[:, j] += sign * motion.evaluate(t, moved)[1] / (2 * width)
    return out


@pytest.mark.parametrize("coordinates", ["absolute", "relative", *ROTATIONS])
@pytest.mark.parametrize("make", [machines.slider_crank, machines.four_bar, loaded_tree, loose, sled])
def test_solutions_satisfy_the_equations(make, coordinates, rng):
    """All entries but the energies at the end, on which nothing depends: of them x = r."""
    record, method = make(), {"integrator": "radau", "coordinates": coordinates}
    if coordinates in ROTATIONS:
        method |= {"formulation": "lagrange", "rotations": coordinates, "coordinates": "absolute"}
    record = record.replace(simulation=record.simulation.replace(**method))
    prepared = prepare(record, record.simulation.formulation, method["coordinates"])
    motion, y = prepared.motion, prepared.start.copy()
    states = len(motion.system.record.elements.state)
    y[len(y) - 2 - states : len(y) - 2] = 1e-3
    J = differences(motion, 0.0, y)[:-2, :-2]
    status, rate = motion.evaluate(0.0, y)
    assert status == OK
    r, imaginary = rng.standard_normal(len(y)), rng.standard_normal(len(y))
    shifted, s, z = motion.system.record.newton.shifted, 0.08, 0.05 - 0.06j
    shifted.real.r[:], shifted.pair.r[:] = r, r + 1j * imaginary
    assert (
        import_module("nivel.kernels.residual.tangent_entries").solve_shifted(motion.handle.address, 0.0, y, rate, s, z)
        == OK
    )
    for shift, x, b in ((s, shifted.real.r, r), (z, shifted.pair.r, r + 1j * imaginary)):
        expected = np.linalg.solve(np.eye(len(J)) - shift * J, b[:-2])
        np.testing.assert_allclose(x[:-2], expected, rtol=0, atol=1e-6 * np.abs(expected).max())
        assert np.array_equal(x[-2:], b[-2:])


@pytest.mark.parametrize("coordinates", ["absolute", "relative"])
@pytest.mark.parametrize("formulation", ["newton-euler", "penalty"])
@pytest.mark.parametrize("make", [machines.slider_crank, machines.four_bar, loaded_tree])
def test_feedback_and_penalties_are_part_of_them(make, formulation, coordinates, rng):
    """2α = 30/s and β² = 200/s², and penalties of twenty times the mass of a row, so soft that 1/α counts."""
    record = make()
    penalty = {"penalty": {"factor": 20.0}} if formulation == "penalty" else {}
    record = record.replace(
        simulation=record.simulation.replace(integrator="radau", formulation=formulation, **penalty)
    )
    prepared = prepare(record, formulation, coordinates)
    motion, y = prepared.motion, prepared.start.copy()
    motion.system.record.control.stabilise[:2] = 30.0, 200.0
    y += 1e-3 * rng.standard_normal(len(y))
    J = differences(motion, 0.0, y)[:-2, :-2]
    status, rate = motion.evaluate(0.0, y)
    assert status == OK
    r = rng.standard_normal(len(y))
    shifted, s = motion.system.record.newton.shifted, 0.08
    shifted.real.r[:], shifted.pair.r[:] = r, r
    solve = import_module("nivel.kernels.residual.tangent_entries").solve_shifted
    assert solve(motion.handle.address, 0.0, y, rate, s, complex(s)) == OK
    expected = np.linalg.solve(np.eye(len(J)) - s * J, r[:-2])
    for x in (shifted.real.r, shifted.pair.r):
        np.testing.assert_allclose(x[:-2], expected, rtol=0, atol=1e-6 * np.abs(expected).max())
