"""Terramechanics: blades and buckets that cut soil, carry it and let it fall, and rigid wheels that sink into it.

The kernels are those of `nivel.elements.contacts.on_soil`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar, Literal

import numpy as np

from nivel.elements.contacts.on_soil import ForceRow, apply
from nivel.elements.contacts.soil import ON_SOIL, OnSoil, add_soil
from nivel.elements.facts import Output, StateFact, of_force
from nivel.elements.kind import Kind
from nivel.errors import Fault, ModelError
from nivel.kernels.elements.soil import address_of
from nivel.known import SystemBuilder
from nivel.machine.core.coefficient import PositiveAngle, Volume
from nivel.machine.core.marker import MarkerPlace, TwoMarkers
from nivel.machine.core.record import Problem
from nivel.machine.given import Field, Maybe
from nivel.machine.units.quantity import PositiveLength


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
    type: Literal["blade"] = "blade"
    edge: TwoMarkers = Field("two markers of a body: the ends of the edge, the left one first")
    rake: PositiveAngle = Field("from where the blade looks up to its face", default=0.87)
    floor: PositiveLength = Field("length behind the edge that bears on the soil", default=0.1)
    capacity: Maybe[Volume] = Field("that a bucket carries", default=None, absent="a blade pushes all")
    load_at: Maybe[MarkerPlace] = Field(
        "marker of the same body: middle of what a bucket carries", default=None, absent="the left end"
    )

    def problems(self) -> Iterator[Problem]:
        if self.rake >= math.pi - self.soil.tool_friction - self.soil.friction_angle:
            yield Problem(("rake",), "rake and both angles of friction together must be below 180 deg")


class SoilWheel(OnSoil):
    """A rigid wheel, or a tyre that is hard beside the soil: pressure by sinkage, and shear, cell by cell."""

    outputs: ClassVar[tuple[str, ...]] = (
        *of_force("load across the plane"),
        Output("longitudinal", "N", "force on the wheel in the direction in which it points"),
        Output("lateral", "N", "force on the wheel to the side to which its marker's z axis points"),
        Output("moment", "N m", "moment on the wheel about its axle"),
        Output("sinkage", "m", "greatest, below the soil as it was laid"),
        *ON_SOIL,
    )

    type: Literal["soil-wheel"] = "soil-wheel"
    wheel: MarkerPlace = Field("marker on the wheel: its point is the centre, its z axis the axle")
    radius: PositiveLength
    width: PositiveLength


def add_blade(builder: SystemBuilder, force: Blade) -> None:
    """A blade, with two shares of its resistances as states."""
    left, right, load = map(builder.end, (*force.edge, force.load_at or force.edge[0]))
    bodies = {builder.markers.body[each] for each in (left, right, load)}
    body = dict(enumerate(builder.machine.bodies)).get(max(bodies))  # the ground has none
    if len(bodies) > 1 or body is None or body.point_mass or body.flexible:
        raise ModelError(Fault.at(f"forces.{force.name}.edge", "all markers of a blade stand on one rigid body"))
    others = [each.edge[0] for each in builder.machine.forces if isinstance(each, Blade) and each is not force]
    if body.name in {(builder.machine.marker_named[at] if isinstance(at, str) else at).body for at in others}:
        message = f"`{body.name}` has another blade: give each a body of its own, joined by `type: fixed`"
        raise ModelError(Fault.at(f"forces.{force.name}.edge", message))
    if not np.any(builder.markers.position[left] != builder.markers.position[right]):
        raise ModelError(Fault.at(f"forces.{force.name}.edge", "the ends of the edge are in one place"))
    push, bearing = (
        builder.own_state(StateFact(f"{force.name}.{name}", "1", f"share of the {text} of {force.name}", 0.0, 1e-2))
        for name, text in (("push", "cutting force"), ("bearing", "bearing force"))
    )
    row = ForceRow.of(force, left=left, right=right, load=load, push=push, bearing=bearing, **add_soil(builder, force))
    builder.add(apply, row)


def add_wheel(builder: SystemBuilder, force: SoilWheel) -> None:
    """A wheel."""
    builder.add(apply, ForceRow.of(force, wheel=builder.end(force.wheel), **add_soil(builder, force)))


KINDS = (Kind(Blade, add_blade, (apply, address_of)), Kind(SoilWheel, add_wheel, (apply, address_of)))
