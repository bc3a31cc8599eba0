"""Settings stand once, in their records: keywords, options, tables and schema follow from these."""

import inspect
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, get_args, get_origin, get_type_hints

import click
import pytest

import nivel
import nivel.settings
from nivel.api import Machine
from nivel.cli import COMMANDS, main
from nivel.files.schema import schema
from nivel.words.arguments import checked_arguments
from settings_keywords import all_keywords, kind_of, meaning_of, module, option_of
from settings_tables import TABLE, with_tables

ROOT = Path(nivel.__file__).parent
DOCS = Path(__file__).parents[2] / "docs"
PAGES = [page for page in sorted(DOCS.rglob("*.md")) if TABLE.search(page.read_text(encoding="utf-8"))]
USED_BY = {
    "RunSettingsDict": (Machine.simulate,),
    "SweepSettingsDict": (nivel.sweep,),
    "MachineSweepSettingsDict": (Machine.sweep,),
    "StepSettingsDict": (Machine.start,),
    "CompareSettingsDict": (Machine.compare,),
    "StaticsSettingsDict": (Machine.statics,),
    "KinematicsSettingsDict": (Machine.kinematics,),
    "InverseSettingsDict": (Machine.inverse,),
    "LineariseSettingsDict": (Machine.linearise,),
}
COMMAND_OF = {
    "RunSettingsDict": ("run", "replay"),
    "CompareSettingsDict": ("compare",),
    "StaticsSettingsDict": ("statics",),
    "KinematicsSettingsDict": ("kinematics",),
    "InverseSettingsDict": ("inverse",),
    "LineariseSettingsDict": ("linearise",),
}


def test_the_keywords_are_those_of_the_records():
    written = (ROOT / "settings.py").read_text(encoding="utf-8")
    assert written == module(), "python packaging/write_settings.py"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_tables_of_a_page_are_those_of_the_records(page):
    text = page.read_text(encoding="utf-8")
    assert text == with_tables(text), "python packaging/write_settings.py"


def test_every_analysis_has_its_table():
    tabled = {found[3] for page in PAGES for found in TABLE.finditer(page.read_text(encoding="utf-8"))}
    assert tabled >= {*COMMAND_OF}


@pytest.mark.parametrize("keywords", all_keywords(), ids=lambda keywords: keywords.name)
def test_python_takes_every_setting_and_shows_it(keywords):
    assert [*get_type_hints(getattr(nivel.settings, keywords.name))] == [*keywords.fields]
    for function in USED_BY[keywords.name]:
        shown = inspect.signature(function).parameters
        assert {*keywords.fields} <= {*shown}
        assert all(shown[name].kind is inspect.Parameter.KEYWORD_ONLY for name in keywords.fields)


@pytest.mark.parametrize(("name", "command"), [(name, each) for name, its in COMMAND_OF.items() for each in its])
def test_every_setting_that_is_no_mapping_is_an_option(name, command):
    (keywords,) = [each for each in all_keywords() if each.name == name]
    options = {each.name: each for each in main.get_command(click.Context(main), command).params}
    for key, field in keywords.fields.items():
        is_part = kind_of(field).type.startswith("Mapping") and not option_of(key, field)
        assert (key in options) == (not is_part)
        if key in options:
            assert meaning_of(field)[1:] in options[key].help
            assert tuple(options[key].words) == kind_of(field).words


def test_no_command_lists_a_setting_by_hand():
    """An option that has the name of a setting of the command's analysis is that of the setting."""
    for name, commands in COMMAND_OF.items():
        keys = get_type_hints(getattr(nivel.settings, name))
        for command in commands:
            its = [each for each in main.get_command(click.Context(main), command).params if each.name in keys]
            assert {type(each).__name__ for each in its} == {"SettingOption"}
    assert {each for commands in COMMAND_OF.values() for each in commands} <= {*COMMANDS}


def test_the_schema_tells_meaning_and_unit_of_every_setting_of_a_run():
    told = schema()["$defs"]["SimulationSettings"]["properties"]
    for key, field in all_keywords()[0].fields.items():
        its = told[key]
        assert (field.description or "") in its["description"]
        if kind_of(field).unit and its.get("anyOf", [{}])[-1].get("type") != "null":
            assert its["description"].endswith("(a time in s, or with a unit)")


def test_settings_that_are_none_are_not_given():
    machine = nivel.Machine("m", bodies=[{"name": "b", "mass": 1, "inertia": [1, 1, 1]}])
    steps = machine.simulate(duration=0.01, step=None, integrator=None, verify=False)
    assert (len(steps.time), steps.settings["integrator"], steps.settings["step"]) == (1001, "dopri5", 1e-3)


def test_words_of_settings_are_told_by_their_reader():
    """The nearest word is told, not the list of all."""
    machine = nivel.Machine("m", bodies=[{"name": "b", "mass": 1, "inertia": [1, 1, 1]}])
    with pytest.raises(nivel.ModelError, match="did you mean `dopri5`"):
        machine.simulate(integrator="dopri6")
    with pytest.raises(nivel.ModelError, match="a text was expected, got `3`"):
        machine.simulate(integrator=3)
    with pytest.raises(nivel.ModelError, match="did you mean `duration`"):
        machine.sweep({"bodies.b.mass": [1, 2]}, durration=3)


def test_arguments_of_a_mapping_stand_before_other_keywords():
    @checked_arguments
    def plain(first: int, *, last: int = 0, **rest: object) -> None: ...

    assert [*inspect.signature(plain).parameters] == ["first", "last", "rest"]
    assert [*inspect.signature(Machine.start).parameters][:3] == ["self", "step", "output_interval"]


@pytest.mark.parametrize("keywords", all_keywords(), ids=lambda keywords: keywords.name)
def test_types_of_keywords_take_what_records_take(keywords):
    """A list where the record holds several, a text with a unit where it holds a quantity, and None for what is not given."""
    for name, hint in get_type_hints(getattr(nivel.settings, keywords.name), include_extras=True).items():
        bare = hint.__origin__ if get_origin(hint) is Annotated else hint
        kind, kinds = kind_of(keywords.fields[name]), get_args(bare)
        assert type(None) in kinds or kind.type == "Any"
        assert any(get_origin(each) is Sequence for each in kinds) == kind.type.startswith("Sequence")
        assert not kind.unit or {float, str} <= {*kinds}
