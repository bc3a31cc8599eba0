"""The light of a live run says while it goes on what the trust report of the same motion says afterwards."""

import re

import numpy as np
import pytest
from click.testing import CliRunner

import cart
from cart import operate, until
from nivel.api import Machine
from nivel.cli import live as command
from nivel.files.reader import parse_machine
from nivel.live.light import Counts, Judge
from nivel.live.page import session_of
from nivel.live.recording import Recording
from nivel.live.replay import replay
from nivel.live.timing import Timing

STIFF = 5e6  # N/m: 1600 rad/s with 2 kg, of which a step of 1 ms is 1.6 rad
PUSH = f"'{STIFF}*(max(0, -0.05 - rail.displacement) - max(0, rail.displacement - 0.05))'"
WALL = f"forces:\n  wall: {{type: motor, coordinate: rail, effort: {PUSH}}}"
CALM = Timing(1000, 1e-3, (1e-5,) * 5, (1e-5,) * 5, 0, 0, 0.0)


def stiff():
    """The cart between two walls so stiff that a contact is over within a few steps."""
    return Machine.from_record(parse_machine(cart.CART.replace("forces:", WALL)))


@pytest.mark.parametrize("made", [stiff, cart.machine])
def test_the_light_is_that_of_the_trust_report_of_the_same_motion(made, tmp_path):
    """Every line of the report on energy and joints that is not green is among the reasons, with the same numbers."""
    with session_of(made(), {}, urgent=False, record=tmp_path / "x.live.npz") as session:
        session.command("run")
        operate(session, [1.0, 1.0], 0.5)
        # between two walls: at one the error grows from the last frame to the pause, which the light has not seen
        operate(session, [-1.0, 1.0], 0.58)
        session.command("pause")
        until(lambda: session.mode == "paused", "the pause")
        looks = session.looks
        # one may be going on now; the next one begins after the pause
        until(lambda: session.looks > looks + 1, "a look after the pause")
        light, (take,) = session.light, session.takes
    trust = replay(Recording(session.plan.machine, "", {}, session.pace, (take,)), take).result.trust
    kept = [each for each in trust.items if each.name in ("energy", "violation", "rate_violation")]
    told = [each for each in light.reasons if not each.startswith("Real time")]
    of_report = [each.text for each in kept if each.verdict != "green"]
    # the report also says which force does it
    assert [each.partition(" (")[0] for each in told] == [re.split(" \\(|;", each)[0] for each in of_report]
    assert ("red" in {each.verdict for each in kept}) == (made is stiff)
    if made is stiff:
        assert light.verdict == "red"
        assert told[0].startswith("Energy: error ")


def test_the_light_is_green_again_after_a_reset_and_red_of_a_failed_run():
    text = cart.CART.replace("effort: 20.0*lever.value", "effort: 20.0*lever.value + 0*sqrt(0.02 - rail.displacement)")
    with session_of(Machine.from_record(parse_machine(text)), {}, urgent=False) as session:
        session.command("run")
        while session.mode == "running":
            operate(session, [1.0, 1.0], 0.05)
        until(lambda: session.light.verdict == "red", "a red light")
        assert "drive is not a number" in session.light.reasons[0]
        session.command("reset")
        assert session.light.verdict == "green"


def judged(*, timing=CALM, counts=None):
    return Judge(None, {}).light(timing, counts or Counts(), 1000)


def test_divided_steps_and_overruns_have_their_lights():
    """The thresholds of `pressure steps` are 1 % and 10 % of the steps, those of real time 1 % and 10 % of ticks or of the time."""
    for guarded, verdict in ((9, "green"), (11, "amber"), (101, "red")):
        assert judged(counts=Counts(0.0, True, 200, guarded, 1e5)).verdict == verdict
    for own, verdict in ((9, "green"), (11, "amber"), (101, "red")):
        late = Timing(1000, 1e-3, (1e-5,) * 5, (1e-5,) * 5, 2 * own, own, 0.0)
        assert judged(timing=late).verdict == verdict
    stretched = Timing(1000, 1e-3, (1e-5,) * 5, (1e-5,) * 5, 50, 0, 0.5)
    light = judged(timing=stretched)
    assert light.verdict == "red"
    assert "stretched by 50 %" in light.reasons[0]


def test_a_look_costs_little_however_long_the_run_was():
    """Once a second sixty frames are looked at, and the first one: none of those before."""
    sizes = []

    class Counted(Judge, frozen=False):
        def _look(self, frames, kinetic_energy):
            sizes.append(len(frames))

    judge = Counted(None, {})
    for _ in range(20):
        judge.take(np.zeros((60, 3)))
        judge.light(CALM, Counts(), 0)
    assert sizes == [61] * 20


def test_the_end_of_a_run_says_what_its_trust_report_would_be(tmp_path, monkeypatch):
    """With the exit code of a run that went through: only a failure changes it."""
    path = tmp_path / "stiff.yaml"
    path.write_text(cart.CART.replace("forces:", WALL))

    def serve(source, **_given):
        session = source._session
        operate(session, [1.0, 1.0], 0.6)

    monkeypatch.setattr("nivel.view.server.serve", serve)
    done = CliRunner().invoke(command.command, [str(path), "--no-browser", "--no-priority", "--udp", "127.0.0.1:0"])
    assert done.exit_code == 0, done.output
    assert re.search(r"datagrams: received at 127\.0\.0\.1:[1-9]\d+\n", done.output)  # 0 is any free port
    assert "datagrams: 0 taken; dropped: 0 malformed" in done.output
    assert "the trust report of this run would be red:" in done.output
    assert "not verified: the errors of its steps were not examined" in done.output
    assert "Energy: error " in done.output
