"""The command `nivel` as far as it needs no computing: help, exit codes, messages, `new`."""

import json
import os
import subprocess
import sys
from pathlib import Path

import click
import pytest
from click.testing import CliRunner

from nivel.cli import COMMANDS, failures, main
from nivel.errors import ModelError, SolveError
from nivel.files import parse_machine, read_machine
from patience import PATIENCE

HEAVY = ("pydantic", "numpy", "numba", "xarray", "pint", "yaml", "rich", "scipy", "matplotlib", "h5py")


def nivel(*arguments):
    return CliRunner().invoke(main, [str(argument) for argument in arguments], prog_name="nivel")


def test_help_loads_nothing_heavy():
    code = (
        "import sys\nfrom nivel.cli import main\n"
        "try: main(['--help'])\nexcept SystemExit: pass\n"
        f"sys.exit(any(name in sys.modules for name in {HEAVY}))"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False, capture_output=True).returncode == 0


@pytest.mark.parametrize(
    ("arguments", "answer"),
    [
        (("run", "a.yaml", "--dt", "3"), "Did you mean '--step'?"),
        (("run", "a.yaml", "--solver", "rk4"), "Did you mean '--integrator'?"),
        (("help", "run"), "write `nivel run --help`"),
        (("version",), "write `nivel --version`"),
    ],
)
def test_options_and_commands_of_other_programs_are_answered_with_ours(arguments, answer):
    outcome = nivel(*arguments)
    assert outcome.exit_code == 2
    assert answer in outcome.output


def test_a_machine_file_of_a_similar_name_is_offered(tmp_path):
    (tmp_path / "crane.yaml").write_text("format: 1\n", encoding="utf-8")
    outcome = nivel("check", tmp_path / "crne.yaml")
    assert outcome.exit_code == 2
    assert "did you mean `" in outcome.output
    assert "crane.yaml`?" in outcome.output.replace("\n", "")


def test_help_lists_every_command():
    for arguments in ((), ("--help",), ("-h",)):
        shown = nivel(*arguments)
        assert shown.exit_code == 0
        for name, place in COMMANDS.items():
            assert f"  {name} " in shown.output
            assert place.help in shown.output


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_exists(name):
    command = main.get_command(click.Context(main), name)
    assert isinstance(command, click.Command)
    assert nivel(name, "--help").exit_code == 0


def test_version():
    shown = nivel("--version")
    assert shown.exit_code == 0
    assert shown.output.startswith("nivel 0.")


@pytest.mark.parametrize("arguments", [("rnu",), ("--foo",), ("new",), ("new", "a", "--foo"), ("new", "a", "b")])
def test_wrong_options_exit_with_2(arguments):
    assert nivel(*arguments).exit_code == 2


def test_an_unknown_command_is_answered_with_the_nearest():
    assert "did you mean 'run'?" in nivel("rnu").stderr


class TestNew:
    @pytest.fixture(autouse=True)
    def _here(self, tmp_path, monkeypatch):
        monkeypatch.chdir(tmp_path)

    def test_writes_a_machine_that_can_be_read(self):
        assert nivel("new", "crane").exit_code == 0
        machine = read_machine("crane.yaml")
        assert machine.name == "crane"
        assert machine.joints
        assert machine.forces

    def test_its_comments_explain_every_section(self):
        nivel("new", "crane")
        text = Path("crane.yaml").read_text(encoding="utf-8")
        for section in ("parameters", "gravity", "bodies", "markers", "joints", "forces", "simulation"):
            assert f"\n{section}:" in text
        assert text.count("#") > 8

    @pytest.mark.parametrize("name", ["crane.yaml", "null", "1e3", "true", "my crane", "Välitanko"])
    def test_any_name_that_a_file_can_have(self, name):
        assert nivel("new", name).exit_code == 0
        file = Path(name if name.endswith(".yaml") else f"{name}.yaml")
        assert read_machine(file).name == file.stem

    def test_does_not_overwrite_without_force(self):
        Path("crane.yaml").write_text("mine", encoding="utf-8")
        refused = nivel("new", "crane")
        assert refused.exit_code == 2
        assert "--force" in refused.stderr
        assert Path("crane.yaml").read_text(encoding="utf-8") == "mine"
        assert nivel("new", "crane", "--force").exit_code == 0
        assert read_machine("crane.yaml")

    def test_with_a_schema_for_editors(self):
        assert nivel("new", "crane", "--schema").exit_code == 0
        assert "$schema=nivel.schema.json" in Path("crane.yaml").read_text(encoding="utf-8").splitlines()[0]
        assert json.loads(Path("nivel.schema.json").read_text(encoding="utf-8"))["properties"]["bodies"]
        assert read_machine("crane.yaml")

    @pytest.mark.parametrize(
        ("name", "part"),
        [
            ("no/such/folder", "cannot be written"),
            ("a:b", "name of a result file"),
            ("", "is a folder"),
            (".", "is a folder"),
            ("..", "is a folder"),
            ("x" * 101, "at most 100 characters"),
            ("x" * 300, "at most 100 characters"),
        ],
    )
    def test_impossible_names(self, name, part):
        refused = nivel("new", name)
        assert refused.exit_code == 2
        assert part in refused.stderr
        assert not list(Path.cwd().iterdir())

    def test_a_folder_is_no_name(self):
        Path("machines").mkdir()
        refused = nivel("new", "machines")
        assert refused.exit_code == 2
        assert "is a folder" in refused.stderr
        assert not Path("machines.yaml").exists()


def told(error, capsys):
    with pytest.raises(SystemExit) as left, failures.told():
        raise error
    out, err = capsys.readouterr()
    assert out == ""
    return left.value.code, err


def test_faults_are_told_one_a_line_and_exit_with_2(capsys):
    with pytest.raises(ModelError) as caught:
        parse_machine(
            "format: 1\nbodies:\n  crank: {mass: 3 m, inertia: [1, 1, 1]}\n  rod: {mass: 1}\n", "machine.yaml"
        )
    code, text = told(caught.value, capsys)
    assert code == 2
    assert text.splitlines() == [
        "machine.yaml:3:17  bodies.crank.mass  `3 m` is a length (m); a mass (kg) was expected",
        "machine.yaml:4:8  bodies.rod  `inertia` is missing: give `inertia` or a `shape` to compute it from",
        "2 faults",
    ]


def test_messages_are_shown_as_they_are(capsys):
    text = "[red]brackets[/red] and a long line that no terminal is wide enough for, " * 4
    assert told(ModelError(text), capsys) == (2, text + "\n")


def test_a_failed_computation_exits_with_3(capsys):
    code, text = told(SolveError("the joint hinge came apart", time=1.25, advice="try a smaller step"), capsys)
    assert code == 3
    assert text == "the computation failed: the joint hinge came apart\ntry a smaller step\n"


def test_an_interrupt_exits_with_130(capsys):
    assert told(KeyboardInterrupt(), capsys) == (130, "interrupted\n")


def test_defects_keep_their_traceback():
    with pytest.raises(ZeroDivisionError), failures.told():
        _ = 1 / 0


@pytest.mark.parametrize("arguments", [["--help"], ["explain", "nobody.nc"]])
def test_a_reader_that_has_enough_is_no_failure(arguments, tmp_path):
    """As `nivel … | head`: what it says finds no reader. A fault of the input keeps its code."""
    reading, writing = os.pipe()
    os.close(reading)
    command = [sys.executable, "-m", "nivel", *arguments]
    ended = subprocess.run(command, cwd=tmp_path, stdout=writing, stderr=writing, check=False, timeout=PATIENCE)
    os.close(writing)
    assert ended.returncode == (0 if arguments == ["--help"] else 2)
