"""A live machine in its process: it does what it is told, follows its operator within limits, and what it did is repeated exactly."""

import json
import time
from itertools import pairwise
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from click.testing import CliRunner

import cart
from cart import DAMPING, FORCE, MASS, machine, operate, running, until
from nivel import PythonLaw
from nivel.api import Machine
from nivel.cli.live import introduction
from nivel.cli.live import replay as replay_command
from nivel.errors import ModelError, SolveError
from nivel.files.reader import parse_machine
from nivel.integrate.loop.paced import DONE, MODE, NEXT, SAVED, STRETCHED
from nivel.live.page import session_of
from nivel.live.preparation import grip, live_plan, pace_of
from nivel.live.recorder import Recorder
from nivel.live.recording import Recording, Take, about_run, read_recording
from nivel.live.replay import machine_of, replay
from nivel.live.shared import STARTING


@pytest.fixture(scope="module")
def driven(tmp_path_factory):
    """A session that was driven, saved, put back, driven otherwise, left alone until its inputs are at rest, and reset; and the file of its
    recording."""
    notes = {}
    with running() as session:
        assert session.mode == "paused"
        session.command("run")
        operate(session, [1.0, 1.0], 0.8)
        notes["speed"] = session.newest[-3:]
        session.command("save")
        notes["saved"] = int(session.live.control[SAVED])
        operate(session, [np.nan, 7.0], 0.4)
        notes["limits"] = session.values()
        assert session.command("restore") == ""
        operate(session, [-1.0, 0.5], 0.6)
        at_rest = {"lever": 0.0, "brake": 1.0}
        until(lambda: not session.is_operated and session.values() == at_rest, "the rest without an operator")
        session.command("pause")
        notes["paused"] = session.mode, int(session.live.control[DONE])
        time.sleep(0.1)
        session.command("step")
        notes["stepped"] = int(session.live.control[DONE])
        until(lambda: session.newest[0] > 0.0)
        session.command("reset")
        notes["reset"] = int(session.live.control[DONE])
        until(lambda: session.newest[0] == 0.0, "a frame at the start")
        notes["timing"] = session.timing
    path = tmp_path_factory.mktemp("live") / "cart.live.npz"
    write_recording(path, session.plan.machine, session.pace, session.recorder.parts)
    return notes, path


def write_recording(path, record, pace, parts):
    """A recording of these parts, as a run leaves it."""
    kept = [[each.before, each.ticks, each.own.whole] for each in parts]
    about = {**about_run(record, "", {}, pace), "parts": kept}
    arrays = {f"{name}_{k}": getattr(each.own, name) for k, each in enumerate(parts) for name in ("tape", "frames")}
    with path.open("wb") as file:
        np.savez_compressed(file, about=np.array(json.dumps(about)), **arrays)


def longest(path):
    stored = read_recording(path)
    return stored, max(stored.takes, key=lambda take: take.ticks)


def test_commands_do_what_they_say(driven):
    notes, _ = driven
    assert notes["paused"][0] == "paused"
    assert notes["stepped"] == notes["paused"][1] + 1
    assert notes["reset"] == 0


def test_inputs_stay_within_their_limits_and_rest_without_an_operator(driven):
    notes, path = driven
    assert notes["limits"] == {"lever": 0.0, "brake": 2.0}  # no number is rest; beyond the range is its end
    stored, take = longest(path)
    tape = take.tape
    lever = np.concatenate([[0.0], tape[:, 0]])
    assert np.abs(np.diff(lever)).max() <= 4.0 * stored.pace.tick * (1.0 + 1e-12)
    assert lever.max() == 1.0
    assert lever.min() == -1.0


def test_a_live_run_is_the_motion_of_its_recorded_inputs(driven):
    """m v̇ = F u - d b v by RK4 with ten steps a tick, u and b straight from tick to tick."""
    stored, take = longest(driven[1])
    h = stored.pace.tick / 10
    tape = np.vstack([[0.0, 1.0], take.tape[:, :2]])
    places, y = [0.0], np.zeros(2)
    for before, after in pairwise(tape):

        def rate(share, y, before=before, after=after):
            lever, brake = before + share * (after - before)
            return np.array([y[1], (FORCE * lever - DAMPING * brake * y[1]) / MASS])

        for k in range(10):
            k1 = rate(0.1 * k, y)
            k2 = rate(0.1 * k + 0.05, y + 0.5 * h * k1)
            k3 = rate(0.1 * k + 0.05, y + 0.5 * h * k2)
            y = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + rate(0.1 * k + 0.1, y + h * k3))
        places.append(y[0])
    frames = take.frames
    assert len(frames) > 60
    ticks = np.round(frames[:, 0] / stored.pace.tick).astype(int)
    np.testing.assert_allclose(frames[:, 1], np.array(places)[ticks], atol=1e-9)  # column 1: x of the cart


def test_a_restored_state_goes_on_exactly_where_it_was_saved(driven):
    """The take after the restore begins with that before it, and is replayed to the last bit through the moment of the restore."""
    notes, path = driven
    stored, take = longest(path)
    assert take.ticks > notes["saved"]
    assert take.whole
    again = replay(stored, take)
    assert again.compared == len(take.frames) > 60
    assert again.is_identical
    assert again.result.trust.verdict == "green"


def test_a_state_that_is_restored_after_a_reset_leads_back_to_what_came_before_it():
    """To the right, saved; reset, to the left; restored: the take is the first motion and what follows, not that after the reset."""
    with running() as session:
        session.command("run")
        operate(session, [1.0, 1.0], 0.4)
        session.command("pause")
        session.command("save")
        saved = int(session.live.control[SAVED])
        session.command("reset")
        session.command("run")
        operate(session, [-1.0, 1.0], 0.3)
        session.command("restore")
        operate(session, [0.0, 1.0], 0.1)
        session.command("pause")
        takes = session.takes
    first, left, last = takes
    assert last.ticks > saved
    np.testing.assert_array_equal(last.tape[:saved], first.tape[:saved])
    assert first.tape[:saved, 0].max() == 1.0
    assert left.tape[:, 0].min() == -1.0
    stored = Recording(session.plan.machine, "", {}, session.pace, tuple(takes))
    assert all(replay(stored, take).is_identical for take in takes)


def test_frames_that_were_not_kept_are_not_compared_and_others_still_are(driven):
    stored, take = longest(driven[1])
    fewer = np.delete(take.frames, [0, 7, 8, 30], axis=0)
    again = replay(stored, Take(take.tape, fewer))
    assert again.is_identical
    assert again.compared == len(fewer)
    moved = fewer.copy()
    moved[5, 0] += 1e-4
    assert replay(stored, Take(take.tape, moved)).different == 1


def test_a_changed_recording_is_not_called_identical(driven):
    stored, take = longest(driven[1])
    tape = take.tape.copy()
    tape[100, 0] += 1e-9
    again = replay(stored, Take(tape, take.frames))
    assert not again.is_identical
    assert again.first > 0.09


def test_other_methods_repeat_the_run_within_their_error(driven):
    stored, take = longest(driven[1])
    other = Machine.from_record(machine_of(stored, take)).simulate(integrator="dopri5", tolerance=1e-9, verify=False)
    same = replay(stored, take).result
    n = min(len(same.time), len(other.time))
    np.testing.assert_allclose(other.array("rail.displacement")[:n], same.array("rail.displacement")[:n], atol=1e-6)


def test_the_inputs_of_a_recording_stand_in_its_machine(driven):
    stored, take = longest(driven[1])
    lever = machine_of(stored, take).inputs[0].signal
    tape = take.tape
    np.testing.assert_allclose([lever(t) for t in (1 + np.arange(len(tape))) * 1e-3], tape[:, 0], atol=1e-9)


def test_every_tick_is_timed(driven):
    timing = driven[0]["timing"]
    assert timing.ticks > 1500
    assert 0.0 < timing.computing[0] <= timing.computing[1] <= timing.computing[2] <= timing.computing[3]
    assert timing.tick == 1e-3
    assert timing.own <= timing.overruns <= timing.ticks


def test_a_file_that_is_no_recording_is_refused(tmp_path):
    path = tmp_path / "x.npz"
    path.write_text("nothing")
    with pytest.raises(ModelError, match="is no recording of a live run"):
        read_recording(path)
    with pytest.raises(ModelError, match="there is no file"):
        read_recording(tmp_path / "none.npz")


def test_a_recording_that_holds_code_is_replayed_only_where_that_is_allowed(tmp_path):
    record, path = machine().record, tmp_path / "law.live.npz"
    law = PythonLaw("def pull(x):\n    return 20.0 * x\n", "pull", ("lever.value",))
    drive, *others = record.forces
    for forces, has_code in (((drive.replace(effort=law), *others), True), (record.forces, False)):
        write_recording(path, record.replace(forces=forces), pace_of(1e-3, None), [])
        assert read_recording(path).has_code == has_code
        refusal = str(CliRunner().invoke(replay_command, [str(path)]).exception)
        assert ("--allow-code" in refusal) == has_code


def test_integrators_that_choose_their_steps_are_refused():
    with pytest.raises(ModelError, match="`dopri5` chooses its steps; live operation needs fixed ones"):
        live_plan(cart.machine().record, {"integrator": "dopri5"}, None)


def test_ticks_are_whole_steps():
    assert (pace_of(1e-4, None).substeps, pace_of(1e-4, None).every) == (10, 17)
    assert pace_of(2e-3, None).substeps == 1
    assert pace_of(1e-3, 5e-3).substeps == 5
    with pytest.raises(ModelError, match="is not a multiple of the step"):
        pace_of(1e-3, 2.5e-3)
    with pytest.raises(ModelError, match=r"1 s is longer than 0\.1 s"):
        pace_of(1.0, None)


def between_ticks(control, places):
    """Counts of the loop while it sleeps: those that are the same a millisecond later."""
    found, later = [], control[places].tolist()
    while found != later:
        found = later
        time.sleep(1e-3)
        later = control[places].tolist()
    return found


def test_slow_motion_goes_at_its_speed():
    """At a tenth of the speed a tick of 1 ms is due 10 ms after the last one, and so much later as the deadlines were moved on a busy
    machine: the first deadline, from which all are counted, was after the command. Of a session that is not recorded nothing is kept."""
    with session_of(machine(), {}, urgent=False) as session:
        control = session.live.control
        session.set_speed(0.1)
        begin = time.monotonic()
        session.command("run")
        until(lambda: control[DONE] >= 1, "the first tick")
        begun = time.monotonic()
        until(lambda: control[DONE] >= 50, "fifty ticks")
        done, stretched, following = between_ticks(control, [DONE, STRETCHED, NEXT])
        assert session.takes == []
    first = 1e-9 * (following - stretched) - 0.01 * done
    assert begin - 0.01 <= first <= begun + 0.01


def test_a_body_that_is_picked_up_moves_as_the_spring_says_and_its_replay_is_the_same():
    """The cart alone on its rail, drag off: x = d (1 - e^(-ζωt) (cos ω't + ζω/ω' sin ω't)), pulled by d along the rail; the hand's
    work is what the cart has."""
    omega, zeta, far = 2 * np.pi * 1.5, 0.7, 0.3
    with running() as session:
        session.live.target[1] = 0.0  # the brake
        session.command("run")

        def is_held():
            session.operate([0.0, 0.0])
            session.hold(0, [0.0, 0.1, 0.0], [far, 0.2, 0.0])
            return session.live.control[DONE] >= 600

        until(is_held, "0.6 s in the hand")
        session.let_go()
        until(lambda: session.live.value[-8] == 0.0, "let go")
        session.command("pause")
    take = session.takes[-1]
    stored = Recording(session.plan.machine, "", {}, session.pace, (take,))
    again = replay(stored, take)
    assert again.is_identical
    result = again.result
    tape = take.tape
    held = tape[:, 2] == 1.0
    begin = (1 + np.argmax(held)) * 1e-3
    assert held.sum() > 200
    assert np.all(tape[held][:, 4:] == [0, 0.1, 0, far, 0.2, 0.0])
    t = result.time - begin
    inside = (t > 0) & (result.time < (1 + np.flatnonzero(held)[-1]) * 1e-3)
    swing = omega * np.sqrt(1 - zeta**2)
    t = t[inside] + 0.5e-3  # the pull rises within the tick before
    exact = far * (1 - np.exp(-zeta * omega * t) * (np.cos(swing * t) + zeta * omega / swing * np.sin(swing * t)))
    np.testing.assert_allclose(result.array("rail.displacement")[inside], exact, atol=1e-4 * far)
    assert result.trust.verdict == "green"
    assert result.array("external_work")[inside][-1] == pytest.approx(
        result.array("kinetic_energy")[inside][-1], rel=1e-3
    )


def test_a_run_that_fails_says_why_and_its_replay_fails_as_it_did():
    """√(0.2 - x) is no number beyond 0.2 m. Only a reset goes on from there."""
    text = cart.CART.replace("effort: 20.0*lever.value", "effort: 20.0*lever.value + 0*sqrt(0.2 - rail.displacement)")
    assert "sqrt" in text
    fragile = Machine.from_record(parse_machine(text))
    with (
        TemporaryDirectory() as folder,
        session_of(fragile, {}, urgent=False, record=Path(folder) / "x.live.npz") as session,
    ):
        session.command("run")
        while session.mode == "running":
            operate(session, [1.0, 1.0], 0.05)
        assert session.mode == "failed"
        until(lambda: session.problem)
        assert "drive is not a number" in session.problem
        assert "go back to the start" in session.command("run")
        at = float(session.live.control[DONE]) * session.pace.tick
        assert session.command("reset") == ""
        assert session.mode == "paused"
        take = session.takes[0]
    assert take.ticks * session.pace.tick == pytest.approx(at)
    with pytest.raises(SolveError, match="drive is not a number") as failure:
        replay(Recording(session.plan.machine, "", {}, session.pace, (take,)), take)
    assert failure.value.result.array("rail.displacement")[-1] < 0.2


def test_the_hand_lets_go_before_it_takes_another_point():
    """A hand that rests, holds point 1 of body 3, is sent to body 5, and holds that."""
    rest, far = [0.0] * 8, [7.0, 8.0, 9.0]
    taken = grip(rest, 3, [1.0, 0.0, 0.0], far)
    assert taken == [0.0, 3.0, 1.0, 0.0, 0.0, *far]
    holding = grip(taken, 3, [1.0, 0.0, 0.0], far)
    assert holding == [1.0, *taken[1:]]
    loose = grip(holding, 5, [0.0, 0.0, 0.0], [0.0, 0.0, 0.0])
    assert loose == [0.0, *holding[1:]]
    assert grip(loose, 5, [0.0, 0.0, 0.0], far) == [0.0, 5.0, 0.0, 0.0, 0.0, *far]


def test_the_terminal_names_levers_and_keys_as_the_page_does():
    text = cart.CART.replace("lever: {range: [-1, 1],", "lever: {range: [-1, 1], description: moves the cart,")
    text = text.replace("raise: d, lower: a", "raise: ArrowUp, lower: a")
    with session_of(Machine.from_record(parse_machine(text)), {}, urgent=False) as session:
        assert [*introduction(session)][1:] == ["  Lever (moves the cart): ↑, the other way A"]


def test_a_running_machine_that_goes_back_to_its_start_loses_no_frame(monkeypatch):
    """Even where the server hears of it late: the first frame is that of the start, the others follow at equal times."""
    with cart.running() as session:
        session.command("run")
        cart.until(lambda: session.newest is not None and session.newest[0] > 0.1, "a tenth of a second")
        do = session._do

        def late(code):
            done = do(code)
            time.sleep(0.1)
            return done

        monkeypatch.setattr(session, "_do", late)
        assert session.command("reset") == ""
        assert session.mode == "running"
        cart.until(lambda: session.newest[0] > 0.2, "frames after the reset")
        session.command("pause")
        times = np.array([frame[0] for frame in session.history.after(0)[1]])
    assert times[0] == 0.0
    np.testing.assert_allclose(np.diff(times), session.pace.every * session.pace.tick, rtol=1e-6)


def test_the_first_frame_is_seen_however_late_frames_are_gathered(monkeypatch):
    """The solver counts frames of ticks that leave no trace, and begins anew: who counted with it would wait for ever."""
    begin = Recorder.__init__

    def late(self, live, *more):
        end = time.monotonic() + 2.0
        while int(live.control[MODE]) == STARTING and time.monotonic() < end:
            time.sleep(0.01)
        begin(self, live, *more)

    monkeypatch.setattr(Recorder, "__init__", late)
    with running() as session:
        until(lambda: session.newest is not None, "the first frame")
