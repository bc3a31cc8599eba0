"""What is wrong with a value names the option by which it came, and no line of the file."""

import pytest
from click.testing import CliRunner

from nivel.api import load
from nivel.cli import main
from nivel.errors import ModelError

MACHINE = """\
format: 1
gravity: [0, -9.81, 0]
bodies:
  bar: {mass: 1, inertia: [0.001, 0.0833, 0.0833], position: [0.5, 0, 0]}
joints:
  hinge: {type: revolute, bodies: [ground, bar], point: [0, 0, 0], axis: [0, 0, 1]}
simulation:
  duration: 1
  step: 1 ms
  output_interval: 10 ms
  integrator: rk4
"""


@pytest.fixture
def machine(tmp_path):
    (tmp_path / "machine.yaml").write_text(MACHINE)
    return str(tmp_path / "machine.yaml")


def said(*arguments):
    done = CliRunner().invoke(main, [*arguments])
    assert done.exit_code == 2, done.output
    return done.stderr


@pytest.mark.parametrize(
    ("command", "options", "named", "message"),
    [
        ("run", ["--output-interval", "1.5 ms"], "--output-interval", "0.0015 s is not a multiple of the step 0.001 s"),
        ("run", ["--duration", "soon"], "--duration", "`soon` is neither a parameter nor a unit"),
        ("run", ["--step", "1e-18"], "--step", "would take more than"),
        (
            "run",
            ["--output-interval", "1e-5"],
            "--output-interval",
            "1e-05 s is shorter than `step` 0.001 s; write `step: 1e-05 s` too, or a longer interval (",
        ),
        ("run", ["--step", "5"], "--step", "`step` 5 s is longer than `duration` 1 s ("),
        ("run", ["--step", "5", "--duration", "2"], "--step", "`step` 5 s is longer than `duration` 2 s"),
        ("run", ["--integrator", "rkx"], "--integrator", "the word `rkx` is not known"),
        ("run", ["--tolerance", "1e-3"], "--tolerance", "`tolerance` has no effect here"),
        ("run", ["--integrator", "dopri5", "--tolerance", "1e-14"], "--tolerance", "1e-14 is below 1e-12"),
        ("run", ["--free", "hinge.angle"], "--free", "the run starts as-given; it is for `start: equilibrium`"),
        ("run", ["--coordinates", "relative", "--cut", "pin, rod"], "--cut", "there is no joint `rod`"),
        ("run", ["--coordinates", "relative", "--cut", "pin"], "--cut", "there is no joint `pin`"),
        (
            "run",
            ["--integrator", "energy-momentum", "--coordinates", "relative"],
            "--coordinates",
            "'relative' does not go",
        ),
        ("compare", ["--duration", "-1"], "--duration", "a time greater than zero was expected"),
        ("compare", ["--steps", "1ms,soon"], "--steps", "`soon` is neither a parameter nor a unit"),
        ("compare", ["--integrators", "rkx"], "--integrators", "the word `rkx` is not known"),
        ("statics", ["--step", "-1"], "--step", "a time greater than zero was expected"),
        ("statics", ["--most-iterations", "0"], "--most-iterations", "a whole number from 2 to 1000"),
    ],
)
def test_an_option_at_fault_is_named(machine, command, options, named, message):
    lines = [line for line in said(command, machine, *options).splitlines() if message in line]
    assert lines
    assert lines[0].startswith(f"{named}  ")


def test_what_the_file_says_keeps_its_line(machine):
    """The interval of the file does not go with the step of the command line: it stands where it stands."""
    line = f"{machine}:10:20  simulation.output_interval  0.01 s is not a multiple of the step 0.003 s"
    assert line in said("run", machine, "--step", "3 ms")


def test_where_the_other_half_of_a_contradiction_stands_is_said(machine):
    assert f"`duration` 1 s ({machine}:8:13)" in said("run", machine, "--step", "5")
    message = "`step` 5 s is longer than `duration` 1 s (`step` set from outside the file)"
    assert message in said("run", machine, "--set", "simulation.step=5")


@pytest.mark.parametrize("command", ["run", "check"])
@pytest.mark.parametrize(
    ("setting", "message"),
    [
        ("simulation.output_interval=1.5 ms", "0.0015 s is not a multiple of the step 0.001 s"),
        ("simulation.tolerance=1e-3", "`tolerance` has no effect here"),
        ("simulation.cut=[pin]", "there is no joint `pin`"),
    ],
)
def test_what_was_set_is_said_to_come_from_outside(machine, command, setting, message):
    (line,) = [line for line in said(command, machine, "--set", setting).splitlines() if message in line]
    assert line.startswith("simulation.")
    assert line.endswith("(set from outside the file)")


def test_in_python_the_argument_is_named(machine):
    with pytest.raises(ModelError) as caught:
        load(machine).simulate(output_interval="1.5 ms")
    (fault,) = caught.value.faults
    assert (fault.path, fault.line) == ("output_interval", 0)


STICKING = MACHINE.replace(
    "simulation:",
    """\
forces:
  rub: {type: friction, coordinate: hinge, model: stiction, coefficient: 0.1, radius: 1 cm}
simulation:
  coordinates: relative""",
)
CLASHES = {
    "`coordinates`: 'relative' does not go with `integrator: energy-momentum`": ":10:16)",
    "`stabilisation`: 'direct' does not go with `integrator: energy-momentum`": (
        "write `stabilisation: none`; the file leaves `stabilisation` at its default"
    ),
    "`forces.rub.model`: 'stiction' does not go with `integrator: energy-momentum`": ":8:51)",
}


@pytest.fixture
def sticking(tmp_path):
    (tmp_path / "sticking.yaml").write_text(STICKING)
    return str(tmp_path / "sticking.yaml")


def test_an_integrator_that_goes_with_nothing_is_told_with_all_that_it_does_not_go_with(sticking):
    """The file alone is right: the option is what is at fault, and the message says where the other half stands."""
    lines = said("run", sticking, "--integrator", "energy-momentum", "--no-report").splitlines()
    for clash, place in CLASHES.items():
        (line,) = [line for line in lines if clash in line]
        assert line.startswith("--integrator  ")
        assert line.endswith(place)


def test_the_argument_that_clashes_with_the_file_is_named(sticking):
    with pytest.raises(ModelError) as caught:
        load(sticking).simulate(integrator="energy-momentum")
    assert [(fault.path, fault.line) for fault in caught.value.faults] == 3 * [("integrator", 0)]


def test_what_clashes_within_the_file_keeps_its_line(sticking, tmp_path):
    text = STICKING.replace("  integrator: rk4\n", "")
    text = text.replace("  coordinates: relative", "  integrator: energy-momentum\n  coordinates: relative")
    (tmp_path / "sticking.yaml").write_text(text)
    lines = said("check", sticking).splitlines()
    for place in ("8:51  forces.rub.model", "9:1  simulation.stabilisation", "11:16  simulation.coordinates"):
        assert any(line.startswith(f"{sticking}:{place}  ") for line in lines)


@pytest.mark.parametrize(
    ("options", "named", "place"),
    [
        (["--duration", "1e300"], "--duration  `step`: ", ":9:9)"),
        (["--step", "1e-300"], "--step  ", ""),
        (["--duration", "1e300", "--step", "2 ms"], "--step  ", ""),
        (["--set", "simulation.duration=1e300"], "simulation.duration  `step`: ", ":9:9) (set from outside the file)"),
    ],
)
def test_too_many_steps_are_told_at_the_option_that_asks_for_them(machine, options, named, place):
    (line,) = [
        line for line in said("run", machine, *options).splitlines() if "would take more than 1e+12 steps" in line
    ]
    assert line.startswith(named)
    assert line.endswith(place)


@pytest.mark.parametrize("option", ["--largest-step", "--output-interval"])
def test_steps_and_frames_that_never_end_are_refused(machine, option):
    assert f"{option}  1e-300 s would" in said("run", machine, "--integrator", "dopri5", option, "1e-300")


def test_a_table_without_a_name_is_refused(machine):
    assert "a table ends with .csv or .json" in said("compare", machine, "--out", "")
