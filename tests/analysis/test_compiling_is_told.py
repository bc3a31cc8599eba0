"""Compiling takes long enough that people must see it, from scripts too."""

import pytest

from nivel.analysis.plan import compilation
from nivel.analysis.progress.log import Listener


class Entry:
    def __init__(self, name):
        self.name = name


@pytest.fixture
def two_missing(monkeypatch):
    entries = [Entry("nivel.kernels.output.observe:observe"), Entry("nivel.elements.forces.springs:resist.twin")]
    monkeypatch.setattr(compilation.library, "missing", lambda _: entries)
    monkeypatch.setattr(compilation.library, "build", lambda missing, done: [done(each.name) for each in missing])
    return entries


def test_a_script_is_told_on_standard_error(two_missing, capsys):
    compilation.build([], None)
    out, error = capsys.readouterr()
    assert "compiling 2 parts of the machine code (only the first run does this)" in error
    assert out == ""


def test_who_listens_hears_how_far_it_is_and_the_rest_is_silent(two_missing, capsys):
    heard = []
    compilation.build([], Listener(lambda text, _: heard.append(text)))
    assert heard[1].startswith("compiled 1 of 2, about ")
    assert heard[1].endswith(" s left: observe")
    assert heard[2] == "compiled 2 of 2, about 0 s left: springs, exact derivatives"
    assert capsys.readouterr() == ("", "")


def test_nothing_is_said_where_nothing_is_compiled(monkeypatch, capsys):
    monkeypatch.setattr(compilation.library, "missing", lambda _: [])
    compilation.build([], None)
    assert capsys.readouterr() == ("", "")
