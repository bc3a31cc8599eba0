"""What the words know and what the numbers know are the same lists."""

import pickle
import subprocess
import sys
from collections import Counter
from importlib import import_module
from pathlib import Path
from typing import get_args

import pytest

import nivel.integrate
from nivel.cli.run import command as run_command
from nivel.elements.circuits import COMPONENTS
from nivel.elements.control import BLOCKS
from nivel.elements.forces import FORCES
from nivel.elements.joints import JOINTS
from nivel.integrate.catalogue import FAMILIES, INTEGRATORS, all_facts
from nivel.integrate.stabilise import STABILISATIONS
from nivel.judge.after.report import every_check
from nivel.judge.during.failure import FAILURES
from nivel.judge.during.stop import Status
from nivel.kernels.core import status
from nivel.lazy import PLACES, provided
from nivel.machine.settings.run import SimulationSettings
from nivel.methods import known_words
from nivel.motion.catalogue import FORMULATIONS
from nivel.native.entry import Entry
from settings_keywords import kind_of


def words(setting):
    return set(known_words(setting))


@pytest.mark.parametrize(
    "setting", [name for name, field in SimulationSettings.model_fields.items() if kind_of(field).words]
)
def test_help_lists_the_words_that_a_file_may_name(setting):
    assert known_words(setting) == get_args(SimulationSettings.model_fields[setting].annotation)
    (option,) = [each for each in run_command.params if each.name == setting]
    assert tuple(option.words) == known_words(setting)


def test_joints_are_found_by_their_words_without_being_imported():
    assert set(JOINTS) == set(JOINTS.homes)
    script = "import sys; from nivel.elements.joints import JOINTS; JOINTS['revolute']; print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout.split()
    assert "nivel.elements.joints.in_trees" in loaded
    assert not {"numba", "nivel.elements.joints.constraints", "nivel.machine.machine_record"} & {*loaded}


def test_every_method_that_a_file_may_name_exists_and_the_other_way_round():
    steps = Counter((facts.name, facts.machines) for facts in all_facts())
    assert max(steps.values()) == 1
    assert words("integrator") == {name for name, machines in steps if machines == "all"} == {name for name, _ in steps}
    assert words("formulation") == set(FORMULATIONS)
    assert words("stabilisation") == set(STABILISATIONS)


@pytest.mark.parametrize("facts", all_facts(), ids=lambda facts: f"{facts.name}-{facts.machines}")
def test_facts_of_an_integrator_agree_with_each_other(facts):
    assert isinstance(facts.step, Entry)
    assert not (facts.kind == "explicit" and facts.needs != "evaluations")
    assert bool(facts.over_step) == (facts.needs == "whole steps")
    assert not (facts.machines != "all" and facts.residual)
    assert facts.held == 1.0 or facts.kind == "explicit"


def test_steps_take_nothing_from_the_module_of_facts_but_the_record():
    # it is not among the sources that machine code depends on
    for path in Path(nivel.integrate.__path__[0]).glob("*/*.py"):
        for line in path.read_text(encoding="utf-8").splitlines():
            assert "integrate.facts" not in line or line == "from nivel.integrate.facts import IntegratorFacts", path


def test_facts_of_integrators_are_looked_for_wherever_they_stand():
    folder = Path(nivel.integrate.__path__[0])
    stating = {path.parent.name for path in folder.glob("*/*.py") if "\nFACTS = " in path.read_text(encoding="utf-8")}
    assert stating == set(FAMILIES)


def test_an_integrator_loads_no_other_family_than_those_before_it():
    script = "import sys; from nivel.integrate.catalogue import INTEGRATORS; assert INTEGRATORS['rk4'].order == 4; print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout.split()
    assert "nivel.integrate.explicit.runge_kutta" in loaded
    assert not {"numba", "llvmlite", *(f"nivel.integrate.{family}" for family in FAMILIES[1:])} & {*loaded}
    assert len(INTEGRATORS) == len(list(INTEGRATORS)) == len(dict(INTEGRATORS))
    with pytest.raises(KeyError):
        _ = INTEGRATORS["no such integrator"]


def test_forces_are_found_by_their_words_without_being_imported():
    for word, module in FORCES.homes.items():
        assert FORCES[word].add.__module__.rpartition(".")[0] == module.rpartition(".")[0]
    script = "import sys; from nivel.elements.forces import FORCES; FORCES['stop']; print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout.split()
    assert "nivel.elements.forces.actuators" in loaded
    assert not {"numba", "nivel.elements.forces.springs", "nivel.machine.machine_record"} & {*loaded}


def test_components_are_found_by_their_words_without_being_imported():
    for word, kind in COMPONENTS.items():
        assert vars(import_module(COMPONENTS.homes[word]))[kind.record.__name__] is kind.record
    script = "import sys; from nivel.elements.circuits import COMPONENTS; COMPONENTS['orifice']; print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout.split()
    assert "nivel.elements.circuits.restrictions" in loaded
    assert not {"numba", "nivel.elements.circuits.pumps", "nivel.machine.machine_record"} & {*loaded}


@pytest.mark.parametrize(
    ("kinds", "word", "said"),
    [
        (FORCES, "stop", "there is a force of type 'stop' already"),
        (COMPONENTS, "orifice", "there is a component of type 'orifice' already"),
        (BLOCKS, "pid", "there is a block of type 'pid' already"),
    ],
)
def test_a_word_that_is_taken_is_named_with_what_has_it(kinds, word, said):
    with pytest.raises(ValueError, match=f"^{said}$"):
        kinds.register(kinds[word])


def test_components_of_gas_alone_have_no_slopes_by_hand():
    without = {word for word, kind in COMPONENTS.items() if not kind.has_slopes}
    assert without == {word for word, kind in COMPONENTS.items() if not kind.record.liquids}


@pytest.mark.parametrize("subject", PLACES)
def test_every_function_that_a_lower_room_asks_for_exists(subject):
    assert callable(provided(subject))


@pytest.mark.parametrize("facts", all_facts(), ids=lambda facts: f"{facts.name}-{facts.machines}")
def test_facts_of_an_integrator_travel_to_another_process(facts):
    """The solver of a live run is one: it gets the plan, with these facts."""
    assert pickle.loads(pickle.dumps(facts)) is facts


def test_every_status_of_kernels_is_one_of_runs_in_order_and_what_is_said_of_a_failure_stands_in_the_table():
    of_kernels = {name: value for name, value in vars(status).items() if name.isupper()}
    assert {each.name: each.value for each in Status if each >= 0} == of_kernels
    assert [each.value for each in Status] == sorted(each.value for each in Status)
    goes_on = {Status.OK, Status.BUFFER_FULL, Status.BUDGET_SPENT, Status.DONE}
    assert set(FAILURES) == set(Status) - goes_on
    assert list(FAILURES) == sorted(FAILURES)


def _kinds(check):
    return set(check.of) if isinstance(check.of, tuple) else {check.of}


def test_checks_of_a_subject_have_names_and_places_of_their_own():
    checks = every_check()
    for one in checks:
        others = [each for each in checks if each is not one and _kinds(each) & _kinds(one)]
        assert one.name not in {each.name for each in others}
        assert one.place not in {each.place for each in others} or one.place == 0
        assert not (one.quiet and not one.threshold) or one.line in {each.line or each.name for each in others}
