"""Python laws as machine code: functions of a row of arguments, real or dual numbers."""

import numpy as np

from nivel.errors import Fault, ModelError
from nivel.kernels.record.hook import FAMILIES
from nivel.machine.laws.python_law import PythonLaw
from nivel.machine.units.tree import TIME
from nivel.native.duals import LANES
from nivel.native.library import address_of_law
from nivel.native.signature import LAW
from nivel.native.workers import NO_COMPILER, CompilationError

# Functions of the text are compiled when the law calls them; division by zero gives infinity, as in the rest of a run. On dual numbers the
# text runs as it is written, or where it calls what these have not, its slopes are differences of order four, whose steps are shares of
# the arguments.
LAW_TEXT = """{source}


import types as _nivel_python_types

import numba as _nivel_numba
import numpy as _nivel_numpy

from nivel.kernels.core.lanes import slope as _nivel_slope, unit as _nivel_unit

for _nivel_name, _nivel_part in list(globals().items()):
    if isinstance(_nivel_part, _nivel_python_types.FunctionType) and _nivel_part.__module__ == __name__:
        globals()[_nivel_name] = _nivel_numba.njit(error_model="numpy")(_nivel_part)


def nivel_law(x):
{body}
"""
SHARE = 1e-4


def dual_address(address: int) -> int:
    """Address of the code on dual numbers of the function at `address`. That of a law is compiled when it is asked for, from the first of
    its texts that can be compiled."""
    if address in FAMILIES:
        return FAMILIES[address].dual_address
    first, *others = _twins[address]
    for other in others:
        try:
            return address_of_law(first, LAW.on("twin"))
        except CompilationError:  # there is another way
            first = other
    return address_of_law(first, LAW.on("twin"))


def law_address(law: PythonLaw, *, motion: bool) -> int:
    """Address of the code of a Python law; that of a motion returns value, rate and acceleration.

    Raises ModelError where it cannot be compiled.
    """
    try:
        address = _real_address(_law_text(law, motion=motion))
    except CompilationError as problem:
        where = f" in {law.file}" if law.file else ""
        message = f"the law `{law.function}`{where} cannot be compiled: {_telling(problem)}"
        raise ModelError(Fault.at("", message)) from problem
    _twins[address] = _dual_law_texts(law, motion=motion)
    return address


def _law_text(law: PythonLaw, *, motion: bool) -> str:
    """The module that is compiled: the law's own text and the C function that calls it."""
    count = len(law.arguments)
    call = f"{law.function}({', '.join(f'x[{n}]' for n in range(count))})"
    if motion:
        lines = [
            f"value, rate, acceleration = {call}",
            f"x[{count}] = rate",
            f"x[{count + 1}] = acceleration",
            "return value",
        ]
    else:
        lines = [f"return {call}"]
    return _module(law, lines)


def _module(law: PythonLaw, lines: list[str]) -> str:
    return LAW_TEXT.format(source=law.source, body="\n".join(f"    {line}" for line in lines))


def _dual_law_texts(law: PythonLaw, *, motion: bool) -> tuple[str, ...]:
    """Modules of the law on dual arguments, the best one first. Motions depend on the time alone: their slopes are what they return."""
    count = len(law.arguments)

    def call(argument: str) -> str:
        return f"{law.function}({', '.join(argument.format(n=n) for n in range(count))})"

    if motion:
        lines = [
            f"value, rate, acceleration = {call('x[{n}].real')}",
            "beyond = x[0] - x[0].real",
            f"x[{count}] = rate + acceleration * beyond",
            f"x[{count + 1}] = acceleration",
            "return value + rate * beyond",
        ]
        return (_module(law, lines),)

    def beside(steps: str) -> str:
        return call("x[{n}].real + " + steps + " * reach * _nivel_slope(x[{n}], k)")

    lines = [
        f"value = {call('x[{n}].real')} + _nivel_unit(0, 0.0)",
        f"for k in range({LANES}):",
        "    reach = _nivel_numpy.inf",
        f"    for n in range({count}):",
        "        along = abs(_nivel_slope(x[n], k))",
        "        if along != 0.0:",
        f"            reach = min(reach, {SHARE} * max(abs(x[n].real), {SHARE}) / along)",
        "    if reach < _nivel_numpy.inf:",
        f"        near = {beside('1.0')} - {beside('-1.0')}",
        f"        far = {beside('2.0')} - {beside('-2.0')}",
        "        value += _nivel_unit(k, (8.0 * near - far) / (12.0 * reach))",
        "return value",
    ]
    return _module(law, [f"return {call('x[{n}]')}"]), _module(law, lines)


def false_derivative(law: PythonLaw, end: float) -> str:
    """What is wrong with the rate or the acceleration that the law of a motion returns, by differences at times up to `end` [s].

    Empty where both fit their functions at nine of ten times: at corners they may not.
    """
    function = LAW.function_at(_real_address(_law_text(law, motion=True)))
    count = len(law.arguments)

    def at(time: float) -> tuple[float, float, float]:
        places = [time if argument == TIME else float(argument) for argument in law.arguments]
        arguments = np.array([*places, 0.0, 0.0])
        value = function(arguments)
        return value, float(arguments[count]), float(arguments[count + 1])

    grid = np.linspace(0.0, end, 2001)
    values, rates = np.array([at(t)[:2] for t in grid]).T
    jump = np.abs(np.diff(values)) - 2.0 * grid[1] * np.abs(rates).max()
    if jump.max() > 1e-9 * np.abs(values).max():
        k = int(np.argmax(jump))
        return f"its value jumps from {values[k]:.6g} to {values[k + 1]:.6g} at about t = {grid[k + 1]:.6g} s"
    h = 1e-6 * end
    triples = [(at(t - h), at(t), at(t + h)) for t in np.random.default_rng(1).uniform(0.01, 0.99, 60) * end]
    for order, name in ((1, "rate"), (2, "acceleration")):
        found = np.array([(after[order - 1] - before[order - 1]) / (2 * h) for before, _, after in triples])
        given = np.array([here[order] for _, here, _ in triples])
        size = max(np.abs(found).max(), np.abs(given).max())
        values = max(abs(here[order - 1]) for _, here, _ in triples)
        wrong = ~(np.abs(found - given) <= 1e-3 * size + 1e-9 * values / h)
        if wrong.mean() > 0.1:
            k = int(np.argmax(wrong))
            what = "value" if order == 1 else "rate"
            return f"its {name} is {given[k]:.6g} where the {what} it returns changes by {found[k]:.6g} a second"
    return ""


def _telling(problem: CompilationError) -> str:
    """The part of an error of the compiler that says what is wrong."""
    lines = [line.strip() for line in str(problem).splitlines() if line.strip()]
    noise = ("Failed in nopython", "During: ", "This error may", "- argument", "File ", "<source")
    told = [line for line in lines if not line.startswith(noise) and set(line) - set("^~ ")]
    return f"{problem.kind}: {' '.join(told)[:400]}" if told else problem.kind


# texts of the code on dual numbers for the addresses handed out
_twins: dict[int, tuple[str, ...]] = {}


def _real_address(text: str) -> int:
    try:
        return address_of_law(text, LAW)
    except CompilationError as problem:
        if problem.kind == NO_COMPILER:
            raise ModelError(Fault.at("", f"Python laws are compiled, and {problem}")) from None
        raise
