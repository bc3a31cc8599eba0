"""Stress of flexible bodies from the result of a run: closed forms, sensors of the run, what is refused."""

import base64
import struct
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import nivel
from models import bar, reduced
from nivel.errors import ModelError
from nivel.flexible.body.body_file import write_body
from nivel.results.stress import write_cycles, write_envelope, write_history, write_states

L, B, H, RHO, E, G = 2.0, 0.02, 0.03, 7850.0, 210e9, 3.0
SETTLING = f"""
format: 1
gravity: [0, 0, -{G}]
bodies:
  bar: {{flexible: {{file: bar.nc, damping_ratio: 0.7}}}}
  other: {{mass: 1, inertia: [1, 1, 1], position: [0, 5, 0]}}
joints:
  wall: {{type: fixed, bodies: [ground, bar], point: [0, 0, 0]}}
  hook: {{type: fixed, bodies: [ground, other], point: [0, 5, 0]}}
simulation: {{integrator: generalised-alpha, duration: 2 s, step: 1 ms, output_interval: 20 ms}}
"""
SWINGING = """
format: 1
gravity: [0, -9.81, 0]
bodies:
  bar: {flexible: {file: bar.nc, modes: 6}}
markers:
  tip: {body: bar, position: [2, 0, 0]}
joints:
  hinge: {type: revolute, bodies: [ground, bar], point: [0, 0, 0], axis: [0, 0, 1]}
sensors:
  tip: {marker: tip, quantity: position}
simulation: {integrator: generalised-alpha, duration: 0.3 s, step: 0.5 ms, output_interval: 10 ms}
"""


def made(folder, machine, **model):
    body, _ = reduced(bar(**model))
    write_body(body, folder / "bar.nc")
    (folder / "machine.yaml").write_text(machine)
    return nivel.load(folder / "machine.yaml").simulate(out=folder / "run.nc")


@pytest.fixture(scope="module")
def settled(tmp_path_factory):
    """A cantilever that comes to rest under its own weight."""
    model = {"reduction": "modes: 6, reference: root, inertia_modes: true", "more": "recovery: {strain: true}"}
    return made(tmp_path_factory.mktemp("settled"), SETTLING, **model)


@pytest.fixture(scope="module")
def swung(tmp_path_factory):
    return made(tmp_path_factory.mktemp("swung"), SWINGING, reduction="modes: 6")


def bending_stress(moment, z):
    """M z / I of a rectangle, tension above, for a moment [N m]."""
    return moment * z / (B * H**3 / 12.0)


def test_stress_at_rest_is_that_of_the_closed_form(settled):
    """M = q (L - x)²/2. Cubic elements have nodal moments off by those of a clamped element, q l²/12."""
    found = settled.recover("bar")
    modes = found.body.stress
    x = found.body.position[modes.station_node, 0]
    z = np.array([float(label.split("z ")[1]) for label in modes.labels])
    q, element = RHO * B * H * G, L / 16
    error = found.stress()[-1, :, 0] - bending_stress(q * (L - x) ** 2 / 2, z)
    assert np.abs(error).max() < 1.01 * bending_stress(q * element**2 / 12, H / 2)
    np.testing.assert_allclose(found.strain()[-1, :, 0], found.stress()[-1, :, 0] / E, rtol=1e-9, atol=1e-12)


def test_worst_state_is_at_the_root_and_where_the_tip_is_lowest(settled):
    """One mode carries nearly all of a cantilever's weight: the largest stress is when the tip is lowest."""
    found = settled.recover()
    (spot,) = found.hot_spots(1)
    assert spot.node_id == found.node("root") == 1
    assert abs(spot.signed) == pytest.approx(spot.value, rel=1e-3)  # shear stresses too
    assert found.worst_time == found.time[spot.index]
    lowest = int(np.argmin(found.displacement("tip")[:, 2]))
    assert abs(spot.index - lowest) <= 2
    assert found.envelope.value.max() == pytest.approx(found.von_mises().max())


def test_tip_is_where_its_sensor_is(swung):
    """R + A (x + φ q) with modes read from the file again, against the kernels of the run."""
    found = swung.recover()
    A = Rotation.from_quat(swung.array("bar.orientation"), scalar_first=True).as_matrix()
    place = swung.array("bar.position") + np.einsum("tij,tj->ti", A, np.array([L, 0, 0]) + found.displacement("tip"))
    sensor = np.column_stack([swung.array(f"sensor.tip.{axis}") for axis in "xyz"])
    np.testing.assert_allclose(place, sensor, atol=1e-12)
    assert np.abs(found.displacement("tip")).max() > 1e-4


def points_of(path):
    """(nodes, 3) of a VTK file."""
    text = ET.parse(path).getroot().find(".//Points/DataArray").text
    raw = base64.b64decode(text)
    assert struct.unpack("<Q", raw[:8])[0] == len(raw) - 8
    return np.frombuffer(raw[8:], float).reshape(-1, 3)


def test_motion_for_paraview_is_in_space(swung, tmp_path):
    heard = []
    files = swung.recover().write_vtk(tmp_path / "m.pvd", told=lambda text, share: heard.append((text, share)))
    assert len(files) == 1 + len(swung.time) == 1 + len(heard)
    sensor = np.column_stack([swung.array(f"sensor.tip.{axis}") for axis in "xyz"])
    tip = swung.recover().body.interface("tip").node
    np.testing.assert_allclose([points_of(path)[tip] for path in files[1:]], sensor, atol=1e-12)
    times = [float(each.get("timestep")) for each in ET.parse(files[0]).getroot().iter("DataSet")]
    np.testing.assert_array_equal(times, swung.time)
    only = swung.recover().write_vtk(tmp_path / "some.pvd", [0.1, 0.2])
    assert len(only) == 3


def test_cycles_of_a_node_and_their_classes(swung):
    found = swung.recover()
    cycles = found.rainflow(9)
    station = found.widest(9)
    history = found.signed_principal(9)[:, station]
    assert max(each.range for each in cycles) == pytest.approx(np.ptp(history))
    classes = found.classes(9, 5)
    assert sum(number for _, _, number in classes) == pytest.approx(sum(each.count for each in cycles))
    assert classes[0][1] == pytest.approx(np.ptp(history))
    opposite = [k for k in range(len(found.labels(9))) if k != station]
    assert all(np.ptp(found.signed_principal(9)[:, k]) <= np.ptp(history) for k in opposite)


def read(path):
    import csv

    with path.open(encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    return header, rows


def test_tables(settled, tmp_path):
    found = settled.recover()
    tip = found.node("tip")
    header, rows = read(write_history(tmp_path / "h.csv", found, ["tip", 1], strains=True))
    assert [float(row[0]) for row in rows] == found.time.tolist()
    assert float(rows[-1][header.index(f"node {tip} displacement z [m]")]) == found.displacement("tip")[-1, 2]
    label = found.labels(1)[0]
    column = header.index(f"node 1 {label} von Mises [Pa]")
    np.testing.assert_array_equal([float(row[column]) for row in rows], found.von_mises(1)[:, 0])
    assert f"node 1 {label} strain xx [1]" in header
    header, rows = read(write_envelope(tmp_path / "e.csv", found))
    assert len(rows) == len(found.body.stress.station_node)
    assert max(float(row[-2]) for row in rows) == found.envelope.value.max()
    header, rows = read(write_states(tmp_path / "s.csv", found, [1.0, 2.0]))
    assert len(rows) == 2 * len(found.body.stress.station_node)
    assert {float(row[0]) for row in rows} == {found.time[found.frame(1.0)], found.time[-1]}
    header, rows = read(write_cycles(tmp_path / "c.csv", found, [1]))
    assert [float(row[2]) for row in rows] == sorted((float(row[2]) for row in rows), reverse=True)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda r: r.recover("other"), "the body `other` is not flexible; the flexible bodies are bar"),
        (lambda r: r.recover("baar"), "there is no body `baar`; did you mean `bar`"),
        (lambda r: r.recover().stress(99), "no node 99; its 17 nodes have numbers from 1 to 17"),
        (lambda r: r.recover().displacement("head"), "no interface `head`; there are root, tip"),
        (lambda r: r.recover().frame(2.5), "outside of the run, 0 to 2 s"),
        (lambda r: r.recover().frame(float("nan")), "outside of the run"),
        (lambda r: r.recover(file=r.path), "no body file of nivel"),
    ],
)
def test_what_is_refused(settled, call, message):
    with pytest.raises(ModelError, match=message):
        call(settled)


def test_strain_that_was_not_asked_for_is_refused(swung):
    with pytest.raises(ModelError, match="knows no strain"):
        swung.recover().strain(1)


def test_machines_without_flexible_bodies_are_told(tmp_path):
    path = tmp_path / "free.yaml"
    path.write_text(
        "format: 1\nbodies: {block: {mass: 1, inertia: [1, 1, 1]}}\nsimulation: {duration: 0.01, step: 0.001}\n"
    )
    with pytest.raises(ModelError, match="no body of this machine is flexible"):
        nivel.load(path).simulate().recover()


def test_file_of_the_body_must_be_that_of_the_run(tmp_path):
    """Gone: told. Moved with the result: found. Other modes, or fewer: told. With stress added later: taken."""
    machine = SWINGING.replace("0.3 s", "5 ms").replace("10 ms", "5 ms")
    result = made(tmp_path, machine, reduction="modes: 6", more="recovery: {stress: false}")
    with pytest.raises(ModelError, match="knows no stress"):
        result.recover().hot_spots()
    (tmp_path / "bar.nc").rename(tmp_path / "moved.nc")
    with pytest.raises(ModelError, match=r"file of the flexible body `bar` is gone: .*bar\.nc"):
        result.recover()
    assert result.recover(file=tmp_path / "moved.nc").name == "bar"
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    (tmp_path / "run.nc").rename(elsewhere / "run.nc")
    (tmp_path / "moved.nc").rename(elsewhere / "bar.nc")
    assert nivel.Result.open(elsewhere / "run.nc").recover().name == "bar"
    for other in (bar(reduction="modes: 6", height=0.031), bar(reduction="modes: 1", interfaces="root: {node: root}")):
        write_body(reduced(other)[0], tmp_path / "other.nc")
        with pytest.raises(ModelError, match="was changed since the run, or is another body"):
            nivel.Result.open(elsewhere / "run.nc").recover(file=tmp_path / "other.nc")
    write_body(reduced(bar(reduction="modes: 6"))[0], tmp_path / "stressed.nc")
    found = nivel.Result.open(elsewhere / "run.nc").recover(file=tmp_path / "stressed.nc")
    assert len(found.hot_spots(2)) == 2
