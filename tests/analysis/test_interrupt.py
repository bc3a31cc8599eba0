"""Signals that come while a run goes on: what was computed is kept, and a program that shall end does."""

import signal

import pytest

import machines
from nivel import Machine
from nivel.analysis.progress.log import Listener
from nivel.files import parse_machine
from nivel.results import Result

SWINGING = """
format: 1
gravity: [0, -9.81, 0]
bodies: {{arm: {{mass: 1, inertia: [1, 1, 1], position: [0.3, 0, 0]}}}}
joints: {{hinge: {{type: revolute, bodies: [ground, arm], point: [0, 0, 0], axis: [0, 0, 1]}}}}
drivers: {{drive: {{coordinate: hinge, value: {}}}}}
"""


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
    before = signal.getsignal(signal.SIGINT)
    result = interrupted_by(signal.SIGINT, tmp_path / "a.nc")
    assert result.outcome == "interrupted"
    assert signal.getsignal(signal.SIGINT) is before


def test_sigterm_ends_the_program_with_the_result_closed(tmp_path):
    with pytest.raises(SystemExit) as end:
        interrupted_by(signal.SIGTERM, tmp_path / "a.nc")
    assert end.value.code == 128 + signal.SIGTERM
    assert Result.open(tmp_path / "a.nc").outcome == "interrupted"
    assert signal.getsignal(signal.SIGTERM) == signal.SIG_DFL


@pytest.mark.parametrize("analysis", ["statics", "kinematics"])
def test_sigterm_ends_other_analyses_likewise(analysis, tmp_path):
    """Each with what it had found until then in a result that is closed."""
    path = tmp_path / "a.nc"
    listener = Listener(progress=lambda _time: signal.raise_signal(signal.SIGTERM))
    machine = Machine.from_record(
        parse_machine(SWINGING.format("0.1*time" if analysis == "kinematics" else "0.1*sin(time)"))
    )
    with pytest.raises(SystemExit) as end:
        getattr(machine, analysis)(duration=1.0, out=path, listener=listener)
    assert end.value.code == 128 + signal.SIGTERM
    result = Result.open(path)
    assert result.outcome == "interrupted"
    assert len(result.time) > 0
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
