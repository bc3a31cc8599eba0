"""Whatever public functions are called with, a ModelError says what was wrong, and NumPy scalars are the numbers that they are."""

import inspect
import json
import subprocess
import sys
from functools import partial
from typing import Any, Unpack

import numpy as np
import pytest

import nivel
import synthetic_run as pendulum
from nivel.api import Machine
from nivel.errors import ModelError
from nivel.results import Memory, Result
from nivel.results.comparison import Comparison, Row
from nivel.results.stress import RecoveredBody
from nivel.settings import KinematicsSettingsDict
from nivel.words.arguments import checked_arguments
from wrong_values import ODD, WRONG, told_or_done

ARM = {"name": "arm", "mass": 1, "inertia": [1, 1, 1]}


def faults_of(call):
    with pytest.raises(ModelError) as caught:
        call()
    return {fault.path: fault.message for fault in caught.value.faults}


def public_methods():
    """(class, name, function) of every method that people call."""
    for kind in (Machine, Result, RecoveredBody, Comparison):
        for name, found in vars(kind).items():
            function = getattr(found, "__func__", found)
            if inspect.isfunction(function) and (not name.startswith("_") or name == "__getitem__"):
                yield pytest.param(kind, name, id=f"{kind.__name__}.{name}")


@pytest.fixture(scope="module")
def machine():
    return Machine("one", bodies=[ARM])


@pytest.fixture
def result():
    sink = Memory()
    sink.begin(pendulum.header())
    sink.take(pendulum.frames(np.linspace(0.0, 2.0, 21)))
    trust = pendulum.judged(sink.result()).to_json()
    return sink.close({"outcome": "done", "trust": trust, "timing": json.dumps({"steps": 20})})


@pytest.fixture
def comparison():
    return Comparison("one", 1.0, 0.1, 1, (Row("rk4", "newton-euler", "absolute", "", "direct"),), (), None, 1.0, 1.0)


@pytest.mark.parametrize(("kind", "name"), [*public_methods()])
def test_every_argument_of_every_method_is_checked(kind, name):
    """Arguments without a type are the object itself; `name in result` and the like take anything."""
    method = getattr(kind, name)
    bound = inspect.ismethod(method)
    parameters = [each for each in inspect.signature(method).parameters.values() if each.name != "self"]
    itself = () if bound else (object(),)
    fixed = [
        each for each in parameters if each.kind is not each.VAR_KEYWORD
    ]  # what settings are is told by their record
    needed = {each.name: ODD for each in fixed if each.default is each.empty and each.kind is not each.VAR_POSITIONAL}
    for each in fixed:
        if each.annotation in ("Any", Any):
            continue  # told where it is used
        if each.kind is each.VAR_POSITIONAL:
            given, named = (*(["x"] if each is not parameters[0] else []), ODD), {}
        else:
            given, named = (), {**needed, each.name: ODD}
        told = faults_of(lambda given=given, named=named: method(*itself, *given, **named))
        assert told[each.name].endswith("was expected, got `Odd()`")


@pytest.mark.parametrize(("kind", "name"), [*public_methods()])
def test_an_argument_that_no_method_has_is_told(kind, name):
    method = getattr(kind, name)
    if not inspect.signature(method).parameters.keys() - {"self"}:
        return  # what takes nothing at all leaves that to Python
    if any(each.kind is each.VAR_KEYWORD for each in inspect.signature(method).parameters.values()):
        return  # what takes settings of a run tells it with them
    itself = () if inspect.ismethod(method) else (object(),)
    assert f"{name}: the argument `nonsense` is not known" in faults_of(lambda: method(*itself, nonsense=1))[""]


def test_all_wrong_arguments_are_told_at_once(machine):
    told = faults_of(lambda: machine.simulate(durration=3, out=3, force=1, listener=2, corrector=3, step=[1]))
    assert told == {
        "": "simulate: the argument `durration` is not known; did you mean `duration`?",
        "out": "the name of a file was expected, got `3`",
        "force": "true or false was expected, got `1`",
        "listener": "a Listener was expected, got `2`",
        "corrector": "a mapping with texts as keys was expected, got `3`",
        "step": "a number or a text was expected, got a list",
    }
    told = faults_of(lambda: machine.compare(steps=[ODD], cut=3, repeat=2.5))
    assert told == {
        "steps": "a number, a text or a list of numbers or texts was expected, got a list",
        "cut": "a text or a list of texts was expected, got `3`",
        "repeat": "a whole number was expected, got `2.5`",
    }


def test_missing_and_superfluous_arguments_are_told(machine):
    assert faults_of(nivel.load) == {"path": "load needs this: the name of a file"}
    assert (
        "takes only path and overrides without a name, got `c` besides"
        in faults_of(lambda: nivel.load("a", {}, "c"))[""]
    )
    assert faults_of(lambda: machine.simulate(3)) == {"": "simulate takes its arguments by name, got `3` besides"}
    assert faults_of(lambda: nivel.load("a", path="b")) == {
        "path": "load is given this twice, with its name and without"
    }
    assert faults_of(lambda: nivel.Body("arm")) == {"": "Body takes its arguments by name, got `arm` besides"}
    assert faults_of(lambda: Machine("one", bodis=[ARM])) == {
        "": "Machine: the argument `bodis` is not known; did you mean `bodies`?"
    }


@pytest.mark.parametrize("value", WRONG, ids=lambda value: repr(value)[:20])
def test_any_value_of_any_argument_ends_in_words(machine, result, comparison, value, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    calls = [
        *[(function, {}, "path") for function in (nivel.load, nivel.open_result, machine.save, result.report)],
        *[
            (function, {}, "path")
            for function in (result.export_csv, result.export_scene, comparison.to_csv, comparison.to_json)
        ],
        (nivel.load, {"path": "none.yaml"}, "overrides"),
        (result.export_csv, {"path": "a.csv"}, "select"),
        *[(function, {}, "name") for function in (result.array, result.units, result.selection, result.__getitem__)],
        (result.array, {"name": "arm.position"}, "frames"),
        (result.mode, {}, "number"),
        (result.recover, {}, "body"),
        (result.recover, {}, "file"),
        (result.view, {}, "height"),
        (Comparison.from_json, {}, "text"),
        (machine.with_settings, {}, "settings"),
        *[(lambda **given: machine.with_settings(given), {}, name) for name in nivel.SimulationSettings.model_fields],
        (nivel.Table, {"values": (0, 1)}, "times"),
        (nivel.Table(times=(0, 1), values=(0, 1)), {}, "at"),
        (nivel.Expression, {}, "text"),
        (nivel.PythonLaw.of, {}, "function"),
        (nivel.PythonLaw, {"source": "def f():\n    return 1.0\n", "function": "f"}, "arguments"),
    ]
    for function, given, name in calls:
        told_or_done(lambda function=function, given=given, name=name: function(**given, **{name: value}))
    assert (value in result) is False


@pytest.mark.parametrize("step", [np.float32(0.5), np.float16(0.5), np.float64(0.5), np.array(0.5)], ids=repr)
def test_numpy_scalars_are_numbers(machine, step):
    assert machine.with_settings({"step": step, "tolerance": step}).record.simulation == nivel.SimulationSettings(
        step=0.5, tolerance=0.5
    )
    settings = nivel.SimulationSettings(corrector={"most_iterations": np.int16(7), "tolerance": step})
    assert (settings.corrector.most_iterations, settings.corrector.tolerance) == (7, 0.5)
    assert nivel.Body(**ARM, hold=np.bool_(True)).hold is True


def test_steps_of_a_grid_may_be_arrays():
    from nivel.analysis.compare.compare_grid import Axes

    assert Axes(steps=np.array([0.5, 0.25])).steps == (0.5, 0.25)
    assert Axes(steps=np.float32(0.5), tolerances=[np.float32(0.5)]).steps == (0.5,)


@pytest.mark.parametrize("value", [True, np.bool_(True)])
@pytest.mark.parametrize(
    "settings", [{"tolerance": ...}, {"corrector": {"most_iterations": ...}}, {"penalty": {"factor": ...}}], ids=str
)
def test_true_is_no_number(settings, value):
    def put(each):
        return {key: put(inner) for key, inner in each.items()} if isinstance(each, dict) else value

    (message,) = faults_of(lambda: nivel.SimulationSettings(**put(settings))).values()
    assert message == "a number was expected, got `true`"


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"duration": "0 kg"}, "`0 kg` is a mass (kg); a time (s) was expected"),
        ({"duration": -1}, "a time greater than zero was expected, got `-1`"),
        ({"duration": "-1 s"}, "a time greater than zero was expected, got `-1 s`"),
        ({"modes": "nan"}, "a whole number from 0 to 1000 was expected, got `nan`"),
        ({"buckling": 10**400}, "a whole number from 0 to 1000 was expected, got a number of more than 40 digits"),
        ({"coordinates": ""}, "'' is not one of auto, absolute, relative"),
        ({"tolerance": np.float32(1.0)}, "a number from 1e-14 to 1e-2 was expected, got `1.0`"),
    ],
)
def test_numbers_of_statics_that_are_none(machine, given, message):
    assert faults_of(lambda: machine.statics(**given)) == {f"statics.{next(iter(given))}": message}


def test_the_signature_stays_what_it_was():
    def plain(first: int, *, second: str = "") -> None:
        """Says what it does."""

    wrapped = checked_arguments(plain)
    assert inspect.signature(wrapped) == inspect.signature(plain)
    assert (wrapped.__name__, wrapped.__doc__) == ("plain", "Says what it does.")


def test_keys_of_settings_stand_in_the_signature_whether_annotations_are_put_off_or_not():
    def read(**settings: Unpack[KinematicsSettingsDict]) -> None: ...

    def put_off(**settings: "Unpack[KinematicsSettingsDict]") -> None: ...

    shown = inspect.signature(checked_arguments(read))
    assert set(shown.parameters) == set(KinematicsSettingsDict.__annotations__)
    assert shown == inspect.signature(checked_arguments(put_off))
    for function in (read, put_off):
        assert "positions" in "".join(faults_of(partial(checked_arguments(function), position=3)).values())


def test_checking_arguments_loads_no_compiler():
    code = "import sys, nivel.words.arguments; print(*{'numba', 'numpy', 'pydantic'} & set(sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == ""
