"""A load that is moved by three metres in five seconds and hangs at rest at the end, with the least effort.

python examples/optimisation/swing_free.py
"""

from pathlib import Path

import nivel

HERE = Path(__file__).parent
AT_REST = {"place": (3.0, 3.0), "speed": (0.0, 0.0), "swing": (0.0, 0.0), "swing_speed": (0.0, 0.0)}
OUTPUTS = {
    "place": "rail.displacement",
    "speed": "sensor.speed",
    "swing": "rod.angle",
    "swing_speed": "sensor.swing_speed",
}


def swing_free(pieces: int = 10):
    """The force over time, and the optimum."""
    machine = nivel.load(HERE / "trolley.yaml")
    tables, found = machine.optimal_inputs("mean(sensor.effort)", {"drive": pieces}, outputs=OUTPUTS, limits=AT_REST)
    return machine, tables, found


if __name__ == "__main__":
    machine, tables, found = swing_free()
    result = machine.simulate(inputs=tables)
    print(found.message, f"{found.evaluations} runs, rms force {found.objective**0.5:.1f} N")
    for name in ("rail.displacement", "rod.angle", "sensor.speed", "sensor.swing_speed"):
        print(f"{name:20} {result.array(name)[-1]:.2e}")
    print(result.trust.headline)
