"""Table of `docs/trust.md` of what each line of the trust report examines, from the records of the checks, and of what nothing examines."""

from __future__ import annotations

import re
import sys
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from typing import Any

from nivel.analysis.trust import checks, subject
from nivel.analysis.trust.check import Check

PAGE = Path(__file__).parents[1] / "docs" / "trust.md"
BEGIN, END = "<!-- what each line examines -->\n", "<!-- to here from packaging/write_trust_table.py -->\n"
ANALYSES = {
    subject.Run: "run",
    subject.Equilibria: "statics",
    subject.Positions: "kinematics",
    subject.Actuated: "inverse",
    subject.Reach: "range of motion",
    subject.Curve: "curve of positions",
    subject.Led: "inverse kinematics",
    subject.Linearisation: "linearise",
    subject.Methods: "compare",
    subject.Sweep: "sweep",
}
SILENT = ("scales", "verification")  # checks without a line
NOTHING = (
    "whether the model describes the machine: masses, stiffnesses, friction, clearances, the law of a contact, the order of a control",
    "errors of elements of beams in stresses, in sections along a beam and in shapes of modes; in *Quantities*",
    "errors of stresses of flexible bodies beyond those of their modes and meshes",
    "Python laws between samples, and what they do outside of the run",
    "other motions that the same start allows: branches behind a singular position that both runs pass, other solutions of friction",
    "the numbers of a run that is not verified, except energy, joints and what is seen without a second run",
)


def table() -> str:
    """The table as Markdown."""
    rows = [row for module in iter_modules(checks.__path__) if (row := _row(module.name)) is not None]
    rows.sort()
    rows += [("nothing", "", "", each, "") for each in NOTHING]
    head = ("line", "of", "needs", "examines", "green below")
    lines = (f"| {' | '.join(row)} |" for row in (head, ("---",) * 5, *rows))
    return re.sub(r"\|  (?=\|)", "| ", "\n".join(lines)) + "\n"


def written(page: str) -> str:
    """The page with the table in its place."""
    before, _, rest = page.partition(BEGIN)
    return f"{before}{BEGIN}{table()}{END}{rest.partition(END)[2]}"


def _row(name: str) -> tuple[str, ...] | None:
    """The row of a module of checks."""
    module: Any = import_module(f"{checks.__name__}.{name}")
    its: tuple[Check[Any, Any], ...] = module.CHECKS
    if its[0].name in SILENT:
        return None
    titles = list(dict.fromkeys(each.title for each in its if each.title)) or [its[0].line.capitalize()]
    of = [word for kind, word in ANALYSES.items() if any(issubclass(kind, each.of) for each in its)]
    needs = [
        need.words
        for need in its[0].needs
        if need.words not in ("frames", "steps") and all(need in each.needs for each in its)
    ]
    green = list(dict.fromkeys(f"{each.threshold.green:g}" for each in its if each.threshold is not None))
    every = "all" if len(of) == len(ANALYSES) else ", ".join(of)
    return ", ".join(titles), every, ", ".join(dict.fromkeys(needs)), _summary(str(module.__doc__)), ", ".join(green)


def _summary(text: str) -> str:
    """The first sentence of a docstring, without its full stop."""
    first = re.sub(r"\s+", " ", text.split("\n\n", maxsplit=1)[0]).strip()
    return re.split(r"\.(?: |$)", first)[0].replace("|", "\\|")


if __name__ == "__main__":
    PAGE.write_text(written(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
    sys.stdout.write(f"{PAGE.name}\n")
