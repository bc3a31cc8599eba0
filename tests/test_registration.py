"""What the words know and what the numbers know are the same lists."""

from typing import get_args

import pytest

from nivel.cli.options import METHODS
from nivel.integrate.catalogue import INTEGRATORS
from nivel.integrate.loop import workspace
from nivel.integrate.stabilise.catalogue import STABILISATIONS
from nivel.integrate.variable_order import variable_workspace
from nivel.kernels.hydraulics import tangent
from nivel.machine.forces import FORCES as RECORDS
from nivel.machine.hydraulics import COMPONENTS as COMPONENT_RECORDS
from nivel.machine.joints.joint import JOINT_COORDINATES, JointType
from nivel.machine.settings import SimulationSettings
from nivel.methods import CHOOSING, EITHER, known_words
from nivel.motion.catalogue import FORMULATIONS
from nivel.results.pages import MAKERS, page_maker
from nivel.system.forces import FORCES
from nivel.system.hydraulics.components import COMPONENTS
from nivel.system.hydraulics.tangent import DERIVED, NUMBERS
from nivel.system.joints.joints import JOINTS


def words(setting):
    return set(known_words(setting))


@pytest.mark.parametrize("setting", METHODS)
def test_help_lists_the_words_that_a_file_may_name(setting):
    assert known_words(setting) == get_args(SimulationSettings.model_fields[setting].annotation)


def test_every_joint_that_a_file_may_name_is_built_and_the_other_way_round():
    assert set(get_args(JointType)) == set(JOINTS)
    for name, joint in JOINTS.items():
        assert tuple(coordinate.name for coordinate in joint.coordinates) == JOINT_COORDINATES[name]


def test_every_method_that_a_file_may_name_exists_and_the_other_way_round():
    assert words("integrator") == set(INTEGRATORS)
    assert set(CHOOSING) == {name for name, facts in INTEGRATORS.items() if facts.chooses_steps}
    assert set(EITHER) == {name for name, facts in INTEGRATORS.items() if facts.optional_control}
    assert words("formulation") == set(FORMULATIONS)
    assert words("stabilisation") == set(STABILISATIONS)


def test_multistep_methods_get_the_rows_and_numbers_that_they_use():
    for name, facts in INTEGRATORS.items():
        if name in ("adams", "gear", "bdf"):
            assert (facts.stages, facts.numbers) == (variable_workspace.ROWS, variable_workspace.NUMBERS)
        elif name.startswith(("ab", "am", "gear")):
            assert (facts.stages, facts.numbers) == (workspace.ROWS, workspace.NUMBERS)


def test_forces_have_the_types_that_the_builder_knows():
    assert {record.model_fields["type"].default for record in RECORDS} == set(FORCES)


def test_components_have_the_types_that_the_builder_knows():
    assert {record.model_fields["type"].default for record in COMPONENT_RECORDS} == set(COMPONENTS)


def test_every_slope_by_hand_has_one_number():
    for kind in COMPONENTS.values():
        assert all(NUMBERS[family] == number for family, number in (kind.slopes or {}).items())
    assert [NUMBERS[family] for family in DERIVED] == list(range(tangent.PIPE + 1))


@pytest.mark.parametrize("page", MAKERS)
def test_every_page_of_a_result_has_a_maker(page):
    assert callable(page_maker(page))
