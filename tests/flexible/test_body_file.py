"""Body files: what is written is read back, by nivel and by xarray; what is no body file is refused."""

import json
import sys
from dataclasses import fields

import h5py
import numpy as np
import pytest
import xarray as xr

from models import bar, block, reduced
from needing import needs
from nivel.errors import ModelError
from nivel.flexible.body.body_file import INVARIANTS, read_body, write_body


@pytest.fixture(scope="module")
def beam():
    return reduced(bar(reduction="modes: 4, reference: root, stiffening: true", more="recovery: {strain: true}"))


def test_body_is_read_back_as_it_was(beam, tmp_path):
    body, findings = beam
    write_body(body, tmp_path / "body.nc", findings=findings.as_data(), model="text")
    again = read_body(tmp_path / "body.nc")
    for each in ("name", "reference", "held", "mass_kind", "source"):
        assert getattr(again, each) == getattr(body, each)
    for each in ("eigenvalues", "node_ids", "position", "modes", "triangles", "lines", "solids"):
        np.testing.assert_array_equal(getattr(again, each), getattr(body, each))
    for each in fields(body.invariants):
        np.testing.assert_array_equal(getattr(again.invariants, each.name), getattr(body.invariants, each.name))
    np.testing.assert_array_equal(again.stress.modes, body.stress.modes)
    np.testing.assert_array_equal(again.stress.strain, body.stress.strain)
    assert again.stress.labels == body.stress.labels
    assert set(again.stiffening) == {"acceleration", "angular_acceleration", "centrifugal", "interface.tip"}
    for name, matrices in body.stiffening.items():
        np.testing.assert_array_equal(again.stiffening[name], matrices)
    assert [each.name for each in again.interfaces] == ["root", "tip"]
    np.testing.assert_array_equal(again.interface("tip").phi, body.interface("tip").phi)
    np.testing.assert_array_equal(again.interface("tip").psi, body.interface("tip").psi)
    with h5py.File(tmp_path / "body.nc") as file:
        assert json.loads(file.attrs["findings"])["errors"] == findings.errors


def test_body_with_fewer_modes_is_that_of_these_modes(beam):
    """Everything that depends on modes has the same columns; I9 and I5 those of both their indices."""
    body = beam[0]
    few = body.keeping(np.array([4, 1]))
    np.testing.assert_array_equal(few.frequencies, body.frequencies[[4, 1]])
    np.testing.assert_allclose(few.invariants.I3, body.invariants.I3[:, [4, 1]])
    np.testing.assert_allclose(few.invariants.I5[0, :, 1], body.invariants.I5[4, :, 1])
    np.testing.assert_allclose(few.invariants.I9[1, 0], body.invariants.I9[1, 4])
    np.testing.assert_array_equal(few.interface("tip").psi, body.interface("tip").psi[:, [4, 1]])
    np.testing.assert_array_equal(few.stress.modes, body.stress.modes[:, :, [4, 1]])
    np.testing.assert_array_equal(few.stiffening["centrifugal"][2, 0, 1], body.stiffening["centrifugal"][2, 4, 1])
    assert few.modes.shape[2] == 2


def test_solid_is_read_back(tmp_path):
    needs("gmsh")
    body, _ = reduced(block(length=0.3, size=0.1, reduction="modes: 3"))
    write_body(body, tmp_path / "body.nc")
    again = read_body(tmp_path / "body.nc")
    np.testing.assert_array_equal(again.solids, body.solids)
    np.testing.assert_array_equal(again.triangles, body.triangles)
    assert np.isfinite(again.modes).all()  # the turns of the nodes too


def test_xarray_reads_it_with_units(beam, tmp_path):
    write_body(beam[0], tmp_path / "body.nc")
    with xr.open_dataset(tmp_path / "body.nc", engine="h5netcdf") as data:
        assert data["I5"].dims == ("mode", "xyz", "mode_")
        for name, (unit, *_) in INVARIANTS.items():
            assert data[name].attrs["units"] == unit
        np.testing.assert_array_equal(data["frequency"], beam[0].frequencies)
        assert data["stress_mode"].sel(stress_component="xx").shape[1] == len(beam[0].eigenvalues)
        assert list(data["interface"].values) == ["root", "tip"]
        assert data.attrs["kind"] == "flexible body"


def test_a_large_body_is_read_array_by_array(beam, tmp_path):
    """As a boom of 70 000 freedoms with 32 modes, 23 000 nodes with stress: with no more calls than a small one."""
    from dataclasses import replace

    from nivel.flexible.body.body import StressModes

    body = beam[0]
    n = len(body.eigenvalues)
    nodes = 23_000
    large = replace(
        body,
        node_ids=np.arange(nodes),
        position=np.zeros((nodes, 3)),
        modes=np.ones((nodes, 6, n)),
        stress=StressModes(np.arange(nodes), (), np.ones((nodes, 6, n))),
    )
    write_body(large, tmp_path / "large.nc")
    write_body(body, tmp_path / "small.nc")
    assert calls(tmp_path / "large.nc") <= calls(tmp_path / "small.nc")


def calls(path):
    """How many functions of Python reading a body takes."""
    count = 0

    def note(_frame, event, _argument):
        nonlocal count
        count += event == "call"

    read_body(path)  # what is done once a process
    sys.setprofile(note)
    try:
        read_body(path)
    finally:
        sys.setprofile(None)
    return count


def test_what_is_no_body_file(tmp_path, beam):
    with pytest.raises(ModelError, match="nivel reduce MODEL -o"):
        read_body(tmp_path / "none.nc")
    with pytest.raises(ModelError, match="folder"):
        read_body(tmp_path)
    (tmp_path / "text.nc").write_text("hello")
    with pytest.raises(ModelError, match="not a body file"):
        read_body(tmp_path / "text.nc")
    xr.Dataset({"a": 1}).to_netcdf(tmp_path / "other.nc", engine="h5netcdf")
    with pytest.raises(ModelError, match="no body file"):
        read_body(tmp_path / "other.nc")
    with pytest.raises(ModelError, match="cannot be written"):
        write_body(beam[0], tmp_path / "nowhere" / "body.nc")
    assert not list(tmp_path.glob(".*.part"))
