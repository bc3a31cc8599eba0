"""Messages, packages and frames: what is written is read back, what is not ours is refused."""

import hashlib
import json
import re
import struct
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from nivel.view import records
from nivel.view.package import Block, layout, message, rows, to_bytes
from nivel.view.page import built
from nivel.view.records import PROTOCOL, Move, Moved, Package, Reset, Shown, Want
from nivel.view.stream import LARGEST, NotUnderstoodError, read_message, said
from nivel.view.typescript import typescript
from packages import from_bytes, unpacked

ROOT = Path(__file__).parent.parent.parent
GENERATED = ROOT / "viewer" / "src" / "generated" / "records.ts"


def test_the_typescript_of_the_records_is_current():
    assert GENERATED.read_text(encoding="utf-8") == typescript(), (
        f"python -m nivel.view.typescript {GENERATED.relative_to(ROOT)}, then npm run build in viewer/"
    )


def test_the_built_page_is_that_of_the_sources():
    folder = ROOT / "viewer"
    files = sorted(
        (path for path in (folder / "src").rglob("*") if path.is_file()),
        key=lambda path: path.relative_to(folder).as_posix(),
    )
    digest = hashlib.sha256()
    for path in [*files, folder / "build.mjs", folder / "package-lock.json"]:
        digest.update(path.read_bytes())
    assert built("SOURCES").strip() == digest.hexdigest(), "npm ci && npm run build in viewer/"


def test_the_lock_file_names_no_registry():
    assert '"resolved"' not in (ROOT / "viewer" / "package-lock.json").read_text(encoding="utf-8")


def test_every_record_and_field_is_in_the_typescript():
    text = typescript()
    for name in ("Stage", "Body", "Joint", "Flexible", "Package", "Move"):
        block = re.search(rf"interface {name} \{{(.*?)\}}", text, re.DOTALL)[1]
        assert re.findall(r"^  (\w+):", block, re.MULTILINE) == [each.name for each in fields(getattr(records, name))]


def test_the_built_page_carries_the_notices_of_what_is_inside():
    for words in ("three", "uplot", "MIT License", "Permission is hereby granted"):
        assert words in built("NOTICE")
    assert "</script" not in built("viewer.js").lower()


@pytest.mark.parametrize(
    "record",
    [Shown("shown", 3), Want("want", 1, 0, "crank.position.x"), Move("move", "hinge.angle", -1.5), Reset("reset")],
)
def test_what_a_page_says_is_read(record):
    assert read_message(json.dumps({each.name: getattr(record, each.name) for each in fields(record)})) == record


@pytest.mark.parametrize(
    "content",
    [
        b"\x00\x01",
        "",
        "[]",
        "{}",
        "null",
        '{"type": "shown"}',
        '{"type": "shown", "frame": -1}',
        '{"type": "shown", "frame": 1.5}',
        '{"type": "shown", "frame": true}',
        '{"type": "shown", "frame": 99999999999999}',
        '{"type": "shown", "frame": 1, "more": 2}',
        '{"type": "move", "coordinate": "a", "value": NaN}',
        '{"type": "move", "coordinate": "a", "value": 1e999}',
        '{"type": "move", "coordinate": 5, "value": 1}',
        '{"type": "move", "coordinate": "a", "value": 1' + "0" * 400 + "}",
        '{"type": ["reset"]}',
        '{"type": "note", "text": "from the server"}',
        "[" * 2000,
        '{"type": "want", "request": 1, "stage": 0, "name": "' + "x" * LARGEST + '"}',
    ],
)
def test_what_no_page_says_is_refused(content):
    with pytest.raises(NotUnderstoodError):
        read_message(content)


@given(
    st.one_of(
        st.binary(max_size=300),
        st.text(max_size=300),
        st.recursive(st.none() | st.integers() | st.text(), st.lists).map(json.dumps),
    )
)
def test_random_content_is_refused_or_read(content):
    try:
        found = read_message(content)
    except NotUnderstoodError:
        return
    assert isinstance(found, Shown | Want | Move | Reset)


def test_the_server_says_only_its_own_records():
    assert json.loads(said(Moved("moved", [1.0, 2.0], ""))) == {"type": "moved", "values": [1.0, 2.0], "problem": ""}
    with pytest.raises(TypeError):
        said(Reset("reset"))


FLOATS = arrays(np.float32, st.tuples(st.integers(0, 5), st.integers(0, 7)))


@given(FLOATS, arrays(np.float64, st.integers(0, 9)), arrays(np.uint32, st.integers(0, 9)))
def test_packed_arrays_are_read_back_bit_by_bit(small, times, indices):
    block = Block()
    places = [block.add(small, "f4"), block.add(times, "f8"), block.add(indices, "u4")]
    head, content = from_bytes(to_bytes(Package(PROTOCOL, "playback", []), block))
    empty: dict[str, list[object]] = {key: [] for key in ("stages", "controls", "gauges", "traced", "parameters")}
    assert head == {"protocol": PROTOCOL, "mode": "playback", **empty}
    for place, values in zip(places, (small, times, indices), strict=True):
        assert place.start % 8 == 0
        again = unpacked({"kind": place.kind, "shape": place.shape, "start": place.start}, content)
        np.testing.assert_array_equal(again.view(np.uint8), np.ascontiguousarray(values).view(np.uint8))


def test_a_frame_is_number_time_and_floats():
    position, orientation = np.arange(6.0).reshape(1, 2, 3), np.arange(8.0).reshape(1, 2, 4)
    modal, vectors = np.array([[0.5]]), np.array([[[7.0, 8.0, 9.0]]])
    (row,) = rows(position, orientation, modal, vectors)
    plan = layout(2, 1, 1)
    assert len(row) == plan.width == 18
    content = message(2**32 + 5, 1.25, row)
    assert struct.unpack_from("<IId", content) == (records.FRAME, 5, 1.25)
    np.testing.assert_array_equal(
        np.frombuffer(content, "<f4", offset=16), [0, 1, 2, 0, 1, 2, 3, 3, 4, 5, 4, 5, 6, 7, 0.5, 7, 8, 9]
    )
