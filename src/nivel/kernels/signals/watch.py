"""The hook of machines with events, and of those whose contacts, stops and switches are followed: values whose zeros are looked for."""

import numpy as np

from nivel.kernels.core.status import OK
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import FUNCTION, record_at
from nivel.native.function import stage

# A value of `Watched.event`'s STOP beside those of the record: no event, but a value whose sign decides within the functions of events, in
# the rows behind all events. Where it changes an event may be passed twice in one step.
MARK = 3
# jobs of the hook of ground with heights beside 0, see `nivel.kernels.forces.height_way`; LOOK: and the number of a surface among what is
# watched
KEEP, ARRIVE, AHEAD, LOOK = 1, 2, 3, 4
# the margin of a switch of which no side can be told
NOT_BEYOND = 1e-300


@stage
def read_watched(machine, t):
    """Fill `watched.value` and `watched.rate` in the state last evaluated."""
    record = record_at(machine)
    watched, elements = record.watched, record.elements
    events = watched.event.shape[0]
    for k in range(events):
        watched.value[k] = evaluate_function(machine, watched.event[k, FUNCTION], t)
    for k in range(watched.surface.shape[0]):
        element, place = watched.surface[k, 0], watched.surface[k, 1]
        watched.value[events + k] = elements.depth[element, place]
        watched.rate[events + k] = elements.depth_rate[element, place]
    first = events + watched.surface.shape[0]
    arguments = record.functions.arguments
    for k in range(watched.switch.shape[0]):
        margin = arguments[watched.switch[k, 0]] * arguments[watched.switch[k, 1]]
        # a difference of zero belongs to both sides, and one that is no number to neither
        watched.value[first + k] = margin if 0.0 < np.abs(margin) < np.inf else NOT_BEYOND


@family
def watch(machine, job, t):
    """The hook itself; of ground with heights it is `nivel.kernels.forces.height_way`."""
    read_watched(machine, t)
    return OK
