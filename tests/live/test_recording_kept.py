"""A live run that is ended from outside: its recording is kept, found by its name, and played; none of its processes lives on.

Real processes of `nivel live`, real signals.
"""

import os
import pty
import select
import signal
import subprocess
import sys
from contextlib import contextmanager

import numpy as np
import pytest

import cart
from needing import needs
from nivel.errors import ModelError
from nivel.files.reader import parse_machine
from nivel.live.preparation import live_plan
from nivel.live.recording import FIRST_LINE, PART, TICKS, Journal, about_run, journal_of, read_recording
from nivel.live.replay import replay
from patience import PATIENCE

needs("websockets")
SOME = 40_000  # bytes of the journal: some hundred ticks


class Run:
    """`nivel live --record` in a session of processes of its own."""

    def __init__(self, folder, *, terminal=False, given=()):
        self.machine, self.target = folder / "cart.yaml", folder / "cart.live.npz"
        self.machine.write_text(cart.CART)
        self.journal, self.said = journal_of(self.target), folder / "said"
        command = [sys.executable, "-m", "nivel", "live", str(self.machine), "--no-browser", "--no-priority"]
        command += ["--record", str(self.target), *given]
        self.terminal = None
        if terminal:
            process, self.terminal = pty.fork()
            if not process:
                os.execv(sys.executable, command)
            self.process, self.popen = process, None
            return
        with self.said.open("wb") as out:
            self.popen = subprocess.Popen(command, stdout=out, stderr=out, start_new_session=True)
        self.process = self.popen.pid

    def until_recorded(self):
        """Wait until a part of a second is in the journal."""
        header = 0

        def is_long():
            nonlocal header
            self.read_terminal()
            if not self.journal.exists() or not self.processes()[1:]:
                return False
            size = self.journal.stat().st_size
            header = header or size
            return size > header + SOME

        cart.until(is_long, "ticks in the journal")

    def read_terminal(self):
        """What is shown on it, so that the program can go on writing."""
        while self.terminal is not None and select.select([self.terminal], [], [], 0)[0]:
            os.read(self.terminal, 1 << 16)

    def processes(self):
        """The server, and those of its descendants that run Python."""
        return [self.process, *children(self.process)]

    def solver(self):
        return next(each for each in children(self.process) if "spawn_main" in command_of(each))

    def ended(self):
        """Wait for the server; its exit code."""
        if self.popen is not None:
            return self.popen.wait(PATIENCE)
        _, status = os.waitpid(self.process, 0)
        return os.waitstatus_to_exitcode(status)


def children(process):
    found = []
    for each in filter(str.isdecimal, os.listdir("/proc")):
        try:
            with open(f"/proc/{each}/stat") as file:
                parent = int(file.read().rpartition(")")[2].split()[1])
        except OSError:
            continue
        if parent == process:
            found.append(int(each))
    return found


def command_of(process):
    try:
        with open(f"/proc/{process}/cmdline") as file:
            return file.read()
    except OSError:
        return ""


def is_over(process):
    """Whether a process is gone, or waits to be buried."""
    try:
        with open(f"/proc/{process}/stat") as file:
            return file.read().rpartition(")")[2].split()[0] == "Z"
    except OSError:
        return True


@contextmanager
def recording(folder, **given):
    run = Run(folder, **given)
    try:
        run.until_recorded()
        yield run
    finally:
        for each in run.processes():
            if not is_over(each):
                os.kill(each, signal.SIGKILL)
        if run.popen is not None:
            run.popen.wait(PATIENCE)


def assert_played(path):
    """Every frame of the recording is repeated to the last bit."""
    (take,) = read_recording(path).takes
    again = replay(read_recording(path), take)
    assert take.ticks > 100
    assert again.is_identical
    return take


@pytest.mark.parametrize("number", [signal.SIGTERM, pytest.param(signal.SIGHUP, marks=pytest.mark.full)])
def test_a_signal_that_ends_programs_completes_the_recording(tmp_path, number):
    with recording(tmp_path) as run:
        processes = run.processes()
        assert run.journal.read_bytes().startswith(FIRST_LINE)
        assert not run.target.exists()
        os.killpg(run.process, number)
        assert run.ended() == 128 + number
        cart.until(lambda: all(map(is_over, processes)), "the end of all processes")
    assert not run.journal.exists()
    assert assert_played(run.target).whole
    assert f"recording: {run.target}" in run.said.read_text()


@pytest.mark.full
def test_a_closed_terminal_completes_the_recording(tmp_path):
    with recording(tmp_path, terminal=True) as run:
        processes = run.processes()
        os.close(run.terminal)
        assert run.ended() == 128 + signal.SIGHUP
        cart.until(lambda: all(map(is_over, processes)), "the end of all processes")
    assert not run.journal.exists()
    assert_played(run.target)


def test_a_killed_solver_ends_the_run_and_completes_the_recording(tmp_path):
    with recording(tmp_path) as run:
        os.kill(run.solver(), signal.SIGKILL)
        assert run.ended() == 3
    assert "the solver's process was ended from outside" in run.said.read_text()
    assert not run.journal.exists()
    assert_played(run.target)


@pytest.mark.parametrize("whole_group", [False, pytest.param(True, marks=pytest.mark.full)])
def test_of_a_killed_run_the_journal_is_found_and_played_and_no_solver_lives_on(tmp_path, whole_group):
    """Ticks until a moment before the kill are there. The commands that read or write the recording name the journal."""
    with recording(tmp_path) as run:
        processes = run.processes()
        size = run.journal.stat().st_size
        (os.killpg if whole_group else os.kill)(run.process, signal.SIGKILL)
        assert run.ended() == -signal.SIGKILL
        cart.until(lambda: all(map(is_over, processes)), "the end of the solver")
    assert run.journal.stat().st_size >= size
    assert not run.target.exists()
    if not whole_group:
        assert f"`nivel replay {run.journal}` plays it" in run.said.read_text()
    assert not assert_played(run.journal).whole
    nivel = [sys.executable, "-m", "nivel"]
    asked = subprocess.run([*nivel, "replay", run.target], capture_output=True, text=True, check=False)
    assert asked.returncode == 2
    assert f"`nivel replay {run.journal}`" in asked.stderr
    again = [*nivel, "live", run.machine, "--record", run.target]
    refused = subprocess.run(again, capture_output=True, text=True, check=False)
    assert refused.returncode == 2
    assert f"`nivel replay {run.journal}` plays it" in refused.stderr


def journal(folder, rows):
    """A journal of two inputs."""
    plan, pace = live_plan(parse_machine(cart.CART), {}, None)
    out = Journal(folder / "x.live.npz.part", about_run(plan.machine, "", {}, pace))
    out.append(PART, np.array([[-1.0, 0.0]]))
    for each in rows:
        out.append(TICKS, each[None])
    return out


def test_a_journal_ends_with_its_last_whole_block_wherever_it_is_cut(tmp_path, rng):
    rows = rng.normal(size=(3, 10))
    written = journal(tmp_path, rows)
    written.close()
    content = written.path.read_bytes()
    block = (len(content) - content.index(b"\n", len(FIRST_LINE))) // 4  # the part and three ticks
    for cut in range(len(content), len(content) - 2 * block, -7):
        written.path.write_bytes(content[:cut])
        (take,) = read_recording(written.path).takes
        np.testing.assert_array_equal(take.tape, rows[: take.ticks])
        assert take.ticks >= 3 - (len(content) - cut) // 100 - 1
    damaged = bytearray(content)
    damaged[-3] ^= 1
    written.path.write_bytes(damaged)
    assert [each.ticks for each in read_recording(written.path).takes] == [2]


def test_two_runs_do_not_record_into_one_file(tmp_path):
    first = journal(tmp_path, np.zeros((1, 10)))
    with pytest.raises(ModelError, match="that was killed"):
        Journal(first.path, {})
    with pytest.raises(ModelError, match="another run is recording into"):
        Journal(first.path, {}, force=True)
    assert [each.ticks for each in read_recording(first.path).takes] == [1]
    first.close()


def test_a_disk_without_room_leaves_a_journal_that_can_be_read(tmp_path):
    """A write that stops in the middle is taken back, and the next one stands where it stood."""
    written = journal(tmp_path, np.ones((1, 10)))
    whole = written.path.stat().st_size

    class Full:
        def __init__(self, file):
            self.file = file

        def __getattr__(self, name):
            return getattr(self.file, name)

        def write(self, content):
            self.file.write(content[:20])
            raise OSError(28, "No space left on device")

    file = written.file
    written._growing.stream = Full(file)
    with pytest.raises(OSError, match="No space"):
        written.append(TICKS, np.zeros((1, 10)))
    assert written.path.stat().st_size == whole
    written._growing.stream = file
    written.append(TICKS, np.full((1, 10), 2.0))
    written.close()
    (take,) = read_recording(written.path).takes
    assert take.tape[:, 0].tolist() == [1.0, 2.0]
