"""Mass matrix, bias and inverse dynamics of imported MJCF trees against MuJoCo with soft terms off, in random states.

    pip install mujoco-core
    python benchmarks/mjcf_against_mujoco.py FILE …

The files can be those of `dm_control/suite`. Compared are trees of hinges and slides. Errors are relative to the largest entry.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

import mujoco as mj
import numpy as np

import nivel

STATES, AGREE = 10, 1e-12
OFF = ("CONTACT", "SPRING", "DAMPER", "EQUALITY", "LIMIT", "FRICTIONLOSS", "ACTUATION")
LIFT = "grav"  # in the names of forces that stand for `gravcomp`


def compared(file: Path) -> tuple[int, float] | None:
    """Degrees of freedom, and the largest error; None where the model has other joints."""
    model = mj.MjSpec.from_file(str(file)).compile()
    for each in OFF:
        model.opt.disableflags |= int(getattr(mj.mjtDisableBit, f"mjDSBL_{each}"))
    model.opt.density = model.opt.viscosity = 0.0
    machine = nivel.import_model(file, contacts="none")
    kept = tuple(each for each in machine.record.forces if LIFT in each.name)
    mechanics = machine.replace(forces=kept, simulation=machine.record.simulation).mechanics()
    if not set(model.jnt_type.tolist()) <= {int(mj.mjtJoint.mjJNT_HINGE), int(mj.mjtJoint.mjJNT_SLIDE)}:
        return None
    number = {re.sub(r"[^\w-]", "_", model.joint(k).name): k for k in range(model.njnt)}

    def joint(name: str) -> int:
        return number[name.rpartition(".")[0].removesuffix("_rotor")]

    order = [joint(name) for name in mechanics.names]
    places = [joint(name) for name in mechanics.position_names]
    rotors = [name.endswith("_rotor.angle") for name in mechanics.position_names]  # of which zero is the start
    random, worst = np.random.default_rng(1), 0.0
    for _ in range(STATES):
        q, v, a = random.uniform(-1.0, 1.0, (3, model.nv))
        data = mj.MjData(model)
        data.qpos[:], data.qvel[:] = model.qpos0 + q, v
        mj.mj_forward(model, data)
        M = np.zeros((model.nv, model.nv))
        mj.mj_fullM(model, data, M)
        bias = data.qfrc_bias - data.qfrc_passive
        data.qacc[:] = a
        mj.mj_inverse(model, data)
        ours = (model.qpos0 + q)[places] - model.qpos0[places] * rotors
        for found, theirs in (
            (mechanics.mass_matrix(ours), M[np.ix_(order, order)]),
            (mechanics.bias(ours, v[order]), bias[order]),
            (mechanics.inverse_dynamics(ours, v[order], a[order]), data.qfrc_inverse[order]),
        ):
            worst = max(worst, np.abs(found - theirs).max() / max(np.abs(theirs).max(), 1e-300))
    return model.nv, float(worst)


def main() -> None:
    """A line for each file, and the count of those that agree."""
    agree = count = 0
    for file in map(Path, sys.argv[1:]):
        try:
            found = compared(file)
        except (nivel.NivelError, ValueError) as refusal:
            print(f"{file.name}: refused: {str(refusal).splitlines()[0]}", flush=True)
            continue
        if found is None:
            print(f"{file.name}: has free or ball joints", flush=True)
            continue
        count, agree = count + 1, agree + (found[1] <= AGREE)
        print(f"{file.name}: {found[0]} degrees of freedom, {found[1]:.1e}", flush=True)
    print(f"{agree} of {count} agree to {AGREE:g}")


if __name__ == "__main__":
    main()
