"""Measured tables: CSV of any length, MAT and Parquet, with units and time offsets; results in the same forms."""

import importlib
import json

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.io import loadmat, savemat

import nivel
from needing import needs
from nivel.cli import main
from nivel.files import parse_machine
from nivel.files.input_table import read_input_table

START = """format: 1
bodies:
  arm: {mass: 3, inertia: [1, 1, 1]}
joints:
  boom: {type: revolute, bodies: [ground, arm], point: [0, 0, 0], axis: [0, 0, 1]}
inputs:
  spindle: {range: [-10, 10]}
drivers:
  turn: {coordinate: boom, value: %s}
simulation: {duration: 10 ms, step: 1 ms}
"""
T, Y = np.array([0.0, 0.5, 1.0]), np.array([0.0, 90.0, -45.0])


def table(folder, text):
    return parse_machine(START % text, str(folder / "m.yaml")).drivers[0].value


def test_a_csv_file_may_be_longer_than_a_hundred_thousand_rows(tmp_path):
    rows = "\n".join(f"{k / 1000},note,{k % 7}" for k in range(120_000))
    (tmp_path / "long.csv").write_text(f"t [s],remark,x\n{rows}\n", encoding="utf-8")
    found = table(tmp_path, "{csv: long.csv, column: x}")
    assert len(found.times) == 120_000
    assert (found.times[-1], found.values[-1]) == (119.999, 119_999 % 7)


def test_a_mat_file_gives_columns_and_units_are_said_in_the_machine(tmp_path):
    savemat(tmp_path / "log.mat", {"angle": Y, "time": 1e3 * T, "title": "run 7"})
    found = table(tmp_path, "{csv: log.mat, column: angle, units: deg, time_units: ms, time_offset: 2 s}")
    assert found.times == pytest.approx(T + 2)
    assert found.values == pytest.approx(np.deg2rad(Y))
    savemat(tmp_path / "in.mat", {"time": T, "spindle": Y})
    assert read_input_table(tmp_path / "in.mat", "spindle").values == pytest.approx(Y)


def test_an_offset_is_in_the_unit_of_time_whatever_that_of_the_column(tmp_path):
    (tmp_path / "c.csv").write_text("time [ms], boom [deg]\n12000, 0\n12500, 90\n", encoding="utf-8")
    assert table(tmp_path, "{csv: c.csv, time_offset: -12 s}").times == pytest.approx((0.0, 0.5))


def test_parquet_has_its_units_in_its_fields(tmp_path):
    arrow, parquet = pytest.importorskip("pyarrow"), pytest.importorskip("pyarrow.parquet")
    fields = [
        arrow.field("t", arrow.float64(), metadata={"unit": "ms"}),
        arrow.field("spindle", arrow.float64(), metadata={"unit": "deg"}),
    ]
    parquet.write_table(arrow.Table.from_arrays([1e3 * T, Y], schema=arrow.schema(fields)), tmp_path / "log.parquet")
    for found in (table(tmp_path, "{csv: log.parquet}"), read_input_table(tmp_path / "log.parquet", "spindle")):
        assert found.times == pytest.approx(T)
        assert found.values == pytest.approx(np.deg2rad(Y))


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ({"time": T, "x": Y[:2]}, "its columns have different lengths: `time` 3, `x` 2"),
        ({"time": T}, "two columns of numbers or more were expected"),
        ({"time": T, "x": [1.0, np.nan, 2.0]}, "the column `x` has no number in row 2"),
        ({"time": T[::-1], "x": Y}, "`time` increases; 0.5 does not come after 1"),
        (None, "the file is damaged, or not what its name says"),
    ],
)
def test_what_is_wrong_with_a_binary_file_is_said(tmp_path, content, message):
    if content is None:
        (tmp_path / "log.mat").write_bytes(b"MATLAB 5.0 MAT-file" + bytes(200))
    else:
        savemat(tmp_path / "log.mat", content)
    with pytest.raises(nivel.ModelError, match=message):
        table(tmp_path, "{csv: log.mat, column: x}")


@pytest.mark.parametrize("form", ["mat", "parquet"])
def test_a_result_is_written_with_all_its_digits(tmp_path, form):
    if form == "parquet":
        parquet = pytest.importorskip("pyarrow.parquet")
    machine = nivel.Machine.from_record(parse_machine(START % "0.3*sin(time)", str(tmp_path / "m.yaml")))
    out = tmp_path / "run.nc"
    result = machine.simulate(out=out, verify=False)
    path = tmp_path / f"run.{form}"
    done = CliRunner().invoke(main, ["export", str(out), f"--{form}", str(path), "--select", "boom.angle,arm.position"])
    assert done.exit_code == 0, done.stderr
    if form == "mat":
        found = loadmat(path, squeeze_me=True)
        np.testing.assert_array_equal(found["boom_angle"], result.array("boom.angle"))
        np.testing.assert_array_equal(found["time"], result.time)
        assert dict(zip(found["names"], found["units"], strict=True))["boom.angle"] == "rad"
    else:
        read = parquet.read_table(path)
        np.testing.assert_array_equal(read["boom.angle"].to_numpy(), result.array("boom.angle"))
        assert read.schema.field("boom.angle").metadata[b"unit"] == b"rad"


def test_without_pyarrow_the_message_says_what_brings_it(tmp_path, monkeypatch):
    monkeypatch.setitem(importlib.import_module("sys").modules, "pyarrow.parquet", None)
    (tmp_path / "log.parquet").write_bytes(b"PAR1")
    with pytest.raises(nivel.ModelError, match=r"Parquet files need pyarrow: pip install 'nivel\[measured\]'"):
        table(tmp_path, "{csv: log.parquet}")


def recording(folder):
    """An MDF4 file with two groups that have times of their own."""
    asammdf = needs("asammdf")
    file = asammdf.MDF(version="4.10")
    for times, name, values, unit in ((T, "boom", Y, "deg"), (2 * T, "spindle", Y / 10, "")):
        file.append([asammdf.Signal(samples=values, timestamps=times, name=name, unit=unit)])
    file.save(folder / "log.mf4", overwrite=True)
    file.close()


@pytest.mark.filterwarnings("ignore")
def test_signals_of_mdf_files_have_their_own_times_and_units(tmp_path):
    recording(tmp_path)
    found = table(tmp_path, "{csv: log.mf4, column: boom, time_offset: 1 s}")
    assert found.times == pytest.approx(T + 1)
    assert found.values == pytest.approx(np.deg2rad(Y))
    assert read_input_table(tmp_path / "log.mf4", "spindle").times == pytest.approx(2 * T)
    with pytest.raises(nivel.ModelError, match=r"`column` is missing: it has the signals `boom`, `spindle`"):
        table(tmp_path, "{csv: log.mf4}")
    with pytest.raises(nivel.ModelError, match=r"the signal `bom` is not known; did you mean `boom`"):
        table(tmp_path, "{csv: log.mf4, column: bom}")


STRING = b"string data"
IMU = b"float64 rate\nfloat32[2] force\n"


def bag(path):
    """Messages in JSON, those of ROS 2, and texts, from the time 5 s on."""
    writer, ros = needs("mcap.writer"), needs("mcap_ros2.writer")
    with path.open("wb") as file:
        out = writer.Writer(file)
        out.start()
        schema = out.register_schema("joint", "jsonschema", b"{}")
        channel = out.register_channel("/joint", "json", schema)
        for t, y in zip(T, Y, strict=True):
            content = json.dumps({"angle": float(y), "name": "boom", "rates": [1, float(y)]}).encode()
            out.add_message(channel, log_time=int((5 + t) * 1e9), data=content, publish_time=0)
        out.finish()
    with path.with_name("ros.mcap").open("wb") as file:
        out = ros.Writer(file)
        schema = out.register_msgdef("rig/Imu", IMU.decode())
        for t, y in zip(T, Y, strict=True):
            message = {"rate": float(y), "force": [0.0, 2.0]}
            out.write_message("/imu", schema, message, log_time=int((5 + t) * 1e9), publish_time=0)
        out.finish()


def test_numbers_of_messages_of_mcap_files_are_signals(tmp_path):
    bag(tmp_path / "log.mcap")
    for column in ("/joint.angle", "'/joint.rates[1]'"):
        found = table(tmp_path, f"{{csv: log.mcap, column: {column}, units: deg}}")
        assert found.times == pytest.approx(T)
        assert found.values == pytest.approx(np.deg2rad(Y))
    assert table(tmp_path, "{csv: ros.mcap, column: /imu.rate}").values == pytest.approx(Y)
    assert table(tmp_path, "{csv: ros.mcap, column: '/imu.force[1]'}").values == pytest.approx([2, 2, 2])
    with pytest.raises(nivel.ModelError, match=r"the signal `/joint.angel` is not known; did you mean `/joint.angle`"):
        table(tmp_path, "{csv: log.mcap, column: /joint.angel}")
    for name, magic in (("log.mcap", "MCAP"), ("log.mf4", "MDF")):
        if name == "log.mf4":
            (tmp_path / name).write_bytes(b"MDF     4.10    " + bytes(100))
        done = CliRunner().invoke(main, ["run", str(tmp_path / name)])
        assert done.exit_code == 2
        said = " ".join(done.output.split())
        assert f"this is a recording ({magic}), not a machine file; a machine reads a signal: `{{csv: " in said
        (tmp_path / name).write_bytes((tmp_path / name).read_bytes()[:30])
        with pytest.raises(nivel.ModelError, match="damaged") as caught:
            table(tmp_path, f"{{csv: {name}, column: x}}")
        assert "object at" not in str(caught.value)


@pytest.mark.filterwarnings("ignore")
def test_results_are_written_as_recordings_and_read_back(tmp_path, monkeypatch):
    needs("asammdf", "mcap")
    monkeypatch.chdir(tmp_path)
    machine = parse_machine(START % "3*time")
    result = nivel.Machine.from_record(machine).simulate(out="r.nc", verify=False)
    expected = result.array("boom.angle")
    for option, column in (("mdf", "boom.angle"), ("mcap", "/nivel.boom.angle")):
        done = CliRunner().invoke(main, ["export", "r.nc", f"--{option}", "--select", "boom"])
        assert done.exit_code == 0, done.output
        suffix = {"mdf": "mf4", "mcap": "mcap"}[option]
        found = table(tmp_path, f"{{csv: r.{suffix}, column: {column}}}")
        np.testing.assert_allclose(found.times, result.time, atol=1e-9)
        np.testing.assert_array_equal(found.values, expected)
