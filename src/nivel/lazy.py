"""Late making: modules that are imported when one of their names is first used, the only place of such imports, functions of rooms
above, and the methods of dataclasses.

A function that needs a heavy or optional module, or one that few runs need, writes its name in full, `scipy.linalg.expm(A)`, with
`from nivel.lazy import scipy` at the head of its file. The names below exist for type checkers; where the program runs, `Late` stands for
the package.

A lower room asks for a function of a room above by its subject; `nivel/__init__.py`, which stands above all rooms, says where each stands.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from dataclasses import asdict, field, fields, is_dataclass, replace  # noqa: F401
from importlib import import_module
from threading import RLock
from types import ModuleType
from typing import TYPE_CHECKING, Any, Final

PLACES: Final[dict[str, str]] = {}


class Late:
    """A package whose modules are imported when one of their names is first used."""

    def __init__(self, name: str) -> None:
        self._name = name

    def __getattr__(self, name: str) -> Any:
        """A name of the package or of one of its modules. Raises ImportError where the package is not installed or has none such."""
        package = import_module(self._name)
        value = getattr(package, name, package)
        if value is package:
            value = import_module(f"{self._name}.{name}")
        if isinstance(value, ModuleType):
            value = Late(value.__name__) if hasattr(value, "__path__") else value
            setattr(self, name, value)
        return value


if TYPE_CHECKING:
    from dataclasses import dataclass

    import distributed
    import gymnasium.vector
    import imageio_ffmpeg
    import matplotlib
    import matplotlib.figure
    import matplotlib.pyplot
    import meshio
    import numpy
    import PIL.Image
    import pint
    import pyarrow
    import rich.box
    import rich.console
    import rich.live
    import rich.progress
    import rich.table
    import rich.text
    import scipy
    import scipy.integrate
    import scipy.interpolate
    import scipy.io
    import scipy.linalg
    import scipy.optimize
    import scipy.signal
    import scipy.sparse
    import scipy.sparse.csgraph
    import scipy.sparse.linalg
    import scipy.spatial
    import scipy.spatial.transform
    import scipy.stats
    import skfem
    import skfem.helpers
    import skfem.io.meshio
    import skfem.models.elasticity
    import skfem.models.poisson
    import websockets.asyncio.server
    import websockets.exceptions
    import websockets.sync.client
    import xarray

    import nivel
    import nivel.analysis.assembly.circuit_start
    import nivel.analysis.assembly.mass
    import nivel.analysis.compare.compare
    import nivel.analysis.compare.compare_grid
    import nivel.analysis.gradients.gradient
    import nivel.analysis.gradients.outputs
    import nivel.analysis.gradients.sensitivities
    import nivel.analysis.interactive.posing
    import nivel.analysis.inverse.actuators
    import nivel.analysis.inverse.mechanics
    import nivel.analysis.inverse.number_table
    import nivel.analysis.inverse.paths
    import nivel.analysis.inverse.run
    import nivel.analysis.kinematics.continuation
    import nivel.analysis.kinematics.drive
    import nivel.analysis.kinematics.run
    import nivel.analysis.linearise.linearise
    import nivel.analysis.linearise.ports
    import nivel.analysis.optimise.evaluations
    import nivel.analysis.optimise.identify
    import nivel.analysis.optimise.inputs
    import nivel.analysis.optimise.optimise
    import nivel.analysis.plan.compilation
    import nivel.analysis.plan.equations_only
    import nivel.analysis.plan.plan
    import nivel.analysis.plan.settings
    import nivel.analysis.preparation.attributes
    import nivel.analysis.progress.journal
    import nivel.analysis.progress.log
    import nivel.analysis.run.many
    import nivel.analysis.run.prepared_state
    import nivel.analysis.run.simulate
    import nivel.analysis.run.stepping
    import nivel.analysis.statics.free_coordinates
    import nivel.analysis.statics.run
    import nivel.analysis.statics.start
    import nivel.analysis.sweep.batch
    import nivel.analysis.sweep.outputs
    import nivel.analysis.sweep.resolution
    import nivel.analysis.sweep.sweep
    import nivel.analysis.sweep.variant
    import nivel.analysis.sweep.variant_runs
    import nivel.analysis.sweep.variants
    import nivel.api
    import nivel.c_library.exported
    import nivel.c_library.writer
    import nivel.cli.analysis_command
    import nivel.cli.live
    import nivel.cli.progress
    import nivel.elements.circuits.actuators
    import nivel.elements.circuits.chambers
    import nivel.elements.forces.ropes
    import nivel.elements.joints
    import nivel.exchange
    import nivel.exchange.gltf_writer
    import nivel.exchange.mjcf_writer
    import nivel.exchange.urdf_writer
    import nivel.extras
    import nivel.files
    import nivel.files.assembly
    import nivel.files.collada_file
    import nivel.files.convex_parts
    import nivel.files.fmu_file
    import nivel.files.input_table
    import nivel.files.reader
    import nivel.files.sources
    import nivel.files.step_file
    import nivel.files.study_file
    import nivel.files.target
    import nivel.flexible.body.body_file
    import nivel.flexible.body.vtk
    import nivel.flexible.foreign.source
    import nivel.flexible.model.model_file
    import nivel.flexible.model.solid_source
    import nivel.flexible.reduce
    import nivel.fmu.writer
    import nivel.gym.machine_environment
    import nivel.judge.after.report
    import nivel.judge.before.analyses
    import nivel.judge.before.check
    import nivel.judge.before.circuits
    import nivel.judge.before.refusals
    import nivel.judge.before.unusual
    import nivel.kernels.bodies.driven_turn
    import nivel.kernels.output.observe
    import nivel.live.budget
    import nivel.live.datagrams
    import nivel.live.journal
    import nivel.live.opening
    import nivel.live.recording
    import nivel.live.replay
    import nivel.live.source
    import nivel.live.timing
    import nivel.looks.circuit.characteristics
    import nivel.looks.circuit.drawing
    import nivel.looks.circuit.power_flow
    import nivel.machine.core.orientation
    import nivel.machine.core.record
    import nivel.machine.settings.compare
    import nivel.machine.settings.inverse
    import nivel.machine.settings.kinematics
    import nivel.machine.settings.linearise
    import nivel.machine.settings.statics
    import nivel.machine.settings.sweep
    import nivel.machine.settings.values
    import nivel.machine.units.quantity
    import nivel.machine.uses.hydraulic_uses
    import nivel.native.library
    import nivel.native.processor
    import nivel.native.shipped
    import nivel.native.store
    import nivel.native.workers
    import nivel.report.reduction_page
    import nivel.report.study_page
    import nivel.results
    import nivel.results.analyses.linear_model
    import nivel.results.analyses.linear_motion
    import nivel.results.analyses.linear_sweep
    import nivel.results.analyses.mechanism
    import nivel.results.analyses.mode_motion
    import nivel.results.analyses.vibration
    import nivel.results.beams
    import nivel.results.comparison_table
    import nivel.results.frames.circuit_balance
    import nivel.results.frames.csv_table
    import nivel.results.frames.labelled
    import nivel.results.frames.loads
    import nivel.results.frames.summary
    import nivel.results.plots
    import nivel.results.result
    import nivel.results.scales
    import nivel.results.stress
    import nivel.results.stress_tables
    import nivel.results.study_statistics
    import nivel.results.trust
    import nivel.studies
    import nivel.system.beams.elements
    import nivel.system.beams.segments
    import nivel.system.circuit_elements
    import nivel.system.circuit_tangent
    import nivel.system.elimination.topology
    import nivel.system.joint_frames
    import nivel.system.signals.c_instance
    import nivel.system.signals.fmu_instance
    import nivel.system.signals.own_process
    import nivel.system.states.flexible_tree
    import nivel.system.states.relative
    import nivel.system.states.tree_nodes
    import nivel.view.capture
    import nivel.view.colours
    import nivel.view.page
    import nivel.view.playback
    import nivel.view.server
    import nivel.view.sources
    import nivel.words.vocabulary
    import nivel.words.wording
else:
    PIL, distributed, gymnasium, imageio_ffmpeg, matplotlib, meshio, nivel = map(
        Late, ("PIL", "distributed", "gymnasium", "imageio_ffmpeg", "matplotlib", "meshio", "nivel")
    )
    numpy, pint, pyarrow, rich, scipy, skfem, websockets, xarray = map(
        Late, ("numpy", "pint", "pyarrow", "rich", "scipy", "skfem", "websockets", "xarray")
    )


def provide(places: Mapping[str, str]) -> None:
    """State where functions stand: subject → `module:function`."""
    PLACES.update(places)


def provided(subject: str) -> Any:
    """The function or class of a subject, whose module is imported now."""
    module, _, name = PLACES[subject].partition(":")
    return getattr(import_module(module), name)


class _Unmade:
    """Stands for a method of a dataclass; where it is asked for, the class gets all of its own.

    Those of the standard library are text that is compiled, up to a millisecond a class, and a run uses a third of the classes that it
    imports.
    """

    __slots__ = ("make", "name")

    def __init__(self, name: str, make: Callable[[], None]) -> None:
        self.name, self.make = name, make

    def __get__(self, record: Any, owner: type | None = None) -> Any:
        self.make()
        return getattr(owner if record is None else record, self.name)


if not TYPE_CHECKING:
    _MAKING = RLock()
    _OF_ALL = ("__init__", "__repr__", "__dataclass_fields__", "__dataclass_params__", "__match_args__")
    _FROZEN = ("__setattr__", "__delattr__")
    _ORDER = ("__lt__", "__le__", "__gt__", "__ge__")

    def _complete(kind, own, options):
        """Give a class what `dataclasses` makes for its double, which has its `own` names: while it is made other threads meet the stubs,
        which wait, and no class that is half made."""
        own = {name: value for name, value in own.items() if name not in ("__dict__", "__weakref__")}
        double = type(kind)(kind.__name__, kind.__bases__, own | {"__qualname__": kind.__qualname__})
        before = dict(vars(double))
        dataclasses.dataclass(double, **options)
        for name, value in vars(double).items():
            if before.get(name, _MAKING) is not value:
                for cell in getattr(value, "__closure__", None) or ():
                    if cell.cell_contents is double:  # in `super(double, self)`
                        cell.cell_contents = kind
                setattr(kind, name, value)
        for name in before.keys() - vars(double).keys():
            delattr(kind, name)

    def dataclass(kind=None, /, **options):
        """As `dataclasses.dataclass`, without `slots`: the class is completed when one of its methods is first asked for."""
        if kind is None:
            return lambda made: dataclass(made, **options)
        compared, frozen = options.get("eq", True), options.get("frozen", False)
        if compared and not frozen and "__hash__" not in vars(kind):
            kind.__hash__ = None
        names = {*_OF_ALL, *_FROZEN * frozen, *_ORDER * options.get("order", False), *("__eq__",) * compared}
        stubs = {}

        def make():
            with _MAKING:
                if stubs:
                    own = {name: value for name, value in vars(kind).items() if stubs.get(name, _MAKING) is not value}
                    stubs.clear()
                    _complete(kind, own, options)

        for name in names.union(("__hash__",) * (compared and frozen)).difference(vars(kind)):
            stubs[name] = _Unmade(name, make)
            setattr(kind, name, stubs[name])
        return kind
