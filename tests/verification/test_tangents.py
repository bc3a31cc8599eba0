"""Exact derivatives of the residual against extrapolated differences: every joint, force, coupling, driver and machine, in motion."""

import numpy as np

from force_zoo import CASES
from nivel.integrate.newmark.newton_state import set_state
from tangent_zoo import COORDINATES, EACH, EVERY_FORMULATED, state_of
from unknowns import SHARES, Unknowns

# of the largest entry in each row; the differences are good for 2e-11, mostly for 1e-12
TOLERANCE = 5e-11


@EVERY_FORMULATED
def test_matrix_is_the_derivative_of_the_residual(name, coordinates, rng):
    """∂(r, ẋ - rates, C/cq)/∂(v̇, ẋ, λ) with positions, velocities and states moved by v̇ and ẋ; rotations once as they are, once in the
    middle of a step, where v̇ moves the rotation vector of the step and columns are for turns after it."""
    here = state_of(name, coordinates, rng)
    # all unknowns together may take bodies off surfaces that they touch
    directions = 3 if name not in CASES or CASES[name].touches is None else None
    for change in (None, rng.uniform(-0.5, 0.5, here.n)):
        unknowns = Unknowns(here, change)
        assert unknowns.error(directions) < TOLERANCE


@COORDINATES
@EACH
def test_newton_moves_the_state_as_its_matrix_has_it(name, coordinates, rng):
    """q = base ∘ exp(turn + cq v̇), v = speed + cv v̇, x = state + cx ẋ."""
    here = state_of(name, coordinates, rng)
    unknowns = Unknowns(here, rng.uniform(-0.5, 0.5, here.n))
    newton, residual = here.motion.system.record.newton, here.motion.system.record.residual
    (cq, cv, cx), n, p = SHARES, here.n, here.positions
    newton.base[:p] = unknowns.base
    newton.turn[:], newton.correction[:] = unknowns.change - cq * here.vdot - 0.25, 0.25
    newton.speed[:] = here.y[p : p + n] - cv * here.vdot
    newton.state[:] = here.y[p + n : -2] - cx * here.xdot
    z = unknowns.z + rng.uniform(-1, 1, len(unknowns.z))
    residual.vdot[:], newton.rate[:] = z[:n], z[n : n + here.states]
    set_state(here.motion.handle.address, cq, cv, cx)
    largest = 1.0 + np.abs(z).max(initial=0.0)
    np.testing.assert_allclose(residual.y[:-2], unknowns.state(z)[:-2], atol=1e-14 * largest)


def test_states_are_where_the_surfaces_of_contacts_and_stops_are_meant_to_be(rng):
    """What is verified above is a contact that touches, or one that does not."""
    for name, case in CASES.items():
        if case.touches is None:
            continue
        here = state_of(name, "absolute", rng)
        surfaces = here.motion.system.record.watched.surface
        depths = [float(here.motion.system.record.elements.depth[tuple(each)]) for each in surfaces]
        assert (max(depths) > 0.01) == case.touches, (name, depths)
        assert case.touches or max(depths) < -0.01, (name, depths)
