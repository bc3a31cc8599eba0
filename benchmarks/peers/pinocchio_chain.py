"""The chain in Pinocchio: classical Runge-Kutta steps of four calls of its articulated-body algorithm (`aba`) each.

Two ways, both with its conventions WORLD and LOCAL:

compiled  a loop in C++ (pinocchio_chain.cpp) around its headers, compiled here with -O3 for this processor; nothing of Python.
library   its shipped library called from Python: four times `aba`, less four times what the same call takes for a model
          without joints. The sums of the Runge-Kutta step are not counted.

The first run compiles, for one minute or more. See peer_chain.py for what is printed.
"""

import hashlib
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import cmeel
import numpy as np
import pinocchio
from peer_chain import Check, main, process_microseconds

from chain_data import CHECK_STEPS, GRAVITY, INERTIA, LENGTH, MASS, STEP

SOURCE = Path(__file__).with_suffix(".cpp")
INCLUDE = Path(cmeel.__path__[0]).parent / "cmeel.prefix" / "include"
# as its own build files ask for
DEFINED = ("NDEBUG", "BOOST_MPL_LIMIT_LIST_SIZE=30", "BOOST_MPL_CFG_NO_PREPROCESSED_HEADERS")
CONVENTIONS = {"world": pinocchio.Convention.WORLD, "local": pinocchio.Convention.LOCAL}


def program() -> Path:
    """The compiled loop, kept for the next run."""
    stamp = hashlib.sha256(SOURCE.read_bytes() + pinocchio.__version__.encode()).hexdigest()[:12]
    path = Path(tempfile.gettempdir()) / f"pinocchio_chain-{stamp}"
    if not path.exists():
        if not (INCLUDE / "eigen3" / "Eigen" / "Core").is_file():
            sys.exit(f"{INCLUDE} lacks the header files of Eigen: {sys.executable} -m pip install cmeel-eigen")
        command = ["g++", "-std=c++17", "-O3", "-march=native", "-w", *(f"-D{name}" for name in DEFINED)]
        command += [f"-I{INCLUDE}", f"-I{INCLUDE / 'eigen3'}", str(SOURCE), "-o", str(path)]
        subprocess.run(command, check=True)
    return path


def compiled(links: int, steps: int, runs: int) -> dict:
    numbers = (links, steps, runs, CHECK_STEPS, STEP, LENGTH, MASS, *INERTIA, GRAVITY)
    done = subprocess.run([program(), *map(repr, numbers)], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def model(links: int) -> pinocchio.Model:
    built = pinocchio.Model()
    built.gravity.linear = np.array([0, -GRAVITY, 0])
    inertia = pinocchio.Inertia(MASS, np.array([LENGTH / 2, 0, 0]), np.diag(INERTIA))
    parent = 0
    for i in range(links):
        place = pinocchio.SE3(np.eye(3), np.array([LENGTH if i else 0.0, 0, 0]))
        parent = built.addJoint(parent, pinocchio.JointModelRZ(), place, f"hinge{i}")
        built.appendBodyToJoint(parent, inertia, pinocchio.SE3.Identity())
    return built


def calls(links: int, count: int, convention: pinocchio.Convention) -> float:
    """µs of one call of aba from Python, at an arbitrary state."""
    built = model(links)
    data, q, zero = built.createData(), np.linspace(0, 1, links), np.zeros(links)

    def work() -> None:
        for _ in range(count):
            pinocchio.aba(built, data, q, zero, zero, convention)

    return process_microseconds(work, count)


def measure(links: int, steps: int, runs: int) -> dict[str, list[float]]:
    found = compiled(links, steps, runs)
    times = {f"compiled, {name}": found[name] for name in CONVENTIONS}
    for name, convention in CONVENTIONS.items():
        pairs = [(calls(links, steps, convention), calls(0, 20_000, convention)) for _ in range(runs)]
        times[f"library, {name}"] = [4 * (call - empty) for call, empty in pairs]
    return times


def check(links: int) -> Check:
    found = compiled(links, 1, 0)
    return Check(found["energy_error"], found["last_position"])


if __name__ == "__main__":
    main("pinocchio", pinocchio.__version__, measure, check)
