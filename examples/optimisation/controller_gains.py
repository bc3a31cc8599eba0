"""The four gains that keep a pole upright on its cart at the least cost, by exact slopes; beside those of the theory of linear machines.

python examples/optimisation/controller_gains.py
"""

from pathlib import Path

import numpy as np
from scipy.linalg import solve_continuous_are

import nivel

HERE = Path(__file__).parent
# the state that is fed back, and the bounds of the gain of each
STATE = ("rail.displacement", "hinge.angle", "rail.displacement.rate", "hinge.angle.rate")
BOUNDS = {
    "parameters.place_gain": (0.5, 60.0),
    "parameters.angle_gain": (20.0, 200.0),
    "parameters.speed_gain": (1.0, 80.0),
    "parameters.turn_gain": (2.0, 60.0),
}
# what place [m], angle [rad] and force [N] are measured by in the cost, as in the machine file
PLACE, ANGLE, FORCE = 0.1, np.radians(5.0), 2.0


def tuned():
    """The machine, and the gains with which its run costs least."""
    machine = nivel.load(HERE / "balanced-pole.yaml")
    return machine, machine.optimise("integral(sensor.cost)", BOUNDS, exact_slopes=True)


def linear(machine: nivel.Machine, gain: float = 0.0):
    """A of the upright pole, whose force is `gain` times its place, for small motions of STATE."""
    values = dict.fromkeys(BOUNDS, 0.0) | {"parameters.place_gain": gain, "hinge.start.angle": 0.0}
    model = machine.with_values(values).linearise(outputs=list(STATE))
    return model.C @ model.A @ np.linalg.inv(model.C)


def best_in_theory(machine: nivel.Machine):
    """Gains of the linear quadratic regulator (Kalman 1960): u = -R⁻¹ Bᵀ P x with P of Riccati's equation."""
    A = linear(machine)
    B = (linear(machine, 1.0) - A)[:, :1]  # ẋ = (A + B K) x, here with K = (1, 0, 0, 0)
    P = solve_continuous_are(A, B, np.diag([PLACE**-2, ANGLE**-2, 0.0, 0.0]), np.array([[FORCE**-2]]))
    return dict(zip(BOUNDS, (-(FORCE**2) * B.T @ P).ravel().tolist(), strict=True))


if __name__ == "__main__":
    machine, found = tuned()
    theory = best_in_theory(machine)
    for path, value in found.values.items():
        print(f"{path:22} {value:8.3f}, in theory {theory[path]:8.3f}")
    print(f"{found.evaluations} runs; {found.message}")
    print(found.machine.simulate().trust.headline)
