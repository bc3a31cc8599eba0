"""A machine whose beams do not bend: how it is moved by hand, where no forces act that would hold their nodes together."""

from __future__ import annotations

from typing import Any

from nivel.machine.joints.joint import Joint
from nivel.machine.machine_record import MachineRecord
from nivel.system.beams.nodes import with_nodes


def with_stiff_beams(machine: MachineRecord) -> MachineRecord:
    """The machine with the nodes of its beams as bodies, each fixed to the next; those joints stand behind its own."""
    whole = with_nodes(machine)
    if not whole.beams:
        return whole
    given: dict[str, Any] = {name: getattr(whole, name) for name in type(whole).model_fields}
    fixed = [
        Joint(name=f"{beam.name}-{k}", type="fixed", bodies=pair, point=whole.body_named[pair[0]].position)
        for beam in whole.beams
        for k, pair in enumerate(zip(beam.node_names[:-1], beam.node_names[1:], strict=True))
    ]
    given |= {"joints": (*whole.joints, *fixed), "beams": ()}
    return type(whole).model_construct(whole.model_fields_set, **given)
