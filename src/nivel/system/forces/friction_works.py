"""Work of the friction of contacts in numbers."""

from __future__ import annotations

from nivel.elements.states import StateFact
from nivel.kernels.forces import friction_work
from nivel.system.builder import SystemBuilder
from nivel.system.forces.outputs import Output

# of a contact that is asked for it, behind its other outputs
WORK: Output = ("friction_work", "J", "work of friction that became heat since the start")


def add_friction_work(builder: SystemBuilder, name: str, power: int) -> int:
    """State with the work of the contact `name`, which has the output WORK; power : output with its rate, or NONE where the patch of the
    contact adds to the state. Returns the state."""
    fact = StateFact(f"{name}.friction_work", "J", f"work of friction of {name}", 0.0, 1.0, integral=True)
    state = builder.own_state(fact)
    builder.elements.add(friction_work.apply, [builder.outputs.index(f"force.{name}.friction_work"), state, power])
    return state
