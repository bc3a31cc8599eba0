"""Usual ranges of quantities of circuits, from small laboratory devices to the largest machines that are built, and the quantities that
many components have, each with its own."""

from typing import Annotated, Final

from nivel.machine.core import coefficient
from nivel.machine.given import Usual
from nivel.machine.laws.time_function import OneFunction, varying
from nivel.machine.units.quantity import PositiveLength

# Water jets apart, circuits of machines stay below 700 bar; the least pressure is that of a vacuum pump.
PRESSURE: Final = Usual(0.01, 700.0, "bar", "250 bar")
DIFFERENCE: Final = Usual(5e-3, 700.0, "bar", "10 bar")
FLOW: Final = Usual(1e-5, 3e4, "l/min", "40 l/min")
POWER: Final = Usual(0.0, 2e4, "kW")
PUMP_DISPLACEMENT: Final = Usual(1e-3, 5e3, "cm^3/rev", "28 cm^3/rev")
DISPLACEMENT: Final = Usual(1e-3, 5e5, "cm^3/rev", "28 cm^3/rev")
TORQUE: Final = Usual(0.0, 1e6, "N*m", "400 N*m")
SHAFT_SPEED: Final = Usual(0.0, 1.2e4, "rpm", "1500 rpm")
PISTON_SPEED: Final = Usual(0.0, 20.0, "m/s")
DIAMETER: Final = Usual(0.5, 4000.0, "mm", "80 mm")
BORE: Final = Usual(0.005, 4000.0, "mm", "2 mm")
ORIFICE: Final = Usual(0.005, 500.0, "mm", "2 mm")
STROKE: Final = Usual(0.1, 5e4, "mm", "500 mm")
PIPE_LENGTH: Final = Usual(1e-3, 1e5, "m", "2 m")
VOLUME: Final = Usual(1e-7, 1e6, "l", "1 l")
LIQUID_DENSITY: Final = Usual(400.0, 14000.0, "kg/m^3", "870 kg/m^3")
GAS_DENSITY: Final = Usual(0.05, 10.0, "kg/m^3", "1.185 kg/m^3")
VAPOUR: Final = Usual(1e-7, 0.5, "bar", "0.02 bar")
BULK_MODULUS: Final = Usual(0.3, 30.0, "GPa", "1.5 GPa")
WALL_MODULUS: Final = Usual(1e-3, 1e4, "GPa", "1 GPa")
VISCOSITY: Final = Usual(0.05, 1e5, "mm^2/s", "46 mm^2/s")
HEAT_TRANSFER: Final = Usual(0.1, 1e5, "W/(m^2*K)", "50 W/(m^2*K)")
SURFACE: Final = Usual(1e-8, 1e4, "m^2", "0.1 m^2")
CONDUCTANCE: Final = Usual(1e-4, 1e4, "dm^3/(s*bar)", "4 dm^3/(s*bar)")
TEMPERATURE: Final = Usual(100.0, 1000.0, "K", "293 K")
HEAT_CAPACITY: Final = Usual(300.0, 1e4, "J/(kg*K)", "1900 J/(kg*K)")
EXPANSION: Final = Usual(1e-5, 3e-3, "1/K", "7e-4/K")
TANK_HEIGHT: Final = Usual(1e-3, 20.0, "m", "0.4 m")
SPOOL_STROKE: Final = Usual(0.05, 100.0, "mm", "7 mm")
CURRENT: Final = Usual(0.0, 20.0, "A", "0.6 A")
LAG: Final = Usual(1e-5, 1.0, "s", "10 ms")
SPOOL_FREQUENCY: Final = Usual(0.2, 1000.0, "Hz", "8 Hz")

Level = Annotated[coefficient.Pressure, PRESSURE]
VaryingLevel = Annotated[OneFunction, varying("pressure"), PRESSURE]
Drop = Annotated[coefficient.Pressure, DIFFERENCE]
LeastDrop = Annotated[coefficient.NotNegativePressure, DIFFERENCE]
Flow = Annotated[coefficient.VolumeFlow, FLOW]
Size = Annotated[coefficient.Volume, VOLUME]
Lag = Annotated[coefficient.NotNegativeDuration, LAG]
Bore = Annotated[PositiveLength, BORE]
Stroke = Annotated[PositiveLength, STROKE]
PipeLength = Annotated[PositiveLength, PIPE_LENGTH]
WallModulus = Annotated[coefficient.Pressure, WALL_MODULUS]
WallTransfer = Annotated[coefficient.HeatTransfer, HEAT_TRANSFER]
Warmth = Annotated[coefficient.Temperature, TEMPERATURE]
SpoolFrequency = Annotated[coefficient.Frequency, SPOOL_FREQUENCY]
