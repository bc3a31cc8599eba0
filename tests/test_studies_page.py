"""The page on studies: its keys, types and options are those of the program, its study and its Python run, and so do the examples."""

import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import get_args

import pytest
from click import Context

from nivel.analysis.sweep.outputs import Task
from nivel.analysis.sweep.variant import run_variant
from nivel.cli import main
from nivel.machine.study.parameter import OUTPUTS, PARAMETERS
from nivel.machine.study.study_record import Design, StudyRecord
from nivel.studies import load_study

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "docs" / "studies.md").read_text(encoding="utf-8")
EXAMPLES = sorted(
    path
    for path in (ROOT / "examples" / "studies").glob("*.yaml")
    if "\noptimise:" not in path.read_text(encoding="utf-8")
)


def first_cells(heading):
    """Words between backticks in the first cells below a heading."""
    section = re.search(rf"^##+ {heading}\n(.*?)(?=^##|\Z)", PAGE, re.MULTILINE | re.DOTALL)[1]
    cells = [line.split("|")[1] for line in section.splitlines() if line[:1] == "|"]
    return {word for cell in cells for word in re.findall(r"`([^`]+)`", cell)}


def types_of(records):
    return {word for each in records for word in get_args(each.model_fields["type"].annotation)}


def test_every_key_type_design_and_option_has_its_row():
    keys = {field.alias or name for name, field in StudyRecord.model_fields.items()}
    assert first_cells("The file") == keys | {"format"}
    parameters = first_cells("Parameters")
    assert {found for text in parameters for found in re.findall(r"type: ([\w-]+)", text)} | {"values"} == types_of(
        PARAMETERS
    )
    assert first_cells("Designs") == set(get_args(Design))
    outputs = {re.sub(r"\{type: ([\w-]+).*", r"\1", text) for text in first_cells("Outputs")}
    assert outputs == types_of(OUTPUTS)
    command = main.get_command(Context(main), "sweep")
    options = {word for parameter in command.params for word in parameter.opts if word.startswith("--")}
    assert first_cells("The command") == options


def test_the_study_and_the_python_of_the_page_run(tmp_path):
    shutil.copy(ROOT / "examples" / "mechanisms" / "slider-crank.yaml", tmp_path)
    (study,) = re.findall(r"```yaml\n(.*?)```", PAGE, re.DOTALL)
    (tmp_path / "tolerances.yaml").write_text(study.replace("2 s}", "20 ms}"), encoding="utf-8")
    (code,) = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
    done = subprocess.run(
        [sys.executable, "-c", f"{code}\nprint(*found.outcome.values)"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == ["done"] * 8
    assert "tolerances.html" in {path.name for path in tmp_path.iterdir()}


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_variants_of_the_examples_have_all_outputs(path):
    study = load_study(path, {"samples": 4, "settings.duration": 0.05})
    record, values = study.file.record, study.variants.values
    task = Task(study.machine, record.analysis, study.resolved.settings, record.outputs)
    found = [run_variant(task, each) for each in values[:3]]
    assert [run.outcome for run in found] == ["done"] * 3
    assert all(set(run.outputs) == set(record.outputs) for run in found)
    assert len({run.outputs["angle"].value for run in found}) == 3
