"""Settings of a run: what was asked for, completed and checked."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil

from nivel.errors import Fault, ModelError
from nivel.machine.settings import SimulationSettings
from nivel.march.catalogue import INTEGRATORS
from nivel.march.stabilise.catalogue import STABILISATIONS
from nivel.motion.catalogue import FORMULATIONS

# Without an output interval: the shortest multiple of the step that gives at most this many frames.
FRAMES = 1000
# More steps than this are a slip of the pen: at a microsecond each they take more than ten days.
MOST_STEPS = 1e12


@dataclass(frozen=True)
class RunSettings:
    """Everything that decides a run. Times in s; `every` steps between frames; coordinates as chosen."""

    duration: float
    step: float
    output_interval: float
    every: int
    steps: int
    integrator: str
    formulation: str
    coordinates: str
    stabilisation: str
    baumgarte: tuple[float, float] | None

    def as_dict(self) -> dict[str, object]:
        """For the result's `settings`."""
        names = ("duration", "step", "output_interval", "integrator", "formulation", "coordinates", "stabilisation")
        out: dict[str, object] = {name: getattr(self, name) for name in names}
        if self.baumgarte is not None:
            out["baumgarte"] = {"alpha": self.baumgarte[0], "beta": self.baumgarte[1]}
        return out


def complete(settings: SimulationSettings) -> RunSettings:
    """Complete settings. Raises ModelError where the words are not known or the output interval is not a multiple of the step."""
    faults: list[Fault] = []
    for field, known in (
        ("integrator", INTEGRATORS),
        ("formulation", FORMULATIONS),
        ("stabilisation", STABILISATIONS),
    ):
        word = getattr(settings, field)
        if word not in known:
            faults.append(_fault(field, f"'{word}' is not known; known are {', '.join(known)}"))
    if not settings.duration <= MOST_STEPS * settings.step:
        wanted = f"a duration of {settings.duration:.6g} s in steps of {settings.step:.6g} s"
        faults.append(_fault("step", f"{wanted} would take more than {MOST_STEPS:.0e} steps; use a larger step"))
        raise ModelError(faults)
    steps = max(1, ceil(settings.duration / settings.step * (1.0 - 1e-12)))
    every = _every(settings, steps, faults)
    if faults:
        raise ModelError(faults)
    own = settings.baumgarte
    return RunSettings(
        duration=settings.duration,
        step=settings.step,
        output_interval=every * settings.step,
        every=every,
        steps=steps,
        integrator=settings.integrator,
        formulation=settings.formulation,
        coordinates="absolute",
        stabilisation=settings.stabilisation,
        baumgarte=None if own is None else (own.alpha, own.beta),
    )


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
            f"{settings.output_interval:.6g} s is not a multiple of the step {settings.step:.6g} s: a fixed step stays fixed; "
            f"use {choices} s"
        )
        faults.append(_fault("output_interval", message))
    return max(1, every)


def _fault(field: str, message: str) -> Fault:
    return Fault("", 0, 0, f"simulation.{field}", message)
