"""What the default tests are worth: lines of kernels are spoilt, one at a time, and each has to be noticed.

    python tests/mutation_guard.py [--seed N] [--count N] [--first N] [--named] [--only TEXT] [--list]

Thirty lines are chosen by a seed: a sign, an operator, an index or a number is changed (`mutations.py`); with `--named` they are those of
`spoilt_lines.py`. Of each line the tests that touch its kernel (`COVER`) run on a copy of the sources in which it is spoilt: first those of
the default lane, until one fails; where none does, the kernels as plain Python, which are of the default lane as well; and at last the
tests marked `full`. A line that only these notice is a reason to take one of them into the default lane; one that nobody notices is a test
that is missing, or changes nothing but a guess, a limit or the order of a sum. Machine code that does not depend on the file spoilt is
taken from a copy of the user's cache, where `nivel warmup` has left it; what the tests need of the rest compiles. The working tree is left
alone.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import mutations
from nivel.native import store
from spoilt_lines import NAMED, verification
from test_house import PLAIN

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "src" / "nivel"
# outcomes of pytest: all tests passed; none was selected
PASSED, NONE_THERE = 0, 5
# a spoilt line may let a loop run for ever [s]
LONGEST = 1800
BY_DEFAULT, BY_FULL, NOT_AT_ALL = "default", "full", "none"


STATES = verification("residual_and_tangent", "consistency")
BEAMS = verification("beam_elements", "beam_motion", "beam_methods")
FLEXIBLE = tuple(
    f"flexible/test_{name}.py"
    for name in (
        "flexible_motion",
        "invariants",
        "stiffening",
        "tumbling",
        "flexible_tree",
        "flexible_independent",
        "mixed_trees",
        "interfaces",
        "pendulum",
        "against_beams",
    )
)
HYDRAULICS = tuple(
    f"hydraulics/test_{name}.py"
    for name in (
        "characteristics",
        "circuit_steps",
        "circuit_tangents",
        "volumes",
        "dynamics",
        "pneumatics",
        "end_stops",
        "steps_in_parts",
        "boom",
        "circuits_at_rest",
        "start_of_several_cylinders",
        "crane",
    )
)
IMPLICIT = verification("alpha", "implicit_lagrange", "implicit_independent", "implicit_friction", "tolerance")
# tests that touch the kernels of a file, the cheapest first: the entry with the longest beginning of its path is taken
COVER = {
    "integrate/": ("integrate/test_orders.py", "integrate/test_chosen_steps.py", *verification("tolerance", "events")),
    "integrate/explicit/": (
        "integrate/test_runge_kutta_tables.py", "integrate/test_orders.py", "integrate/test_chosen_steps.py",
        *verification("tolerance", "events", "motion"),
    ),
    "integrate/loop/": (
        "integrate/test_loop.py", "integrate/test_chosen_steps.py",
        *verification("events", "contact_location", "driver_corners", "force_corners", "jumps_in_time", "switches", "geometric", "states"),
        *verification("tolerance"),
        "live/test_budget.py",
    ),
    "integrate/multistep/": (
        "integrate/test_multistep_weights.py", "integrate/test_multistep.py", "integrate/test_orders.py",
        *verification("stiff", "newton_convergence"),
    ),
    "elements/": STATES,
    "elements/forces/": (
        *verification("springs", "everyday_forces", "element_references", "motors", "drives", "loads"), *STATES,
    ),
    "integrate/newmark/": (*IMPLICIT, *verification(
        "implicit_tolerance", "energy_momentum", "stiff_springs", "newton_policy", "implicit_penalties", "stiff_dampers", "jams",
    )),
    "integrate/radau/": verification("radau", "implicit_tolerance", "implicit_friction"),
    "integrate/rosenbrock/": (*verification("ros2"), *HYDRAULICS),
    "integrate/stabilise.py": verification("geometric", "formulations", "motion"),
    "integrate/variable_order/": ("integrate/test_multistep_polynomials.py", *verification("bdf", "tolerance", "implicit_tolerance")),
    "kernels/": STATES,
    "kernels/algebra/": (
        *(f"kernels/test_{name}.py" for name in ("rotation", "rotation_coordinates", "lu", "sparse_lu", "saddle_solvers", "trigonometry")),
        *verification("joints", "motion", "rotations", "euler_angle_sensors"), *STATES,
    ),
    "kernels/bodies/": (
        *verification("joints", "motion", "mechanisms", "rolling", "couplings", "driven_poses", "driven_lengths", "rails"),
        *verification("special_joints", "compound_joints"), *STATES,
    ),
    "kernels/bodies/floating": FLEXIBLE,
    "kernels/bodies/geometric": FLEXIBLE,
    "kernels/bodies/shared": (*verification("rails", "eliminated_rails"), *FLEXIBLE),
    "kernels/bodies/rail": (*verification("rails", "eliminated_rails"), *STATES),
    "kernels/elements/": (*BEAMS, *verification("friction", "frictions_together", "held_friction", "implicit_friction")),
    "kernels/forces/": (
        *verification("springs", "everyday_forces", "contact", "element_references", "motors", "drives", "loads"), *STATES,
    ),
    "elements/contacts/": (*verification("contact", "contact_location", "pairs_of_shapes", "contact_that_sticks"), *STATES),
    "elements/contacts/hulls": (*verification("contact_of_hulls", "contact_of_two_hulls"), *STATES),
    "elements/contacts/pressure_cells": (*verification("contact_of_hulls", "contact_of_two_hulls"), *STATES),
    "elements/contacts/height": (*verification("height_fields"), *STATES),
    "elements/contacts/heap": (*verification("contacts_of_many"), *STATES),
    "elements/contacts/ellipsoids": (*verification("ellipsoids", "pairs_of_shapes"), *STATES),
    "elements/forces/ropes": (*verification("ropes"), *STATES),
    "elements/beams/": (*verification("statics_beams"), *BEAMS),
    "elements/beams/ancf": verification("gradient_beams"),
    "elements/circuits/": HYDRAULICS,
    "kernels/output/": (*verification("consistency", "motion", "redundant_loops"), "flexible/test_flexible_motion.py"),
    "kernels/record/": ("machine/test_time_functions.py", "system/test_programs.py", *verification("drivers", "laws", "control"), *STATES),
    "kernels/residual/": (
        *STATES,
        *verification("residual", "tangent_structure", "implicit_points", "shifted_parts", "rails", "energy_momentum"), *IMPLICIT,
    ),
    "kernels/residual/flexible": ("flexible/test_flexible_energy_momentum.py", *FLEXIBLE),
    "kernels/residual/shared": ("flexible/test_flexible_energy_momentum.py", *verification("rails", "energy_momentum"), *FLEXIBLE),
    "kernels/signals/": (*verification("sensors", "control", "states", "events", "inputs"), "live/test_budget.py"),
    "kernels/solve/": (
        "kernels/test_saddle_solvers.py",
        *verification("independent", "formulations", "redundant_loops", "singular_positions", "implicit_independent"), *STATES,
    ),
    "kernels/solve/flexible": ("flexible/test_flexible_independent.py", "flexible/test_redundant_flexible.py", *FLEXIBLE),
    "kernels/tree/": (*verification("relative", "relative_runs", "relative_turns", "eliminated_rails"), *STATES),
    "kernels/tree/flexible": ("flexible/test_flexible_tree.py", "flexible/test_mixed_trees.py", *FLEXIBLE),
    "kernels/tree/modal": ("flexible/test_flexible_tree.py", "flexible/test_mixed_trees.py", *FLEXIBLE),
}  # fmt: skip


@dataclass(frozen=True)
class Case:
    """A file of the package as it becomes, and the tests that touch it."""

    name: str
    file: str
    text: str
    tests: tuple[str, ...]


def covered_by(file):
    """Files of tests that touch the kernels of a file of the package."""
    return dict.fromkeys(COVER[max((each for each in COVER if file.startswith(each)), key=len)])


def named_cases():
    """Those of `spoilt_lines.py`. Raises RuntimeError where a line is not there once."""
    for each in NAMED:
        text = (PACKAGE / each.file).read_text(encoding="utf-8")
        if text.count(each.before) != 1:
            raise RuntimeError(f"{each.name}: its line is not in {each.file} once")
        yield Case(each.name, each.file, text.replace(each.before, each.after), each.tests)


def chosen_cases(count, seed):
    """So many lines chosen by a seed."""
    for each in mutations.chosen(PACKAGE, count, seed):
        name = f"{each.kind:8} {each.file}:{each.number} {each.function}"
        yield Case(name, each.file, mutations.mutated(PACKAGE, each), tuple(covered_by(each.file)))


def noticed(source, arguments, **more):
    """The first test that fails on these sources, or nothing."""
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider", *arguments]
    environment = {**os.environ, "PYTHONPATH": str(source), "NIVEL_CACHE_DIR": str(source.parent / "cache"), **more}
    try:
        done = subprocess.run(
            command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False, timeout=LONGEST
        )
    except subprocess.TimeoutExpired:
        return "a test that does not end"
    if done.returncode in (PASSED, NONE_THERE):
        return ""
    failed = re.findall(r"^(?:FAILED|ERROR) (\S+)", done.stdout, re.MULTILINE)
    return failed[0].removeprefix("tests/") if failed else f"outcome {done.returncode} of pytest"


def check(case):
    """(lane that notices the spoilt line, test that does, seconds)."""
    begin = time.perf_counter()
    files = [str(ROOT / "tests" / each) for each in case.tests]
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "src"
        shutil.copytree(PACKAGE.parent, source, ignore=shutil.ignore_patterns("__pycache__"))
        (source / "nivel" / case.file).write_text(case.text, encoding="utf-8")
        shutil.copytree(store.folder(), source.parent / "cache" / "objects")
        lane = BY_DEFAULT
        by = noticed(source, ["-m", "not full", *files])
        if not by:
            by = noticed(source, PLAIN, NUMBA_DISABLE_JIT="1")
        if not by:
            lane, by = BY_FULL, noticed(source, ["-m", "full", *files], NIVEL_TESTS_FULL="1")
    return lane if by else NOT_AT_ALL, by, time.perf_counter() - begin


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=1, help="of the choice of lines")
    parser.add_argument("--count", type=int, default=30, help="how many")
    parser.add_argument("--first", type=int, default=0, help="number of the first one that is tested")
    parser.add_argument("--named", action="store_true", help="the lines of `spoilt_lines.py` instead")
    parser.add_argument("--only", default="", help="those whose names contain this")
    parser.add_argument("--list", action="store_true", help="name them and end")
    options = parser.parse_args()
    every = list(named_cases()) if options.named else list(chosen_cases(options.first + options.count, options.seed))
    cases = [each for each in every[options.first :][: options.count] if options.only in each.name]
    missed = 0
    for case in cases:
        if options.list:
            print(case.name)
            continue
        lane, by, seconds = check(case)
        missed += lane == BY_FULL
        print(f"{case.name:75} {lane:8} {seconds:5.0f} s  {by}", flush=True)
    sys.exit(f"{missed} of {len(cases)} noticed by the full tests alone" if missed else 0)


if __name__ == "__main__":
    main()
