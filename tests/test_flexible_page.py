"""The page on flexible bodies: its models are reduced, its Python runs, nothing that can be written is missing."""

import re
import subprocess
import sys
from pathlib import Path
from typing import get_args

import numpy as np
import pytest
from click import Context

from needing import needs
from nivel.cli import main
from nivel.elements.beams.sections import Material, SectionRecord
from nivel.flexible.body.body_file import write_body
from nivel.flexible.model.model_file import TOP_WORDS, parse_model, read_model
from nivel.flexible.model.records import (
    FORMATS,
    BeamRecord,
    Frame,
    InterfaceRecord,
    Matrices,
    Part,
    Recovery,
    Reduction,
    ShapeFunction,
    Solid,
)
from nivel.flexible.reduce import reduce, reduce_model
from nivel.machine.core.record import field_words

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "docs" / "flexible-bodies.md").read_text(encoding="utf-8")
MACHINE = re.compile(r"^bodies:", re.MULTILINE)  # machines stand beside the models of their bodies
EXAMPLES = [
    path
    for path in sorted((ROOT / "examples" / "flexible").glob("*.yaml"))
    if not MACHINE.search(path.read_text(encoding="utf-8"))
]
MODELS = [
    text for text in re.findall(r"^```yaml\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL) if not MACHINE.search(text)
]


def section(title):
    """The text under a heading, without its subsections of the same level."""
    (text,) = re.findall(rf"^#+ {re.escape(title)}\n(.*?)(?=^#+ |\Z)", PAGE, re.MULTILINE | re.DOTALL)
    return text


def words(text):
    return {word for code in re.findall(r"`([^`\n]+)`", text) for word in re.findall(r"[\w-]+", code)}


def first_cells(text):
    return {word for line in text.splitlines() if line[:1] == "|" for word in words(line.split("|")[1])}


@pytest.mark.parametrize("text", MODELS)
def test_models_of_the_page_are_reduced(text):
    body = reduce_model(parse_model(text)).body
    assert body.frequencies.min() > 1.0


def test_python_of_the_page_runs(tmp_path):
    (code,) = re.findall(r"^```python\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
    path = ROOT / "examples" / "flexible" / "pendulum-bar.yaml"
    body = reduce(path, overrides={"reduction.reference": "root"}).body
    write_body(body, tmp_path / "bar.nc")
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    # M / W of 5 N at 2 m of a square of 10 mm: 60 MPa at the root
    assert re.search(r"node 1 bar.*: (59\.9|60\.0)\d MPa", done.stdout)


@pytest.mark.parametrize(
    ("title", "record"),
    [
        ("Frames", Frame),
        ("Frames", BeamRecord),
        ("Solids", Solid),
        ("Matrices of other programs", Matrices),
        ("Interfaces", InterfaceRecord),
        ("Reduction", Reduction),
        ("Recovery", Recovery),
    ],
)
def test_every_key_has_its_row(title, record):
    assert set(field_words(record)) <= first_cells(section(title))


def test_every_word_is_mentioned():
    assert set(TOP_WORDS) == first_cells(section("Model files"))
    assert set(field_words(Material)) <= words(section("Model files"))
    assert set(field_words(ShapeFunction)) <= words(section("Reduction"))
    assert set(FORMATS) <= first_cells(section("Matrices of other programs"))
    for union, title in ((SectionRecord, "Frames"), (Part, "Solids")):
        for record in get_args(get_args(union)[0]):
            assert set(field_words(record)) - {"type"} <= words(section(title)) | {"type"}
            assert record.model_fields["type"].default in first_cells(section(title))


def test_every_option_has_its_row():
    for name, title, more in (("reduce", "Flexible bodies", {"-o"}), ("stress", "Stress of a run", set())):
        command = main.get_command(Context(main), name)
        options = {word for parameter in command.params for word in parameter.opts if word.startswith("-")}
        rows = [line.split("|")[1] for line in section(title).splitlines() if line.startswith("|")]
        assert options == {word for row in rows for word in re.findall(r"--[a-z][\w-]*", row)} | more


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_example_is_reduced_well(path):
    """The first frequencies within 1 % of the whole model; meshes here coarser than in the file."""
    overrides = {}
    if read_model(path).record.solid is not None:
        needs("gmsh")
        overrides = {"solid.element_size": "0.2", "reduction.modes": 10}
    reduction = reduce(path, overrides=overrides)
    assert np.all(np.abs(reduction.findings.errors[:4]) < 0.01)
    assert len(reduction.findings.rigid_frequencies) == 6
    assert reduction.body.source
    if path.stem == "crane-boom":
        # walls; bosses inside and outside of them; bores through them
        volume = 4 * (0.16 * 0.26 - 0.14 * 0.24) + 2 * np.pi * ((0.08**2 - 0.04**2) * 0.18 - 0.04**2 * 0.02)
        assert reduction.body.mass == pytest.approx(7850 * volume, rel=1e-3)


def test_lines_are_short():
    assert not [line for line in PAGE.splitlines() if len(line) > 140 and not line.startswith("|")]


def test_readme_leads_here():
    assert "docs/flexible-bodies.md" in (ROOT / "README.md").read_text(encoding="utf-8")
