"""Wrong input of every kind: machine files, expressions, tables, meshes, models, result files. Nothing may end in a traceback, take
more than ten seconds or more than two gigabytes.

    python tests/fuzz.py               # some hundred cases
    python tests/fuzz.py --full        # ten thousand
    python tests/fuzz.py --seed 7 meshes expressions

Each case is written to the folder that is printed before it is tried; what fails stays there.
"""

from __future__ import annotations

import argparse
import random
import resource
import signal
import sys
import tempfile
import traceback
from collections.abc import Callable
from pathlib import Path

from fuzz_cases import KINDS
from nivel.errors import NivelError

SECONDS, MEMORY = 10, 2 * 1024**3
FEW, MANY = 1200, 10_000


class TooLongError(Exception):
    """A case that takes longer than SECONDS."""


def _too_long(_signal: int, _frame: object) -> None:
    raise TooLongError


def tried(case: Callable[[], object]) -> str:
    """What went wrong with a case; empty where it was computed, or refused in words."""
    signal.alarm(SECONDS)
    try:
        case()
    except (NivelError, UnicodeEncodeError):
        return ""
    except TooLongError:
        return f"took more than {SECONDS} s"
    except BaseException:
        return traceback.format_exc(limit=-4)
    finally:
        signal.alarm(0)
    return ""


def main() -> int:
    """Try the cases; how many failed is the exit code."""
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("kinds", nargs="*", metavar="KIND", help=", ".join(KINDS))
    options.add_argument("--full", action="store_true")
    options.add_argument("--seed", type=int, default=0)
    given = options.parse_args()
    kinds = given.kinds or list(KINDS)
    if unknown := set(kinds) - set(KINDS):
        options.error(f"there are no {', '.join(unknown)}; there are {', '.join(KINDS)}")
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    signal.signal(signal.SIGALRM, _too_long)
    base = Path(tempfile.mkdtemp(prefix="nivel-fuzz-"))
    print(f"cases in {base}")
    failed: dict[str, int] = {}
    for number in range(MANY if given.full else FEW):
        rng = random.Random(f"{given.seed} {number}")
        folder = base / f"{number}"
        folder.mkdir()
        kind = kinds[number % len(kinds)]
        wrong = tried(KINDS[kind](rng, folder))
        if wrong:
            last = wrong.strip().splitlines()[-1]
            failed[last] = failed.get(last, 0) + 1
            if failed[last] == 1:
                print(f"{folder} ({kind}): {wrong}")
        else:
            for path in folder.iterdir():
                path.unlink()
            folder.rmdir()
    print(f"{sum(failed.values())} failed, in {len(failed)} ways")
    return min(sum(failed.values()), 1)


if __name__ == "__main__":
    sys.exit(main())
