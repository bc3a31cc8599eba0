"""A step of the cart-pole as an environment takes it, here and in MuJoCo: a new input, one step, four readings.

    python benchmarks/against_mujoco.py

The machine is examples/control/cart-pole.yaml; MuJoCo gets it as `nivel export --mjcf` writes it. Pairs with the same number of
evaluations a step: rk4 and MuJoCo's RK4 with four, euler and MuJoCo's own integrator, which is semi-implicit, with one. All in one
thread, by turns; the least of several rounds, processor time.
Needs `nivel[robots]`.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

import mujoco
import numpy as np
from mujoco import rollout
from rich.console import Console
from rich.table import Table

import nivel

MACHINE = Path(__file__).parent.parent / "examples" / "control" / "cart-pole.yaml"
READINGS = ("rail.displacement", "hinge.angle", "rail.displacement.rate", "hinge.angle.rate")
STEPS, ROUNDS, COPIES = 500, 10, 16
STEP = 2e-3
FORCES = 0.5 * np.sin(np.arange(STEPS))


def main() -> None:
    """Print microseconds a step, the least of several rounds by turns."""
    machine = nivel.load(MACHINE)
    ways: dict[str, Way] = {}
    for integrator in ("rk4", "euler"):
        ways |= ours(machine, integrator)
    for name, integrator in (("RK4", mujoco.mjtIntegrator.mjINT_RK4), ("Euler", mujoco.mjtIntegrator.mjINT_EULER)):
        ways |= theirs(exported(machine), name, integrator)
    best = dict.fromkeys(ways, float("inf"))
    for _ in range(ROUNDS):
        for name, (way, count) in ways.items():
            begin = time.thread_time()
            way()
            best[name] = min(best[name], (time.thread_time() - begin) / count)
    table = Table("cart-pole", "µs a step")
    for name, least in best.items():
        table.add_row(name, f"{1e6 * least:.2f}")
    Console().print(table)


Way = tuple[Callable[[], object], int]


def ours(machine: nivel.Machine, integrator: str) -> dict[str, Way]:
    """What is measured of nivel, and how many steps each way makes."""
    machine = machine.without("end_right", "end_left", "fallen_right", "fallen_left")
    given = {"integrator": integrator, "step": STEP}
    sim, sims = (
        machine.start(**given),
        {lanes: machine.start(n=COPIES, lanes=lanes, **given) for lanes in (True, False)},
    )
    readings = tuple(name for name in READINGS if name in sim)
    begin, begins = sim.state, sims[False].states

    def environment() -> None:
        sim.restore(begin)
        for force in FORCES:
            sim.step({"push": force})
            for name in readings:
                sim[name]

    def loop() -> None:
        sim.restore(begin)
        sim.advance(STEPS * STEP)

    def many(lanes: bool, names: tuple[str, ...]) -> None:
        sims[lanes].restore(begins)
        for force in FORCES:
            sims[lanes].step({"push": np.full(COPIES, force)})
            for name in names:
                sims[lanes][name]

    copies: dict[str, Way] = {}
    for lanes, word in ((True, "in lanes"), (False, "singly")):
        for names in (readings, ()):
            what = f"nivel {integrator}, {COPIES} copies {word}, an input and {len(names)} readings"
            copies[what] = partial(many, lanes, names), STEPS * COPIES

    return {
        f"nivel {integrator}, step with an input and {len(readings)} readings": (environment, STEPS),
        f"nivel {integrator}, steps in one call": (loop, STEPS),
        **copies,
    }


def exported(machine: nivel.Machine) -> mujoco.MjModel:
    """The machine in MuJoCo, its cart pushed by a motor."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "cart-pole.xml"
        machine.export_mjcf(path)
        text = path.read_text(encoding="utf-8")
    if "<actuator>" not in text:
        text = text.replace("</mujoco>", '<actuator><motor joint="rail"/></actuator></mujoco>')
    model = mujoco.MjModel.from_xml_string(text)
    model.opt.timestep = STEP
    return model


def theirs(model: mujoco.MjModel, name: str, integrator: mujoco.mjtIntegrator) -> dict[str, Way]:
    """What is measured of MuJoCo."""
    model.opt.integrator = integrator
    data = mujoco.MjData(model)
    size = mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_FULLPHYSICS)
    state = np.zeros((1, size))
    mujoco.mj_getState(model, data, state[0], mujoco.mjtState.mjSTATE_FULLPHYSICS)
    controls = FORCES[None, :, None]

    def environment() -> None:
        mujoco.mj_resetData(model, data)
        q, v, u = data.qpos, data.qvel, data.ctrl
        for force in FORCES:
            u[0] = force
            mujoco.mj_step(model, data)
            q[0], q[1], v[0], v[1]

    def roll() -> None:
        rollout.rollout(model, data, state, controls)

    return {
        f"MuJoCo {name}, mj_step with an input and 4 readings": (environment, STEPS),
        f"MuJoCo {name}, rollout": (roll, STEPS),
    }


if __name__ == "__main__":
    main()
