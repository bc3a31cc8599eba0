"""The chain in MuJoCo: its own RK4, `mj_step` looping in C, constraints and contacts off. See peer_chain.py for what is printed."""

import mujoco
import numpy as np
from peer_chain import Check, main, process_microseconds

from chain_data import CHECK_STEPS, GRAVITY, INERTIA, LENGTH, MASS, STEP


def model(links: int) -> mujoco.MjModel:
    spec = mujoco.MjSpec()
    spec.option.timestep = STEP
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_RK4
    spec.option.gravity = [0, -GRAVITY, 0]
    body = spec.worldbody
    for i in range(links):
        place = [LENGTH if i else 0.0, 0, 0]
        body = body.add_body(
            pos=place, mass=MASS, ipos=[LENGTH / 2, 0, 0], inertia=list(INERTIA), explicitinertial=True
        )
        body.add_joint(type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0, 0, 1])
    built = spec.compile()
    off = mujoco.mjtDisableBit
    # leaves out what an open chain does not need: a fifth less time at 4 links
    built.opt.disableflags = int(off.mjDSBL_CONSTRAINT | off.mjDSBL_CONTACT)
    return built


def measure(links: int, steps: int, runs: int) -> dict[str, list[float]]:
    built = model(links)
    data = mujoco.MjData(built)
    times = []
    for _ in range(runs):
        mujoco.mj_resetData(built, data)
        mujoco.mj_step(built, data, 10)
        times.append(process_microseconds(lambda: mujoco.mj_step(built, data, steps), steps))
    return {"rk4": times}


def check(links: int) -> Check:
    built = model(links)
    built.opt.enableflags = int(mujoco.mjtEnableBit.mjENBL_ENERGY)
    data = mujoco.MjData(built)
    energy = []
    for n in range(CHECK_STEPS + 1):
        if n:
            mujoco.mj_step(built, data)
        mujoco.mj_forward(built, data)
        energy.append(data.energy.copy())
    potential, kinetic = np.array(energy).T
    total = potential + kinetic
    return Check(float(np.max(np.abs(total - total[0])) / np.max(kinetic)), data.xipos[links].tolist())


if __name__ == "__main__":
    main("mujoco", mujoco.__version__, measure, check)
