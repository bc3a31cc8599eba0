"""What a user asks of a result, by name."""

import json
import subprocess
import sys

import numpy as np
import pytest

import synthetic_run as pendulum
from needing import needs
from nivel.errors import ModelError
from nivel.results import Memory, Result, Store

TIME = np.linspace(0.0, 2.0, 201)
EXPECTED = pendulum.histories(TIME)


@pytest.fixture(params=["memory", "file"])
def result(request, tmp_path):
    sink = Memory() if request.param == "memory" else Store(tmp_path / "run.nc")
    sink.begin(pendulum.header())
    sink.take(pendulum.frames(TIME))
    trust = pendulum.judged(sink.result()).to_json()
    return sink.close({"outcome": "done", "trust": trust, "timing": json.dumps({"steps": 2000})})


@pytest.mark.parametrize(
    ("name", "values", "units"),
    [
        ("time", TIME, "s"),
        ("position", EXPECTED["position"], "m"),
        ("arm.position", EXPECTED["position"][:, 0], "m"),
        ("arm.position.y", EXPECTED["position"][:, 0, 1], "m"),
        ("arm.orientation.3", EXPECTED["orientation"][:, 0, 3], "1"),
        ("hinge.force", EXPECTED["joint_force"][:, 0], "N"),
        ("hinge.force_local.x", EXPECTED["joint_force_local"][:, 0, 0], "N"),
        ("hinge.torque", EXPECTED["joint_torque"][:, 0], "N m"),
        ("hinge.angle", EXPECTED["joint_coordinate"][:, 0], "rad"),
        ("hinge.angle.rate", EXPECTED["joint_rate"][:, 0], "rad/s"),
        ("hinge.s.y.violation", EXPECTED["constraint_violation"][:, 1], "m"),
        ("hinge.d1.xz.rate_violation", EXPECTED["constraint_rate_violation"][:, 3], "1/s"),
        ("hinge.d1.xz.force", EXPECTED["constraint_force"][:, 3], "N m"),
        ("kinetic_energy", EXPECTED["kinetic_energy"], "J"),
        ("force.push.power", EXPECTED["force.push.power"], "W"),
    ],
)
def test_numbers_are_asked_for_by_name(result, name, values, units):
    np.testing.assert_array_equal(result.array(name), values)
    np.testing.assert_array_equal(result.array(name, slice(10, 20)), values[10:20])
    labelled = result[name]
    np.testing.assert_array_equal(labelled.values, values)
    assert labelled.attrs["units"] == result.units(name) == units
    assert labelled.dims[0] == "time"
    assert name in result


def test_a_labelled_array_knows_its_element_and_components(result):
    position = result["arm.position"]
    assert position.coords["body"].item() == "arm"
    assert list(position.coords["xyz"].values) == ["x", "y", "z"]
    np.testing.assert_array_equal(position.sel(xyz="y", time=1.0).item(), EXPECTED["position"][100, 0, 1])


def test_the_dataset_has_everything(result):
    dataset = result.dataset
    assert set(dataset.data_vars) == set(EXPECTED)
    for name, values in EXPECTED.items():
        np.testing.assert_array_equal(dataset[name].values, values)
    assert list(dataset["body"].values) == ["arm"]
    assert dataset["position"].attrs["units"] == "m"
    assert dataset.attrs["outcome"] == "done"
    dataset.close()


def test_a_finished_file_is_a_netcdf_file_for_everyone(tmp_path):
    import h5netcdf
    import xarray

    sink = Store(tmp_path / "run.nc")
    sink.begin(pendulum.header())
    sink.take(pendulum.frames(TIME))
    sink.close({})
    with h5netcdf.File(tmp_path / "run.nc", "r") as file:
        assert file.variables["position"].dimensions == ("time", "body", "xyz")
    with xarray.open_dataset(tmp_path / "run.nc") as dataset:
        np.testing.assert_array_equal(dataset["position"].sel(body="arm").values, EXPECTED["position"][:, 0])


def test_an_unknown_name_gets_the_nearest(result):
    with pytest.raises(ModelError, match=r"no `arm.positon`; did you mean `arm.position`"):
        result["arm.positon"]
    with pytest.raises(ModelError, match="no `zzzzzz`; it has, for instance, `position`"):
        result.array("zzzzzz")
    assert "nothing" not in result


def test_every_name_can_be_read(result):
    for name in result.names:
        assert len(result.array(name)) == len(TIME)


def test_settings_timing_and_trust_are_records(result):
    assert result.settings["integrator"] == "rk4"
    assert result.timing == {"steps": 2000}
    assert result.trust.degrees_of_freedom == 1
    assert result.scene["joints"][0]["name"] == "hinge"
    assert result.name == "pendulum"
    json.dumps(result.summary())


def test_representations_say_what_happened(result):
    text = repr(result)
    assert "pendulum: done" in text
    assert "201 frames, 1 body, 1 joint" in text
    assert "Energy: error" in text
    html = result._repr_html_()
    assert "pendulum" in html
    assert "Energy: error" in html


def test_html_shows_names_as_text():
    memory = Memory()
    memory.begin(pendulum.header(machine="<script>alert(1)</script>"))
    memory.take(pendulum.frames(TIME))
    assert "<script>" not in memory.close({"outcome": "done"})._repr_html_()


def test_csv_can_be_read_back_exactly(result, tmp_path):
    path = result.export_csv(tmp_path / "run.csv")
    lines = path.read_text(encoding="utf-8").splitlines()
    header = lines[0].split(",")
    numbers = np.array([[float(cell) for cell in line.split(",")] for line in lines[1:]])
    assert header[0] == "time [s]"
    assert "arm.position.y [m]" in header
    assert "hinge.angle [rad]" in header
    np.testing.assert_array_equal(numbers[:, 0], TIME)
    np.testing.assert_array_equal(numbers[:, header.index("arm.position.y [m]")], EXPECTED["position"][:, 0, 1])
    assert numbers.shape == (len(TIME), pendulum.layout().width)


def test_csv_of_a_choice(result, tmp_path):
    def header(*select):
        path = result.export_csv(tmp_path / "run.csv", select)
        return path.read_text(encoding="utf-8").splitlines()[0].split(",")[1:]

    assert header("hinge.angle", "arm.position") == [
        "hinge.angle [rad]", "arm.position.x [m]", "arm.position.y [m]", "arm.position.z [m]"
    ]  # fmt: skip
    assert header("*.angle", "hinge.angle") == ["hinge.angle [rad]"]
    assert header("kinetic_energy") == ["kinetic_energy [J]"]
    assert len(header("arm")) == 5 * 3 + 4  # five vectors and four Euler parameters
    with pytest.raises(ModelError, match=r"`hinge.angel`(.|\n)*`arm.positoin`|`arm.positoin`(.|\n)*`hinge.angel`"):
        header("hinge.angel", "arm.positoin")


def test_csv_that_cannot_be_written_is_said(result, tmp_path):
    with pytest.raises(ModelError, match="cannot be written: no such file or directory"):
        result.export_csv(tmp_path / "nowhere" / "run.csv")


def test_curves_are_grouped_by_unit(result):
    matplotlib = needs("matplotlib")
    matplotlib.use("agg")
    from matplotlib import pyplot

    figure = result.plot("hinge.angle", "arm.position", "kinetic_energy")
    assert [axis.get_ylabel() for axis in figure.axes] == ["hinge.angle [rad]", "[m]", "kinetic_energy [J]"]
    assert [len(axis.lines) for axis in figure.axes] == [1, 3, 1]
    assert len(result.plot().axes) == 1
    pyplot.close("all")


def test_plots_without_matplotlib_say_what_to_install(result, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(ModelError, match=r"pip install 'nivel\[plot\]'"):
        result.plot("hinge.angle")


def test_reading_and_writing_load_no_heavy_library(tmp_path):
    code = f"""
import sys, numpy as np
sys.path[:0] = {sys.path!r}
import synthetic_run as pendulum
from nivel.results import Store
import nivel.report.write
sink = Store({str(tmp_path / "run.nc")!r})
sink.begin(pendulum.header())
sink.take(pendulum.frames(np.linspace(0, 1, 11)))
result = sink.close({{"trust": pendulum.judged(sink.result(), degrees=None).to_json()}})
result.report({str(tmp_path / "run.html")!r})
repr(result)
print([name for name in ("xarray", "pandas", "h5netcdf", "matplotlib", "numba", "scipy", "pint") if name in sys.modules])
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_results_can_be_sent_to_other_processes(tmp_path):
    import pickle

    sink = Store(tmp_path / "run.nc")
    sink.begin(pendulum.header())
    sink.take(pendulum.frames(TIME))
    copy = pickle.loads(pickle.dumps(sink.close({"outcome": "done"})))
    assert isinstance(copy, Result)
    np.testing.assert_array_equal(copy.array("hinge.angle"), EXPECTED["joint_coordinate"][:, 0])
