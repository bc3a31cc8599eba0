"""`nivel kinematics`, `linearise` and `inverse` as a user calls them: files, exit codes, what is said."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from nivel.cli import main
from nivel.results import Result

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def nivel(*arguments):
    return CliRunner().invoke(main, [str(argument) for argument in arguments], prog_name="nivel")


def test_a_locked_machine_ends_with_3_and_keeps_its_positions(folder):
    done = nivel(
        "kinematics", EXAMPLES / "mechanisms" / "four-bar-revolutes.yaml", "--drive", "rocker_pivot", "--no-report"
    )
    assert done.exit_code == 3
    assert "drive is held by crank_pivot" in done.stderr
    assert len(Result.open(folder / "four-bar-revolutes-kinematics.nc").time) > 10


def test_curves_and_transmission_angles_are_said_and_drawn(folder):
    words = (
        "--drive",
        "crank_pivot",
        "--transmission",
        "crank_pin,rocker_pin,rocker_pivot",
        "--curve",
        "coupler:5 cm,0,0",
    )
    done = nivel("kinematics", EXAMPLES / "mechanisms" / "four-bar-revolutes.yaml", *words)
    assert done.exit_code == 0, done.stderr
    assert "transmission at rocker_pin: from 45.3095" in done.stderr
    assert "<svg" in (folder / "four-bar-revolutes-kinematics-curves.html").read_text(encoding="utf-8")


def test_a_range_is_told_as_json(folder):
    done = nivel(
        "kinematics",
        EXAMPLES / "mechanisms" / "four-bar-revolutes.yaml",
        "--drive",
        "crank_pivot",
        "--range",
        "--json",
        "--quiet",
    )
    assert json.loads(done.stdout)["full_turn"] is True
    assert not list(folder.iterdir())


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("kinematics", "mechanisms/slider-crank.yaml"), "1 motion is not driven"),
        (("kinematics", "mechanisms/slider-crank.yaml", "--range"), "--drive"),
        (
            ("kinematics", "mechanisms/slider-crank.yaml", "--drive", "hinge", "--transmission", "hinge,pin"),
            "three joints",
        ),
        (
            ("kinematics", "mechanisms/slider-crank.yaml", "--drive", "hinge", "--curve", "rodd:1,2,3"),
            "did you mean `rod`",
        ),
        (("linearise", "mechanisms/slider-crank.yaml", "--about", "noon"), "--about"),
        (("linearise", "mechanisms/slider-crank.yaml", "--over", "parameters.offset=3:1:5"), "PATH=FROM:TO:COUNT"),
        (("linearise", "mechanisms/slider-crank.yaml", "--orders", "1"), "belongs to --over"),
        (("inverse", "mechanisms/slider-crank.yaml"), "no motors and no drivers"),
        (("inverse", "mechanisms/slider-crank.yaml", "--limit", "hinge"), "NAME=VALUE"),
        (("inverse", "mechanisms/slider-crank.yaml", "--path", "way.csv"), "a path leads a point"),
        (("inverse", "mechanisms/slider-crank.yaml", "--path", "way.csv", "--point", "slider"), "cannot be read"),
    ],
)
def test_input_at_fault_ends_with_2(folder, words, said):
    name, machine, *rest = words
    done = nivel(name, EXAMPLES / machine, *rest)
    assert done.exit_code == 2
    assert said in done.stderr
    assert "Traceback" not in done.stderr


def test_eigenvalues_over_a_parameter_make_a_page(folder):
    over = ("--over", "parameters.rope=1:8:4 m", "--about", "equilibrium")
    done = nivel("linearise", EXAMPLES / "control" / "crane-control.yaml", *over)
    assert done.exit_code == 0, done.stderr
    assert {"crane-control-sweep.nc", "crane-control-sweep.html"} == {path.name for path in folder.iterdir()}


def test_a_point_is_led_along_a_path(folder):
    (folder / "way.csv").write_text("time,x,y,z\n0,1.0,-3.9,0\n1,1.5,-3.8,0\n", encoding="utf-8")
    done = nivel("inverse", EXAMPLES / "control" / "crane-control.yaml", "--point", "load", "--path", "way.csv")
    assert done.exit_code == 0, done.stderr
    assert "2 of 2 places reached" in done.stderr
    assert (folder / "crane-control-joints.csv").read_text(encoding="utf-8").startswith("time,")
