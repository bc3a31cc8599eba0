"""Tyres: a disc on a plane whose patch rolls, slides and stands by one equation.

A slip law returns fluidities A = sliding speed by force [m/(N s)] along, across and about the normal, at a load, a transport speed
v_T = r |Ω| of the tread and sliding velocities v of the patch. A carcass of stiffness c and damping d joins patch and rim:

    ż = -(v + A c z)/(1 + A d),   F = c z + d ż                    steady: F = -v/A, the curve of the law

Rolling, A = v_T/slope: z relaxes over the length slope/c. Locked, A = |v|/F_sliding: a bristle (Dahl 1968). At rest A = 0 and ż = 0: no
creep, and no smallest speed. Rill 2012, 3.7 has the same equation with a smallest speed in A. Below STICKS of the sliding force, or
unloading, and slower than SLOW the sliding part of A is zero (Dupont et al. 2002), and slower than ROCKS the rolling part falls with v_T²:
vibration would else make the bristle creep. Where the load has fallen, so that c z is beyond the peak, A grows by (c z/F_peak - 1)/d: z
comes back, and no state at rest has more than the peak.

The curves are those of TMeasy (Rill 2012, 3.5): slope, peak and sliding at two loads, forces between by a parabola through zero, slips
linearly; rational to the peak, two parabolas down to sliding. With slips together, σ² = Σ (s/s_M)², each direction has F/s of its own curve
at σ s_M: slopes, peaks and their ellipse are exact, and where it slides the force is along the velocity. Bore slip R_B ω_n/v_T is a third
component, R_B = (L + b)/6; camber is a sliding speed L/6 Ω sin γ; F_y acts behind the middle by the trail n L.
Every force acts on the velocity that it is computed from: F_x at the rolling radius, F_y at the trail. So what is lost is
d ż² + A F² ≥ 0, and nothing else.

With the numbers of a `.tir` file the law is a Magic Formula (`magic_formula`): F of its slips κ and tan α is F₀ - v/A, where A is the
secant of the curve without its shifts and F₀ what they add, so ż = -(v + A (c z - F₀))/(1 + A d). Its transport speed is |v_x|. Its
moments act besides, with the work that they do; the spin of a leaning wheel is in the formula and not in the bore.
"""

from collections.abc import Iterator, Sequence
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import BeforeValidator

from nivel.elements.contacts.height_field import HeightField
from nivel.elements.contacts.heights import BEND, HIGHEST, height, look_at_heights, mesh_of, numbers_of, surface
from nivel.elements.facts import Output, StateFact, add_outputs, of_force
from nivel.elements.forces import magic_formula
from nivel.elements.forces.magic_formula import MOST_SLIP, Magic, MagicFormula, lever, magic, overturning, resistance
from nivel.elements.kind import Kind
from nivel.elements.rows import Row, element, several
from nivel.kernels.algebra.analytic import absolute, arctan2, maximum, minimum, real
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.algebra.vectors import axis, minus, opposite, plus, seen, times, turned
from nivel.kernels.forces.wrench import add_force_at, add_torque
from nivel.kernels.record import function
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.record import NONE, record_at
from nivel.known import MachineRecord, SystemBuilder
from nivel.machine.core.coefficient import NotNegativeNumber, PositiveForce, PositiveNumber, Pressure
from nivel.machine.core.element import Acts, ForceElement, Inequalities, MarkerPlace
from nivel.machine.core.placement import marker_frame
from nivel.machine.core.record import Checked, Problem, superfluous
from nivel.machine.given import Field, Maybe, OneNumber, OneRecord, TwoNumbers
from nivel.machine.laws.time_function import OneFunction, varying
from nivel.machine.units.quantity import PositiveLength, Quantity, listed
from nivel.native.function import leaf

PositiveStiffness = Annotated[OneNumber, Quantity("stiffness", positive=True)]
PositiveDamping = Annotated[OneNumber, Quantity("damping", positive=True)]
Grip = Annotated[OneFunction, varying("number", local=("x", "y"))]
TwoForces = Annotated[TwoNumbers[PositiveForce], BeforeValidator(listed)]
TwoShares = Annotated[TwoNumbers[PositiveNumber], BeforeValidator(listed)]

ROCKS = 1e-3  # [m/s] of rolling, below which a tyre rocks to and fro on the same tread, which relaxes nothing further
STICKS, SLIDES, SLOW = (
    0.7,
    0.95,
    0.1,
)  # shares of the sliding force, and a speed [m/s], between which a bristle is elastic and slides
ROLLING = 0.01  # force by load
ROLLED, ROLL_TIME = 0.01, 0.05  # [m] of rolling that stretch the rolling resistance, and d/c of it [s]
LEAST_GRIP = 1e-3
MOST_LOAD, LEAST_LOAD = 3.0, 1e-6  # of the nominal load: curves end there, and a tyre with less has left the ground
SKEW = 0.2  # sine of the angle between axle and joint beyond which one of them is taken for a slip
NEAR = 0.1  # of the radius, from the middle of the patch to where heights are taken before and behind it
# The place of the patch on heights: most places to each side that are looked at, share of the radius by which two may differ in distance
# so that both are; steps to the nearest, of which the first are by Newton's method, and the share of the radius at which they end
MOST_PLACES, TIED, TOUCHES, STRAIGHT, SETTLED = 200, 0.02, 40, 12, 1e-6
FLAT = 0.1  # cosine of camber of a wheel that lies rather than rolls
# A guess by the nominal load P: the passenger-car tyre of Rill 2012, 3.5, at P and 2 P; forces by P, its carcass by the vertical stiffness
ALONG = {
    "slope": (30.0, 50.0),
    "peak_slip": (0.11, 0.12),
    "peak": (1.1, 2.175),
    "sliding_slip": (0.5, 0.8),
    "sliding": (1.0625, 1.9),
}
ACROSS = {
    "slope": (13.75, 20.0),
    "peak_slip": (0.2, 0.22),
    "peak": (1.05, 1.875),
    "sliding_slip": (0.8, 1.0),
    "sliding": (1.0375, 1.85),
}
DEFLECTION = 1 / 15  # of the radius, under the nominal load
DAMPING_TIME, CARCASS_TIME = 2e-3, 4e-3  # d/c [s]
SOFTER = {"along": 0.85, "across": 0.65}  # stiffness of the carcass by the vertical one


class SlipCurve(Checked):
    """Force over slip of one direction at the nominal load and at twice that, and the carcass in this direction."""

    slope: Maybe[TwoForces] = Field("of force over slip at zero slip", default=None, absent="guessed")
    peak: Maybe[TwoForces] = Field("largest force", default=None, absent="guessed")
    peak_slip: Maybe[TwoShares] = Field("slip of the largest force", default=None, absent="guessed")
    sliding: Maybe[TwoForces] = Field("force where all of the patch slides", default=None, absent="guessed")
    sliding_slip: Maybe[TwoShares] = Field("slip from which on all slides", default=None, absent="guessed")
    stiffness: Maybe[PositiveStiffness] = Field("of the carcass", default=None, absent="guessed")
    damping: Maybe[PositiveDamping] = Field("of the carcass", default=None, absent="4 ms · stiffness")

    def problems(self) -> Iterator[Problem]:
        for name in ALONG:
            pair = getattr(self, name)
            most = 4.0 if name in ("slope", "peak", "sliding") else 2.0
            least = 1.0 if most == 4.0 else 0.5
            if pair is not None and not least * pair[0] < pair[1] < most * pair[0]:
                message = f"at twice the load {least:g} to {most:g} times as much was expected, got {pair[0]:g} and {pair[1]:g}"
                yield Problem((name,), message)

    def numbers(self, load: float, guess: dict[str, tuple[float, float]]) -> dict[str, tuple[float, float]]:
        """The pairs of `guess` at a nominal load [N], and in their place what is given."""
        made = {name: tuple(v if "slip" in name else v * load for v in pair) for name, pair in guess.items()}
        given = {name: tuple(pair) for name in guess if (pair := getattr(self, name)) is not None}
        return {**made, **given}  # type: ignore[dict-item]

    def problems_with(self, load: float, guess: dict[str, tuple[float, float]]) -> Iterator[Problem]:
        """What is wrong between its numbers and guessed ones."""
        its = self.numbers(load, guess)
        for k in (0, 1):
            least = 2.0 * its["peak"][k] / its["peak_slip"][k]
            if its["slope"][k] < least * (1.0 - 1e-9):
                told = f"no curve with this `slope` has its `peak` at `peak_slip`: at least {least:.6g} N was expected"
                yield Problem(("slope",), f"{told}, got {its['slope'][k]:.6g} N")
            if its["sliding"][k] > its["peak"][k]:
                yield Problem(
                    ("sliding",), f"`sliding` {its['sliding'][k]:g} N is more than the `peak` {its['peak'][k]:g} N"
                )
            if its["sliding_slip"][k] <= its["peak_slip"][k]:
                told = f"`sliding_slip` {its['sliding_slip'][k]:g} must be greater than `peak_slip` {its['peak_slip'][k]:g}"
                yield Problem(("sliding_slip",), told)


class Tyre(ForceElement):
    """A tyre on the plane of a marker. What is not given of it is guessed from `radius`, `width` and `nominal_load`."""

    outputs: ClassVar[tuple[str, ...]] = (
        *of_force("load across the plane"),
        Output("longitudinal", "N", "force on the wheel in the direction in which it points"),
        Output("lateral", "N", "force on the wheel to the side to which its marker's z axis points"),
        Output("moment", "N m", "moment on the wheel about the normal of the plane"),
        Output("rolling_moment", "N m", "moment on the wheel about its axle beside that of the longitudinal force"),
        Output("slip", "1", "(r Ω - v) / max(|v|, r |Ω|)"),
        Output("slip_angle", "rad", "angle from where the wheel points to where it moves"),
        Output("camber", "rad", "angle of the axle above the plane"),
        Output("deflection", "m", "vertical deflection"),
        Output("slip_loss", "W", "power lost in patch and carcass"),
        Output("place_x", "m", "place of the patch along the x axis of the plane's marker"),
        Output("place_y", "m", "place of the patch along its y axis"),
        Output("overturning_moment", "N*m", "about the direction in which it points"),
    )
    turns: ClassVar[bool] = True
    inequalities: ClassVar[Inequalities] = (
        Acts(
            ("is off the ground", "touches the ground"),
            "radius",
            lambda own, of: of["deflection"],
            lambda own, of: of["magnitude"],
        ),
    )

    type: Literal["tyre"] = "tyre"
    wheel: MarkerPlace = Field("marker on the wheel: its point is the centre, its z axis the axle")
    plane: MarkerPlace = Field("marker: its point lies in the plane, its z axis points out of it")
    heights: Maybe[OneRecord[HeightField]] = Field(
        "of ground that is not flat, along the z axis of the `plane` over its x and y axes", default=None
    )
    file: str | None = Field(
        "`.tir` file of a Magic Formula, relative to the machine file: sizes, stiffness and curves that are not given here",
        default=None,
    )
    side: Literal["left", "right"] | None = Field(
        "of the vehicle on which it is: on the other one than that of the `file` it is in the mirror; default: as the file",
        default=None,
    )
    pressure: Maybe[Pressure] = Field("of inflation", default=None, absent="that of the `file`")
    magic: Maybe[OneRecord[MagicFormula]] = Field("the numbers of the `file`", default=None)
    radius: PositiveLength = Field("of the tyre without load")
    width: PositiveLength = Field("of the patch")
    nominal_load: PositiveForce = Field("to which the first numbers of the curves belong")
    stiffness: Maybe[PositiveStiffness] = Field("vertical one", default=None, absent="15 · nominal_load / radius")
    damping: Maybe[PositiveDamping] = Field("vertical one", default=None, absent="2 ms · stiffness")
    along: OneRecord[SlipCurve] = Field("curve of the longitudinal force, and carcass", default=SlipCurve())
    across: OneRecord[SlipCurve] = Field("curve of the lateral force, and carcass", default=SlipCurve())
    trail: TwoShares = Field("of the lateral force at zero slip, by the length of the patch", default=(0.178, 0.19))
    trail_zero: TwoShares = Field("lateral slip at which the trail is zero", default=(0.2, 0.22))
    trail_end: TwoShares = Field("lateral slip from which on it is zero again", default=(0.35, 0.4))
    grip: Grip = Field(
        "factor of peak and sliding forces and of their slips; a function, of the place `x`, `y` too", default=1.0
    )
    rolling_resistance: NotNegativeNumber = Field("force by load", default=ROLLING)
    rolling_share: NotNegativeNumber = Field(
        "of the deflection that the rolling radius does not follow, at the nominal load", default=0.375
    )

    @property
    def vertical_stiffness(self) -> float:
        """[N/m], given or guessed."""
        return self.nominal_load / (DEFLECTION * self.radius) if self.stiffness is None else self.stiffness

    @property
    def source(self) -> str:
        """Where its numbers are from."""
        if self.magic is not None:
            mirrored = "" if self.side in (None, self.magic.side) else " in the mirror"
            unused = f"; not used: {', '.join(self.magic.unused)}" if self.magic.unused else ""
            return f"Magic Formula {self.magic.version} of {self.file or 'its coefficients'}{mirrored}{unused}"
        guessed = ["stiffness"] if self.stiffness is None else []
        for name in ("along", "across"):
            missing = [key for key in ALONG if getattr(getattr(self, name), key) is None]
            guessed += [name] if len(missing) == len(ALONG) else [f"{name}.{key}" for key in missing]
        return f"guessed by radius and nominal load: {', '.join(guessed)}" if guessed else "all numbers given"

    def remarks(self, machine: MachineRecord) -> Iterator[tuple[str, str]]:
        marker = machine.marker_named[self.wheel] if isinstance(self.wheel, str) else self.wheel
        if marker.body not in machine.placed:
            return
        (place, rotation), (own, frame) = machine.placed[marker.body], marker_frame(marker)
        axle, centre = rotation @ frame[:, 2], place + rotation @ own
        for joint in machine.joints:
            if joint.type != "revolute" or joint.axis is None or marker.body not in (joint.bodies or ()):
                continue
            axis = np.array(joint.axis) / np.linalg.norm(joint.axis)
            if (
                joint.point is None
                or np.linalg.norm(np.cross(centre - np.array(joint.point), axis)) > SKEW * self.radius
            ):
                continue  # it turns about something else
            if np.linalg.norm(np.cross(axis, axle)) > SKEW:
                text = f"the z axis of the marker is not along the axis of the joint `{joint.name}`, about which `{marker.body}` turns"
                yield (
                    "wheel",
                    f"{text}; z is the axle: a body whose shape goes `from` one point `to` another has its x axis along them",
                )

    def problems(self) -> Iterator[Problem]:
        if self.magic is None and self.file is not None:
            yield Problem(("file",), f"the file `{self.file}` was not read; in Python give `magic`")
        for name in ("side", "pressure"):
            if self.magic is None and getattr(self, name) is not None:
                yield superfluous(name, "belongs to the `file` of a Magic Formula, and none is given")
        if self.magic is not None and self.pressure is not None and not self.magic.nominal_pressure:
            yield superfluous("pressure", "has no effect by this `file`: version 6.1 and `NOMPRES` were expected")
        if self.magic is not None and self.rolling_resistance != ROLLING:
            yield superfluous("rolling_resistance", "is that of the `file`")
        for name in ("along", "across"):
            given = [key for key in ALONG if getattr(getattr(self, name), key) is not None]
            if self.magic is not None and given:
                message = f"the curve of the `file` stands in place of {', '.join(f'`{key}`' for key in given)}"
                yield Problem((name,), message)
        if isinstance(self.grip, int | float) and self.grip < LEAST_GRIP:
            yield Problem(("grip",), f"a number of {LEAST_GRIP:g} or more was expected, got {self.grip:g}")
        for name, guess in (("along", ALONG), ("across", ACROSS)):
            for each in getattr(self, name).problems_with(self.nominal_load, guess):
                yield Problem((name, *each.place), each.message)
        for name in ("trail", "trail_zero", "trail_end"):
            first, second = getattr(self, name)
            if not 0.5 < second / first < 2.0:
                yield Problem(
                    (name,), f"at twice the load 0.5 to 2 times as much was expected, got {first:g} and {second:g}"
                )
        for k in (0, 1):
            if self.trail_end[k] <= self.trail_zero[k]:
                told = f"`trail_end` {self.trail_end[k]:g} must be greater than `trail_zero` {self.trail_zero[k]:g}"
                yield Problem(("trail_end",), told)


class TyreRow(Row):
    """Markers WHEEL and PLANE, states of four stretches; vertical, carcass and curves: slope, peak slip, peak, sliding slip, sliding.

    FRICTION : the function of the grip, whose value is in GRIP. GROUND : by how many rows before this one stands the tyre with the HEIGHTS
    of the ground, or NONE where it is flat.
    """

    output: int
    wheel: int
    plane: int
    ground: int = NONE
    friction: int
    stretch: Sequence[int] = several(4)
    radius: float
    width: float
    load: float
    c: float
    d: float
    cx: float
    dx: float
    cy: float
    dy: float
    grip: float = 1.0
    rolling: float
    rolling_share: float
    along: Sequence[float] = several(10)
    across: Sequence[float] = several(10)
    trail: Sequence[float] = several(6)
    is_magic: float = 0.0
    magic: Sequence[float] = several(Magic.row_length, default=(0.0,) * Magic.row_length)
    heights: Sequence[float] = several(default=())


@leaf
def between(n, k, q):
    """A number at q times the nominal load, linearly between two."""
    return n[k] + (n[k + 1] - n[k]) * (q - 1.0)


@leaf
def force_at(n, k, q):
    """A force at q times the nominal load: the parabola through zero and two."""
    return q * (2.0 * n[k] - 0.5 * n[k + 1] + (0.5 * n[k + 1] - n[k]) * q)


@leaf
def curve_at(n, k, q, grip):
    """(slope, s_M, F_M, s_S, F_S)."""
    s_m, f_m = grip * between(n, k + 2, q), grip * force_at(n, k + 4, q)
    # of little load, the parabola of the sliding force may pass that of the peak
    return force_at(n, k, q), s_m, f_m, grip * between(n, k + 6, q), minimum(grip * force_at(n, k + 8, q), f_m)


@leaf
def over_slip(s, curve):
    """F(s)/s of one direction."""
    slope, s_m, f_m, s_s, f_s = curve
    slope = maximum(slope, 2.0 * f_m / s_m)
    if real(s) < real(s_m):
        n = s / s_m
        return slope / (1.0 + n * (n + slope * s_m / f_m - 2.0))
    if real(s) >= real(s_s):
        return f_s / s
    bend = (f_m / s_m) ** 2 / (slope * s_m)
    joint = s_m + (f_m - f_s) / (bend * (s_s - s_m))
    if real(joint) > real(s_s):
        n = (s - s_m) / (s_s - s_m)
        return (f_m - (f_m - f_s) * n * n * (3.0 - 2.0 * n)) / s
    if real(s) <= real(joint):
        return (f_m - bend * (s - s_m) ** 2) / s
    return (f_s + bend * (joint - s_m) / (s_s - joint) * (s_s - s) ** 2) / s


@leaf
def smooth(x):
    """From 0 at 0 to 1 at 1 without corners."""
    return x * x * (3.0 - 2.0 * x)


@leaf
def fluidity(v_t, weighted, speed, curve):
    """A of one direction. weighted : s_M times the sliding speeds by their s_M; speed : the same without weights."""
    if real(weighted) >= real(curve[3] * v_t):
        return speed / curve[4]
    s = weighted / v_t
    fluid = v_t / over_slip(s, curve)
    if real(s) > real(curve[1]):
        fluid *= 1.0 + smooth((s - curve[1]) / (curve[3] - curve[1])) * (speed / weighted - 1.0)
    return fluid


@leaf
def sliding_share(share, unloads, speed):
    """Of the sliding part of A, of a bristle under a share of its sliding force."""
    slides = 1.0 + 0.0 * share
    if unloads or real(share) < STICKS:
        slides = 0.0 * share
    elif real(share) < SLIDES:
        slides = smooth((share - STICKS) / (SLIDES - STICKS))
    if real(speed) >= SLOW:
        return 1.0 + 0.0 * share
    return maximum(slides, smooth(2.0 * speed / SLOW - 1.0)) if real(speed) > 0.5 * SLOW else slides


@leaf
def root(x):
    """√x, without a slope at zero."""
    return np.sqrt(x) if real(x) > 0.0 else 0.0 * x


@leaf
def fluidities(n, q, v_t, v, z):
    """(A_x, A_y = A of the bore) of TMeasy. v, z : sliding velocities and stretches along, across and of the bore."""
    x, y = curve_at(n, TyreRow.ALONG, q, n[TyreRow.GRIP]), curve_at(n, TyreRow.ACROSS, q, n[TyreRow.GRIP])
    across = v[1] * v[1] + v[2] * v[2]
    speed = root(v[0] * v[0] + across)
    weighted = root((v[0] / x[1]) ** 2 + across / (y[1] * y[1]))
    a, b = fluidity(v_t, x[1] * weighted, speed, x), fluidity(v_t, y[1] * weighted, speed, y)
    a, b, _ = held(n, v_t, v, z, (x[0], x[2], x[4]), (y[0], y[2], y[4]), a, b, b)
    return a, b


@leaf
def held(n, v_t, v, z, x, y, a, b, bore):
    """(A_x, A_y, A of the bore) of a bristle, which may be below its sliding force or beyond the peak. x, y : slope, peak, sliding."""
    fx, fy, fb = n[TyreRow.CX] * z[0], n[TyreRow.CY] * z[1], n[TyreRow.CY] * z[2]
    across = fy * fy + fb * fb
    speed = root(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
    if real(speed) < SLOW:
        share = root((fx / x[2]) ** 2 + across / (y[2] * y[2]))
        slides = sliding_share(share, real(v[0] * fx + v[1] * fy + v[2] * fb) > 0.0, speed)
        a, b = v_t / x[0] + (a - v_t / x[0]) * slides, v_t / y[0] + (b - v_t / y[0]) * slides
        bore = v_t / y[0] + (bore - v_t / y[0]) * slides
    over = (fx / x[1]) ** 2 + across / (y[1] * y[1])
    if real(over) > 1.0:
        over = np.sqrt(over) - 1.0
        a, b, bore = a + over / n[TyreRow.DX], b + over / n[TyreRow.DY], bore + over / n[TyreRow.DY]
    return a, b, bore


@leaf
def magic_fluidities(n, load, v_t, v_x, v, z, forward, tilt):
    """((A_x, A_y, A of the bore), (F₀ along, across), (F_y that is not on the trail, trail, M_zr)) of a Magic Formula.

    v_t, v, z : as of `fluidities`; v_x : speed of the contact point along x, by which slips are; forward : 1 or -1, the sense of it.
    """
    p = n[TyreRow.MAGIC : TyreRow.MAGIC + Magic.row_length]
    speed = root(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
    scale = maximum(v_x, speed / MOST_SLIP)
    kappa, tangent, side = 0.0 * speed, 0.0 * speed, p[Magic.SIGN] * forward
    if real(scale) > 0.0:
        kappa, tangent = -forward * v[0] / scale, side * v[1] / scale
    along, across, moments = magic(p, load, kappa, tangent, side * tilt, n[TyreRow.GRIP])
    a, b = scale / along[4], scale / across[4]
    bore = v_t / across[1] + absolute(v[2]) / across[3]
    f0, g0 = forward * (along[0] - along[4] * kappa), side * (across[0] + across[4] * tangent)
    x, y = (along[1], along[3], along[2]), (across[1], across[3], across[2])
    return held(n, v_t, v, z, x, y, a, b, bore), (f0, g0), moments


@leaf
def magic_moments(n, load, moments, fx, fy, forward, tilt, speed):
    """(M_z, M_x, -M_y) of a Magic Formula, of forces in the sense in which the wheel rolls."""
    p = n[TyreRow.MAGIC : TyreRow.MAGIC + Magic.row_length]
    sign = p[Magic.SIGN]
    fy, tilt = sign * fy, sign * forward * tilt
    about = moments[2] - moments[1] * (fy - moments[0]) + lever(p, load, fy, tilt) * fx
    return sign * about, sign * forward * overturning(p, load, fy, tilt), resistance(p, load, fx, speed, tilt)


@leaf
def rocked(v):
    """Speed of the tread with which stretches relax."""
    return absolute(v) if np.abs(real(v)) >= ROCKS else v * v / ROCKS


@leaf
def stretch_rate(v, a, c, d, z):
    """ż of a carcass."""
    return -(v + a * c * z) / (1.0 + a * d)


@leaf
def trail_at(n, q, slip):
    """Trail by the length of the patch (Rill 2012, 3.6)."""
    n0, zero = between(n, TyreRow.TRAIL, q), n[TyreRow.GRIP] * between(n, TyreRow.TRAIL + 2, q)
    end = n[TyreRow.GRIP] * between(n, TyreRow.TRAIL + 4, q)
    if real(slip) >= real(end):
        return 0.0 * slip
    w = zero / end
    if real(slip) <= real(zero):
        s = slip / zero
        return n0 * ((1.0 - w) * (1.0 - s) + w * (1.0 - smooth(s)))
    s = (end - slip) / (end - zero)
    return -n0 * (1.0 - w) * (slip - zero) / zero * s * s


@leaf
def rolling(n, most, roll, v_t, z):
    """(F, ż, loss) of a rolling resistance, which stands still at rest. most : its force; roll : r Ω."""
    c = n[TyreRow.ROLLING] * n[TyreRow.LOAD] / ROLLED
    d = ROLL_TIME * c
    if real(c) == 0.0 or real(most) <= 0.0:
        return 0.0 * roll, -z / ROLL_TIME, 0.0 * roll
    share = absolute(c * z) / most
    a = v_t / most * sliding_share(share, real(roll * z) > 0.0, v_t)
    if real(share) > 1.0:
        a += (share - 1.0) / d
    u = stretch_rate(roll, a, c, d, z)
    force = c * z + d * u
    return force, u, d * u * u + a * force * force


@leaf
def mean_ground(heights, x, y, e0, e1, radius, width):
    """(h, slopes u along (e1, -e0) and v along (e0, e1), second derivatives uu, uv, vv) of the ground as a patch at (x, y) feels it.

    Its axle is along (e0, e1). Means of four places: NEAR of the radius before and behind, and half of the width on either side.
    """
    o = 0.0 * x
    h, u, v, uu, uv, vv = o, o, o, o, o, o
    for k in range(4):
        before = NEAR * radius * (1.0 - k) if k in (0, 2) else 0.0
        beside = 0.5 * width * (2.0 - k) if k in (1, 3) else 0.0
        z, zx, zy, xx, xy, yy = surface(heights, x + before * e1 + beside * e0, y - before * e0 + beside * e1)
        h, u, v = h + 0.25 * z, u + 0.25 * (zx * e1 - zy * e0), v + 0.25 * (zx * e0 + zy * e1)
        uu += 0.25 * (xx * e1 * e1 - 2.0 * xy * e1 * e0 + yy * e0 * e0)
        uv += 0.25 * ((xx - yy) * e0 * e1 + xy * (e1 * e1 - e0 * e0))
        vv += 0.25 * (xx * e0 * e0 + 2.0 * xy * e0 * e1 + yy * e1 * e1)
    return h, u, v, uu, uv, vv


@leaf
def way_along(ground, m, upright, lean):
    """(m', half of (s² + m²)'', v') where the mean ground is m below the centre of a disc, by the offset s along it; 0 counts for m < 0."""
    _, u, v, uu, uv, vv = ground
    over = upright + lean * v
    rise = -u / over
    bends, leans = uu + rise * lean * uv, uv + rise * lean * vv
    return rise, 1.0 + rise * rise - maximum(m, 0.0 * m) * (bends + rise * lean * leans) / over, leans


@leaf
def mean_height(heights, x, y, e0, e1, radius, width):
    """h of `mean_ground` alone, of real numbers."""
    p, q, u, v = NEAR * radius * e1, NEAR * radius * e0, 0.5 * width * e0, 0.5 * width * e1
    h = height(heights, x + p, y - q) + height(heights, x - p, y + q)
    return 0.25 * (h + height(heights, x + u, y + v) + height(heights, x - u, y - v))


@leaf
def offsets_to_try(heights, x, y, top, upright, e0, e1, radius, width):
    """Two offsets along (e1, -e0) near which the mean ground may be nearest to the centre of a disc, `top` above zero, and how near [m].

    They are looked for at every half of a mesh, as far as the highest ground beside may be nearer than that below. Where none bends as
    much as the disc, there is one. Of real numbers.
    """
    mesh = mesh_of(heights)
    if real(heights[BEND]) * radius < mesh * mesh:
        return 0.0, 0.0, radius
    below = max((top - mean_height(heights, x, y, e0, e1, radius, width)) / upright, 0.0)
    highest = max((top - real(heights[HIGHEST])) / upright, 0.0)
    reach = min(np.sqrt(max(below * below - highest * highest, 0.0)), radius)
    around = reach + NEAR * radius, 0.5 * width
    p, q = around[0] * np.abs(e1) + around[1] * np.abs(e0), around[0] * np.abs(e0) + around[1] * np.abs(e1)
    highest, bend = look_at_heights(heights, x - p, x + p, y - q, y + q)
    if bend * radius < mesh * mesh:
        return 0.0, 0.0, around[0]
    highest = max((top - highest) / upright, 0.0)
    reach = min(np.sqrt(max(below * below - highest * highest, 0.0)), reach)
    count = np.int64(min(np.ceil(reach / min(0.5 * mesh, NEAR * radius)), MOST_PLACES)) + 1
    step = reach / count
    first, second, least, next_least = 0.0, 0.0, np.inf, np.inf
    before, middle = np.inf, np.inf
    for k in range(-count, count + 2):
        s, squared = k * step, np.inf
        if k <= count:
            h = mean_height(heights, x + s * e1, y - s * e0, e0, e1, radius, width)
            squared = s * s + max((top - h) / upright, 0.0) ** 2
        if middle < before and middle <= squared:
            if middle < least:
                first, second, least, next_least = s - step, first, middle, least
            elif middle < next_least:
                second, next_least = s - step, middle
        before, middle = middle, squared
    return first, second if next_least < (np.sqrt(least) + TIED * radius) ** 2 else first, step


@leaf
def nearest_place(heights, c, e0, e1, upright, lean, s, reach, radius, width):
    """(distance, s, m) where the mean ground is nearest to the centre c of a disc within `reach` of the offset s, of real numbers.

    The place is c + s (e1, -e0, 0) - m (upward in the disc); where ground beside c is higher, m counts as zero. By Newton's method, and
    halvings where that leaves the bounds.
    """
    low, high, m = s - reach, s + reach, 0.0
    for k in range(TOUCHES):
        x, y = c[0] + s * e1 + m * lean * e0, c[1] - s * e0 + m * lean * e1
        ground = mean_ground(heights, x, y, e0, e1, radius, width)
        m += (c[2] - m * upright - ground[0]) / (upright + lean * ground[2])
        rise, curve, _ = way_along(ground, m, upright, lean)
        slope = s + max(m, 0.0) * rise
        if slope > 0.0:
            high = s
        else:
            low = s
        to = s - slope / curve if curve > 0.0 else low - 1.0
        if not low <= to <= high or k >= STRAIGHT:
            to = 0.5 * (low + high)
        m += rise * (to - s)
        settled = np.abs(to - s) < SETTLED * radius
        s = to
        if settled:
            break
    return np.sqrt(s * s + max(m, 0.0) ** 2), s, m


@leaf
def plane_under(heights, A, r, centre, y, radius, width):
    """(normal, point) of the plane in which a tyre stands on ground with heights, whose marker has the axes A and the point r.

    The plane is that through the place of the mean ground which is nearest to the centre of the disc, across the line between both. The
    distance grows along this line as the centre moves, wherever the place is, so that energy is kept: over edges and in ditches too.
    """
    c, o = seen(A, minus(centre, r)), seen(A, y)
    level = root(o[0] * o[0] + o[1] * o[1])
    e0, e1 = (o[0] / level, o[1] / level) if real(level) > 0.0 else (o[0], o[1])
    upright, lean = maximum(level, FLAT + 0.0 * level), o[2]
    known = real(c[0]), real(c[1]), real(c[2])
    f0, f1, up, by = real(e0), real(e1), real(upright), real(lean)
    size, broad = real(radius), real(width)
    m = (known[2] - height(heights, known[0], known[1])) / up
    first, second, reach = offsets_to_try(
        heights, known[0] + m * by * f0, known[1] + m * by * f1, known[2], up, f0, f1, size, broad
    )
    least, s, m = nearest_place(heights, known, f0, f1, up, by, first, reach, size, broad)
    if second != first:
        other, beside, below = nearest_place(heights, known, f0, f1, up, by, second, reach, size, broad)
        if other < least:
            s, m = beside, below
    # one step more carries the slopes
    q, d = s + 0.0 * c[0], m + 0.0 * c[0]
    x, y = c[0] + q * e1 + d * lean * e0, c[1] - q * e0 + d * lean * e1
    h, u, v, uu, uv, vv = mean_ground(heights, x, y, e0, e1, radius, width)
    change = (c[2] - d * upright - h) / (upright + lean * v)
    d, u, v = d + change, u + change * lean * uv, v + change * lean * vv
    rise, curve, leans = way_along((h, u, v, uu, uv, vv), d, upright, lean)
    slope = q + maximum(d, 0.0 * d) * rise
    if np.abs(real(slope)) < NEAR * NEAR * size * real(curve):
        move = -slope / curve
        q, d, v = q + move, d + rise * move, v + leans * move
    drop = maximum(d, 0.0 * d)
    distance = root(q * q + drop * drop)
    if real(distance) > 0.0:
        before, upward = -q / distance, drop / distance
    else:
        distance, before, upward = d, 0.0 * d, 1.0 + 0.0 * d
    w = before * e1 - upward * lean * e0, -before * e0 - upward * lean * e1, upward * level
    tau = upward * (lean - level * v) / (upright + lean * v)
    n = times(1.0 / np.sqrt(1.0 + tau * tau), plus(w, times(tau, o)))
    return turned(A, n), plus(r, turned(A, minus(c, times(distance, w))))


@element
def apply(machine, k, index, n, t):
    """Forces of a tyre, on wheel and plane, and rates of its stretches."""
    record = record_at(machine)
    elements, markers, bodies, control = record.elements, record.markers, record.bodies, record.control
    i, j, first, own = index[TyreRow.WHEEL], index[TyreRow.PLANE], index[TyreRow.OUTPUT], index[TyreRow.STRETCH :]
    wheel, road = markers.body[i], markers.body[j]
    normal, y, centre = axis(markers.A[j], 2), axis(markers.A[i], 2), markers.r[i]
    ground = markers.r[j, 0], markers.r[j, 1], markers.r[j, 2]
    if index[TyreRow.GROUND] != NONE:
        heights = elements.number[k - index[TyreRow.GROUND], TyreRow.HEIGHTS :]
        normal, ground = plane_under(heights, markers.A[j], ground, centre, y, n[TyreRow.RADIUS], n[TyreRow.WIDTH])
    cx, dx, cy, dy = n[TyreRow.CX], n[TyreRow.DX], n[TyreRow.CY], n[TyreRow.DY]
    rate = elements.state_rate
    z, rolled = (elements.state[own[0]], elements.state[own[1]], elements.state[own[2]]), elements.state[own[3]]
    out = record.outputs.value[first : first + 14]
    # from the centre to the patch d, across the axle in the plane of the axle and the normal; x, a: along and across in the plane
    tilt = dot(normal, y)
    upright = np.sqrt(maximum(1.0 - tilt * tilt, FLAT * FLAT + 0.0 * tilt))
    loaded = dot(normal, minus(centre, ground)) / upright
    deflection = n[TyreRow.RADIUS] - loaded
    x = cross(y, normal)
    x = x[0] / upright, x[1] / upright, x[2] / upright
    a = cross(normal, x)
    d = times(-loaded / upright, minus(normal, times(tilt, y)))
    p = plus(centre, d)
    w, over = bodies.omega[wheel], bodies.omega[road]
    below = plus(markers.rdot[j], cross(over, minus(p, markers.r[j])))
    s = minus(plus(markers.rdot[i], cross(w, d)), below)
    w = minus(w, over)
    spin, bore, sinking = dot(w, y), dot(w, normal), -dot(s, normal) / upright
    elements.depth[k, 0] = deflection
    if record.watched.followed[0] == 1:
        elements.depth_rate[k, 0] = sinking
    elastic = n[TyreRow.C] * deflection
    load = maximum((elastic + n[TyreRow.D] * sinking) / upright, 0.0 * tilt)
    control.stored[0] += 0.5 * (cx * z[0] * z[0] + cy * (z[1] * z[1] + z[2] * z[2]))
    control.stored[0] += 0.5 * n[TyreRow.ROLLING] * n[TyreRow.LOAD] / ROLLED * rolled * rolled
    if real(deflection) > 0.0:
        control.stored[0] += 0.5 * elastic * deflection
        control.power[1] += (load * upright - elastic) * sinking
    q = load / n[TyreRow.LOAD]
    for m in range(14):
        out[m] = 0.0 * tilt
    out[11], out[12], _ = seen(markers.A[j], minus(p, markers.r[j]))
    n[TyreRow.GRIP] = maximum(evaluate_function(machine, index[TyreRow.FRICTION], t), LEAST_GRIP + 0.0 * tilt)
    if real(deflection) <= 0.0 or real(q) < LEAST_LOAD or real(tilt * tilt) > 1.0 - FLAT * FLAT:
        rate[own[0]] -= cx / dx * z[0]
        rate[own[1]] -= cy / dy * z[1]
        rate[own[2]] -= cy / dy * z[2]
        rate[own[3]] -= rolled / ROLL_TIME
        loss = cx / dx * cx * z[0] * z[0] + cy / dy * cy * (z[1] * z[1] + z[2] * z[2])
        loss += n[TyreRow.ROLLING] * n[TyreRow.LOAD] / ROLLED / ROLL_TIME * rolled * rolled
        control.power[1] += loss
        out[9], out[10] = deflection, loss
        return
    q = minimum(q, MOST_LOAD + 0.0 * q)
    stays = n[TyreRow.ROLLING_SHARE] * minimum(q, 2.0 + 0.0 * q)
    r = n[TyreRow.RADIUS] - (1.0 - stays) * deflection
    roll = r * spin
    v_t = rocked(roll)
    length = 2.0 * np.sqrt(n[TyreRow.RADIUS] * deflection)
    patch = (length + n[TyreRow.WIDTH]) / 6.0
    along, across = dot(s, x), dot(s, a)
    moved = along + loaded * spin  # of the contact point without its spin
    slide = along + (loaded - r) * spin
    most, beside, about, turning = n[TyreRow.ROLLING] * load, 0.0 * load, 0.0 * load, 0.0 * load
    bearing, forward, moments = q * n[TyreRow.LOAD], 1.0 if real(moved) >= 0.0 else -1.0, (most, most, most)
    if n[TyreRow.IS_MAGIC] == 1.0:
        trail, lean, turning = 0.0 * load, 0.0 * load, tilt
        v = slide, across, patch * (bore - turning * spin)
        fluid, (f0, g0), moments = magic_fluidities(n, bearing, v_t, absolute(moved), v, z, forward, tilt)
    else:
        lean = length / 6.0 * tilt
        slow = np.sqrt(v_t * v_t + SLOW * SLOW)
        trail = length * trail_at(n, q, absolute(across + lean * spin) / slow) * roll / slow
        v = slide, across - trail * bore + lean * spin, patch * bore
        a_x, a_y = fluidities(n, q, v_t, v, z)
        fluid, f0, g0 = (a_x, a_y, a_y), 0.0 * load, 0.0 * load
    u0 = stretch_rate(v[0] - fluid[0] * f0, fluid[0], cx, dx, z[0])
    u1 = stretch_rate(v[1] - fluid[1] * g0, fluid[1], cy, dy, z[1])
    u2 = stretch_rate(v[2], fluid[2], cy, dy, z[2])
    fx, fy, fb = cx * z[0] + dx * u0, cy * z[1] + dy * u1, cy * z[2] + dy * u2
    if n[TyreRow.IS_MAGIC] == 1.0:
        about, beside, moment = magic_moments(n, bearing, moments, forward * fx, forward * fy, forward, tilt, moved)
        about, most = about * v_t / np.sqrt(v_t * v_t + SLOW * SLOW), moment / r
    fr, u3, loss = rolling(n, most, roll, v_t, rolled)
    rate[own[0]] += u0
    rate[own[1]] += u1
    rate[own[2]] += u2
    rate[own[3]] += u3
    loss += dx * u0 * u0 + dy * (u1 * u1 + u2 * u2) - about * bore - beside * dot(w, x)
    loss += fluid[0] * fx * (fx - f0) + fluid[1] * fy * (fy - g0) + fluid[2] * fb * fb
    control.power[1] += loss
    moment = patch * fb - trail * fy + about
    axial = r * fr + (loaded - r) * fx + lean * fy - patch * fb * turning
    force = plus(plus(times(fx, x), times(fy, a)), times(load, normal))
    torque = plus(plus(times(moment, normal), times(axial, y)), times(beside, x))
    power = add_force_at(bodies, wheel, p, force) + add_torque(bodies, wheel, torque)
    power += add_force_at(bodies, road, p, opposite(force)) + add_torque(bodies, road, opposite(torque))
    fastest = maximum(absolute(moved), v_t)
    out[0], out[1], out[2], out[3], out[4], out[5] = load, power, fx, fy, moment, axial
    if real(fastest) > 0.0:
        out[6] = (roll - moved) / fastest
    out[7], out[8], out[9], out[10] = arctan2(across, absolute(moved)), np.arcsin(tilt), deflection, loss
    out[13] = beside


def add_tyre(builder: SystemBuilder, force: Tyre) -> None:
    """A tyre, with four stretches."""
    wheel, plane = builder.ends((force.wheel, force.plane))
    vertical = force.vertical_stiffness
    curves, carcass = {}, {}
    for name, guess in (("along", ALONG), ("across", ACROSS)):
        own: SlipCurve = getattr(force, name)
        curves[name] = [each for pair in own.numbers(force.nominal_load, guess).values() for each in pair]
        c = SOFTER[name] * vertical if own.stiffness is None else own.stiffness
        carcass[name] = c, CARCASS_TIME * c if own.damping is None else own.damping
    words = (("along", "along the wheel"), ("across", "across it"), ("bore", "of its turn"), ("roll", "of its rolling"))
    facts = [
        StateFact(f"{force.name}.{word}", "m", f"stretch of {force.name} {text}", 0.0, 1e-3, follows=True)
        for word, text in words
    ]
    first = add_outputs(builder, force)
    formula = [0.0] * Magic.row_length
    if force.magic is not None:
        formula = magic_formula.numbers_of(force.magic, force.pressure, force.side)
        vertical *= 1.0 + formula[Magic.PRESSED]
    # tyres on the same heights share the numbers of the first one
    others = [each for each in builder.machine.forces if isinstance(each, Tyre)]
    ground, heights = NONE, []
    if force.heights is not None:
        ground = others.index(force) - next(k for k, each in enumerate(others) if each.heights == force.heights)
        heights = numbers_of(force.heights.heights, force.heights.size) if ground == 0 else []
    row = TyreRow(
        ground=ground,
        heights=heights,
        output=first,
        wheel=wheel,
        plane=plane,
        stretch=[builder.own_state(fact) for fact in facts],
        radius=force.radius,
        width=force.width,
        load=force.nominal_load,
        c=vertical,
        d=DAMPING_TIME * vertical if force.damping is None else force.damping,
        cx=carcass["along"][0],
        dx=carcass["along"][1],
        cy=carcass["across"][0],
        dy=carcass["across"][1],
        friction=builder.function(
            force.grip, {"x": (function.OUTPUT, first + 11, 0), "y": (function.OUTPUT, first + 12, 0)}
        ),
        rolling=max(formula[Magic.QSY] + formula[Magic.QSY + 2], 0.0) if force.magic else force.rolling_resistance,
        rolling_share=force.rolling_share,
        trail=[*force.trail, *force.trail_zero, *force.trail_end],
        is_magic=float(force.magic is not None),
        magic=formula,
        **curves,
    )
    builder.add(apply, row, 1, (0,))


KINDS = (Kind(Tyre, add_tyre, (apply,)),)
