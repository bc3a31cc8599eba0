"""Stress measures, histories, hot spots, rainflow, VTK."""

import base64
import struct
import xml.etree.ElementTree as ET
from collections import Counter

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from models import bar, reduced
from needing import needs
from nivel.errors import ModelError
from nivel.flexible.body.recovery import (
    BLOCK,
    Cycle,
    counted,
    displacement,
    envelope,
    hot_spots,
    principal,
    rainflow,
    reversals,
    signed_principal,
    stations_at,
    strain,
    stress,
    von_mises,
)
from nivel.flexible.body.vtk import write_modes, write_motion
from nivel.results.frames.loads import FatigueCurve

L, B, H, E = 2.0, 0.02, 0.03, 210e9


@pytest.fixture(scope="module")
def cantilever():
    return reduced(bar(elements=16, reduction="modes: 8, reference: root", more="recovery: {strain: true}"))[0]


@pytest.fixture(scope="module")
def bent(cantilever):
    """Modal coordinates for a tip force of 50 N along z."""
    return cantilever.interface("tip").phi.T @ [0, 0, 50.0] / cantilever.eigenvalues


def test_measures_of_simple_stresses():
    """Uniaxial: σ; pure shear: √3 τ and ±τ; hydrostatic: none."""
    pull, shear, even = np.array([[100.0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 50, 0], [-7, -7, -7, 0, 0, 0]])
    assert von_mises(np.array([pull, shear, even])) == pytest.approx([100, np.sqrt(3) * 50, 0])
    np.testing.assert_allclose(principal(shear), [-50, 0, 50], atol=1e-12)
    assert signed_principal(np.array([pull, -pull, even])) == pytest.approx([100, -100, -7])


def test_von_mises_does_not_depend_on_axes(rng):
    S = rng.normal(size=(3, 3))
    S = S + S.T
    Q = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    six = [np.array([T[0, 0], T[1, 1], T[2, 2], T[0, 1], T[1, 2], T[2, 0]]) for T in (S, Q @ S @ Q.T)]
    assert von_mises(six[0]) == pytest.approx(von_mises(six[1]))
    np.testing.assert_allclose(principal(six[0]), np.linalg.eigvalsh(S))


def test_stress_along_a_cantilever(cantilever, bent):
    """σ = F (L - x) z / I at every fibre of every element."""
    modes = cantilever.stress
    values = stress(cantilever, bent)[0, :, 0]
    x = cantilever.position[modes.station_node, 0]
    z = np.array([float(label.split("z ")[1]) for label in modes.labels])
    np.testing.assert_allclose(values, -50 * (L - x) * z / (B * H**3 / 12), atol=1e-5 * np.abs(values).max())


def test_strain_is_stress_over_modulus(cantilever, bent):
    sigma, epsilon = stress(cantilever, bent)[0], strain(cantilever, bent)[0]
    np.testing.assert_allclose(epsilon[:, 0], sigma[:, 0] / E, atol=1e-15)
    np.testing.assert_allclose(epsilon[:, 1], -0.3 * sigma[:, 0] / E, atol=1e-15)
    np.testing.assert_allclose(epsilon[:, 5], sigma[:, 5] / (E / 2.6), atol=1e-15)


def test_displacement_of_the_tip(cantilever, bent):
    moved = displacement(cantilever, np.array([0 * bent, bent]))
    tip = cantilever.interface("tip").node
    assert np.all(moved[0] == 0)
    assert moved[1, tip, 2] == pytest.approx(50 * L**3 / (3 * E * B * H**3 / 12), rel=1e-6)


def test_envelope_finds_the_moment_also_across_blocks(cantilever, bent, monkeypatch):
    """The worst state of a history of a thousand moments, read in blocks of a few."""
    monkeypatch.setattr("nivel.flexible.body.recovery.BLOCK", 6 * len(cantilever.stress.station_node) * 7)
    assert 6 * len(cantilever.stress.station_node) * 7 < BLOCK
    size = np.sin(np.linspace(0, 20, 1000)) * np.linspace(0, 1, 1000)
    found = envelope(cantilever, np.outer(size, bent))
    assert found.worst == np.argmax(np.abs(size))
    alone = von_mises(stress(cantilever, bent)[0]) * np.abs(size).max()
    np.testing.assert_allclose(found.value, alone, rtol=1e-10)


def test_hot_spots_are_apart_and_in_order(cantilever, bent):
    spots = hot_spots(cantilever, bent[None], count=4, apart=0.1)
    assert spots[0].position[0] == 0
    assert [spot.value for spot in spots] == sorted((spot.value for spot in spots), reverse=True)
    places = np.array([spot.position for spot in spots])
    distances = np.linalg.norm(places[:, None] - places, axis=-1) + 10 * np.eye(4)
    assert distances.min() > 0.1 * 2.0 * 0.999
    assert spots[0].node_id == 1
    assert "z" in spots[0].label


def test_stations_of_nodes(cantilever):
    assert len(stations_at(cantilever, 1)) == 8  # one element, eight fibres
    assert len(stations_at(cantilever, 5)) == 16  # between two
    with pytest.raises(ModelError, match="node 99"):
        stations_at(cantilever, 99)


def test_body_without_stress_says_what_to_do(cantilever):
    body, _ = reduced(bar(more="recovery: {stress: false}"))
    with pytest.raises(ModelError, match=r"recovery: \{stress: true\}"):
        stress(body, np.zeros(len(body.eigenvalues)))
    plain, _ = reduced(bar())
    with pytest.raises(ModelError, match=r"recovery: \{strain: true\}"):
        strain(plain, np.zeros(len(plain.eigenvalues)))


def test_stress_of_chosen_nodes_only():
    body, _ = reduced(bar(more="recovery: {nodes: [1, 2]}"))
    assert set(body.node_ids[body.stress.station_node]) == {1, 2}


def test_rainflow_of_the_example_of_the_standard():
    """ASTM E1049-85, figure 6: history -2 1 -3 5 -1 3 -4 4 -2 has the cycles 0.5 of 3, 1.5 of 4, 0.5 of 6, 1 of 8, 0.5 of 9."""
    cycles = rainflow(np.array([-2, 1, -3, 5, -1, 3, -4, 4, -2]))
    assert counted(cycles) == {3: 0.5, 4: 1.5, 6: 0.5, 8: 1.0, 9: 0.5}
    assert Counter((c.range, c.mean, c.count) for c in cycles)[4, 1, 1.0] == 1  # E–F, from -1 to 3


def test_rainflow_of_a_sine_is_its_amplitude():
    cycles = rainflow(3 + 2 * np.sin(np.linspace(0, 20 * np.pi, 2001)))
    assert sum(c.count for c in cycles if abs(c.range - 4) < 1e-3) == pytest.approx(9.5)
    assert all(abs(c.mean - 3) < 1e-3 for c in cycles if abs(c.range - 4) < 1e-3)


@given(st.lists(st.integers(-20, 20), min_size=2, max_size=60))
def test_rainflow_counts_every_reversal_half(history):
    """Each cycle takes two half ranges: twice the counts are the ranges between reversals; the greatest is that of the history."""
    points = reversals(np.array(history, dtype=float))
    cycles = rainflow(np.array(history, dtype=float))
    if len(points) < 2:
        assert sum(c.count for c in cycles) in (0, 0.5)
        return
    assert 2 * sum(c.count for c in cycles) == len(points) - 1
    assert max(c.range for c in cycles) == np.ptp(points)


def test_history_without_reversals_has_no_cycle():
    assert rainflow(np.full(5, 3.0)) == []
    assert rainflow(np.zeros(0)) == []
    assert counted(rainflow(np.array([0.0, 1.0, 2.0]))) == {2.0: 0.5}


def decoded(element):
    raw = base64.b64decode(element.text)
    (length,) = struct.unpack("<Q", raw[:8])
    assert len(raw) == 8 + length
    dtype = {"Float64": "<f8", "Int64": "<i8", "UInt8": "u1"}[element.get("type")]
    return np.frombuffer(raw[8:], dtype).reshape(-1, int(element.get("NumberOfComponents")))


def arrays(path):
    return {each.get("Name"): decoded(each) for each in ET.parse(path).iter("DataArray")}


def test_vtk_files_hold_the_motion(cantilever, bent, tmp_path):
    turned = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    files = write_motion(
        cantilever,
        tmp_path / "a.pvd",
        np.array([0.0, 0.5]),
        np.array([0 * bent, bent]),
        np.array([[0, 0, 0], [5.0, 0, 0]]),
        np.array([np.eye(3), turned]),
    )
    assert [path.name for path in files] == ["a.pvd", "a-0001.vtu", "a-0002.vtu"]
    listed = [(float(each.get("timestep")), each.get("file")) for each in ET.parse(files[0]).iter("DataSet")]
    assert listed == [(0.0, "a-0001.vtu"), (0.5, "a-0002.vtu")]
    first, second = arrays(files[1]), arrays(files[2])
    np.testing.assert_array_equal(first["Points"], cantilever.position)
    np.testing.assert_allclose(
        second["Points"], (cantilever.position + displacement(cantilever, bent)[0]) @ turned.T + [5, 0, 0]
    )
    assert second["von_mises_stress"].max() == pytest.approx(von_mises(stress(cantilever, bent)[0]).max())
    assert list(first["types"][:, 0]) == [3] * 16
    assert first["offsets"][-1, 0] == len(first["connectivity"]) == 32


def test_vtk_files_are_read_by_another_program(tmp_path):
    meshio = needs("gmsh", "meshio")
    from models import block

    body, _ = reduced(block(length=0.3, size=0.1, reduction="modes: 3"))
    files = write_modes(body, tmp_path / "modes.pvd")
    assert len(files) == 1 + 3
    grid = meshio.read(files[1])
    np.testing.assert_array_equal(grid.points, body.position)
    np.testing.assert_array_equal(grid.cells_dict["tetra10"], body.solids)
    size = np.linalg.norm(np.ptp(body.position, axis=0))
    assert np.linalg.norm(grid.point_data["displacement"], axis=1).max() == pytest.approx(0.1 * size)


def test_vtk_name_must_be_that_of_a_collection(cantilever, tmp_path):
    with pytest.raises(ModelError, match=r"\.pvd"):
        write_modes(cantilever, tmp_path / "modes.vtk")


BASQUIN = {"strength": "100 MPa", "knee": 2e6, "slope": 5, "slope_below": 9}


def test_damage_of_blocks_is_that_of_miner():
    """Σ n/N: 2 whole cycles of 200 MPa, one half of 100 MPa that the knee is at, 3 of 50 MPa below it; N = knee (strength/S)^slope."""
    cycles = [Cycle(400e6, 0.0, 2.0), Cycle(200e6, 0.0, 0.5), Cycle(100e6, 0.0, 3.0)]
    found = FatigueCurve.of(BASQUIN, "Pa").damages(cycles)
    np.testing.assert_allclose(found, [2 * 2**5 / 2e6, 0.5 / 2e6, 3 * 0.5**9 / 2e6], rtol=1e-14)
    endless = {name: BASQUIN[name] for name in ("strength", "knee", "slope")}
    np.testing.assert_allclose(FatigueCurve.of(endless, "Pa").damages(cycles), [*found[:2], 0.0], rtol=1e-14)


def test_means_count_as_goodman_has_them():
    """S/(1 - mean/R); a compressive mean changes nothing, and one of the tensile strength breaks at once."""
    curve = FatigueCurve.of({**BASQUIN, "ultimate": "400 MPa"}, "Pa")
    found = curve.damages([Cycle(200e6, 200e6, 1.0), Cycle(200e6, -200e6, 1.0), Cycle(200e6, 400e6, 1.0)])
    np.testing.assert_allclose(found, [2**5 / 2e6, 1 / 2e6, np.inf], rtol=1e-14)


@pytest.mark.parametrize(
    ("given", "names"),
    [
        ({"strength": "3 MPa", "slop": 5}, ("`knee` is missing", "fatigue.slop")),
        ({"strength": "3 kg", "knee": -1, "slope": 5}, ("fatigue.strength", "fatigue.knee")),
    ],
)
def test_faults_of_fatigue_curves_are_told_at_once(given, names):
    with pytest.raises(ModelError) as caught:
        FatigueCurve.of(given, "Pa")
    assert all(name in str(caught.value) for name in names)
