"""A load that is moved by three metres and hangs at rest at the end: in five seconds with the least effort, and as fast as possible.

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


def fastest(pieces: int = 16, low: float = 3.0, high: float = 5.0, within: float = 0.05):
    """The shortest duration [s] in which the force reaches, by bisection, and the force over time that does it."""
    machine, best = nivel.load(HERE / "trolley.yaml"), None
    while high - low > within:
        middle = round(0.5 * (low + high), 2)
        tables, found = machine.optimal_inputs(
            "mean(sensor.effort)", {"drive": pieces}, outputs=OUTPUTS, limits=AT_REST, duration=middle, iterations=40
        )
        if found.kept:
            high, best = middle, tables
        else:
            low = middle
    return machine, high, best


if __name__ == "__main__":
    machine, tables, found = swing_free()
    result = machine.simulate(inputs=tables)
    print(found.message, f"{found.evaluations} runs, rms force {found.objective**0.5:.1f} N")
    for name in ("rail.displacement", "rod.angle", "sensor.speed", "sensor.swing_speed"):
        print(f"{name:20} {result.array(name)[-1]:.2e}")
    print(result.trust.headline)
    _, duration, _ = fastest()
    print(f"the shortest time within ±400 N is {duration:.2f} s")
