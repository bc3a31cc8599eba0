"""Plain lines about a long computation: what begins, every tenth of it, a word at least every ten seconds."""

from io import StringIO

import pytest

from nivel.analysis.progress.log import LATEST, Log


class Clock:
    def __init__(self):
        self.now = 100.0

    def __call__(self):
        return self.now


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def written(clock):
    stream = StringIO()
    log = Log(stream, clock)
    return log, lambda: stream.getvalue().splitlines()


def test_a_run_of_twenty_seconds_says_every_tenth_of_it(written, clock):
    log, lines = written
    log.stage("preparing")
    log.stage("running", 5.0)
    for k in range(1, 2001):
        clock.now += 0.01
        log.progress(5.0 * k / 2000)
    log.stage("writing the report")
    log.end()
    tenths = [f"running: {k} %" for k in range(10, 101, 10)]
    assert lines() == ["preparing", "running", *tenths, "writing the report", "ended after 20.0 s"]


def test_a_quick_run_has_no_line_about_its_progress(written, clock):
    log, lines = written
    log.stage("running", 1.0)
    for k in range(100):
        clock.now += 0.005
        log.progress(0.01 * k)
    assert lines() == ["running"]


def test_a_slow_run_says_a_word_every_ten_seconds(written, clock):
    log, lines = written
    log.stage("running", 1000.0)
    for k in range(488):
        clock.now += 0.125
        log.progress(0.125 * k)
    assert len(lines()) == 1 + int(60.0 / LATEST)
    assert lines()[-1] == "running: 6 %"


def test_of_many_counted_stages_a_tenth_is_written(written, clock):
    log, lines = written
    for k in range(1, 201):
        log.stage(f"compiled {k} of 200, about 3 s left: spring")
        clock.now += 0.2
    assert lines()[0].startswith("compiled 1 of 200")
    assert [line.split(" of ")[0] for line in lines()[1:]] == [f"compiled {k}" for k in range(20, 201, 20)]
