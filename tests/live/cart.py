"""A cart that a lever drives, live, for tests."""

import time
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from nivel.api import Machine
from nivel.files.reader import parse_machine
from nivel.integrate.loop.paced import DONE
from nivel.live.page import session_of
from patience import PATIENCE

MASS, FORCE, DAMPING = 2.0, 20.0, 3.0
CART = f"""
format: 1
name: cart
bodies:
  cart: {{mass: {MASS}, inertia: [1, 1, 1], shape: {{type: box, size: [1, 0.5, 0.4]}}}}
joints:
  rail: {{type: translational, bodies: [ground, cart], point: [0, 0, 0], axis: [1, 0, 0]}}
inputs:
  lever: {{range: [-1, 1], rate: 4, keys: {{raise: d, lower: a}}, gamepad: {{axis: 0, dead_zone: 0.1}}, stick: left-x}}
  brake: {{range: [0, 2], rest: 1, hold: true}}
forces:
  drive: {{type: motor, coordinate: rail, effort: {FORCE}*lever.value}}
  drag: {{type: motor, coordinate: rail, effort: -{DAMPING}*brake.value*rail.displacement_rate}}
sensors:
  speed: {{coordinate: rail, quantity: rate}}
simulation: {{duration: 2, step: 1 ms}}
"""


def machine():
    return Machine.from_record(parse_machine(CART))


@contextmanager
def running(**given):
    """A session of the cart, paused at its start."""
    with TemporaryDirectory() as folder:
        opened = session_of(machine(), {}, urgent=False, record=Path(folder) / "cart.live.npz", **given)
        with opened as session:
            yield session


def until(condition, what=""):
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end, f"never: {what}"
        time.sleep(0.005)


def operate(session, values, seconds):
    """Hold values for so much simulated time, as a page does; until the run is over where that is earlier."""

    def is_done():
        session.operate(values)
        return int(session.live.control[DONE]) >= last or session.mode in ("ended", "failed")

    last = int(session.live.control[DONE]) + round(seconds / session.pace.tick)
    until(is_done, f"{seconds} s of the machine")
