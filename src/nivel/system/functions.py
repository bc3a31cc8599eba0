"""Functions of time for the kernels: constants and tables as numbers, expressions as compiled code."""

from __future__ import annotations

import hashlib
import importlib.util
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from nivel.kernels import cache
from nivel.kernels.function import COMPILED, CONSTANT, TABLE
from nivel.kernels.record import Functions
from nivel.machine.arithmetic import Call, Name, Negative, Node, Number, Operation, Time, bind
from nivel.machine.grammar import parse
from nivel.machine.time_function import Expression, Table

TEMPLATE = '''"""A function of time written by nivel from an expression of a machine file."""

import numpy as np
from numba import cfunc, types


@cfunc(types.float64(types.float64), cache=True, error_model="numpy")
def law(time):
    return {source}
'''


def function_table(functions: Sequence[float | Table | Expression]) -> Functions:
    """Table of `functions` in their order. Expressions are compiled, or loaded from the cache."""
    count = len(functions)
    kind = np.zeros(count, dtype=np.uint32)
    value = np.zeros(count)
    address = np.zeros(count, dtype=np.uint64)
    table = np.zeros((count, 2), dtype=np.uint32)
    times: list[float] = []
    values: list[float] = []
    for k, function in enumerate(functions):
        if isinstance(function, Table):
            kind[k] = TABLE
            table[k] = len(times), len(times) + len(function.times)
            times += function.times
            values += function.values
        elif isinstance(function, Expression):
            kind[k] = COMPILED
            address[k] = compiled_address(function)
        else:
            kind[k] = CONSTANT
            value[k] = function
    return Functions(kind, value, table, np.array(times, dtype=float), np.array(values, dtype=float), address)


def compiled_address(expression: Expression) -> int:
    """Address of the machine code of an expression of `time`.

    The code is a module named by its content in the cache directory: a function made from a string could not be cached.
    """
    return int(_module(TEMPLATE.format(source=source(bind(parse(expression.text), {})))).law.address)


SPELLING = {"asin": "arcsin", "acos": "arccos", "atan": "arctan", "atan2": "arctan2"}


def source(node: Node) -> str:
    """Python source of an arithmetic tree for the compiler; `max` and `min` of many arguments are nested."""
    match node:
        case Number(value, _):
            return f"({value!r})"
        case Time():
            return "time"
        case Negative(operand):
            return f"(-{source(operand)})"
        case Operation(symbol, left, right):
            return f"({source(left)} {symbol} {source(right)})"
        case Call(("min" | "max") as function, (first, *others)):
            text = source(first)
            for other in others:
                text = f"np.{function}imum({text}, {source(other)})"
            return text
        case Call(function, arguments):
            return f"np.{SPELLING.get(function, function)}({', '.join(source(argument) for argument in arguments)})"
        case Name(text):
            raise ValueError(f"the name {text} is not bound")


def _module(text: str) -> Any:
    name = f"law_{hashlib.sha256(text.encode()).hexdigest()[:20]}"
    if name in sys.modules:
        return sys.modules[name]
    path = Path(cache.directory()) / f"{name}.py"
    if not path.exists():
        draft = path.with_suffix(f".{id(text)}.tmp")
        draft.write_text(text)
        draft.replace(path)
    spec = importlib.util.spec_from_file_location(name, path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module
