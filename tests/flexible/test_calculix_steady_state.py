"""Transmissibility of a flexible body on a moving base against CalculiX's *STEADY STATE DYNAMICS, on the same mesh."""

import itertools

import numpy as np
import pytest
import scipy.io
import scipy.linalg

import nivel
from nivel.flexible.body.body_file import write_body
from nivel.flexible.reduce import reduce

# A bar of 12 bricks (C3D8) of 10 x 20 x 20 mm along x, clamped at x = 0; node 4 i + 2 k + j + 1 is at (10 i, 20 j, 20 k) mm. CalculiX 2.20:
#
#     *MATERIAL, NAME=STEEL               *STEP                         *STEP
#     *ELASTIC                            *FREQUENCY, STORAGE=YES       *STEADY STATE DYNAMICS
#     210000., .3                         20                            200., 4000., 12, 1.
#     *DENSITY                            *END STEP                     *MODAL DAMPING
#     7.85e-9                                                           1, 20, 0.02
#     *BOUNDARY                                                         *DLOAD
#     1, 1, 3                                                           BAR, GRAV, 1., 0., 1., 0.
#     … (nodes 1 to 4)                                                  *NODE PRINT, NSET=SEEN
#                                                                       U
#
COUNT, LENGTH, SIDE, YOUNG, POISSON, DENSITY = 12, 0.01, 0.02, 210e9, 0.3, 7850.0
MIDDLE, TIP = 25, 49
FIRST = 1281.046  # Hz
# frequency [Hz]; displacements along y of the nodes MIDDLE and TIP [mm] from the base, which has an acceleration of -1 mm/s² along y
SEEN = [
    (200, 8.738478e-09 - 5.437245e-11j, 2.413938e-08 - 1.564641e-10j),
    (396.554, 9.404967e-09 - 1.253960e-10j, 2.607154e-08 - 3.612828e-10j),
    (593.108, 1.077645e-08 - 2.480059e-10j, 3.004860e-08 - 7.158465e-10j),
    (789.662, 1.356341e-08 - 5.288180e-10j, 3.813326e-08 - 1.529680e-09j),
    (986.216, 2.040871e-08 - 1.521813e-09j, 5.799847e-08 - 4.411138e-09j),
    (1182.77, 5.283946e-08 - 1.315183e-08j, 1.521437e-07 - 3.817495e-08j),
    (1528.22, -1.891282e-08 - 2.170591e-09j, -5.619879e-08 - 6.290195e-09j),
    (2022.58, -5.186914e-09 - 2.369852e-10j, -1.639672e-08 - 6.714345e-10j),
    (2516.93, -2.540539e-09 - 8.448236e-11j, -8.780620e-09 - 2.225332e-10j),
    (3011.29, -1.460595e-09 - 4.512148e-11j, -5.736328e-09 - 1.002180e-10j),
    (3505.64, -8.811134e-10 - 3.136024e-11j, -4.177231e-09 - 4.917847e-11j),
    (4000, -5.132117e-10 - 2.722626e-11j, -3.278067e-09 - 2.097518e-11j),
]
CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))


def matrices():
    """K [N/m] and M [kg] of the bar: trilinear bricks with 2 x 2 x 2 points of Gauss, consistent mass (Bathe 2014, §5.3)."""
    lame, shear = YOUNG * POISSON / (1 + POISSON) / (1 - 2 * POISSON), YOUNG / 2 / (1 + POISSON)
    law = np.diag([2 * shear] * 3 + [shear] * 3)
    law[:3, :3] += lame
    size, signs = np.array([LENGTH, SIDE, SIDE]), 2.0 * np.array(CORNERS) - 1.0
    volume = size.prod()
    k, m = np.zeros((24, 24)), np.zeros((24, 24))
    for point in itertools.product((-(3**-0.5), 3**-0.5), repeat=3):
        factors = 0.5 * (1.0 + signs * point)
        shape = factors.prod(axis=1)
        slope = np.stack([signs[:, a] * np.delete(factors, a, 1).prod(axis=1) / size[a] for a in range(3)], axis=1)
        strain = np.zeros((6, 24))
        for a in range(3):
            strain[a, a::3] = slope[:, a]
        for row, (a, b) in enumerate(((0, 1), (0, 2), (1, 2)), 3):
            strain[row, a::3], strain[row, b::3] = slope[:, b], slope[:, a]
        k += strain.T @ law @ strain * volume / 8.0
        m += np.kron(np.outer(shape, shape), np.eye(3)) * DENSITY * volume / 8.0
    K, M = np.zeros((2, 12 * (COUNT + 1), 12 * (COUNT + 1)))
    for e in range(COUNT):
        places = np.concatenate([3 * (4 * (e + i) + 2 * z + y) + np.arange(3) for i, y, z in CORNERS])
        K[np.ix_(places, places)] += k
        M[np.ix_(places, places)] += m
    return K, M


def test_the_transmissibility_of_a_bar_is_that_of_calculix(tmp_path):
    K, M = matrices()
    free = slice(12, None)
    first = scipy.linalg.eigh(K[free, free], M[free, free], eigvals_only=True, subset_by_index=[0, 0])[0] ** 0.5
    assert first / (2.0 * np.pi) == pytest.approx(FIRST, rel=1e-6)  # the elements are those of CalculiX
    for name, matrix in (("k", K), ("m", M)):
        scipy.io.mmwrite(tmp_path / f"{name}.mtx", scipy.sparse.coo_array(matrix), symmetry="symmetric")
    nodes = (
        f"{4 * i + 2 * k + j + 1}, {LENGTH * i}, {SIDE * j}, {SIDE * k}"
        for i in range(COUNT + 1)
        for k in (0, 1)
        for j in (0, 1)
    )
    (tmp_path / "nodes.csv").write_text("id, x, y, z\n" + "\n".join(nodes), encoding="utf-8")
    (tmp_path / "bar.yaml").write_text(
        f"""
format: 1
name: bar
matrices: {{format: matrix-market, stiffness: k.mtx, mass: m.mtx, nodes: nodes.csv}}
interfaces:
  root: {{plane: {{point: [0, 0, 0], normal: [1, 0, 0]}}}}
  middle: {{node: {MIDDLE}}}
  tip: {{node: {TIP}}}
reduction: {{modes: 40, reference: root}}
""",
        encoding="utf-8",
    )
    write_body(reduce(tmp_path / "bar.yaml").body, tmp_path / "bar.nc")
    (tmp_path / "machine.yaml").write_text(
        """
format: 1
gravity: [0, 0, 0]
bodies: {base: {mass: 1, inertia: [1, 1, 1]}, bar: {flexible: {file: bar.nc, damping_ratio: 0.02}}}
markers:
  middle: {body: bar, interface: middle}
  tip: {body: bar, interface: tip}
joints:
  rail: {type: translational, bodies: [ground, base], point: [0, 0, 0], axis: [0, 1, 0]}
  clamp: {type: fixed, bodies: [base, bar], interface: root}
drivers: {shake: {coordinate: rail, value: "0 m"}}
sensors:
  at_middle: {marker: middle, quantity: position}
  at_tip: {marker: tip, quantity: position}
simulation: {duration: 1 s}
""",
        encoding="utf-8",
    )
    machine = nivel.load(tmp_path / "machine.yaml")
    model = machine.linearise(inputs=["shake"], outputs=["base.position.y", "at_middle.y", "at_tip.y"])
    frequencies, middle, tip = np.array(SEEN).T
    passed = model.transmissibility("base.position.y", frequencies=frequencies.real)
    for name, seen in (("middle", middle), ("tip", tip)):
        # 1 mm of the base is an acceleration of -ω² mm/s²
        wanted = 1.0 + (2.0 * np.pi * frequencies.real) ** 2 * seen
        found = passed.sel(output=f"sensor.at_{name}.y").values
        np.testing.assert_allclose(found, wanted, rtol=1e-3)
