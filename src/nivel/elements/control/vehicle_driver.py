"""Driver of a vehicle: steers along a course with preview, or as told, and holds a speed with two pedals.

The aim lies `preview` seconds ahead along the course. The vehicle is to take the circle along its heading through its place and the aim:
curvature 2 e/l² for an aim at the distance l, e to the left (Wallace et al. 1985; the preview is that of MacAdam 1981). The angle is
(wheelbase + understeer v²) times that, as of the linear single track. The station on the course is where ṡ = v cos(ψ - ψ_c) + a/τ leads,
with what the vehicle is ahead of it, a.
"""

from collections.abc import Iterator
from typing import Annotated, Literal

import numpy as np
from pydantic import BeforeValidator

from nivel.elements.kind import Kind
from nivel.lazy import scipy
from nivel.machine.control.block import Block, Input, Matrix, NotNegativeTime, Number, PositiveNumber
from nivel.machine.control.part import Part
from nivel.machine.core.record import Problem, superfluous
from nivel.machine.given import Field, Maybe
from nivel.machine.laws.varying_value import Table
from nivel.machine.units.formula import formula, linear
from nivel.machine.units.quantity import Duration, listed

FOUND = 0.2  # τ [s]
FEWEST = 3  # points of a course
PARTS, FINER = 8, 16  # of a course between two points, and of these to sum its length
ALONG = ("x", "y", "heading", "wheelbase")  # what a course needs


class VehicleDriver(Block):
    """Angle of the front wheels along a `course` or as `steering` says; pedals by the speed."""

    quantities = ("value", "throttle", "brake", "deviation", "station")

    type: Literal["vehicle-driver"] = "vehicle-driver"
    speed: Input = Field("measured speed forwards")
    target: Input = Field("speed to be held; zero or less: the brake is 1", default=0.0)
    gain: PositiveNumber = Field("pedal, up to 1, by missing speed, s/m", default=0.5)
    steering: Maybe[Input] = Field("angle of the front wheels, in place of a `course`", default=None)
    course: Maybe[Annotated[Matrix, BeforeValidator(listed)]] = Field(
        "points `[x, y]` from the start on, in m; a cubic spline goes through them", default=None
    )
    x: Maybe[Input] = Field("with a `course`: measured place", default=None)
    y: Maybe[Input] = Field("with a `course`: measured place", default=None)
    heading: Maybe[Input] = Field("with a `course`: measured yaw angle", default=None)
    wheelbase: Maybe[PositiveNumber] = Field("with a `course`: distance of the axles", default=None)
    understeer: Number = Field("steering angle by lateral acceleration, rad s²/m", default=0.0)
    preview: Duration = Field("time by which the aim is ahead", default=0.8)
    lag: NotNegativeTime = Field("time constant of the steering along a course", default=0.0)
    limit: PositiveNumber = Field("greatest steering angle, rad", default=0.6)

    def computation(self) -> tuple[Part, ...]:
        parts = [self.present("own_speed", self.speed, key="speed"), self.present("wished", self.target, key="target")]
        if self.steering is not None:
            parts.append(self.present(self.output, self.steering, key="steering"))
        else:
            parts += self._along()
        names = {"target": self.path("wished"), "speed": self.path("own_speed"), "gain": self.gain}
        parts.append(self.present("throttle", formula("min(max(gain*(target - speed), 0), 1)", **names)))
        parts.append(
            self.present("brake", formula("if(target <= 0, 1, min(max(gain*(speed - target), 0), 1))", **names))
        )
        return tuple(parts)

    def _along(self) -> Iterator[Part]:
        for name in ("x", "y", "heading"):
            yield self.present(f"own_{name}", getattr(self, name), key=name)
        s, points, slopes = _course(np.array(self.course))
        courses = {"place_x": points[:, 0], "place_y": points[:, 1], "slope_x": slopes[:, 0], "slope_y": slopes[:, 1]}
        yield self.present("ahead", linear((1.0, self.path("station")), (self.preview, self.path("own_speed"))))
        for name, values in courses.items():
            yield self.present(name, Table(tuple(s), tuple(values), "cubic", self.path("station")))
        for name in ("place_x", "place_y"):
            yield self.present(f"aim_{name[-1]}", Table(tuple(s), tuple(courses[name]), "cubic", self.path("ahead")))
        own = {name: self.path(f"own_{name}") for name in ("x", "y", "heading", "speed")}
        own |= {name: self.path(name) for name in (*courses, "aim_x", "aim_y", "station")}
        size = "sqrt(slope_x^2 + slope_y^2)"
        yield self.present(
            "deviation",
            formula(f"((y - place_y)*slope_x - (x - place_x)*slope_y)/{size}", **_only(own, *courses, "x", "y")),
        )
        rate = f"(speed*(slope_x*cos(heading) + slope_y*sin(heading)) + ((x - place_x)*slope_x + (y - place_y)*slope_y)/found)/{size}"
        known = _only(own, *courses, "x", "y", "heading", "speed")
        after = formula(
            f"station + step*{rate}", found=max(FOUND, self.period), step=self.period, station=own["station"], **known
        )
        yield self.remembered("station", formula(rate, found=FOUND, **known), after)
        bend = "2*((aim_y - y)*cos(heading) - (aim_x - x)*sin(heading))/max((aim_x - x)^2 + (aim_y - y)^2, 0.01)"
        angle = f"min(max((wheelbase + understeer*speed^2)*{bend}, -limit), limit)"
        of_angle = _only(own, "aim_x", "aim_y", "x", "y", "heading", "speed")
        numbers = {"wheelbase": self.wheelbase or 0.0, "understeer": self.understeer, "limit": self.limit}
        if not self.lag:
            yield self.present(self.output, formula(angle, **of_angle, **numbers))
            return
        yield self.present("wanted", formula(angle, **of_angle, **numbers))
        wanted, steered, time = self.path("wanted"), self.path("steered"), max(self.lag, self.period)
        share = self.period / time
        yield self.remembered(
            "steered",
            linear((1.0 / time, wanted), (-1.0 / time, steered)),
            linear((1.0 - share, steered), (share, wanted)),
        )
        yield self.present(self.output, linear((1.0, steered)))

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if (self.course is None) == (self.steering is None):
            yield Problem((), "a driver needs a `course`, points `[x, y]`, or `steering`, an angle; one of them")
        for key in ALONG:
            if self.course is not None and getattr(self, key) is None:
                yield Problem((), f"`{key}` is missing: a driver along a `course` measures place and heading")
            if self.course is None and getattr(self, key) is not None:
                yield superfluous(key, "belongs to a `course`, and none is given")
        if self.course is not None:
            if len(self.course) < FEWEST or any(len(row) != 2 for row in self.course):
                yield Problem(("course",), f"{FEWEST} or more points `[x, y]` were expected")
            elif not np.hypot(*np.diff(np.array(self.course), axis=0).T).all():
                yield Problem(("course",), "two points beside each other are the same")


def _only(names: dict[str, str], *wanted: str) -> dict[str, str]:
    return {name: names[name] for name in wanted}


def _course(points: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Lengths (m,) along the cubic spline through points (n, 2), places and directions (m, 2), in PARTS from point to point.

    Directions are no spline, and the length is no polynomial of that of the polygon: so they stand at more places than the points.
    """
    chord = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    spline = scipy.interpolate.CubicSpline(chord, points, bc_type="natural")
    at = np.interp(np.arange((len(chord) - 1) * PARTS * FINER + 1) / (PARTS * FINER), np.arange(len(chord)), chord)
    speed = np.hypot(*spline(at, 1).T)
    s = np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(at))])
    kept = at[::FINER]
    return s[::FINER], spline(kept), spline(kept, 1) / speed[::FINER, None]


KINDS = (Kind(VehicleDriver),)
