"""The installation of the README: after its command the commands that it names next work, without another one."""

import os
import re
import shutil
import signal
import subprocess
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import pytest

from browsing import chromium, until, watched
from patience import PATIENCE

ROOT = Path(__file__).parent.parent
README = (ROOT / "README.md").read_text(encoding="utf-8")
# of the repository: what is installed, and machines
COPIED = ("pyproject.toml", "README.md", "LICENSE", "packaging", "src", "examples")
NOT_COPIED = shutil.ignore_patterns("__pycache__", "shipped")
MOVED = 0.05  # m


def commands(mark):
    """The lines of a block of the README."""
    (found,) = re.findall(rf"<!-- {mark} -->\n```bash\n(.*?)```", README, re.DOTALL)
    return found.strip().splitlines()


# full: wheels are installed and run by their check, CI installs the sources, and pages of demos and results have tests of their own
pytestmark = pytest.mark.full


@pytest.fixture(params=["kept", "new"])
def installed(request, tmp_path):
    """A copy of the repository in which the README's command has run, and the environment of its commands.

    Machine code is what the tests have compiled, where versions are the same, or compiled as by a new user.
    """
    folder = tmp_path / "nivel"
    folder.mkdir()
    for name in COPIED:
        copy = shutil.copy if (ROOT / name).is_file() else partial(shutil.copytree, ignore=NOT_COPIED)
        copy(ROOT / name, folder / name)
    own = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "VIRTUAL_ENV")}
    own["PIP_COMPILE"] = "0"  # of what is installed little is imported
    if request.param == "new":
        own["NIVEL_CACHE_DIR"] = str(folder / "machine-code")
    (command,) = commands("run")
    done = subprocess.run(["bash", "-c", command], cwd=folder, env=own, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return folder, own


@contextmanager
def shown(installed, command):
    """What a command of the README says up to the address of its page, and the address; ended as by Ctrl-C."""
    folder, environment = installed
    running = subprocess.Popen(
        [*command.split(), "--no-browser"], cwd=folder, env=environment, stderr=subprocess.PIPE, text=True
    )
    try:
        said = ""
        for line in running.stderr:
            said += line
            if found := re.search(r"viewer: (\S+)", line):
                yield said, found[1]
                break
        else:
            pytest.fail(f"`{command}` showed no page:\n{said}")
        running.send_signal(signal.SIGINT)
        rest = running.communicate(timeout=PATIENCE)[1]
        assert running.returncode == 0, rest
    finally:
        running.kill()
        running.communicate()


def test_the_first_machine_has_run_the_demo_is_operated_and_the_result_is_shown(installed):
    """One test, so that one process of pytest installs."""
    folder, _ = installed
    assert (folder / "slider-crank.nc").stat().st_size > 0
    assert "slider-crank" in (folder / "slider-crank.html").read_text(encoding="utf-8")
    demo, view = commands("look")
    with chromium() as browser:
        with shown(installed, demo) as (said, address), watched(browser) as seen:
            page = seen.open(address)
            until(page, "!!nivel.app.live.status")
            before = poses(seen)
            key = re.search(r"Lift lever[^:]*: (\w), the other way", said)[1].lower()
            page.keyboard.down(key)
            until(page, lambda: moved(before, poses(seen)) > MOVED)
            page.keyboard.up(key)
        with shown(installed, view) as (_, address), watched(browser) as seen:
            page = seen.open(address)
            before = poses(seen)
            page.keyboard.press("Space")
            until(page, lambda: moved(before, poses(seen)) > MOVED)


def poses(seen):
    """Positions of all bodies that are drawn."""
    return [seen.pose(k)[:3] for k in range(seen.page.evaluate("nivel.app.actor.bodies.length"))]


def moved(before, after):
    """The longest way of a body along an axis [m]."""
    return max(abs(x - y) for one, other in zip(before, after, strict=True) for x, y in zip(one, other, strict=True))
