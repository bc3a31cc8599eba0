"""`nivel optimise` and `nivel identify`: searches of a study file, from the command line."""

import json

import numpy as np
import pytest
import xarray
from click.testing import CliRunner

import nivel
from nivel.cli import main

BLOCK = """
format: 1
bodies:
  block: {mass: 2 kg, inertia: [1, 1, 1]}
joints:
  rail: {type: translational, bodies: [ground, block], point: [0, 0, 0], axis: [1, 0, 0], start_rates: {displacement: 1 m/s}}
forces:
  spring: {type: joint-spring-damper, coordinate: rail, stiffness: 50 N/m, damping: 4 N s/m}
simulation: {duration: 2 s, step: 2 ms, output_interval: 20 ms, integrator: rk4}
"""
STUDY = """
format: 1
machine: block.yaml
parameters:
  forces.spring.stiffness: {type: range, from: 20 N/m, to: 200 N/m}
  forces.spring.damping: {type: range, from: 0.5 N s/m, to: 10 N s/m}
"""
BEST = """
outputs:
  speed: {type: rms, of: rail.displacement.rate}
  reach: {type: max, of: rail.displacement, at_most: 12 cm}
optimise: {output: speed, starts: 2}
"""
FROM_BENCH = """
identify: {data: bench.csv, deviations: {rail.displacement: 0.001}}
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "block.yaml").write_text(BLOCK)
    return tmp_path


def called(*words):
    return CliRunner().invoke(main, [*words])


def test_optimise_finds_what_python_finds(folder):
    (folder / "best.yaml").write_text(STUDY + BEST)
    done = called("optimise", "best.yaml", "--json", "--quiet")
    assert done.exit_code == 0, done.output
    facts = json.loads(done.stdout)
    machine = nivel.load("block.yaml")
    same = machine.optimise(
        "rms(rail.displacement.rate)",
        {"forces.spring.stiffness": (20, 200), "forces.spring.damping": (0.5, 10)},
        outputs={"reach": "max(rail.displacement)"},
        limits={"reach": (None, 0.12)},
        starts=2,
    )
    assert facts["kept"]
    assert facts["outputs"]["speed"] == pytest.approx(same.objective, rel=1e-5)
    assert facts["headline"]
    with xarray.open_dataset("best.nc", engine="h5netcdf") as table:
        assert table.sizes["variant"] == facts["evaluations"]
        assert table["reach"].attrs == {"units": "m", "at_most": 0.12}
    page = (folder / "best.html").read_text(encoding="utf-8")
    assert "Course of the search" in page
    assert f"{facts['values']['forces.spring.stiffness']:.6g}</td>" in page
    assert "of runs within all limits" in page
    assert called("optimise", "best.yaml").exit_code == 2, "the data file is not replaced without --force"


def test_limits_that_cannot_be_kept_are_told(folder):
    (folder / "best.yaml").write_text(STUDY + BEST.replace("12 cm", "1 mm"))
    done = called("optimise", "best.yaml", "--set", "optimise.starts=1")
    assert done.exit_code == 3
    assert "NOT ALL LIMITS ARE KEPT" in done.output


def test_all_variants_are_kept_where_no_run_comes_to_its_end(folder):
    text = STUDY.replace("from: 20 N/m, to: 200 N/m", "from: 1e11 N/m, to: 1e12 N/m") + BEST
    (folder / "stiff.yaml").write_text(f"{text}settings: {{integrator: radau}}\ntime_limit: 20 ms\n")
    done = called("optimise", "stiff.yaml", "--set", "optimise.starts=1")
    assert done.exit_code == 3, done.output
    assert "it took longer than the time limit of 20 ms" in done.output
    assert "No values were found" in (folder / "stiff.html").read_text(encoding="utf-8")
    with xarray.open_dataset("stiff.nc", engine="h5netcdf") as table:
        assert set(table["outcome"].values) == {"timed out"}


def test_identify_reads_the_table_beside_the_study(folder):
    (folder / "bench.study.yaml").write_text(STUDY + FROM_BENCH)
    truth = nivel.load("block.yaml", {"forces.spring.stiffness": 64, "forces.spring.damping": 2.5}).simulate(
        verify=False
    )
    noise = 1e-3 * np.random.default_rng(2).standard_normal(len(truth.time))
    values = 1e3 * (truth.array("rail.displacement") + noise)
    rows = [f"{t:.6f};{x:.6f}" for t, x in zip(truth.time, values, strict=True)]
    (folder / "bench.csv").write_text("\n".join(["time [s];rail.displacement [mm]", *rows]))
    done = called("identify", "bench.study.yaml", "--json")
    assert done.exit_code == 0, done.output
    facts = json.loads(done.stdout[done.stdout.index("{") : done.stdout.rindex("}") + 1])
    for path, value in (("forces.spring.stiffness", 64.0), ("forces.spring.damping", 2.5)):
        assert abs(facts["values"][path] - value) < 4.0 * facts["standard_deviations"][path] < 0.05 * value
    (folder / "beyond.yaml").write_text(STUDY.replace("from: 0.5 N s/m", "from: 4 N s/m") + FROM_BENCH)
    beyond = called("identify", "beyond.yaml")
    assert beyond.exit_code == 0, beyond.output
    assert "on a bound, without a deviation: forces.spring.damping" in beyond.output
    page = (folder / "beyond.html").read_text(encoding="utf-8")
    assert "<td>on its bound</td>" in page


@pytest.mark.parametrize(
    ("command", "study", "message"),
    [
        (
            "optimise",
            STUDY + BEST.replace("optimise: {output: speed, starts: 2}", ""),
            "write `design: latin-hypercube`|count: 5",
        ),
        ("optimise", STUDY + BEST.replace("output: speed", "output: sped"), "did you mean `speed`"),
        ("identify", STUDY + BEST, "write `identify: {data: FILE.csv}`"),
        ("identify", STUDY + FROM_BENCH, "bench.csv"),
        (
            "identify",
            STUDY + FROM_BENCH.replace("bench.csv", "other.csv"),
            "wrong.yaml:8:41 identify.deviations there are no measurements of `rail.displacement`; there are `rail.place`",
        ),
        ("optimise", STUDY.replace("from: 20 N/m, to: 200 N/m", "from: 20 N/m") + BEST, "to"),
        (
            "optimise",
            STUDY.replace("{type: range, from: 20 N/m, to: 200 N/m}", "{values: [20, 30]}") + BEST,
            "two bounds",
        ),
    ],
)
def test_faults_say_what_to_write(folder, command, study, message):
    (folder / "wrong.yaml").write_text(study)
    (folder / "other.csv").write_text("time, rail.place\n0, 1\n1, 2\n")
    done = called(command, "wrong.yaml")
    assert done.exit_code == 2
    assert any(each in " ".join(done.output.split()) for each in message.split("|")), done.output
