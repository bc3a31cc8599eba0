"""Blades and buckets: an edge on a body that cuts soil, pushes it, carries it and lets it fall (`nivel.elements.contacts.on_soil`)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, ClassVar, Literal

import numpy as np

from nivel.elements.contacts.on_soil import BladeRow, apply
from nivel.elements.contacts.soil import CHANGES_OUT, ON_SOIL, OnSoil, PositiveAngle, add_soil
from nivel.elements.kind import Kind
from nivel.elements.output import Output, add_outputs, of_force
from nivel.elements.states import StateFact
from nivel.errors import Fault, ModelError
from nivel.machine.core.checked import Problem
from nivel.machine.core.coefficient import Volume
from nivel.machine.core.marker import MarkerPlace, TwoMarkers
from nivel.machine.given import Field, Maybe
from nivel.machine.units.quantity import PositiveLength

if TYPE_CHECKING:
    from nivel.system.builder import SystemBuilder


class Blade(OnSoil):
    """An edge between two markers of a body, which cuts what stands above it where it moves.

    The x axis of the first marker points to where the blade looks, its face leans back from there by `rake`.
    """

    outputs: ClassVar[tuple[str, ...]] = (
        *of_force("force of the soil on the blade"),
        Output("cutting", "N", "force of the wedge before the edge"),
        Output("bearing", "N", "force of the soil under the floor"),
        Output("depth", "m", "of the edge below the soil ahead"),
        Output("load", "kg", "mass that it carries"),
        *ON_SOIL,
    )
    turns: ClassVar[bool] = True

    type: Literal["blade"] = "blade"
    edge: TwoMarkers = Field(description="two markers of a body: the ends of the edge, the left one first")
    rake: PositiveAngle = Field(default=math.radians(50.0), description="from where the blade looks up to its face")
    floor: PositiveLength = Field(default=0.1, description="length behind the edge that bears on the soil")
    capacity: Maybe[Volume] = Field(
        default=None, description="that a bucket carries", absent="none: a blade pushes all"
    )
    load_at: Maybe[MarkerPlace] = Field(
        default=None, description="marker of the same body: middle of what a bucket carries", absent="the left end"
    )

    def problems(self) -> Iterator[Problem]:
        if self.rake >= math.pi - self.soil.tool_friction - self.soil.friction_angle:
            yield Problem(("rake",), "rake and both angles of friction together must be below 180 deg")


def add(builder: SystemBuilder, force: Blade) -> None:
    """A blade, with two shares of its resistances as states."""
    left, right = builder.ends(force.edge)
    load = left if force.load_at is None else builder.end(force.load_at)
    bodies = {builder.markers.body[each] for each in (left, right, load)}
    names = [body.name for body in builder.machine.bodies]
    if len(bodies) > 1 or max(bodies) == len(names) or builder.machine.bodies[max(bodies)].point_mass:
        raise ModelError(Fault.at(f"forces.{force.name}.edge", "all markers of a blade stand on one rigid body"))
    apart = np.linalg.norm(builder.markers.position[left] - builder.markers.position[right])
    if not apart > 0.0:
        raise ModelError(Fault.at(f"forces.{force.name}.edge", "the ends of the edge are in one place"))
    first = add_outputs(builder, force)
    shares = [
        builder.own_state(StateFact(f"{force.name}.{name}", "1", f"share of the {text} of {force.name}", 0.0, 1e-2))
        for name, text in (("push", "cutting force"), ("bearing", "bearing force"))
    ]
    own: dict[str, Any] = add_soil(builder, force, first + CHANGES_OUT)
    row = BladeRow(
        output=first,
        left=left,
        right=right,
        load=load,
        push=shares[0],
        bearing=shares[1],
        rake=force.rake,
        capacity=force.capacity or 0.0,
        floor=force.floor,
        work=[0.0] * 6,
        **own,
    )
    builder.add(apply, row)


KINDS = (Kind(Blade, add, (apply,)),)
