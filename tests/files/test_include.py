"""Machines made of several files: `include`, mass properties, laws in Python."""

import pytest
from base_machine import write_files

from nivel import PythonLaw
from nivel.errors import ModelError
from nivel.files import locate, parse_machine, read_machine, write_machine

BALL = "{mass: 1, shape: {type: sphere, radius: size}}"


def written(folder, **texts):
    """Files in `folder`; the first is the main one. Double underscores stand for folders."""
    for name, text in texts.items():
        file = folder / f"{name.replace('__', '/')}.yaml"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(f"format: 1\n{text}\n", encoding="utf-8")
    return folder / f"{next(iter(texts))}.yaml"


def names(records):
    return [record.name for record in records]


def faults(file, **options):
    with pytest.raises(ModelError) as caught:
        read_machine(file, **options)
    return caught.value.faults


def test_sections_are_merged_and_included_elements_come_first(tmp_path):
    file = written(
        tmp_path,
        main=f"include: [a.yaml, b.yaml]\nbodies:\n  own: {BALL}",
        a=f"bodies:\n  first: {BALL}\nparameters: {{size: 10 cm}}",
        b=f"bodies:\n  second: {BALL}\nmarkers: {{tip: {{body: first}}}}",
    )
    machine = read_machine(file)
    assert names(machine.bodies) == ["first", "second", "own"]
    assert names(machine.markers) == ["tip"]
    assert machine.bodies[2].shape.radius == 0.1


@pytest.mark.parametrize("form", ["a.yaml", "[a.yaml]", "{file: a.yaml}", "[{file: a.yaml}]"])
def test_forms(tmp_path, form):
    file = written(tmp_path, main=f"include: {form}", a="bodies: {a: {mass: 1, shape: {type: sphere, radius: 1}}}")
    assert names(read_machine(file).bodies) == ["a"]


def test_paths_are_relative_to_the_file_that_names_them(tmp_path):
    file = written(
        tmp_path,
        main="include: parts/a.yaml",
        parts__a="include: more/b.yaml",
        parts__more__b="bodies: {b: {mass_properties: b.json}}",
    )
    (tmp_path / "parts/more/b.json").write_text('{\n\t"mass": "2 kg",\n\t"inertia": [1, 1, 1]\n}', encoding="utf-8")
    assert read_machine(file).bodies[0].mass == 2


def test_only_some_sections_and_nothing_of_the_whole_machine(tmp_path):
    part = "name: part\ngravity: [0, 0, 1]\nsimulation: {step: 1 ms}\nparameters: {size: 1}\n"
    part += f"bodies: {{a: {BALL}}}\nmarkers: {{m: {{body: a}}}}"
    file = written(tmp_path, main="include: {file: part.yaml, only: [bodies]}", part=part)
    machine = read_machine(file)
    assert (machine.name, machine.gravity, machine.markers) == ("main", (0, 0, 0), ())
    assert names(machine.bodies) == ["a"]
    assert read_machine(tmp_path / "part.yaml").gravity == (0, 0, 1)


def test_a_file_that_two_others_include_is_taken_once(tmp_path):
    file = written(
        tmp_path,
        main="include: [a.yaml, b.yaml]",
        a=f"include: common.yaml\nbodies: {{a: {BALL}}}",
        b=f"include: common.yaml\nbodies: {{b: {BALL}}}",
        common="parameters: {size: 10 cm}",
    )
    assert names(read_machine(file).bodies) == ["a", "b"]


def test_two_included_files_with_one_name_are_both_named(tmp_path):
    file = written(
        tmp_path,
        main="parameters: {size: 1}\ninclude: [a.yaml, b.yaml]",
        a=f"bodies: {{a: {BALL}}}",
        b=f"bodies:\n  a: {BALL}",
    )
    (fault,) = faults(file)
    assert (fault.file, fault.line, fault.path) == (str(tmp_path / "b.yaml"), 3, "bodies.a")
    assert fault.message == f"`a` is defined twice; the other stands in {tmp_path / 'a.yaml'}:2:13"


def test_files_that_cannot_be_read(tmp_path):
    file = written(tmp_path, main="include: [folder, a.yaml, b.yaml]\nbodies: {a: {}}", b="[")
    (tmp_path / "folder").mkdir()
    (tmp_path / "a.yaml").write_bytes(b"format: 1\nname: \xff")
    found = {fault.message.split(":")[0]: fault for fault in faults(file)}
    assert found["this is not YAML"].file == str(tmp_path / "b.yaml")
    assert found[f"there is no file `{tmp_path / 'folder'}`"].path == "include.0"
    assert found["the file is not UTF-8 text"].line == 2


def test_values_of_included_files_are_set_from_outside(tmp_path):
    file = written(tmp_path, main="include: [a.yaml]", a="bodies: {a: {mass: 1, inertia: [1, 1, 1]}}", b="bodies: {}")
    assert read_machine(file, overrides={"bodies.a.inertia.2": "1.5"}).bodies[0].inertia.zz == 1.5
    (fault,) = faults(file, overrides={"bodies.b.mass": "2"})
    assert "the name `b` is not known" in fault.message
    assert "at least one body" in faults(file, overrides={"include": "b.yaml"})[0].message


def test_mass_properties_give_way_to_values_from_outside(tmp_path):
    file = write_files(tmp_path)
    options = {"allow_code": True}
    assert read_machine(file, **options).bodies[2].mass == 3
    assert read_machine(file, overrides={"bodies.disc.mass": "4 kg"}, **options).bodies[2].mass == 4
    inertia = read_machine(file, overrides={"bodies.disc.inertia.2": 0.015}, **options).bodies[2].inertia
    assert (inertia.xx, inertia.zz) == (0.01, 0.015)
    (tmp_path / "other.yaml").write_text("mass: 5 kg\ninertia: [1, 1, 1]", encoding="utf-8")
    assert read_machine(file, overrides={"bodies.disc.mass_properties": "other.yaml"}, **options).bodies[2].mass == 5


def test_the_text_of_a_law_is_in_the_machine(tmp_path):
    machine = read_machine(write_files(tmp_path), allow_code=True)
    (law,) = [force.effort for force in machine.forces if force.name == "brake"]
    assert isinstance(law, PythonLaw)
    assert law.source.startswith("def brake(")
    assert law.function == "brake"
    assert law.arguments == ("time", "axle.angle_rate", 2000.0)
    assert law.file.endswith("laws.py")


def test_the_whole_machine_is_written_as_one_file(tmp_path):
    machine = read_machine(write_files(tmp_path), allow_code=True)
    text = write_machine(machine)
    assert parse_machine(text, allow_code=True) == machine
    with pytest.raises(ModelError, match="--allow-code"):
        parse_machine(text)


def test_elements_of_other_files_are_located_where_they_are_named(tmp_path):
    text = write_files(tmp_path).read_text(encoding="utf-8")
    lines = text.splitlines()
    assert lines[locate(text, "bodies.left_shank.mass")[0] - 1].startswith("  left: {")
    assert lines[locate(text, "joints.r_knee")[0] - 1].startswith("  right: {")
    assert lines[locate(text, "bodies.ball")[0] - 1].startswith("include:")
    assert lines[locate(text, "bodies.shaft.mass")[0] - 1].startswith("  shaft: {")


def test_many_files_have_an_end(tmp_path):
    texts = {f"f{at}": f"include: f{at + 1}.yaml" for at in range(40)}
    assert "more than 20 files lead from one to the next" in faults(written(tmp_path, **texts))[0].message
    twice = {f"g{at}": f"assemblies: {{a: {{file: g{at + 1}.yaml}}, b: {{file: g{at + 1}.yaml}}}}" for at in range(18)}
    found = faults(written(tmp_path, **twice, g18="bodies: {a: {mass: 1, inertia: [1, 1, 1]}}"))
    assert any("made of more than 2000 files" in fault.message for fault in found)
