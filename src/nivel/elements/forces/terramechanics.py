"""Terramechanics: blades and buckets that cut soil, carry it and let it fall, and rigid wheels and tracks that sink into it.

The kernels are those of `nivel.elements.contacts.on_soil` and `nivel.elements.contacts.tracks`, where tracks are on hard ground too.
"""

import math
from collections.abc import Iterator
from typing import Any, ClassVar, Literal

import numpy as np

from nivel.elements.contacts import tracks
from nivel.elements.contacts.height_field import HeightField
from nivel.elements.contacts.heights import numbers_of
from nivel.elements.contacts.on_soil import apply
from nivel.elements.contacts.soil import ON_SOIL, ForceRow, OnSoil, Soil, add_soil
from nivel.elements.facts import Output, StateFact, add_outputs, of_force
from nivel.elements.forces.tyre import Grip, PositiveDamping, PositiveStiffness
from nivel.elements.kind import Kind
from nivel.errors import Fault, ModelError
from nivel.kernels.elements.soil import address_of
from nivel.kernels.record import function
from nivel.known import SystemBuilder
from nivel.machine.bodies.inertia import mass_of
from nivel.machine.core.coefficient import PositiveAngle, Volume
from nivel.machine.core.element import ForceElement, MarkerPlace, TwoMarkers
from nivel.machine.core.record import GROUND, Problem, superfluous
from nivel.machine.given import Field, Maybe, OneRecord, TwoNumbers
from nivel.machine.units.quantity import Length, PositiveLength, Whole


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
    cast: Maybe[TwoNumbers[Length]] = Field(
        "how far ahead of its edge, and to the left of there, what it does not carry falls",
        default=None,
        absent="just ahead",
    )
    load_at: Maybe[MarkerPlace] = Field(
        "marker of the same body: middle of what a bucket carries", default=None, absent="the left end"
    )

    opening: Maybe[TwoMarkers] = Field(
        "two markers of the same body: opposite corners of a rectangle into which soil falls", default=None
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


class Track(ForceElement):
    """A belt with shoes about wheels of a frame, which a sprocket drives: patches between two points, on hard ground or on soil."""

    turns: ClassVar[bool] = True
    outputs: ClassVar[tuple[str, ...]] = (
        *of_force("load across the belt"),
        Output("pull", "N", "force on the frame forwards, what resists the sinking taken off"),
        Output("lateral", "N", "force on the frame to the left"),
        Output("moment", "N m", "moment on the frame about the normal of the belt, of its lateral forces"),
        Output("driving_moment", "N m", "moment on the sprocket about its axle, as if that pointed to the left"),
        Output("sinkage", "m", "greatest, below the soil as it was laid; how deep it presses into hard ground"),
        Output("slip", "1", "(belt - v) / max(|v|, |belt|)"),
        Output("slip_loss", "W", "power lost by sliding"),
        Output("resistance", "N", "of soil that is pressed down, against forward motion"),
        Output("place_x", "m", "place of the middle along the x axis of the plane's marker"),
        Output("place_y", "m", "place of the middle along its y axis"),
        *ON_SOIL,
    )

    type: Literal["track"] = "track"
    contact: TwoMarkers = Field(
        "markers of the frame: front and rear end of the belt below; z of the first one points up"
    )
    sprocket: MarkerPlace = Field("marker on what drives the belt: its z axis is the axle, in either sense")
    radius: PositiveLength = Field("of the sprocket, to the pins of the belt")
    width: PositiveLength = Field("of the belt")
    patches: Whole = Field("along the belt, 2 to 100", default=10)
    plane: MarkerPlace = Field("marker: its point lies in the plane, its z axis points out of it")
    heights: Maybe[OneRecord[HeightField]] = Field("of ground that is not flat, over the `plane`", default=None)
    soil: Maybe[OneRecord[Soil]] = Field("numbers of the soil", default=None, absent="hard ground")
    grip: Grip = Field("of hard ground: shear by load; a function, of the place `x`, `y` too", default=0.8)
    stiffness: Maybe[PositiveStiffness] = Field(
        "on hard ground", default=None, absent="all weight presses belts in by 1 cm"
    )
    damping: Maybe[PositiveDamping] = Field("on hard ground", default=None, absent="10 ms · stiffness")
    shear_length: PositiveLength = Field("on hard ground: sliding after which 63 % of the grip acts", default=0.01)

    def problems(self) -> Iterator[Problem]:
        if not 2 <= self.patches <= MOST_PATCHES:
            yield Problem(("patches",), f"2 to {MOST_PATCHES} patches were expected, got {self.patches}")
        if self.soil is None:
            return
        if self.heights is None:
            yield Problem(("heights",), "`heights` of the soil are missing")
        for name in ("stiffness", "damping"):
            if getattr(self, name) is not None:
                yield superfluous(name, "belongs to hard ground, and `soil` is given")


MOST_PATCHES, STANDARD_GRAVITY = 100, 9.81
PRESSED_IN, DAMPING_TIME = 0.01, 0.01  # [m] under the weight, and d/c [s], of a track whose stiffness is not given


def add_blade(builder: SystemBuilder, force: Blade) -> None:
    """A blade, with two shares of its resistances as states."""
    left, right, load, *opening = map(
        builder.end, (*force.edge, force.load_at or force.edge[0], *(force.opening or ()))
    )
    bodies = {builder.markers.body[each] for each in (left, right, load, *opening)}
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
    columns: dict[str, Any] = add_soil(builder, force) | dict(zip(("near", "far"), opening, strict=False))
    columns |= dict(zip(("cast_ahead", "cast_left"), force.cast or (), strict=False))
    builder.add(apply, ForceRow.of(force, left=left, right=right, load=load, push=push, bearing=bearing, **columns))


def add_wheel(builder: SystemBuilder, force: SoilWheel) -> None:
    """A wheel."""
    builder.add(apply, ForceRow.of(force, wheel=builder.end(force.wheel), **add_soil(builder, force)))


def add_track(builder: SystemBuilder, force: Track) -> None:
    """A track, with two shares of each patch, and on soil one of what resists at either end."""
    front, rear, sprocket = map(builder.end, (*force.contact, force.sprocket))
    (body, a, axes), (other, b, _), (turning, _, _) = map(builder.as_placed, (*force.contact, force.sprocket))
    known, along, is_hard = builder.machine.body_named, a - b, force.soil is None
    bends = any(known[each].flexible for each in {body, turning} & known.keys())
    across = float(np.linalg.norm(np.cross(axes[:, 2], along)))
    weight = STANDARD_GRAVITY * sum(map(mass_of, builder.machine.bodies))
    stiffness = force.stiffness or weight / sum(isinstance(each, Track) for each in builder.machine.forces) / PRESSED_IN
    upright = "the z axis of the first marker points away from the ground, across the line from the second one to it"
    for wrong, key, message in (
        (body != other or body == GROUND, "contact", "both markers of a belt stand on one body"),
        (across <= LEAST_SINE * float(np.linalg.norm(along)), "contact", upright),
        (turning in (body, GROUND), "sprocket", "the sprocket needs a body that turns on the frame"),
        (bends, "contact", "a track stands on rigid bodies"),
        (
            is_hard and stiffness == 0.0,
            "stiffness",
            "must be given: no body has a weight of which a share could press the belt in",
        ),
    ):
        if wrong:
            raise ModelError(Fault.at(f"forces.{force.name}.{key}", message))
    columns = {"output": add_outputs(builder, force, without=ON_SOIL)} if is_hard else add_soil(builder, force)

    def share(name: str, text: str, *, follows: bool) -> int:
        long_name = f"share of the {text} of {force.name}"
        return builder.own_state(StateFact(f"{force.name}.{name}", "1", long_name, 0.0, 1e-2, follows=follows))

    if not is_hard:
        columns |= {name: share(key, f"resistance {text}", follows=False) for name, key, text in ENDS}
    heights = force.heights if is_hard else None
    x, y = ((function.OUTPUT, columns["output"] + tracks.PLACE + k, 0) for k in range(2))
    row = ForceRow.of(
        force,
        front=front,
        rear=rear,
        sprocket=sprocket,
        grip=builder.function(force.grip, {"x": x, "y": y}),
        uneven=int(heights is not None),
        shares=[
            share(f"{way}_{k + 1}", f"strength {way} patch {k + 1}", follows=True)
            for k in range(force.patches)
            for way in ("along", "across")
        ],
        stiffness=stiffness,
        damping=DAMPING_TIME * stiffness if force.damping is None else force.damping,
        work=[0.0] * tracks.KEPT * force.patches + (numbers_of(heights.heights, heights.size) if heights else []),
        **(columns | {"plane": builder.end(force.plane)}),
    )
    builder.add(tracks.apply if is_hard else apply, row)


LEAST_SINE = 0.1  # of the angle between the belt and the z axis of its first marker
ENDS = (("push", "front", "ahead of the front end"), ("bearing", "rear", "behind the rear end"))
KINDS = (
    Kind(Blade, add_blade, (apply, address_of)),
    Kind(SoilWheel, add_wheel, (apply, address_of)),
    Kind(
        Track,
        add_track,
        (tracks.apply, apply, address_of),
        lambda machine, force: (apply, address_of) if force.soil else (tracks.apply,),
    ),
)
