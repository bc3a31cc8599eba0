"""Laws in Python: taken from functions, checked by their text, read, written."""

import functools
import math
from math import tanh
from typing import Annotated

import numpy as np
import pytest

from nivel import PointForce
from nivel.errors import ModelError
from nivel.machine.core.record import Record
from nivel.machine.laws.time_function import ForceComponent, PythonLaw, SpringForce, TimeFunction, varying
from nivel.machine.units.tree import Number

AngleMotion = Annotated[TimeFunction, varying("angle", smooth=True)]

BRAKE = """import math

SLOPE = 3.0

def brake(time, rate, radius, load):
    return -load * radius * math.tanh(SLOPE * rate)
"""
SWING = """def swing(time, amplitude):
    def inner():
        return 5
    return amplitude * time**2, 2 * amplitude * time, 2 * amplitude
"""


class Fields(Record):
    """Fields that a law may stand in."""

    force: ForceComponent = 0.0
    spring: SpringForce = 0.0
    angle: AngleMotion = 0.0


def law(source=BRAKE, function="brake", arguments=("time", "hinge.angle_rate", 0.1, "2 kN"), **more):
    return {"source": source, "function": function, "arguments": list(arguments), **more}


def refused(field, value):
    with pytest.raises(ModelError) as caught:
        Fields(**{field: value})
    return str(caught.value)


def test_arguments_become_si():
    context = {"parameters": {"radius": Number(0.25)}}
    given = law(arguments=["time", "hinge.angle_rate", "radius/2", "2 kN"], file="laws.py")
    read = Fields.model_validate({"force": given}, context=context).force
    assert read == PythonLaw(BRAKE, "brake", ("time", "hinge.angle_rate", 0.125, 2000.0), "laws.py")
    assert read.signals == ("hinge.angle_rate",)


def test_local_symbols_are_arguments_of_spring_laws():
    source = "def pull(length, rate):\n    return 3 * length\n"
    read = Fields(spring=law(source, "pull", ["length", "rate"])).spring
    assert isinstance(read, PythonLaw)
    assert read.arguments == ("length", "rate")
    assert "arguments.0: `length` is neither" in refused("force", law(source, "pull", ["length", "rate"]))


def test_written_and_read_back():
    record = Fields(force=law(file="laws.py"), angle=PythonLaw(SWING, "swing", ("time", "30 deg")))
    assert record.model_dump()["force"] == {
        "source": BRAKE,
        "function": "brake",
        "arguments": ["time", "hinge.angle_rate", 0.1, 2000.0],
        "file": "laws.py",
    }
    assert Fields(**record.model_dump()) == record


@pytest.mark.parametrize(
    ("given", "part"),
    [
        ({"python": "laws.py", "function": "brake"}, "a law in Python needs its text"),
        ({"function": "brake"}, "`source` is missing"),
        ({"source": BRAKE}, "`function` is missing"),
        (law(function=3), "a text was expected, got `3`"),
        (law(source=3), "the text of a Python file was expected"),
        (law(more=1), "the key `more` is not known"),
        ({**law(), "arguments": "time"}, "a list was expected, got `time`"),
        (law(arguments=["time"]), "`brake` takes 4 arguments (time, rate, radius, load); `arguments` has 1"),
        (
            law(arguments=["time", "2*hinge.angle", 1, 2]),
            "arguments.1: `2*hinge.angle`: an argument is `time`, one symbol",
        ),
        (law(arguments=["time", "a.x", "radius", 2]), "arguments.2: `radius` is neither a parameter nor a unit"),
        (law(arguments=["time", "a.x", None, 2]), "got nothing"),
        (law(function="break"), "does not define a function `break` at its top level; did you mean `brake`?"),
        (law(source="x = 1", function="f"), "there are none"),
        (law(source="brake = abs"), "does not define a function `brake` at its top level"),
        (law(source="if True:\n    def brake(): return 1\n"), "at its top level"),
        (law(source="def brake(:\n"), "the Python text, line 1: this is not Python"),
        (law(source="x = 1\ndef brake()\n    return 1", file="laws.py"), "`laws.py`, line 2: this is not Python"),
        (law(source="\0"), "is not Python"),
        (law(source="def brake(*all):\n    return 1"), "takes `*all`; a law has a fixed number of arguments"),
        (law(source="def brake(**all):\n    return 1"), "takes `**all`"),
        (law(source="def brake(a, b, c, *, d):\n    return 1"), "takes `d` by keyword only"),
        (law(source="def brake(a, b, c, d):\n    pass"), "`brake` returns nothing; one number must be returned"),
        (law(source="def brake(a, b, c, d):\n    return a, b"), "`brake` returns 2 numbers in line 2; one number must"),
    ],
)
def test_refused_with_the_reason(given, part):
    assert part in refused("force", given)


def test_invalid_escapes_in_the_text_are_no_warning_of_ours():
    assert Fields(force=law(source='def f():\n    "\\d"\n    return 1', function="f", arguments=()))


@pytest.mark.parametrize(
    ("given", "part"),
    [
        (law(SWING, "swing", ["hinge.angle", 1]), "a driver depends on `time` alone, not on `hinge.angle`"),
        (
            law("def f(time):\n    return 2*time", "f", ["time"]),
            "returns 1 number in line 2; three numbers, (value, rate, acc",
        ),
        (law("def f(time):\n    return time, 1", "f", ["time"]), "returns 2 numbers in line 2"),
    ],
)
def test_drivers_refuse(given, part):
    assert part in refused("angle", given)


def test_results_that_cannot_be_counted_are_accepted():
    for result in ("g(time)", "[*g(time)]", "x"):
        assert Fields(angle=law(f"def f(time):\n    return {result}", "f", ["time"]))


# From functions of this program

GAIN = 3.0
TABLE = (np.float64(1.0), 2)
ADDRESS = {"a": 1}


def half(x: float) -> float:
    return x / 2


def damped(time: float, rate: float) -> float:
    if time > GAIN:
        return half(rate) * TABLE[1]
    return -np.sign(rate) * tanh(rate) + math.pi + max(rate, 0.0) + sum([k + 1 for k in range(2)])


def factorial(n):
    return 1.0 if n < 1 else n * factorial(n - 1)


def reads_address(time):
    return ADDRESS["a"]


@functools.wraps(half)
def wrapped(x):
    return half(x)


def run(law):
    scope: dict = {}
    exec(law.source, scope)
    return scope[law.function]


def test_a_function_takes_along_what_it_uses():
    law = PythonLaw.of(damped, ["time", "hinge.angle_rate"])
    assert law.function == "damped"
    assert law.arguments == ("time", "hinge.angle_rate")
    for arguments in ((1.0, 0.5), (4.0, 0.5)):
        assert run(law)(*arguments) == damped(*arguments)
    assert Fields(force=law).force == law
    assert law.source.count("def half") == 1
    assert "GAIN = 3.0\nTABLE = (1.0, 2,)" in law.source


def test_a_function_may_use_itself_and_be_indented():
    assert run(PythonLaw.of(factorial, ["time"]))(3) == 6.0

    def local(time):
        return 2 * time

    assert run(PythonLaw.of(local, ["time"]))(3) == 6


def test_arguments_are_a_list():
    with pytest.raises(ModelError, match="arguments: a list was expected, got `time`"):
        PythonLaw.of(factorial, "time")
    law = {**PythonLaw.of(factorial, ["time"]).written(), "arguments": "time"}
    assert "a list was expected, got `time`" in refused("force", law)


def test_the_function_under_a_wrapper_is_taken():
    assert run(PythonLaw.of(wrapped, ["time"]))(3) == 1.5


def test_functions_that_cannot_be_taken():
    offset = 3.0

    def uses_offset(time):
        return time + offset

    namespace: dict = {}
    exec("def typed(time):\n    return time", namespace)
    for function, part in [
        (lambda time: time, "is not a function made with `def`"),
        (math.sin, "is not a function made with `def`"),
        (uses_offset, "uses `offset` of the function around it"),
        (reads_address, "uses `ADDRESS`, which stands outside of it"),
        (namespace["typed"], "the text of `typed` cannot be found"),
    ]:
        with pytest.raises(ModelError, match=part):
            PythonLaw.of(function, ["time"])


@pytest.mark.parametrize(
    "text",
    [
        "    if x < 0:\n        raise ValueError\n",
        "    assert x > 0\n",
        "    try:\n        x = 1 / x\n    except ZeroDivisionError:\n        x = 0.0\n",
    ],
    ids=["raise", "assert", "try"],
)
def test_what_compiled_code_would_swallow_is_refused(text):
    with pytest.raises(ModelError, match="knows no"):
        PointForce(name="f", body="a", vector=(PythonLaw(f"def law(x):\n{text}    return x\n", "law", ("time",)), 0, 0))
