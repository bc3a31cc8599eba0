"""Motions that hardly cost energy though they are not rigid: mechanisms, and hourglass modes of elements with strain at one point."""

import shutil
from types import SimpleNamespace

import numpy as np
import pytest
import scipy.sparse as sp

from nivel.elements.beams.sections import Material
from nivel.flexible.checks.findings import _hourglass_statement
from nivel.flexible.model import solid_shapes as shapes
from nivel.flexible.model.solid_elements import SolidBlock, SolidElements, elasticity
from nivel.flexible.reduce import reduce
from nivel.flexible.reduction.factor import NoStiffnessError, lowest_modes
from test_shells import by_calculix, deck, model_file

STEEL = Material.model_construct(youngs_modulus=210e9, poisson_ratio=0.3, density=7850.0)
CORNERS = np.array(
    [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], dtype=float
)


def strip(shape, count=4):
    """Bricks 1 m × 1 m × 0.1 m in a row along x."""
    position = np.concatenate([CORNERS + np.array([k, 0, 0]) for k in range(count)]) * [1.0, 1.0, 0.1]
    nodes = np.arange(8 * count).reshape(count, 8)
    freedoms = np.arange(24 * count).reshape(-1, 3)
    block = SolidBlock(shape, nodes, position, elasticity=elasticity(STEEL)[None, None])
    return SolidElements((block,), freedoms, position)


def bent(elements, curvature=1e-3):
    """u_x = -κ x z, u_z = κ x²/2, about the middle."""
    x, z = elements.position[:, 0], elements.position[:, 2] - 0.05
    return np.stack([-curvature * x * z, 0.0 * x, 0.5 * curvature * x**2], axis=1).ravel()[:, None]


def test_strain_energy_of_a_stretch_is_its_closed_form():
    """E ε²/2 · V, with ε_y = ε_z = -ν ε."""
    for shape in (shapes.HEXAHEDRON_8, shapes.HEXAHEDRON_8_CENTRE):
        elements = strip(shape)
        stretched = (elements.position * [1e-3, -0.3e-3, -0.3e-3]).ravel()[:, None]
        assert elements.strain_energy(stretched) == pytest.approx(0.5 * 210e9 * 1e-6 * elements.volume, rel=1e-12)
        assert elements.has_one_point == (shape is shapes.HEXAHEDRON_8_CENTRE)


@pytest.mark.parametrize(("shape", "told"), [(shapes.HEXAHEDRON_8, False), (shapes.HEXAHEDRON_8_CENTRE, True)])
def test_a_mode_that_only_hourglass_control_resists_is_told(shape, told):
    """The energy of the mode is that of bending with all eight points; of these an element of one layer with its middle has none."""
    elements, known = strip(shape), strip(shapes.HEXAHEDRON_8)
    mode = bent(elements)
    body = SimpleNamespace(model=SimpleNamespace(elements=elements, expansion=sp.eye_array(len(mode))))
    said = _hourglass_statement(body, 2.0 * known.strain_energy(mode), mode)
    assert bool(said) == told
    if told:
        assert "1 of 1 modes of the free body are hourglass modes" in said[0]
        assert "S4 or S8R" in said[0]


@pytest.mark.parametrize(("kind", "told"), [("S4R", True), ("S8R", False)])
def test_shells_of_calculix_that_bend_by_hourglass_control_are_told(tmp_path, kind, told):
    """Bending of a free strip, the first mode: S8R has it at 3349 Hz, S4R at 4698 Hz by its control alone."""
    if shutil.which("ccx") is None:
        pytest.skip("CalculiX, the program ccx, is not installed")
    by_calculix(tmp_path, deck(kind))
    found = reduce(model_file(tmp_path, interfaces="", reduction="modes: 6, method: normal-modes")).findings
    said = [text for text in found.statements if "hourglass modes: in mode 1" in text]
    assert bool(said) == told
    assert not told or "S4 or S8R" in said[0]


def test_a_mechanism_without_mass_is_a_motion_that_costs_no_energy():
    """Two springs in a row, and a mass beside them that nothing holds."""
    K = sp.csc_array(
        np.array([[2.0, -1.0, 0.0, 0.0], [-1.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, -1.0], [0.0, 0.0, -1.0, 1.0]])
    )
    M = sp.csc_array(np.diag([1.0, 1.0, 0.0, 0.0]))
    with pytest.raises(NoStiffnessError) as told:
        lowest_modes(K, M, 2, lambda load: load)
    motion = told.value.motion
    assert np.abs(K @ motion).max() < 1e-12
    assert motion[2] == pytest.approx(motion[3])
