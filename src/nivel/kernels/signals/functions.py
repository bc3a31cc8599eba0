"""Functions that are evaluated with the equations: inputs, signals of a control, rates of user states; and the hook of sampled
states, their values after the samples that are due."""

from nivel.kernels.core.status import OK
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import NONE, record_at
from nivel.native.function import stage

# columns of `columns` of inputs and signals; of states, SAMPLED: whether the function is the value after a sample
OUTPUT, FUNCTION = 0, 1
STATE, SAMPLED = 0, 2


@family
def rate_states(machine, number, t):
    """ẋ of each state is a function of time and signals; of sampled ones it is zero, and in statics what a sample changes them by."""
    record = record_at(machine)
    elements, at_rest = record.elements, record.sampled.at_rest[0] == 1
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index = elements.columns[k]
        own = index[STATE]
        if index[SAMPLED] == 0:
            elements.state_rate[own] += evaluate_function(machine, index[FUNCTION], t)
        elif at_rest:
            elements.state_rate[own] += evaluate_function(machine, index[FUNCTION], t) - elements.state[own]
    return OK


@family
def read_inputs(machine, number, t):
    """The value of every input at time t [s], a function of time alone. Inputs come before all elements that may read them."""
    record = record_at(machine)
    elements = record.elements
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index = elements.columns[k]
        record.outputs.value[index[OUTPUT]] = evaluate_function(machine, index[FUNCTION], t)
    return OK


@family
def compute(machine, number, t):
    """Each signal is a function of time and of other signals."""
    record = record_at(machine)
    elements, outputs = record.elements, record.outputs.value
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index = elements.columns[k]
        outputs[index[OUTPUT]] = evaluate_function(machine, index[FUNCTION], t)
    return OK


@stage
def fill_samples(machine, t):
    """Fill `sampled.value` where `sampled.due`, from the state last evaluated and the new values of what is sampled at once before.

    Signals are computed anew. `elements.state` has the new values of what is sampled at once.
    """
    record = record_at(machine)
    sampled, outputs, state = record.sampled, record.outputs.value, record.elements.state
    for k in range(sampled.state.shape[0]):
        if sampled.output[k] != NONE:
            outputs[sampled.output[k]] = evaluate_function(machine, sampled.function[k], t)
        elif sampled.due[k] == 1:
            sampled.value[k] = evaluate_function(machine, sampled.function[k], t)
            if sampled.at_once[k] == 1:
                state[sampled.state[k]] = sampled.value[k]
    return OK


@family
def sample(machine, job, t):
    """The hook SAMPLE: see `fill_samples`."""
    return fill_samples(machine, t)
