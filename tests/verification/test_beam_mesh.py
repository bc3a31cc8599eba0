"""What linear elements of beams miss: of a cantilever under a load at its end 1/(4 n² - 1) of the energy that they have, 1/(4 n²) of the
deflection."""

import numpy as np
import pytest

from nivel.results.trust.beam_mesh import turns
from simulating import machine

LENGTH, EI, LOAD = 1.0, 2.07e11 * 0.01**4 / 12, 0.5


def bent(elements, order=1):
    """A cantilever at rest under a small load at its end."""
    rod = {
        "from": [0, 0, 0],
        "to": [LENGTH, 0, 0],
        "section": {"type": "rectangle", "width": 0.01, "height": 0.01},
        "material": {"density": 7850, "youngs_modulus": 2.07e11, "poisson_ratio": 0.3},
        "elements": elements,
        "order": order,
    }
    sections = {
        "beams": {"rod": rod},
        "joints": {"root": {"type": "fixed", "bodies": ["ground", "rod.start"], "point": [0, 0, 0]}},
        "forces": {"push": {"type": "force", "body": "rod.end", "vector": [0, LOAD, 0]}},
        "simulation": {"duration": 4e-3, "step": 1e-3, "integrator": "generalised-alpha", "start": "equilibrium"},
    }
    return machine(sections).simulate()


def line(result):
    return next((item for item in result.trust.items if item.name == "mesh"), None)


def test_missed_energy_of_a_cantilever_is_that_of_its_curvature():
    n, result = 4, bent(4)
    told = line(result)
    assert told.verdict == "amber"
    assert told.row == "rod"
    assert told.fraction == pytest.approx(1.0 / (4 * n**2 - 1), rel=1e-2)
    deflection = LOAD * LENGTH**3 / (3.0 * EI)
    short = 1.0 - result.array("rod.end.position")[-1, 1] / deflection
    assert short == pytest.approx(1.0 / (4 * n**2), rel=2e-2)


def test_a_fine_mesh_and_quadratic_elements_have_no_such_line():
    assert line(bent(8)) is None
    assert line(bent(2, order=2)) is None


def test_turns_of_axes_are_rotation_vectors():
    angle = np.array([0.3, -0.2, 0.5])
    size = np.linalg.norm(angle)
    first = np.array([0.5, 0.5, -0.5, 0.5])
    e0, e = np.cos(size / 2), np.sin(size / 2) * angle / size
    second = np.array([first[0] * e0 - first[1:] @ e, *(first[0] * e + e0 * first[1:] + np.cross(first[1:], e))])
    for sign in (1.0, -1.0):
        assert turns(np.array([first, sign * second]))[0] == pytest.approx(angle, abs=1e-14)
