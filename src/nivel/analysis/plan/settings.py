"""Settings of a run: what was asked for, completed and checked."""

from collections.abc import Iterator
from math import ceil
from typing import TypeVar

from nivel.errors import Fault, ModelError, refuse
from nivel.integrate.catalogue import INTEGRATORS
from nivel.integrate.facts import IntegratorFacts
from nivel.integrate.newmark.alpha_constants import CHOSEN_STEPS, FIXED_STEPS, generalised_alpha, hht, newmark
from nivel.lazy import Struct, replace
from nivel.machine.settings.run import Corrector, Penalty, SimulationSettings
from nivel.machine.units.quantity import asked, shown
from nivel.methods import chooses
from nivel.model import Model
from nivel.motion.catalogue import FORMULATIONS, PATHS, path_of

M = TypeVar("M", bound=Model)
# Without an output interval: the shortest multiple of the step that gives at most this many frames.
FRAMES = 1000
# More steps than this are a slip of the pen: at a microsecond each they take more than ten days.
MOST_STEPS = 1e12
# The round-off of some thousand steps; a verification runs with a tenth of the tolerance.
LEAST_TOLERANCE = 1e-12
# Of the changes of an iteration, as shares of the scales: below, they are round-off.
LEAST_CHANGE = 1e-15


class RunSettings(Struct):
    """Everything that decides a run. Times in s; coordinates as chosen. What is not completed stands in `asked`, as it was asked for.

    steps : in all, `every` of them between frames; both 0 where the integrator chooses its steps. tolerance, corrector, penalty : None
    where the methods have none. constants : of the integrator, as its module wants them.
    """

    asked: SimulationSettings
    duration: float
    step: float
    output_interval: float
    every: int
    steps: int
    integrator: str
    formulation: str
    coordinates: str
    stabilisation: str
    tolerance: float | None
    largest_step: float
    corrector: Corrector | None
    penalty: Penalty | None
    baumgarte: tuple[float, float] | None
    constants: tuple[float, ...] = ()

    @property
    def frames(self) -> float:
        """How many are asked for, at most."""
        return self.duration / self.output_interval + 2.0

    @property
    def with_usual_frames(self) -> "RunSettings":
        """The same run with frames that are no farther apart than without an output interval: numbers are made from these, whatever frames
        are asked for."""
        if not self.steps:
            return replace(self, output_interval=min(self.output_interval, self.duration / FRAMES))
        every = min(self.every, ceil(self.steps / FRAMES))
        return replace(self, every=every, output_interval=every * self.step)

    def as_dict(self) -> dict[str, object]:
        """For the result's `settings`."""
        names = ("duration", "step", "output_interval", "integrator", "formulation", "coordinates", "stabilisation")
        out: dict[str, object] = {name: getattr(self, name) for name in names}
        if self.asked.start != "as-given":
            out["start"] = self.asked.start
        if self.formulation == "lagrange":
            out["rotations"] = self.asked.rotations
        if self.tolerance is not None:
            out["tolerance"], out["largest_step"] = self.tolerance, self.largest_step
        for name in ("corrector", "penalty"):
            if (given := getattr(self, name)) is not None:
                out[name] = {key: value for key, value in given.model_dump(exclude_none=True).items() if value != {}}
        if self.constants:
            names = ("alpha_m", "alpha_f", "beta", "gamma", "delta_m", "delta_f", "theta")
            out["constants"] = dict(zip(names, self.constants, strict=True))
        if self.asked.baumgarte is not None:
            out["baumgarte"] = self.asked.baumgarte.model_dump(exclude_defaults=True)
        if self.coordinates == "independent" and self.asked.independent:
            out["independent"] = self.asked.independent
        return out


def complete(settings: SimulationSettings, coordinates: str = "absolute") -> RunSettings:
    """Complete settings; `coordinates` are what `auto` means for the machine.

    Raises ModelError where words do not go together, or the output interval is not a multiple of the step.
    """
    faults: list[Fault] = []
    facts = INTEGRATORS[settings.integrator]
    chosen_steps = chooses(settings.integrator, settings.step_control)
    countable = settings.duration <= MOST_STEPS * settings.step
    if not chosen_steps and not countable:
        wanted = f"a `duration` of {settings.duration:.6g} s in steps of {settings.step:.6g} s"
        message = f"{wanted} would take more than {MOST_STEPS:.0e} steps; use a larger step, or a shorter duration"
        faults.append(Fault.at("simulation.step", message))
    if facts.kind == "corrector" and settings.corrector.tolerance < LEAST_CHANGE:
        message = f"{settings.corrector.tolerance:.3g} is below {LEAST_CHANGE:.0e}, where round-off dominates; use a larger value"
        faults.append(Fault.at("simulation.corrector.tolerance", message))
    steps, every, interval = 0, 0, settings.duration
    if chosen_steps:
        interval = settings.output_interval or settings.duration / FRAMES
        if settings.duration > MOST_STEPS * interval:
            wanted = f"{interval:.6g} s would give more than {MOST_STEPS:.0e} frames"
            message = f"{wanted} in a `duration` of {settings.duration:.6g} s"
            faults.append(Fault.at("simulation.output_interval", message))
        if settings.largest_step is not None and settings.duration > MOST_STEPS * settings.largest_step:
            wanted = f"{settings.largest_step:.6g} s would take more than {MOST_STEPS:.0e} steps"
            faults.append(Fault.at("simulation.largest_step", f"{wanted} in a `duration` of {settings.duration:.6g} s"))
        if settings.tolerance < LEAST_TOLERANCE:
            message = f"{settings.tolerance:.3g} is below {LEAST_TOLERANCE:.0e}, where round-off dominates; use a larger value"
            faults.append(Fault.at("simulation.tolerance", message))
    elif countable:
        steps = max(1, ceil(settings.duration / settings.step * (1.0 - 1e-12)))
        every = _every(settings, steps, faults)
        interval = every * settings.step
    chosen = coordinates if settings.coordinates == "auto" else settings.coordinates
    faults += refuse_combinations(settings, chosen)
    refuse(faults)
    own = settings.baumgarte
    return RunSettings(
        asked=settings,
        duration=settings.duration,
        step=settings.step,
        output_interval=interval,
        every=every,
        steps=steps,
        integrator=settings.integrator,
        formulation=settings.formulation,
        coordinates=chosen,
        stabilisation=settings.stabilisation,
        tolerance=settings.tolerance if chosen_steps else None,
        largest_step=settings.largest_step or settings.duration,
        corrector=_corrector(settings.corrector, facts) if facts.kind == "corrector" else None,
        penalty=settings.penalty if FORMULATIONS[settings.formulation].factor > 0.0 else None,
        baumgarte=None if own is None or own.alpha is None or own.beta is None else (own.alpha, own.beta),
        constants=_constants(settings),
    )


def with_usual_frames(machine: M) -> M:
    """The same machine with frames no farther apart than without an output interval, for numbers that are made from them."""
    simulation = machine.record.simulation
    if simulation.output_interval is None or simulation.output_interval * FRAMES <= simulation.duration:
        return machine
    return machine.with_settings({"output_interval": None})


def waiting_time(name: str, value: float | str) -> float:
    """A time [s] that the option `name` gives as a number or a text; zero is none to wait. Raises ModelError."""
    seconds = asked(name, value, "time")
    if seconds < 0.0:
        raise ModelError(Fault.at(name, f"a time was expected, got {shown(value)}"))
    return seconds


def _corrector(given: Corrector, facts: IntegratorFacts) -> Corrector:
    """With an iteration: Newton's for methods with exact tangents, functional for the others where none was chosen."""
    return given.replace(iteration="newton" if facts.residual else given.iteration or "functional")


def _constants(settings: SimulationSettings) -> tuple[float, ...]:
    """Constants of the integrator, where its user may choose them."""
    match settings.integrator:
        case "newmark":
            return newmark(settings.newmark.beta, settings.newmark.gamma)
        case "hht":
            return hht(settings.hht.alpha)
        case "generalised-alpha":
            usual = CHOSEN_STEPS if settings.step_control == "error" else FIXED_STEPS
            given = settings.generalised_alpha.spectral_radius
            return generalised_alpha(usual if given is None else given)
    return ()


def _every(settings: SimulationSettings, steps: int, faults: list[Fault]) -> int:
    if settings.output_interval is None:
        return max(1, ceil(steps / FRAMES))
    every = round(settings.output_interval / settings.step)
    if every < 1 or abs(every * settings.step - settings.output_interval) > 1e-9 * settings.output_interval:
        near = sorted(
            {max(1, every), max(1, every) + (1 if settings.output_interval > every * settings.step else -1)} - {0}
        )
        choices = " or ".join(f"{k * settings.step:.6g}" for k in near)
        message = (
            f"{settings.output_interval:.6g} s is not a multiple of the step {settings.step:.6g} s; use {choices} s"
        )
        faults.append(Fault.at("simulation.output_interval", message))
    return max(1, every)


# Combinations of methods that have no meaning, each with its reason.

Problems = Iterator[tuple[str, str]]  # field of the settings, message


def refuse_combinations(settings: SimulationSettings, coordinates: str) -> list[Fault]:
    """Faults of `settings` with these coordinates (`auto` resolved)."""
    return [Fault.at(f"simulation.{field}", message) for field, message in _problems(settings, coordinates)]


def _problems(settings: SimulationSettings, coordinates: str) -> Problems:
    formulation, stabilisation = settings.formulation, settings.stabilisation
    if settings.rotations != "euler-parameters" and (formulation, coordinates) != ("lagrange", "absolute"):
        message = (
            f"'{settings.rotations}' are rotation coordinates of `formulation: lagrange` with `coordinates: absolute`; "
            f"{formulation} in {coordinates} coordinates has no use for them"
        )
        yield "rotations", message
    if path_of(coordinates, formulation, "euler-parameters") is None:
        known = sorted({c for c, f, _ in PATHS if f == ("lagrange" if formulation == "lagrange" else "newton-euler")})
        message = f"'{coordinates}' does not go with `formulation: {formulation}`, which is for {' or '.join(known)}"
        yield "coordinates", message
    if stabilisation == "baumgarte" and FORMULATIONS[formulation].factor > 0.0:
        message = (
            f"'baumgarte' does not go with `formulation: {formulation}`, which feeds violations back itself: "
            f"set `penalty: {{omega: …, mu: …}}` and take none, direct or geometric"
        )
        yield "stabilisation", message
    if coordinates == "independent":
        yield from _beside_independent(formulation, stabilisation)
    yield from _beside_residual(settings, coordinates)
    yield from _of_step_control(settings)
    yield from _of_matrix(settings)
    yield from _of_chosen_steps(settings)


def _beside_independent(formulation: str, stabilisation: str) -> Problems:
    """What feeds violations of constraints back, in coordinates that have none."""
    left = "the constraints are solved for the dependent coordinates after every step, so there is no violation to feed back"
    if stabilisation == "baumgarte":
        message = f"'baumgarte' does not go with `coordinates: independent`: {left}; take none, direct or geometric"
        yield "stabilisation", message
    if FORMULATIONS[formulation].factor > 0.0:
        yield "formulation", f"'{formulation}' does not go with `coordinates: independent`: {left}; take newton-euler"


def _beside_residual(settings: SimulationSettings, coordinates: str) -> Problems:
    """What does not go with an integrator that needs the equations of motion as a residual, with exact tangents."""
    facts = INTEGRATORS[settings.integrator]
    if not facts.residual:
        return
    name = f"`integrator: {settings.integrator}`"
    if coordinates == "independent" and settings.formulation == "lagrange":
        message = (
            f"'lagrange' in independent coordinates does not go with {name}, which needs a residual: use newton-euler, which has the same "
            f"motion, or an explicit or multistep integrator"
        )
        yield "formulation", message
    if facts.needs == "whole steps":
        yield from _beside_whole_steps(settings, coordinates)
        return
    if (
        settings.stabilisation == "baumgarte"
        and not _gives_coefficients(settings)
        and facts.first_order
        and not facts.chooses_steps
    ):
        message = (
            f"'baumgarte' without coefficients takes α = 1/step and β = √2/step, as fast as a step of {name}, which does not iterate and "
            f"has order one there: take direct, or own coefficients `baumgarte: {{alpha: 20/s, beta: 20/s}}`"
        )
        yield "stabilisation", message
    if facts.kind == "corrector" and settings.corrector.iteration == "functional":
        message = f"'functional' does not go with {name}, which takes Newton's method with exact tangents: leave `iteration` out"
        yield "corrector.iteration", message


def _beside_whole_steps(settings: SimulationSettings, coordinates: str) -> Problems:
    """What does not go with an integrator that balances momenta over a whole step."""
    name = f"`integrator: {settings.integrator}`"
    if FORMULATIONS[settings.formulation].factor > 0.0:
        message = (
            f"'{settings.formulation}' does not go with {name}, whose multipliers solve the position constraints: use newton-euler, "
            f"which gives the same motion"
        )
        yield "formulation", message
    if settings.formulation == "lagrange":
        message = (
            f"'lagrange' does not go with {name}, which balances momenta for angular velocities, not for rates of rotation "
            f"coordinates: use newton-euler, which gives the same motion"
        )
        yield "formulation", message
    if coordinates != "absolute":
        message = f"'{coordinates}' does not go with {name}, which balances the momenta of each body: take absolute"
        yield "coordinates", message
    if settings.stabilisation != "none":
        message = (
            f"'{settings.stabilisation}' does not go with {name}: it solves the position constraints itself, and a change of "
            f"velocities after a step would change the energy that it conserves: write `stabilisation: none`"
        )
        yield "stabilisation", message
    if settings.corrector.iteration == "functional":
        message = f"'functional' does not go with {name}, which takes Newton's method with exact tangents: leave `iteration` out"
        yield "corrector.iteration", message


def _of_matrix(settings: SimulationSettings) -> Problems:
    """Newton's matrix made anew for every iteration, where the method has another use for it, or none."""
    facts = INTEGRATORS[settings.integrator]
    if settings.corrector.matrix != "full" or (facts.residual and not facts.first_order):
        return
    if facts.kind == "explicit":
        return  # no corrector at all
    why = "solves with one exact matrix a step and does not iterate"
    if facts.chooses_steps:
        why = "chooses steps and orders by the cost of its matrix so far"
    elif facts.kind == "corrector":
        why = "computes its matrix by differences, again when the iteration converges slowly"
    message = (
        f"'full' does not go with `integrator: {settings.integrator}`, which {why}: take newmark, hht or generalised-alpha, or leave "
        f"`matrix` out"
    )
    yield "corrector.matrix", message


def _of_step_control(settings: SimulationSettings) -> Problems:
    """Steps that the integrator cannot choose, or cannot but choose."""
    facts, wanted = INTEGRATORS[settings.integrator], settings.step_control
    if wanted == "own" or facts.optional_control or facts.chooses_steps == (wanted == "error"):
        return
    name = f"`integrator: {settings.integrator}`"
    if wanted == "fixed":
        message = f"{name} always chooses its steps: take an integrator of fixed step, e.g. rk4 or generalised-alpha"
    else:
        message = f"{name} has no estimate of its error: take dopri5, or radau for stiff machines"
    yield "step_control", message


def _of_chosen_steps(settings: SimulationSettings) -> Problems:
    """What needs a step of fixed size and gets an integrator that chooses its steps."""
    if not chooses(settings.integrator, settings.step_control):
        return
    reason = f"which depend on the step, and `integrator: {settings.integrator}` chooses its steps"
    if settings.stabilisation == "baumgarte" and not _gives_coefficients(settings):
        message = (
            f"'baumgarte' without coefficients takes α = 1/step and β = √2/step, {reason}: take direct, or own coefficients "
            f"`baumgarte: {{alpha: 20/s, beta: 20/s}}`"
        )
        yield "stabilisation", message
    penalised = FORMULATIONS[settings.formulation].factor > 0.0
    if penalised and settings.stabilisation == "none" and settings.penalty.omega is None:
        message = (
            f"`formulation: {settings.formulation}` without `omega` takes Ω = 0.1/step, {reason}: set `penalty: {{omega: 10/s}}`, "
            f"or take `stabilisation: direct`, which needs no Ω"
        )
        yield "penalty", message


def _gives_coefficients(settings: SimulationSettings) -> bool:
    """Whether the settings have coefficients of Baumgarte's feedback of their own, for all rows."""
    return settings.baumgarte is not None and settings.baumgarte.is_whole
