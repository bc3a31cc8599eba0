# pyright: strict
"""A user's script: all that it writes is accepted by a strict type checker."""

from pathlib import Path

import numpy as np

import nivel

arm = nivel.Body(
    name="arm",
    mass="2 kg",
    inertia=(0.01, "200 kg*cm^2", 0.2),
    position=("50 cm", 0, 0),
    shape={"type": "sphere", "radius": "3 cm"},
)
tip = nivel.Body(name="tip", mass=1, point_mass=True, position=np.array([1.0, 0.0, 0.0]), velocity=["1 m/s", 0, 0])
turned = nivel.Body(name="turned", mass=1.0, inertia=[1, 1, 1], orientation={"axis": (0, 0, 1), "angle": "30 deg"})
pin = nivel.Joint(
    name="pin",
    type="revolute",
    bodies=["ground", "arm"],
    point=(0, 0, 0),
    axis=(0, 0, 1),
    start={"angle": "10 deg"},
    start_rates=None,
)
spring = nivel.SpringDamper(
    name="spring", bodies=("arm", "tip"), points=((0, 0, 0), ("1 m", 0, 0)), stiffness="3 N/mm", damping=2
)
motor = nivel.Motor(name="motor", coordinate="pin", effort="2 N*m * sin(3 * time)")
table = nivel.Table(times=(0.0, 1.0), values=(0.0, 2.0))
settings = nivel.SimulationSettings(duration="2 s", step=1e-3, integrator="dopri5")
made = nivel.Machine("made", bodies=[arm, tip], joints=[pin], forces=[spring, motor], gravity=(0, "-9.81 m/s^2", 0))
assert made.bodies["arm"].position is not None
x: float = made.bodies["arm"].position[0]
stiffness: float | None = spring.stiffness

machine = nivel.load("press.yaml", {"bodies.ram.mass": "3 kg"})
ram = machine.bodies["ram"].mass
assert ram is not None
weight: float = 9.81 * ram
names: list[str] = [*machine.bodies, *machine.joints, *machine.forces, *machine.sensors]
axis: tuple[float, float, float] | None = machine.joints["main"].axis
for force in machine.forces.values():
    if isinstance(force, nivel.Motor):
        coordinate: str = force.coordinate
result = machine.simulate(
    duration="1 s",
    integrator="generalised-alpha",
    formulation="newton-euler",
    coordinates="relative",
    stabilisation="none",
    verify=False,
)
angles = result.array("main.angle")
largest = float(angles.max())
mean = float(result["main.angle"].mean())
error = result.estimated_error("main.angle")
figure = result.plot("main.angle", "pin.angle", band=True)
figure.set_size_inches(8.0, 4.0)
page: Path = result.report("press.html")
heavier = machine.replace(machine.bodies["ram"].replace(mass="5 kg")).with_values({"ram.mass": 6})
rest = heavier.statics(coordinates="relative")
print(rest.outcome, result.trust.headline, largest, mean, error, page, x, weight, names, axis, stiffness, table, turned)
