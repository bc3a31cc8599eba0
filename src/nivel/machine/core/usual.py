"""Usual ranges of quantities of machines: from micromechanics to cranes, mines and launchers."""

from typing import Final

from nivel.machine.given import Usual

DENSITY: Final = Usual(1.0, 23000.0, "kg/m^3", "7850 kg/m^3")
SPEED: Final = Usual(0.0, 12e3, "m/s", "2 m/s")  # of what is launched; orbits are slower
ANGULAR_SPEED: Final = Usual(0.0, 1e6, "rpm", "1500 rpm")  # of the fastest centrifuges
SLIDING_SPEED: Final = Usual(0.0, 1000.0, "m/s")
SIZE: Final = Usual(1e-6, 1e5, "m", "2 m")
SOLID: Final = Usual(1e-7, 1e4, "m", "50 mm")
POWER: Final = Usual(0.0, 1000.0, "MW")
GRAVITY: Final = Usual(0.0, 300.0, "m/s^2", "[0, 0, -9.81]")
