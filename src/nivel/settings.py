"""Settings of the analyses as keywords of Python, with the option of the command line and its help.

Written by `python -m nivel.machine.settings` from the records in `nivel/machine/settings`. Do not edit.
"""

# fmt: off
# ruff: noqa: E501
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, TypedDict

from nivel.methods import Coordinates, Formulation, Integrator, Rotations, Stabilisation, Start, StepControl


class RunSettingsDict(TypedDict, total=False):
    """Settings of a run."""

    duration: Annotated[float | str | None, "--duration TIME", "Simulated time, e.g. 8 or '8 s'."]
    step: Annotated[float | str | None, "--step TIME", "Time step, e.g. '1 ms'; first step of integrators that choose their steps."]
    output_interval: Annotated[float | str | None, "--output-interval TIME", "Time between frames; with a fixed step a multiple of it; default: up to 1000 intervals."]
    integrator: Annotated[Integrator | None, "--integrator NAME", "Time integration method:"]
    formulation: Annotated[Formulation | None, "--formulation NAME", "Equations of motion:"]
    coordinates: Annotated[Coordinates | None, "--coordinates NAME", "Coordinates of the equations:"]
    rotations: Annotated[Rotations | None, "--rotations NAME", "Rotation coordinates of lagrange:"]
    cut: Annotated[Sequence[str] | str | None, "--cut JOINTS", "Joints that close loops: they stay constraints in relative coordinates; default: chosen automatically."]
    stabilisation: Annotated[Stabilisation | None, "--stabilisation NAME", "Constraint stabilisation:"]
    start: Annotated[Start | None, "--start NAME", "Initial state: as assembled, or the equilibrium at rest:"]
    free: Annotated[Sequence[str] | str | None, "--free NAMES", "Joint coordinates without stiffness that an equilibrium leaves where they are placed."]
    step_control: Annotated[StepControl | None, "--step-control NAME", "Steps fixed, or chosen by their error; own: as the integrator does:"]
    tolerance: Annotated[float | str | None, "--tolerance NUMBER", "Relative tolerance of the motion, for integrators that choose their steps."]
    largest_step: Annotated[float | str | None, "--largest-step TIME", "Longest step of integrators that choose their steps; default: the duration."]
    corrector: Mapping[str, Any] | None
    newmark: Mapping[str, Any] | None
    hht: Mapping[str, Any] | None
    generalised_alpha: Mapping[str, Any] | None
    penalty: Mapping[str, Any] | None
    baumgarte: Mapping[str, Any] | None


class StepSettingsDict(TypedDict, total=False):
    """Settings of a machine that is moved step by step."""

    step: Annotated[float | str | None, "--step TIME", "Time step, e.g. '1 ms'; first step of integrators that choose their steps."]
    output_interval: Annotated[float | str | None, "--output-interval TIME", "Time between frames; with a fixed step a multiple of it; default: up to 1000 intervals."]
    integrator: Annotated[Integrator | None, "--integrator NAME", "Time integration method:"]
    formulation: Annotated[Formulation | None, "--formulation NAME", "Equations of motion:"]
    coordinates: Annotated[Coordinates | None, "--coordinates NAME", "Coordinates of the equations:"]
    rotations: Annotated[Rotations | None, "--rotations NAME", "Rotation coordinates of lagrange:"]
    cut: Annotated[Sequence[str] | str | None, "--cut JOINTS", "Joints that close loops: they stay constraints in relative coordinates; default: chosen automatically."]
    stabilisation: Annotated[Stabilisation | None, "--stabilisation NAME", "Constraint stabilisation:"]
    start: Annotated[Start | None, "--start NAME", "Initial state: as assembled, or the equilibrium at rest:"]
    free: Annotated[Sequence[str] | str | None, "--free NAMES", "Joint coordinates without stiffness that an equilibrium leaves where they are placed."]
    step_control: Annotated[StepControl | None, "--step-control NAME", "Steps fixed, or chosen by their error; own: as the integrator does:"]
    tolerance: Annotated[float | str | None, "--tolerance NUMBER", "Relative tolerance of the motion, for integrators that choose their steps."]
    largest_step: Annotated[float | str | None, "--largest-step TIME", "Longest step of integrators that choose their steps; default: the duration."]
    corrector: Mapping[str, Any] | None
    newmark: Mapping[str, Any] | None
    hht: Mapping[str, Any] | None
    generalised_alpha: Mapping[str, Any] | None
    penalty: Mapping[str, Any] | None
    baumgarte: Mapping[str, Any] | None


class CompareSettingsDict(TypedDict, total=False):
    """Settings of a comparison: axes of its grid, and settings of all runs."""

    integrators: Annotated[Sequence[Integrator] | Integrator | None, "--integrators NAMES", "Time integration method:"]
    formulations: Annotated[Sequence[Formulation] | Formulation | None, "--formulations NAMES", "Equations of motion:"]
    coordinates: Annotated[Sequence[Coordinates] | Coordinates | None, "--coordinates NAMES", "Coordinates of the equations:"]
    rotations: Annotated[Sequence[Rotations] | Rotations | None, "--rotations NAMES", "Rotation coordinates of lagrange:"]
    stabilisations: Annotated[Sequence[Stabilisation] | Stabilisation | None, "--stabilisations NAMES", "Constraint stabilisation:"]
    steps: Annotated[Sequence[float | str] | float | str | None, "--steps TIMES", "Steps of integrators with a fixed step, e.g. 1ms,2ms."]
    tolerances: Annotated[Sequence[float | str] | float | str | None, "--tolerances NUMBERS", "Tolerances of integrators that choose their steps."]
    duration: Annotated[float | str | None, "--duration TIME", "Simulated time, e.g. 8 or '8 s'."]
    output_interval: Annotated[float | str | None, "--output-interval TIME", "Time between frames; with a fixed step a multiple of it; default: up to 1000 intervals."]
    largest_step: Annotated[float | str | None, "--largest-step TIME", "Longest step of integrators that choose their steps; default: the duration."]
    cut: Annotated[Sequence[str] | str | None, "--cut JOINTS", "Joints that close loops: they stay constraints in relative coordinates; default: chosen automatically."]
