"""Signals that come while a run goes on: what was computed is kept, and a program that shall end does."""

import signal

import pytest

import machines
from nivel import Machine
from nivel.analysis.progress.listener import Listener
from nivel.results import Result


def interrupted_by(number, path, **settings):
    """A run to which this signal comes as soon as it has begun."""
    came = []

    def progress(_time):
        if not came:
            came.append(number)
            signal.raise_signal(number)

    machine = Machine.from_record(machines.slider_crank())
    return machine.simulate(
        duration=1e4, out=path, verify=False, listener=Listener(progress=progress), output_interval=1, **settings
    )


def test_ctrl_c_gives_what_was_computed(tmp_path):
    result = interrupted_by(signal.SIGINT, tmp_path / "a.nc")
    assert result.outcome == "interrupted"
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_sigterm_ends_the_program_with_the_result_closed(tmp_path):
    with pytest.raises(SystemExit) as end:
        interrupted_by(signal.SIGTERM, tmp_path / "a.nc")
    assert end.value.code == 128 + signal.SIGTERM
    assert Result.open(tmp_path / "a.nc").outcome == "interrupted"
    assert signal.getsignal(signal.SIGTERM) == signal.SIG_DFL


def test_a_programs_own_handler_of_sigterm_is_called_when_the_result_is_closed(tmp_path):
    outcomes = []
    path = tmp_path / "a.nc"
    before = signal.signal(signal.SIGTERM, lambda *_: outcomes.append(Result.open(path).outcome))
    try:
        result = interrupted_by(signal.SIGTERM, path)
    finally:
        signal.signal(signal.SIGTERM, before)
    assert outcomes == [result.outcome] == ["interrupted"]
