"""Which numbers of a slider-crank move its slider most, and a rod length for which it is at a given place after half a second.

Run it with ``python examples/mechanisms/slider_place.py``. Slopes are exact: the run itself is done with dual numbers. The search is
Newton's method on one number, each step of which is one run.
"""

from pathlib import Path

import nivel
from nivel.gradients import value_and_gradient

PLACE, WANTED = "slider.position.x", 1.55  # m
LENGTH = "parameters.rod_length"
NUMBERS = [LENGTH, "parameters.crank_radius", "bodies.rod.mass", "bodies.crank.mass", "gravity.1"]

machine = nivel.load(Path(__file__).parent / "slider-crank.yaml").with_settings({"duration": 0.5, "integrator": "rk4"})


def find_length(wanted: float = WANTED) -> float:
    """The rod length [m] for which the slider is at `wanted` [m] in the end."""
    place = value_and_gradient(machine, PLACE, [LENGTH])
    length = float(machine[LENGTH])
    for _ in range(6):
        value, slopes = place([length])
        length += (wanted - value) / float(slopes[0])
    return length


if __name__ == "__main__":
    found = machine.gradient(PLACE, NUMBERS)
    print(f"{PLACE} = {found[PLACE].item():.4f} m; {found.headline}")
    for path in NUMBERS:
        slope = found[f"d({PLACE})/d({path})"]
        print(f"  1 % more of {path:22} moves it by {10.0 * abs(float(machine[path])) * slope.item():+8.4f} mm")
    print(f"it is at {WANTED} m with a rod of {find_length():.4f} m")
