"""Attributes of a run that are known before its first frame."""

import json
from pathlib import Path
from typing import Protocol

from nivel import __version__
from nivel.analysis.plan.choice import names_no_integrator
from nivel.analysis.preparation.preparation import Prepared
from nivel.flexible.body.body_file import fingerprint
from nivel.lazy import nivel
from nivel.machine.machine_record import MachineRecord
from nivel.results.frames.contents import ATTRIBUTE as RESULT_FORMAT
from nivel.results.frames.contents import FORMAT
from nivel.results.stress import ATTRIBUTE, BodySource, as_attribute
from nivel.system.flexible import bending_bodies
from nivel.system.scene import scene


class Settings(Protocol):
    """Settings of an analysis."""

    def as_dict(self) -> dict[str, object]:
        """For the result's `settings`."""
        ...


def run_attributes(
    machine: MachineRecord, source: str, prepared: Prepared, settings: Settings, reason: str = ""
) -> dict[str, str | float | int]:
    """The attributes of a result, see `nivel.integrate.loop.sink.Header`.

    source : text of the machine's file. reason : why it has its integrator where nobody asked for it.
    """
    system, assembly = prepared.motion.system, prepared.assembly
    # what the file leaves to nivel
    simulation = machine.simulation
    unnamed = simulation.where_given - simulation.model_fields_set if names_no_integrator(machine) else frozenset()
    coordinates = system.layout.coordinates["joint_coordinate"]
    return {
        "machine": machine.name,
        "machine_record": machine.model_dump_json(
            by_alias=True, exclude_none=True, exclude={"simulation": set(unnamed)} if unnamed else None
        ),
        "machine_source": source,
        # relative coordinates move body frames
        "scene": json.dumps(scene(nivel.system.beam_nodes.with_nodes(machine), prepared.absolute.system)),
        "settings": settings_in_json(settings, reason),
        "nivel_version": __version__,
        RESULT_FORMAT: FORMAT,
        "outcome": "running",
        "coordinate_units": json.dumps(dict(zip(coordinates, system.coordinate_units, strict=True))),
        "constraint_units": json.dumps(dict(zip(system.rows, system.row_units, strict=True))),
        ATTRIBUTE: as_attribute(_bodies(machine)),
        "assembly": json.dumps(
            {
                "gap": assembly.gap,
                "gap_row": assembly.gap_row,
                "moved": assembly.moved,
                "velocity_change": assembly.velocity_change,
                "followed": assembly.followed,
            }
        ),
    }


def settings_in_json(settings: Settings, reason: str = "", went_on: tuple[str, float] | None = None) -> str:
    """The attribute `settings`. went_on : the integrator that went on, and from when [s]."""
    out = settings.as_dict() | ({"reason": reason} if reason else {})
    if went_on is not None:
        out["went_on"] = {"integrator": went_on[0], "from": went_on[1]}
    return json.dumps(out)


def _bodies(machine: MachineRecord) -> list[BodySource]:
    """Where the flexible bodies came from."""
    out = []
    for each in bending_bodies(machine):
        if each.beam:
            continue
        body = machine.bodies[each.body]
        assert body.flexible is not None
        file = str(Path(body.flexible.file).resolve())
        out.append(BodySource(body.name, file, each.modes, fingerprint(each.reduced)))
    return out
