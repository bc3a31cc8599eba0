"""Settings of the simulation of a machine and of its assembly."""

from collections import Counter
from collections.abc import Iterator, Mapping
from typing import Annotated, Any, ClassVar, Literal

from pydantic import ValidationInfo, field_validator

from nivel import methods
from nivel.machine.core.coefficient import NotNegative
from nivel.machine.core.record import Checked, Problem, Record
from nivel.machine.given import Field, Given, ManyNames, Maybe, OneRecord
from nivel.machine.units.quantity import Angle, Duration, PositiveLength, Rate, Real, Whole, fault
from nivel.machine.uses.coordinate_reference import CoordinateReference

Tolerance = Annotated[Real, Field(gt=0.0, lt=1.0)]


class RowFeedback(Record):
    """Feedback of the violations of some rows of constraints: C̈ + 2 α Ċ + β² C = 0."""

    alpha: Rate
    beta: Rate


class Baumgarte(Record):
    """Feedback of constraint violations: C̈ + 2 α Ċ + β² C = 0.

    Without `alpha` and `beta` they follow from the step. `rows` gives joints, couplings, drivers or single rows their own.
    """

    alpha: Maybe[Rate] = Field(default=None)
    beta: Maybe[Rate] = Field(default=None)
    rows: Given[dict[str, RowFeedback], Mapping[str, RowFeedback], Mapping[str, Any]] = Field(
        "joint, or row: its own `alpha` and `beta`", default={}
    )

    @property
    def is_whole(self) -> bool:
        """Whether it gives the coefficients of all rows."""
        return self.alpha is not None and self.beta is not None


class RowPenalty(Record):
    """Penalty of some rows of constraints; what is not given is that of all rows."""

    factor: Annotated[Real, Field(ge=1.0, le=1e14)] | None = None
    alpha: Annotated[Real, Field(gt=0.0)] | None = None
    omega: Maybe[Rate] = Field(default=None)
    mu: Annotated[Real, Field(ge=0.0)] | None = None


class Penalty(Record):
    """Penalty and augmented Lagrangian: λ = α (C̈ + 2 Ω μ Ċ + Ω² C).

    `alpha` is one number for all rows, in SI units; without it every row gets `factor` times the mass that it moves. Without `omega`,
    Ω = 0.1/step, or 0 where the stabilisation corrects states anyway. `rows` gives joints, couplings, drivers or single rows their own.
    The iteration of augmented-lagrangian ends where what it still changes is below `tolerance`, as a share of what the forces do.
    """

    factor: Annotated[Real, Field(ge=1.0, le=1e14)] | None = None
    alpha: Annotated[Real, Field(gt=0.0)] | None = None
    omega: Maybe[Rate] = Field(default=None)
    mu: Annotated[Real, Field(ge=0.0)] = 1.0
    iterations: Annotated[Whole, Field(ge=1, le=1000)] = 30
    tolerance: Tolerance = 1e-12
    rows: Given[dict[str, RowPenalty], Mapping[str, RowPenalty], Mapping[str, Any]] = Field(
        "joint, or row: its own `factor` or `alpha`, `omega` and `mu`", default={}
    )


class Corrector(Record):
    """How the equations of implicit methods are solved: iteration, its tolerance (relative to each coordinate) and limit.

    Without `iteration`, as suits the method: newton where it has exact tangents, functional otherwise.
    Methods that choose their steps iterate as exactly as the `tolerance` of the run asks for, four times at most.
    `matrix` says when newmark, hht and generalised-alpha make Newton's matrix anew: kept as long as it serves, or full, every iteration.
    """

    iteration: Literal["functional", "newton"] | None = None
    tolerance: Tolerance = 1e-10
    most_iterations: Annotated[Whole, Field(ge=1, le=1000)] = 50
    matrix: Literal["kept", "full"] = Field("of newmark, hht and generalised-alpha", default="kept")


class Newmark(Record):
    """Constants of newmark: order 2 and no damping with γ = ½, stable at any step with β ≥ γ/2."""

    beta: Annotated[Real, Field(gt=0.0, le=1.0)] = 0.25
    gamma: Annotated[Real, Field(ge=0.5, le=1.0)] = 0.5


class HHT(Record):
    """Damping of hht: 0 none (newmark), ⅓ most."""

    alpha: Annotated[Real, Field(ge=0.0, le=1.0 / 3.0)] = 0.1


class GeneralisedAlpha(Record):
    """Damping of generalised-alpha: what is left of a vibration far above the step's frequency after one step, 0 … 1."""

    spectral_radius: Annotated[Real, Field(ge=0.0, le=1.0)] | None = Field(
        "absent, 0.8 with fixed steps and 0.6 with chosen ones", default=None
    )


ENDLESS = ("duration",)  # settings of no use to a machine that is moved step by step
SHORTEST = 1e-12  # s; squares of speeds of a machine's length in such a time are still numbers


class SimulationSettings(Checked):
    """Time span, step and methods. Without `baumgarte`, the coefficients of that stabilisation follow from the step.

    Integrators that choose their steps try `step` first, and keep the motion within ten times the `tolerance` (relative to the largest
    value of each coordinate so far, or the size of the machine).
    """

    where_given: ClassVar[frozenset[str]] = frozenset({"integrator", "step", "tolerance"})

    duration: Duration = Field("simulated time, e.g. 8 or '8 s'", default=1.0)
    step: Duration = Field("time step, e.g. '1 ms'; first step of integrators that choose their steps", default=1e-3)
    output_interval: Maybe[Duration] = Field(
        "time between frames; with a fixed step a multiple of it", default=None, absent="up to 1000 intervals"
    )
    integrator: OneRecord[methods.Integrator] = Field("time integration method", default="rk4", absent="by the machine")
    formulation: methods.Formulation = Field("equations of motion", default="newton-euler")
    coordinates: methods.Coordinates = Field("coordinates of the equations", default="auto")
    rotations: methods.Rotations = Field("rotation coordinates of lagrange", default="euler-parameters")
    cut: ManyNames[str] = Field(
        "joints that close loops: they stay constraints in relative coordinates",
        default=(),
        option="--cut JOINTS",
        absent="chosen automatically",
    )
    independent: ManyNames[str] = Field(
        "velocities that independent coordinates keep as unknowns, e.g. crank.about_z",
        default=(),
        option="--independent NAMES",
        absent="chosen automatically",
    )
    stabilisation: methods.Stabilisation = Field("constraint stabilisation", default="direct")
    start: methods.Start = Field("initial state: as assembled, or the equilibrium at rest", default="as-given")
    free: ManyNames[CoordinateReference] = Field(
        "joint coordinates without stiffness that an equilibrium leaves where they are placed", default=()
    )
    step_control: methods.StepControl = Field(
        "steps fixed, or chosen by their error; own: as the integrator does", default="own"
    )
    tolerance: Tolerance = Field(
        "relative tolerance of the motion, of chosen steps; 1e-8 where no integrator is named", default=1e-6
    )
    largest_step: Maybe[Duration] = Field(
        "longest step of integrators that choose their steps", default=None, absent="the duration"
    )
    corrector: OneRecord[Corrector] = Field("iteration of implicit methods", default=Corrector())
    newmark: OneRecord[Newmark] = Field("constants of newmark", default=Newmark())
    hht: OneRecord[HHT] = Field("damping of hht", default=HHT())
    generalised_alpha: OneRecord[GeneralisedAlpha] = Field("damping of generalised-alpha", default=GeneralisedAlpha())
    penalty: OneRecord[Penalty] = Field("of penalty and augmented-lagrangian", default=Penalty())
    baumgarte: Maybe[OneRecord[Baumgarte]] = Field(
        "coefficients in 1/s; need the stabilisation baumgarte", default=None, absent="from the step"
    )

    @field_validator("cut", "independent")
    @classmethod
    def _named_once(cls, names: tuple[str, ...], info: ValidationInfo) -> tuple[str, ...]:
        twice = [name for name, count in Counter(names).items() if count > 1]
        if twice:
            what = "joint" if info.field_name == "cut" else "velocity"
            raise fault(f"{', '.join(f'`{name}`' for name in twice)} stands here more than once; name each {what} once")
        return names

    def problems(self) -> Iterator[Problem]:
        """Each is about several settings, which its message names; the place is that of all of them."""
        is_open = "integrator" not in self.model_fields_set and self.step_control == "own"
        fixed = not (is_open or methods.chooses(self.integrator, self.step_control))
        messages = []
        if self.duration < SHORTEST:
            messages.append(f"`duration` {self.duration:g} s is shorter than {SHORTEST:g} s, the shortest run there is")
        is_given = "step" in self.model_fields_set
        if (fixed or (is_open and is_given)) and self.step > self.duration:
            messages.append(f"`step` {self.step:g} s is longer than `duration` {self.duration:g} s")
        wanted = self.output_interval if fixed and is_given else None
        if wanted is not None and wanted < self.step * (1 - 1e-9):
            interval = f"{self.output_interval:g} s"
            messages.append(
                f"`output_interval` {interval} is shorter than `step` {self.step:g} s; write `step: {interval}` too, or a longer interval"
            )
        if self.baumgarte is not None and self.stabilisation != "baumgarte":
            messages.append(f"`baumgarte` needs `stabilisation: baumgarte`; it is `{self.stabilisation}`")
        if self.independent and self.coordinates not in ("auto", "independent"):
            messages.append(f"`independent` needs `coordinates: independent`; it is `{self.coordinates}`")
        if self.independent and self.cut and self.coordinates == "auto":
            messages.append(
                "`independent` and `cut` are for different coordinates: write `coordinates: independent` or `relative`"
            )
        own = self.baumgarte
        if own is not None and (own.alpha is None) != (own.beta is None):
            messages.append("`baumgarte` takes `alpha` and `beta`, both or none")
        for name, each in (
            ("penalty", self.penalty),
            *((f"penalty.rows.{row}", of) for row, of in self.penalty.rows.items()),
        ):
            if each.factor is not None and each.alpha is not None:
                messages.append(f"`{name}` takes `factor` or `alpha`, not both")
        yield from (Problem((), message) for message in messages)


class AssemblySettings(Record):
    """What the assembly may do to close the joints."""

    largest_gap: Maybe[PositiveLength] = Field(
        "by which joints may be open as given; absent, a tenth of the size of the machine", default=None
    )
    parallel: Annotated[Angle, NotNegative] = Field(
        "axes of joints that differ by no more, as placed, are taken as parallel: those of an export with six digits are",
        default=1e-6,
    )


def changed(settings: SimulationSettings, changes: Mapping[str, Any]) -> SimulationSettings:
    """`settings` with `changes`, of `cut` also a single name; what belongs to a method that is replaced is left behind,
    unless it is among the changes itself.

    Raises ModelError where the words are not known or the numbers do not fit together.
    """
    changes = dict(changes)
    if isinstance(changes.get("cut"), str):
        changes["cut"] = (changes["cut"],)
    words = {name: each for name, each in changes.items() if isinstance(each, str)}  # anything else is refused below
    # own Baumgarte coefficients belong to the stabilisation they were given with
    if words.get("stabilisation", "baumgarte") != "baumgarte" and settings.baumgarte is not None:
        changes.setdefault("baumgarte", None)
    # velocities that are kept as unknowns belong to independent coordinates
    if words.get("coordinates", "independent") not in ("auto", "independent") and settings.independent:
        changes.setdefault("independent", ())
    # rotation coordinates belong to lagrange in absolute coordinates
    if (words.get("formulation", "lagrange"), words.get("coordinates", "absolute")) != ("lagrange", "absolute"):
        changes.setdefault("rotations", "euler-parameters")
    return settings.replace(**changes)
