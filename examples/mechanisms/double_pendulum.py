"""A double pendulum written in Python: two steel bars, two hinges, five seconds.

Run it with ``python examples/mechanisms/double_pendulum.py``.
"""

import nivel

LENGTH = 0.5


def bar(name: str, start: float) -> nivel.Body:
    """A horizontal bar of LENGTH from x = start, 4 cm by 1 cm, of steel."""
    shape = {"type": "box", "from": (start, 0, 0), "to": (start + LENGTH, 0, 0), "width": "4 cm", "height": "1 cm"}
    return nivel.Body(name=name, shape=shape, density="7850 kg/m^3")


def hinge(name: str, first: str, second: str, x: float) -> nivel.Joint:
    """A hinge about Z."""
    return nivel.Joint(name=name, type="revolute", bodies=(first, second), point=(x, 0, 0), axis=(0, 0, 1))


machine = nivel.Machine(
    "double-pendulum",
    gravity=(0, -9.81, 0),
    bodies=[bar("upper", 0.0), bar("lower", LENGTH)],
    joints=[hinge("shoulder", "ground", "upper", 0.0), hinge("elbow", "upper", "lower", LENGTH)],
    simulation=nivel.SimulationSettings(duration="5 s", step="1 ms", output_interval="10 ms"),
)

if __name__ == "__main__":
    result = machine.simulate(
        verify=False,
    )
    print(result)
    print(f"elbow at the end: {float(result['elbow.angle'][-1]):.3f} rad")
