"""What linear elements of beams miss: of a cantilever under a load at its end 1/(4 n² - 1) of the energy that they have, 1/(4 n²) of the
deflection."""

import numpy as np
import pytest

from nivel.judge.after.checks.beams import BeamMesh, coarsest, turns
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


def test_one_linear_element_lacks_a_third_of_its_energy():
    """A curvature that falls to nothing along the element, and the constant one that it has: 1/3 to 1/4."""
    result = bent(1)
    assert (line(result).verdict, line(result).fraction) == ("red", pytest.approx(1.0 / 3.0, rel=1e-2))
    assert result.array("rod.end.position")[-1, 1] == pytest.approx(0.75 * LOAD * LENGTH**3 / (3.0 * EI), rel=1e-2)


def test_quadratic_elements_are_told_by_how_the_slope_of_curvature_changes():
    """An even load w on a cantilever of n elements: κ'' = w/(E I), so w² L⁵/(1440 n⁴ E I) is missed of w² L⁵/(40 E I)."""
    n = 3
    places = np.linspace(0.0, LENGTH, 2 * n + 1)
    angles = 1e-3 * (LENGTH**3 - (LENGTH - places) ** 3) / 6.0
    theta = np.zeros((1, 2 * n + 1, 4))
    theta[0, :, 0], theta[0, :, 3] = np.cos(angles / 2), np.sin(angles / 2)
    names = tuple(f"n{k}" for k in range(2 * n + 1))
    beam = BeamMesh("rod", names, np.diff(places), np.full(3, EI), np.zeros((2 * n, 3)), 2)
    found = coarsest(Frames(theta, names), [beam])
    assert (found.elements, found.order) == (n, 2)
    assert found.share == pytest.approx(1.0 / (36.0 * n**4), rel=0.03)


class Frames:
    """A result of one frame of these orientations, without energies."""

    attributes = variables = {}  # noqa: RUF012
    time = np.zeros(1)

    def __init__(self, theta, names):
        self.theta, self.coordinates = theta, {"body": names}

    def array(self, _name, frames=slice(None)):
        return self.theta[frames]


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
