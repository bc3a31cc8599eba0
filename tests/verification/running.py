"""Run a machine and get its frames as arrays by name."""

from types import SimpleNamespace

import numpy as np

from nivel.analysis.plan.settings import complete
from nivel.analysis.run.dynamics import march
from preparing import prepare


class Frames:
    """A sink that keeps everything."""

    def __init__(self):
        self.blocks = []

    def take(self, frames):
        self.blocks.append(frames.copy())


def reference_run(machine, **settings):
    """`run`, once for equal machines and settings: what many tests compare with."""
    key = repr((machine, sorted(settings.items())))
    if key not in _REFERENCES:
        _REFERENCES[key] = found = run(machine, **settings)
        found.frames.flags.writeable = False
    return _REFERENCES[key]


_REFERENCES = {}


def run(machine, *, chunk_steps=None, **settings):
    """Arrays of all variables, `time`, the prepared machine and how the run finished."""
    record = machine.replace(simulation=machine.simulation.replace(**settings)) if settings else machine
    complete_settings = complete(record.simulation)
    prepared = prepare(record, complete_settings.formulation, complete_settings.coordinates)
    sink = Frames()
    finished = march(prepared, complete_settings, [sink], chunk_steps=chunk_steps)
    frames = np.vstack(sink.blocks)
    layout = prepared.motion.system.layout
    out = {"time": frames[:, 0], "frames": frames, "prepared": prepared, "finished": finished}
    for variable in layout.variables:
        shape = [len(layout.coordinates[dim]) for dim in variable.dims[1:]]
        out[variable.name] = frames[:, variable.columns].reshape(len(frames), *shape)
    return SimpleNamespace(**out)
