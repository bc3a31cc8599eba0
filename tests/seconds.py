"""Seconds of every file of tests: a plugin of pytest that `tests/all.py` loads, and the comparison with those kept.

The seconds of one run stand in a file beside those kept in `tests/seconds.json`. Machines differ in speed, so before two runs are
compared the older one is scaled by the median ratio of its files.
"""

import json
import os
import statistics
from pathlib import Path

KEPT = Path(__file__).parent / "seconds.json"
# seconds by which a file grows before it is named; files below the second number say nothing about the speed of the machine
GROWN, COUNTED = 10.0, 1.0


class Seconds:
    """Seconds of set-up, call and tear-down of all tests, summed by file; written when the session ends."""

    def __init__(self, path):
        self.path, self.files = path, {}

    def pytest_runtest_logreport(self, report):
        name = report.nodeid.partition("::")[0]
        self.files[name] = self.files.get(name, 0.0) + report.duration

    def pytest_sessionfinish(self):
        ordered = sorted(self.files.items(), key=lambda item: -item[1])
        self.path.write_text(json.dumps({name: round(value, 1) for name, value in ordered}, indent=1), encoding="utf-8")


def pytest_configure(config):
    """Only the process that gathers the reports of all others writes."""
    path = os.environ.get("NIVEL_TESTS_SECONDS")
    if path and not hasattr(config, "workerinput"):
        config.pluginmanager.register(Seconds(Path(path)), "seconds of files")


def speed(now, before):
    """How much slower this machine is than that of the seconds kept: the median ratio over files of both."""
    ratios = [now[name] / before[name] for name in now.keys() & before.keys() if min(now[name], before[name]) > COUNTED]
    return statistics.median(ratios) if ratios else 1.0


def grown(now, before):
    """(file, seconds now, seconds before at the speed of now) of the files that grew by `GROWN` and more; files that are new were at 0."""
    factor = speed(now, before)
    found = [(name, value, factor * before.get(name, 0.0)) for name, value in now.items()]
    return sorted((each for each in found if each[1] - each[2] >= GROWN), key=lambda each: each[2] - each[1])


def told(now, before):
    """Lines about a run: its dearest files, and those that grew."""
    yield f"{sum(now.values()):.0f} s in {len(now)} files; the dearest:"
    for name, value in sorted(now.items(), key=lambda item: -item[1])[:10]:
        yield f"  {value:6.1f} s  {name}"
    if before:
        yield f"machine at {speed(now, before):.2f} times the seconds of tests/seconds.json"
        for name, value, was in grown(now, before):
            yield f"  grew from {was:.1f} to {value:.1f} s: {name}"
