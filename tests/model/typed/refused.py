# pyright: strict
"""What a type checker refuses in a user's script: every line that ends with `refused`, and no other."""

import nivel

machine = nivel.load("press.yaml")
machine.simulate(integrator="rk5")  # refused
machine.simulate(formulation="newton")  # refused
machine.simulate(coordinates="polar")  # refused
machine.simulate(stabilisation="some")  # refused
machine.statics(coordinates="independent")  # refused
nivel.SimulationSettings(integrator="rk5")  # refused
nivel.Body(mass=1.0)  # refused
nivel.Body(name="a", weight=1.0)  # refused
nivel.Body(name="a", mass=None, position=3.0)  # refused
nivel.Body(name="a", mass=[1.0])  # refused
nivel.Joint(name="a", type="hinge")  # refused
machine.bodies["a"].mass = 3.0  # refused
machine.bodies["a"] = nivel.Body(name="a", mass="1 kg")  # refused
print(machine.bodies.rod)  # refused
text: str = machine.joints["a"].pitch  # refused
