"""Settings of the analyses as keywords of Python, with the option of the command line and its help.

Written by `python packaging/write_settings.py` from the records in `nivel/machine/settings`. Do not edit.
"""

# fmt: off
# ruff: noqa: E501, I001
from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Annotated, Any, TypedDict

from nivel.methods import Analysis, Combination, Coordinates, Drawn, Formulation, Integrator, Rotations, Stabilisation, Start, StaticCoordinates, StepControl


class EndSettingsDict(TypedDict, total=False):
    """Settings of what has an end."""

    duration: Annotated[float | str | None, "--duration TIME", "Simulated time, e.g. 8 or '8 s'."]


class StepSettingsDict(TypedDict, total=False):
    """Settings of a machine that is moved step by step."""

    step: Annotated[float | str | None, "--step TIME", "Time step, e.g. '1 ms'; first step of integrators that choose their steps."]
    output_interval: Annotated[float | str | None, "--output-interval TIME", "Time between frames; with a fixed step a multiple of it; default: up to 1000 intervals."]
    integrator: Annotated[Integrator | None, "--integrator NAME", "Time integration method:"]
    formulation: Annotated[Formulation | None, "--formulation NAME", "Equations of motion:"]
    coordinates: Annotated[Coordinates | None, "--coordinates NAME", "Coordinates of the equations:"]
    rotations: Annotated[Rotations | None, "--rotations NAME", "Rotation coordinates of lagrange:"]
    cut: Annotated[Sequence[str] | str | None, "--cut JOINTS", "Joints that close loops: they stay constraints in relative coordinates; default: chosen automatically."]
    independent: Annotated[Sequence[str] | str | None, "--independent NAMES", "Velocities that independent coordinates keep as unknowns, e.g. crank.about_z; default: chosen automatically."]
    stabilisation: Annotated[Stabilisation | None, "--stabilisation NAME", "Constraint stabilisation:"]
    start: Annotated[Start | None, "--start NAME", "Initial state: as assembled, or the equilibrium at rest:"]
    free: Annotated[Sequence[str] | str | None, "--free NAMES", "Joint coordinates without stiffness that an equilibrium leaves where they are placed."]
    step_control: Annotated[StepControl | None, "--step-control NAME", "Steps fixed, or chosen by their error; own: as the integrator does:"]
    tolerance: Annotated[float | str | None, "--tolerance NUMBER", "Relative tolerance of the motion, of chosen steps; 1e-8 where no integrator is named."]
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


class SweepSettingsDict(TypedDict, total=False):
    """Settings of a sweep over machines."""

    combine: Annotated[Combination | None, "--combine NAME", "Grid, every value with every other; rows, the first of all lists, the second of all; or a design between two bounds:"]
    samples: Annotated[int | str | None, "--samples NUMBER", "Number of variants of a Latin hypercube between two bounds, or over distributions."]
    seed: Annotated[int | str | None, "--seed NUMBER", "Seed of the random numbers of samples."]
    save: Annotated[Sequence[str] | str | None, "--save NAMES", "Names of results; default: all joint coordinates and sensors."]
    design: Annotated[Drawn | None, "--design NAME", "How samples are drawn:"]
    analysis: Annotated[Analysis | None, "--analysis NAME", "What is computed of each variant:"]
    analysis_settings: Mapping[str, Any] | None
    outputs: Mapping[str, Any] | None
    time_limit: Annotated[float | str | None, "--time-limit TIME", "Longest computing time of a variant; default: none."]
    scheduler: Annotated[str | None, "--scheduler TEXT", "Address of the scheduler of a Dask cluster that computes; default: none."]
    processes: Annotated[int | str | None, "--processes NUMBER", "Number of processes; default: as many as there are processors."]
    verify: Annotated[bool | None, "--verify", "A second run beside each variant, to estimate its error; default: not verified."]


class StaticsSettingsDict(TypedDict, total=False):
    """Settings of statics."""

    duration: Annotated[float | str | None, "--duration TIME", "Last time of the loads and drivers; 0: only t = 0; default: that of the machine."]
    step: Annotated[float | str | None, "--step TIME", "Time between two states; default: a twentieth of the duration."]
    arc_length: Annotated[bool | None, "--arc-length", "Path of equilibria through limit points, where time turns back."]
    tolerance: Annotated[float | str | None, "--tolerance NUMBER", "Largest last correction of Newton's method, in lengths of the machine and in radians; default: 1e-10."]
    most_iterations: Annotated[int | str | None, "--most-iterations NUMBER", "Limit of Newton iterations for a state; default: 25."]
    line_search: Annotated[bool | None, "--no-line-search", "No shortening of Newton steps that come no nearer."]
    modes: Annotated[int | str | None, "--modes NUMBER", "Number of natural frequencies and modes about every state."]
    buckling: Annotated[int | str | None, "--buckling NUMBER", "Number of linearised buckling loads, from the first and the last state."]
    coordinates: Annotated[StaticCoordinates | None, "--coordinates NAME", "Coordinates of the equations:"]
    verify: Annotated[bool | None, "--no-verify", "No states with other elements of beams, to estimate their error."]


class KinematicsSettingsDict(TypedDict, total=False):
    """Settings of kinematics."""

    drive: Annotated[str | None, "--drive COORDINATE", "Joint coordinate that is driven at constant speed, e.g. hinge.angle."]
    start: Annotated[float | str | None, "--from VALUE", "First value of this coordinate, e.g. '10 deg'; default: its value in the assembled machine."]
    end: Annotated[float | str | None, "--to VALUE", "Last value of this coordinate; default: one turn more."]
    duration: Annotated[float | str | None, "--duration TIME", "Duration of the motion; default: that of the machine, 1 s with --drive."]
    positions: Annotated[int | str | None, "--positions NUMBER", "Number of positions, both ends included; default: 361, or as many more as show the motion between them."]
    coordinates: Annotated[StaticCoordinates | None, "--coordinates NAME", "Coordinates of the equations:"]


class InverseSettingsDict(TypedDict, total=False):
    """Settings of inverse dynamics."""

    actuators: Annotated[Sequence[str] | str | None, "--actuators NAMES", "Joint coordinates, or motors, which then do not act themselves; default: the motors, or the coordinates that the drivers prescribe."]
    motion: Annotated[Any, "--motion RESULT.nc", "Result of a run or of kinematics; default: the motion that the drivers prescribe."]
    trajectory: Annotated[str | PathLike[str] | None, "--trajectory FILE.csv", "Table of joint coordinates over time, in place of a motion."]
    limits: Annotated[Mapping[str, Any] | None, "--limit NAME=VALUE", "Greatest effort of an actuator; default: those of the motors."]
    weights: Annotated[Mapping[str, Any] | None, "--weight NAME=NUMBER", "Weight of an effort, if there are more actuators than needed; default: one over the limit, or 1."]
    hold: Annotated[Sequence[str] | str | None, "--hold DRIVERS", "Drivers that keep what they prescribe."]
    positions: Annotated[int | str | None, "--positions NUMBER", "Number of positions of the drivers' motion or of a trajectory; default: 361, or as many more as show the motion between them."]


class LineariseSettingsDict(TypedDict, total=False):
    """Settings of a linear model."""

    about: Annotated[float | str | None, "--about STATE", "State to linearise about: start, equilibrium, rotation (steady, strained by it), or a time up to which the machine is simulated, e.g. '2 s'; default: the start of the machine."]
    inputs: Annotated[Sequence[str] | str | None, "--inputs NAMES", "Inputs, e.g. hinge.angle; default: motors, drivers, commands of circuits."]
    outputs: Annotated[Sequence[str] | str | None, "--outputs NAMES", "Outputs; default: sensors, or joint coordinates and pressures."]
    coordinates: Annotated[StaticCoordinates | None, "--coordinates NAME", "Coordinates of the equations:"]
    verify: Annotated[bool | None, "--no-verify", "No vibrations with other elements of beams, to estimate their error."]


class RunSettingsDict(EndSettingsDict, StepSettingsDict, total=False):
    """Settings of a run."""


class MachineSweepSettingsDict(SweepSettingsDict, RunSettingsDict, total=False):
    """Settings of a sweep over values of a machine, and of its runs."""
