"""Curved elements of order 2 and 3, whose outer nodes have a negative moment of inertia by themselves."""

import numpy as np
import pytest

from nivel.elements.beams.beam import Beam
from nivel.system.beam_nodes import lumps_of
from simulating import machine

ROOT = 0.7071067811865476


def arc(order, elements, **beam):
    """A quarter of a circle of radius 1 m, clamped at its foot; a strip, whose section hardly resists turning about its line."""
    rod = {
        "from": [0, 0, 0],
        "via": [ROOT, 0, 1 - ROOT],
        "to": [1, 0, 1],
        "section": {"type": "rectangle", "width": 0.04, "height": 0.005},
        "material": {"youngs_modulus": 210e9, "poisson_ratio": 0.3, "density": 7850},
        "elements": elements,
        "order": order,
        **beam,
    }
    wall = {"type": "fixed", "bodies": ["ground", "rod.start"], "point": [0, 0, 0]}
    return {"gravity": [0, 0, -9.81], "beams": {"rod": rod}, "joints": {"wall": wall}}


@pytest.mark.parametrize(("order", "elements"), [(2, 1), (2, 2), (3, 1)])
def test_curved_elements_fall_with_their_energy(order, elements):
    result = machine(arc(order, elements)).simulate(
        duration=0.02, step=5e-4, integrator="generalised-alpha", verify=False
    )
    assert result.outcome == "done"
    energy = result.array("kinetic_energy") + result.array("potential_energy")
    fallen = np.ptp(result.array("potential_energy"))
    assert np.ptp(energy) < 2e-3 * fallen


@pytest.mark.parametrize(("order", "elements"), [(2, 1), (2, 2), (3, 1)])
def test_lumped_nodes_have_positive_moments_and_those_of_the_line_together(order, elements):
    """∫ ρ J ds in global axes: the sections turn by the angle φ of the arc, over which cos² and sin² have the mean 1/2."""
    given = arc(order, elements, mass="lumped")["beams"]["rod"]
    beam = Beam(name="rod", **given)
    lumps = lumps_of(beam)
    assert min(np.linalg.eigvalsh(lumps.inertia).ravel()) > 0.0
    axes = beam.frames(beam.shares)[1]
    whole = np.einsum("nij,njk,nlk->il", axes, lumps.inertia, axes)
    along, across, up = np.diagonal(beam.properties.inertia)
    # z of the section is the normal of the plane of an arc, y lies in the plane
    wanted = 0.5 * np.pi * np.array([0.5 * (along + across), up, 0.5 * (along + across)])
    np.testing.assert_allclose(np.diagonal(whole), wanted, rtol=1e-2)
