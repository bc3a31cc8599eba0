"""Files that are none, and words that would harm: a sentence, at once."""

import os

import pytest
import yaml

from nivel.errors import Fault, ModelError
from nivel.files import parse_machine, read_machine
from nivel.files.nodes import MOST
from nivel.flexible.foreign.matrix import FormatError
from nivel.flexible.foreign.read_mesh import read_mesh

BODY = "bodies: {a: {mass: %s, inertia: [1, 1, 1]}}\n"


def told(text):
    with pytest.raises(ModelError) as caught:
        parse_machine("format: 1\nname: one\n" + text)
    return str(caught.value)


@pytest.mark.parametrize("name", ["m⁰", "kg⁺", "n" * 100_000, "½", "m‿s"])
def test_odd_and_long_units_are_refused_in_a_sentence(name):
    message = told(BODY % f"1 {name}")
    assert "bodies.a.mass" in message
    assert len(message) < 3000


def test_devices_and_pipes_are_no_files(tmp_path):
    os.mkfifo(tmp_path / "pipe.yaml")
    for file in ("/dev/zero", tmp_path / "pipe.yaml"):
        with pytest.raises(ModelError, match="a device or a pipe"):
            read_machine(file)


def test_a_huge_file_is_refused_unread(tmp_path):
    with (tmp_path / "huge.yaml").open("wb") as file:
        file.truncate(10**9)  # a hole, which takes no place
    with pytest.raises(ModelError, match="1000 MB; up to 500 MB are read"):
        read_machine(tmp_path / "huge.yaml")


def test_messages_steer_no_terminal():
    assert "\x1b" not in told('bodies: {"a\\e[2J": {mass: 1}}\n')
    fault = Fault("m\x1b.yaml", 1, 1, "bodies.\u202ea", "x" * 10_000 + "\x07")
    assert str(fault).isprintable()
    assert len(str(fault)) < 3000


def test_what_is_no_machine_file_is_not_quoted(tmp_path):
    (tmp_path / "secret").write_text("root:x:0:0\npassword = 1234\n")
    (tmp_path / "machine.yaml").write_text("format: 1\nname: one\ninclude: secret\n" + BODY % 1)
    with pytest.raises(ModelError, match="`format: 1` is missing: this is no machine file") as caught:
        read_machine(tmp_path / "machine.yaml")
    assert "root:x" not in str(caught.value)
    assert "password" not in str(caught.value)


FLAT = """*HEADING
*PART, NAME=P
*END PART
*ASSEMBLY, NAME=A
*INSTANCE, NAME=P-1, PART=P
%s*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 0, 1, 0
4, 0, 0, 1
*ELEMENT, TYPE=C3D4
1, 1, 2, 3, 4
%s*END INSTANCE
*END ASSEMBLY
"""


def test_an_instance_that_moves_nothing_is_read(tmp_path):
    path = tmp_path / "flat.inp"
    path.write_text(FLAT % ("", ""))
    assert len(read_mesh(path).elements) == 1
    for lines, message in (
        (("0.0, 1.0, 0.0\n", ""), "line 6: .*moves its nodes by `0.0, 1.0, 0.0`"),
        (("", "*INSTANCE, NAME=P-2, PART=P\n"), "line 13: this is a second .INSTANCE"),
    ):
        path.write_text(FLAT % lines)
        with pytest.raises((FormatError, ModelError), match=message):
            read_mesh(path)


FREE = "format: 1\nbodies:\n  a: &a {mass: 1, inertia: [1, 1, 1]}\n"
LONG = {
    "a list of 100 MB": lambda: f"{FREE}sensors: [{'1,' * 50_000_000}1]\n",
    "a million bodies": lambda: FREE + "".join(f"  b{k}: *a\n" for k in range(1_000_000)),
    "a table of a million points": lambda: (
        f"{FREE}functions: {{f: {{times: [{', '.join(map(str, range(1_000_000)))}]}}}}\n"
    ),
}


@pytest.mark.parametrize("kind", LONG)
def test_endless_files_are_refused_before_all_of_them_is_read(kind, monkeypatch):
    text, parse, events = LONG[kind](), yaml.parse, []

    def counted(*arguments, **more):
        for event in parse(*arguments, **more):
            events.append(None)
            yield event

    monkeypatch.setattr(yaml, "parse", counted)
    with pytest.raises(
        ModelError, match="the file has more than 200000 values; long tables belong in a CSV file"
    ) as caught:
        parse_machine(text, "machine.yaml")
    assert len(events) < 2.2 * MOST
    assert caught.value.faults[0].line
