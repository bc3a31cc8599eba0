"""The machines that come with nivel to be driven: `nivel demo NAME`."""

from pathlib import Path
from typing import Final

FOLDER: Final = Path(__file__).parent
# the first is shown where none is named
DEMOS: Final = {
    "loader-crane": "a crane on a truck with its whole hydraulic circuit: four levers, four valves, a load on its hook",
    "excavator": "boom, stick and bucket on hydraulic cylinders, a house that slews: four levers",
    "wheel-loader": "an articulated loader on soil, a heap to dig, a truck to load: drive, steer, lift, tilt",
    "harbour-crane": "a container crane: gantry, trolley, four ropes on winches, a load that swings",
    "four-bar": "a linkage with sliders for its dimensions, and the curve that its coupler draws",
}


def demo_file(name: str) -> Path:
    """The machine file of a demo."""
    return FOLDER / f"{name}.yaml"
