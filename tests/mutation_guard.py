"""What the default tests are worth: thirty lines of kernels are spoilt, one at a time, and each has to be noticed.

    python tests/mutation_guard.py [--only NAME] [--first N] [--count N]

Of each line the tests that are said to cover it run on a copy of the sources in which it is spoilt: first those of the default lane, until
one fails; where none does, those marked `full`. A line that only these notice is a reason to take one of them into the default lane; one
that nobody notices is a test that is missing. Machine code that does not depend on the file spoilt is taken from a copy of the user's
cache, where `nivel warmup` has left it; what depends on it compiles. The working tree is left alone.
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

from nivel.native import store

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "src" / "nivel"
# outcomes of pytest: all tests passed; none was selected
PASSED, NONE_THERE = 0, 5


@dataclass(frozen=True)
class Mutation:
    """In `file` of the package `before`, which stands there once, becomes `after`; `tests` are files below `tests`."""

    name: str
    file: str
    before: str
    after: str
    tests: tuple[str, ...]


def _verification(*names):
    return tuple(f"verification/test_{name}.py" for name in names)


MUTATIONS = [
    # forces
    Mutation("spring: half the damper", "kernels/forces/spring.py", "damping = numbers[DAMPING] * rate",
             "damping = 0.5 * numbers[DAMPING] * rate", _verification("springs")),
    Mutation("spring: energy of the preload", "kernels/forces/spring.py", "(0.5 * numbers[STIFFNESS] * stretch + numbers[PRELOAD])",
             "(0.5 * numbers[STIFFNESS] * stretch)", _verification("springs", "consistency")),
    Mutation("impact: sign of the loss", "kernels/forces/impact.py", "(1.0 + x / speed * rate)", "(1.0 - x / speed * rate)",
             _verification("contact", "contact_location")),
    Mutation("contact: friction without its normal force", "kernels/forces/contact.py",
             "numbers[FRICTION] * force * tanh", "numbers[FRICTION] * tanh", _verification("contact", "consistency")),
    Mutation("stop: the upper one pulls", "kernels/forces/stop.py", "depth[1], rate, n[STIFFNESS]", "depth[1], -rate, n[STIFFNESS]",
             _verification("contact", "springs", "element_references", "contact_location", "tangents")),
    Mutation("bushing: moment of the offset", "kernels/forces/bushing.py", "m0 + d1 * f2 - d2 * f1,", "m0 - d1 * f2 + d2 * f1,",
             _verification("springs", "consistency")),
    Mutation("motor: speed held the wrong way", "kernels/forces/motor.py", "gain * (effort - coordinates.rate[q])",
             "gain * (effort - 0.9 * coordinates.rate[q])", _verification("motors")),
    Mutation("push: lever of a point", "kernels/forces/wrench.py", "n0, n1, n2 = u1 * z - u2 * y, u2 * x - u0 * z,",
             "n0, n1, n2 = u1 * z - u2 * y, u2 * x + u0 * z,", _verification("contact", "contact_location")),
    Mutation("table: its slope", "kernels/record/function.py", "c[1] + s * (2.0 * c[2] + 3.0 * s * c[3]),",
             "c[1] + s * (2.0 * c[2] + 2.0 * s * c[3]),",
             ("machine/test_time_functions.py", *_verification("drivers", "laws"))),
    # constraints
    Mutation("coincident points: their acceleration", "kernels/bodies/constraint.py", "markers.bias[i, x] - markers.bias[j, x]",
             "markers.bias[i, x] + markers.bias[j, x]", _verification("joints")),
    Mutation("coordinate: Coriolis along an axis", "kernels/bodies/coordinate.py", "- ad * dot(w, w) + 2.0 * (s0",
             "- ad * dot(w, w) + 1.0 * (s0",
             _verification("joints")),
    Mutation("coordinate: bias of an angle", "kernels/bodies/coordinate.py", "- rate * 2.0 * (c * cdot + s * sdot)",
             "- rate * (c * cdot + s * sdot)",
             _verification("drivers", "joints", "couplings")),
    # bodies and trees
    Mutation("Euler parameters: their rates", "kernels/algebra/rotation.py", "out[2] = theta[3] * x + theta[0] * y - theta[1] * z",
             "out[2] = theta[3] * x + theta[0] * y + theta[1] * z", ("kernels/test_rotation.py", *_verification("motion"))),
    Mutation("weight: its moment", "kernels/bodies/rigid.py", "F[4] = c[2] * F[0] - c[0] * F[2]", "F[4] = c[2] * F[0] + c[0] * F[2]",
             _verification("consistency", "motion", "mechanisms")),
    Mutation("kinetic energy of turning", "kernels/bodies/rigid.py", "+ 0.5 * turning", "+ 0.49 * turning", _verification("motion")),
    Mutation("tree: inertia of a child", "kernels/tree/articulated.py", "P[5] - 2.0 * (K6 * y - K7 * x)", "P[5] - (K6 * y - K7 * x)",
             _verification("relative")),
    Mutation("tree: motion of a child", "kernels/tree/articulated.py", "parent[4] + parent[2] * r[0] - parent[0] * r[2]",
             "parent[4] + parent[2] * r[0] + parent[0] * r[2]", _verification("relative")),
    # friction and sensors
    Mutation("friction: Stribeck's exponent", "kernels/elements/friction.py", "np.exp(-ratio * ratio)", "np.exp(-ratio)",
             _verification("friction")),
    Mutation("friction: load of a collar", "kernels/elements/friction.py", "return load + n[COLLAR] * absolute(fz)",
             "return load + n[COLLAR] * fz",
             _verification("friction", "frictions_together")),
    Mutation("friction: multipliers", "kernels/elements/friction.py", "total += friction.response[k, row] * friction.force[k]",
             "total -= friction.response[k, row] * friction.force[k]", _verification("friction")),
    Mutation("sensor: Coriolis", "kernels/signals/sensor.py", "cross(w, cross(w, d))), coriolis), coriolis)",
             "cross(w, cross(w, d))), coriolis), d)",
             _verification("sensors")),
    Mutation("sensor: relative angular acceleration", "kernels/signals/sensor.py", "value = less(value, cross(w, turning))",
             "value = less(value, cross(turning, w))", _verification("sensors")),
    # beams, rails, flexible bodies
    Mutation("rail: product of rates", "kernels/bodies/rail.py", "+ 2.0 * dot(a[1], b[1])", "+ dot(a[1], b[1])", _verification("rails")),
    Mutation("beam: stored energy", "kernels/elements/beam_element.py", "stored += 0.5 * elastic * strain",
             "stored += 0.51 * elastic * strain",
             _verification("beam_elements")),
    Mutation("beam: change of the tangent", "kernels/elements/beam_element.py", "outwards = da * along - db * across",
             "outwards = da * along + db * across", _verification("beam_elements")),
    Mutation("flexible body: inertia of the second order", "kernels/bodies/floating_frame.py", "(2.0 * I8[c, k] + row[k])",
             "(I8[c, k] + row[k])",
             ("flexible/test_invariants.py", "flexible/test_flexible_motion.py", "flexible/test_tumbling.py")),
    Mutation("flexible body: stiffening of a node", "kernels/bodies/floating_frame.py", "second -= pdot * across[j]",
             "second += pdot * across[j]",
             ("flexible/test_interfaces.py", "flexible/test_stiffening.py", "flexible/test_flexible_tree.py")),
    # integrators, events
    Mutation("rk4: a weight", "integrate/explicit/runge_kutta.py", "1 / 6, 1 / 3, 1 / 3, 1 / 6", "1 / 6, 1 / 3, 1 / 6, 1 / 3",
             ("integrate/test_orders.py",)),
    Mutation("ros2: second stage", "integrate/rosenbrock/rosenbrock.py", "second[i] -= 2.0 * first[i]", "second[i] -= 1.9 * first[i]",
             _verification("ros2")),
    Mutation("generalised-alpha: order of positions", "integrate/newmark/alpha_step.py", "(0.5 - c[BETA]) * a", "(0.55 - c[BETA]) * a",
             _verification("alpha")),
    Mutation("geometric stabilisation: the factor", "integrate/loop/energy.py", "np.sqrt(1.0 + missing / kinetic)",
             "1.0 + missing / kinetic",
             _verification("geometric")),
    Mutation("events: sides are kept", "integrate/loop/events.py", "values[SIDE, k] = -values[SIDE, k]",
             "values[SIDE, k] = values[SIDE, k]",
             _verification("events")),
]  # fmt: skip


def tests_of(mutation, source, marker):
    """Outcome of pytest, and its last lines."""
    files = [str(ROOT / "tests" / each) for each in mutation.tests]
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-m", marker, "-p", "no:cacheprovider", *files]
    environment = {**os.environ, "PYTHONPATH": str(source), "NIVEL_CACHE_DIR": str(source.parent / "cache")}
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    failed = re.findall(r"^(?:FAILED|ERROR) (\S+)", done.stdout, re.MULTILINE)
    if done.returncode not in (PASSED, 1, NONE_THERE):
        raise RuntimeError(done.stdout + done.stderr)
    return done.returncode == 1, failed[0].removeprefix("tests/") if failed else ""


def check(mutation):
    """(verdict, test that noticed it, seconds)."""
    begin = time.perf_counter()
    path = PACKAGE / mutation.file
    text = path.read_text(encoding="utf-8")
    if text.count(mutation.before) != 1:
        return "stale: its line is not there once", "", 0.0
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "src"
        shutil.copytree(PACKAGE.parent, source, ignore=shutil.ignore_patterns("__pycache__"))
        (source / "nivel" / mutation.file).write_text(text.replace(mutation.before, mutation.after), encoding="utf-8")
        shutil.copytree(store.folder(), source.parent / "cache" / "objects")
        verdict = "caught by default"
        caught, by = tests_of(mutation, source, "not full")
        if not caught:
            caught, by = tests_of(mutation, source, "full")
            verdict = "only by full" if caught else "survived"
    return verdict, by, time.perf_counter() - begin


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", help="mutations whose names contain this")
    parser.add_argument("--first", type=int, default=0, help="number of the first one")
    parser.add_argument("--count", type=int, default=len(MUTATIONS), help="how many at most")
    options = parser.parse_args()
    chosen = [each for each in MUTATIONS if options.only in each.name][options.first :][: options.count]
    missed = 0
    for mutation in chosen:
        verdict, by, seconds = check(mutation)
        missed += verdict != "caught by default"
        print(f"{mutation.name:45} {verdict:18} {seconds:5.0f} s  {by}", flush=True)
    sys.exit(f"{missed} of {len(chosen)} not caught by the default tests" if missed else 0)


if __name__ == "__main__":
    main()
