"""The script that feeds wrong input runs, and what it found once is mended; `python tests/fuzz.py --full` has ten thousand cases."""

import json
import random

import pytest

import fuzz
from nivel.errors import ModelError
from nivel.files.mesh_file import read_mesh


@pytest.mark.parametrize(
    "kind",
    [
        "meshes",
        "models",
        "input_tables",
        "expressions",
        "machine_files",
        "machine_values",
        "robots",
        "studies",
        "decks",
    ],
)
def test_wrong_input_is_refused_in_words(kind, tmp_path, monkeypatch):
    monkeypatch.setattr(fuzz.signal, "alarm", lambda _seconds: 0)
    for number in range(25):
        wrong = fuzz.tried(fuzz.KINDS[kind](random.Random(number), tmp_path))
        assert not wrong, (number, wrong)


def test_nodes_with_two_parents_are_refused_at_once(tmp_path):
    """Forty levels of two children that are one: two to the power of forty paths."""
    nodes = [{"children": [k + 1, k + 1]} for k in range(40)] + [{}]
    (tmp_path / "deep.gltf").write_text(
        json.dumps({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": nodes})
    )
    with pytest.raises(ModelError, match="two parents"):
        read_mesh(tmp_path / "deep.gltf")


def test_a_primitive_that_is_none_is_refused(tmp_path):
    scene = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [None]}],
    }
    (tmp_path / "none.gltf").write_text(json.dumps(scene))
    with pytest.raises(ModelError, match="damaged"):
        read_mesh(tmp_path / "none.gltf")
