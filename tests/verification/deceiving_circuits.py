"""Circuits and controls made to deceive, as `deceiving.py` has of mechanics: pulses of valves and inputs between the steps, a relief valve
that chatters, a volume that is too stiff for its steps, a piston that meets its end stop between two frames.

What an input pushes has a closed form; circuits are compared with themselves at a tolerance four decades below, by an implicit method.
"""

from functools import cache

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from deceiving import Deceiving
from nivel.api import Machine
from nivel.files import parse_machine

CART = """
format: 1
name: {name}
bodies:
  cart: {{mass: {mass}, inertia: [1, 1, 1]}}
joints:
  rail: {{type: translational, bodies: [ground, cart], point: [0, 0, 0], axis: [1, 0, 0]}}
"""
PISTON = """
fluids:
  oil: {{density: 870 kg/m^3, bulk_modulus: 1.5 GPa, viscosity: 46 mm^2/s}}
hydraulics:
  tank: {{type: tank, pressure: 2 bar}}
  jack:
    type: cylinder
    bodies: [ground, cart]
    points: [[-1, 0, 0], [0, 0, 0]]
    piston: 40 mm
    stroke: {stroke}
    retracted_length: 0.95 m
    dead_volume_A: {dead}
    dead_volume_B: {dead}
    friction: {{viscous: 3000 N*s/m}}
    start_A: 2 bar
    start_B: 2 bar
"""
SPIKE = (0.50003, 2e-3)


def parsed(text):
    return parse_machine(text)


def spike(harmless):
    """Times and values of a triangle of one unit second."""
    begin, width = SPIKE[0], 0.4 if harmless else SPIKE[1]
    return [0.0, begin, begin + width / 2, begin + width, 2.0], [0.0, 0.0, 2.0 / width, 0.0, 0.0]


def pushed(time, harmless):
    """Place of a mass of 1 kg after that push."""
    begin, w = SPIKE[0], 0.4 if harmless else SPIKE[1]
    s = np.clip((time - begin) / w, 0.0, 1.0)
    rising, falling = np.minimum(s, 0.5), np.maximum(s - 0.5, 0.0)
    place = w * (2.0 / 3.0 * rising**3 + 0.5 * falling + falling**2 - 2.0 / 3.0 * falling**3)
    return place + np.maximum(time - begin - w, 0.0)


def of_input():
    """A spike of 2 ms in the table of an input, in steps of 10 ms."""

    def machine(harmless):
        times, values = spike(harmless)
        return parsed(
            CART.format(name="input", mass=1)
            + f"""
inputs: {{lever: {{range: [0, 5000], signal: {{times: {times}, values: {values}}}}}}}
forces: {{push: {{type: force, body: cart, vector: [lever.value, 0, 0]}}}}
simulation: {{duration: 1, step: 10 ms}}
"""
        )

    return Deceiving("spike-of-an-input", machine, "cart.position.x", pushed)


def of_block():
    """The same spike in a continuous block, behind a gain."""

    def machine(harmless):
        times, values = spike(harmless)
        return parsed(
            CART.format(name="block", mass=1)
            + f"""
control:
  wish: {{type: signal, value: {{times: {times}, values: {values}}}}}
  half: {{type: gain, input: 2*wish.value, gain: 0.5}}
forces: {{push: {{type: force, body: cart, vector: [half.value, 0, 0]}}}}
simulation: {{duration: 1, step: 10 ms}}
"""
        )

    return Deceiving("spike-of-a-block", machine, "cart.position.x", pushed)


def circuit(name, text):
    """text(harmless) : of a machine with a circuit, but for its methods."""

    def machine(harmless):
        return parsed(text(harmless))

    @cache
    def reference(harmless):
        result = Machine.from_record(machine(harmless)).simulate(
            integrator="radau", coordinates="relative", tolerance=1e-10, output_interval=1e-4
        )
        place, speed = (result.array(f"cart.{each}.x") for each in ("position", "velocity"))
        return CubicHermiteSpline(result.time, place, speed)

    return Deceiving(name, machine, "cart.position.x", lambda time, harmless: reference(harmless)(time))


def valve_pulse(harmless):
    """A valve opens for 3 ms in steps of 10 ms, harmlessly for 0.4 s in steps of 1 ms."""
    width = 0.4 if harmless else 3e-3
    times, values = [0.0, 0.303, 0.303 + width / 2, 0.303 + width, 2.0], [0, 0, 0.1 if harmless else 1, 0, 0]
    return (
        CART.format(name="valve", mass=100)
        + PISTON.format(stroke="0.9 m", dead="0.5 L")
        + f"""
  supply: {{type: tank, pressure: 100 bar}}
  inlet: {{type: orifice, ports: {{A: supply, B: jack.A}}, flow: 60 L/min, pressure_drop: 10 bar,
    opening: {{times: {times}, values: {values}}}}}
  outlet: {{type: orifice, ports: {{A: jack.B, B: tank}}, flow: 60 L/min, pressure_drop: 10 bar}}
simulation: {{duration: 1, step: {"1 ms" if harmless else "10 ms"}}}
"""
    )


def chattering(harmless):
    """A relief valve without a damping that is worth it, on a volume of 0.1 L, harmlessly of 5 L, in steps of 5 ms."""
    return (
        CART.format(name="relief", mass=100)
        + PISTON.format(stroke="0.9 m", dead="0.5 L")
        + f"""
  line: {{type: volume, volume: {"5 L" if harmless else "0.1 L"}}}
  pump: {{type: pump, ports: {{A: tank, B: line}}, displacement: 20 cm^3/rev, speed: 1500 rpm}}
  relief: {{type: relief-valve, ports: {{P: line, T: tank}}, opens_at: 80 bar, opening_range: {"60 bar" if harmless else "1 bar"},
    flow: 60 L/min,
    pressure_drop: 80 bar, lag: {"2 ms" if harmless else "20 ms"}}}
  inlet: {{type: orifice, ports: {{A: line, B: jack.A}}, flow: 2 L/min, pressure_drop: 50 bar}}
  outlet: {{type: orifice, ports: {{A: jack.B, B: tank}}, flow: 60 L/min, pressure_drop: 10 bar}}
simulation: {{duration: 1, step: 5 ms}}
"""
    )


def stiff_volume(harmless):
    """A volume of 1 cm³ between two orifices, harmlessly of 10 L, in steps of 1 ms."""
    return (
        CART.format(name="volume", mass=100)
        + PISTON.format(stroke="0.9 m", dead="0.5 L")
        + f"""
  supply: {{type: tank, pressure: 100 bar}}
  block: {{type: volume, volume: {"10 L" if harmless else "1 cm^3"}}}
  inlet: {{type: orifice, ports: {{A: supply, B: block}}, flow: 5 L/min, pressure_drop: 10 bar}}
  passage: {{type: orifice, ports: {{A: block, B: jack.A}}, flow: 5 L/min, pressure_drop: 10 bar}}
  outlet: {{type: orifice, ports: {{A: jack.B, B: tank}}, flow: 60 L/min, pressure_drop: 10 bar}}
simulation: {{duration: 0.5, step: 1 ms}}
"""
    )


def end_stop(harmless):
    """A piston that comes to its end stop between two frames 0.1 s apart; harmlessly it has more stroke than time."""
    return (
        CART.format(name="stop", mass=100)
        + PISTON.format(stroke="0.9 m" if harmless else "0.1503 m", dead="0.5 L")
        + """
  supply: {type: tank, pressure: 100 bar}
  inlet: {type: orifice, ports: {A: supply, B: jack.A}, flow: 10 L/min, pressure_drop: 50 bar}
  outlet: {type: orifice, ports: {A: jack.B, B: tank}, flow: 60 L/min, pressure_drop: 10 bar}
simulation: {duration: 1, step: 1 ms, output_interval: 100 ms}
"""
    )


KINDS = (
    of_input(),
    of_block(),
    circuit("valve-pulse-of-3-ms", valve_pulse),
    circuit("chattering-relief", chattering),
    circuit("stiff-volume", stiff_volume),
    circuit("end-stop-between-frames", end_stop),
)
