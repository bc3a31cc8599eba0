"""Faults in machines of several files: each is found in its file, at its line, with its element and what would be right."""

import pytest
from base_machine import FILES, faults_of_full, write_files

from nivel.errors import ModelError
from nivel.files import read_machine

M, P, L, D = "machine", "parts", "leg", "disc"

# file; what stands there → what is written instead; lines further down; the element; part of the message
FAULTS = {
    "density of feathers": (P, "mass: 1}", "mass: 1 mg}", 0, "bodies.ball.mass", "a slip of a unit?"),
    # includes
    "file that is not there": (M, "include: [parts.yaml]", "include: [part.yaml]", 0, "include.0", "did you mean"),
    "include of a number": (
        M,
        "include: [parts.yaml]",
        "include: 5",
        0,
        "include",
        "the name of a file was expected, got `5`",
    ),
    "include of an unknown key": (
        M,
        "include: [parts.yaml]",
        "include: {fil: parts.yaml}",
        0,
        "include.fil",
        "did you mean `file`",
    ),
    "only an unknown section": (
        M,
        "[parts.yaml]",
        "{file: parts.yaml, only: [bodys]}",
        0,
        "include.only",
        "did you mean `bodies`",
    ),
    "file that includes itself": (
        P,
        "format: 1",
        "format: 1\ninclude: parts.yaml",
        1,
        "include",
        "leads back to itself: parts.yaml → parts.yaml",
    ),
    "files that include each other": (
        P,
        "format: 1",
        "format: 1\ninclude: machine.yaml",
        1,
        "include",
        "machine.yaml → parts.yaml → machine.yaml",
    ),
    "no format": (P, "format: 1\n", "", 0, "", "`format: 1` is missing"),
    "other format": (P, "format: 1", "format: 2", 0, "format", "this nivel reads format 1"),
    "gravity of a part": (
        P,
        "format: 1",
        "format: 1\ngravity: [0, 0, -9.81]",
        1,
        "gravity",
        "belongs to the main file",
    ),
    "settings of a part": (
        P,
        "format: 1",
        "format: 1\nsimulation: {step: 1 ms}",
        1,
        "simulation",
        "only: [bodies, joints]",
    ),
    "fault in an included file": (
        P,
        "radius: 5 cm",
        "radius: 5 kg",
        0,
        "bodies.ball.shape.radius",
        "a length (m) was expected",
    ),
    "key in an included file": (
        P,
        "radius: 5 cm",
        "radios: 5 cm",
        0,
        "bodies.ball.shape.radios",
        "did you mean `radius`",
    ),
    "section of an included file": (P, "parameters:", "parameter:", 0, "parameter", "did you mean `parameters`"),
    "YAML of an included file": (P, "radius: 5 cm}", "radius: 5 cm", 1, "", "this is not YAML"),
    "defined twice": (
        P,
        "  ball: {",
        "  frame: {mass: 1, inertia: [1, 1, 1]}\n  ball: {",
        None,
        "bodies.frame",
        "defined twice; the other stands in",
    ),
    # assemblies
    "assembly without a file": (
        M,
        "left: {file: leg.yaml, position",
        "left: {position",
        0,
        "assemblies.left",
        "`file` is missing",
    ),
    "assembly of no file": (
        M,
        "left: {file: leg.yaml",
        "left: {file: legs.yaml",
        0,
        "assemblies.left.file",
        "there is no file",
    ),
    "mirror in no axis": (M, "mirror: y", "mirror: xy", 0, "assemblies.right.mirror", "did you mean `y`"),
    "unknown key of an assembly": (M, "mirror: y", "miror: y", 0, "assemblies.right.miror", "did you mean `mirror`"),
    "place of an assembly": (
        M,
        "position: [0, wide, 0], parameters",
        "position: [0, wide, 3 kg], parameters",
        0,
        "assemblies.left.position.2",
        "a length (m)",
    ),
    "unknown parameter of a part": (
        M,
        "{length: 60 cm}",
        "{lenght: 60 cm}",
        0,
        "assemblies.left.parameters.lenght",
        "did you mean `length`",
    ),
    "parameter of a part at fault": (
        M,
        "{length: 60 cm}",
        "{length: 60 cn}",
        0,
        "assemblies.left.parameters.length",
        "`cn` is neither a parameter nor a unit",
    ),
    "parameter of a part is a mass": (
        M,
        "{length: 60 cm}",
        "{length: 60 kg}",
        None,
        "bodies.shank.position.2",
        "`-1.4*length` is a mass (kg); a length (m) was expected (in assemblies.left, with the parameters",
    ),
    "prefix is no name": (M, "prefix: r_", "prefix: 5_", 0, "assemblies.right.prefix", "the start of a name"),
    "prefix taken": (M, "prefix: r_", "prefix: left_", 0, "assemblies.right", "its `left_thigh` stands in"),
    "name taken": (M, "  frame: {mass", "  left_shank: {mass", 12, "assemblies.left", "its `left_shank` stands in"),
    "fault in a part": (L, "mass: 2,", "mass: 2 m,", 0, "bodies.shank.mass", "a mass (kg) was expected"),
    "reference in a part": (L, "marker: foot", "marker: fot", 0, "forces.push.marker", "did you mean `foot`"),
    "a part knows no other file": (
        L,
        "bodies: [thigh, shank]",
        "bodies: [thigh, frame]",
        0,
        "joints.knee.bodies.1",
        "there is no body `frame`",
    ),
    "gravity of an assembly": (
        L,
        "format: 1",
        "format: 1\ngravity: [0, 0, 1]",
        1,
        "gravity",
        "`assemblies.left: {file: leg.yaml, only:",
    ),
    "part of itself": (
        L,
        "format: 1",
        "format: 1\nassemblies: {toe: {file: leg.yaml}}",
        1,
        "assemblies.toe.file",
        "leg.yaml → leg.yaml",
    ),
    "table that is turned": (
        L,
        "[10 - 5*foot.x, 2*time, 0]",
        "[10 - 5*foot.x, {times: [0, 1], values: [0, 1]}, 0]",
        None,
        "assemblies.right",
        "forces.push: a table would have to be mixed",
    ),
    # mass properties
    "mass of a file": (D, '"3 kg"', '"3 m"', 0, "bodies.disc.mass", "a mass (kg) was expected"),
    "key of a file": (D, '"mass"', '"mas"', 0, "mas", "did you mean `mass`"),
    "inertia of a file": (D, "0.02]", "0.05]", 0, "bodies.disc.inertia", "exceeds the sum"),
    "no such mass file": (M, "disc.json", "disk.json", 0, "bodies.disc.mass_properties", "did you mean"),
    "mass twice": (
        M,
        "mass_properties: disc.json",
        "mass: 1, mass_properties: disc.json",
        0,
        "bodies.disc.mass",
        "stands in",
    ),
    "mass file is a list": (D, FILES["disc.json"], "[1, 2]", 0, "", "a mapping with mass"),
    # laws in Python
    "no such law file": (M, "python: laws.py", "python: law.py", 0, "forces.brake.effort.python", "there is no file"),
    "no such function": (M, "function: brake", "function: break", 0, "forces.brake.effort.function", "brake"),
    "too few arguments": (M, ", 2 kN]", "]", 0, "forces.brake.effort.arguments", "takes 3 arguments"),
    "argument of no joint": (M, "axle.angle_rate, 2", "axl.angle_rate, 2", 0, "forces.brake.effort.arguments.1", "axl"),
    "file and text": (M, "python: laws.py", "python: laws.py, source: x", 0, "forces.brake.effort.python", "not both"),
}


@pytest.mark.parametrize("change", FAULTS.values(), ids=FAULTS.keys())
def test_the_fault_is_found_where_it_stands(change, tmp_path):
    stem, old, new, further, element, part = change
    faults, line = faults_of_full(tmp_path, stem, old, new)
    found = [fault for fault in faults if part in fault.message]
    assert found, faults
    assert {fault.path for fault in found} == {element}
    if further is not None:
        assert {fault.line for fault in found} == {line + further}


@pytest.mark.parametrize("name", [name for name, change in FAULTS.items() if change[0] != M])
def test_the_fault_is_found_in_its_file(name, tmp_path):
    stem, old, new, further, _, part = FAULTS[name]
    faults, _ = faults_of_full(tmp_path, stem, old, new)
    (fault, *_) = [fault for fault in faults if part in fault.message]
    if further is not None:
        (file,) = [file for file in FILES if file.split(".")[0] == stem]
        assert fault.file == str(tmp_path / file)


FOLLOW_FROM = [
    "file that is not there",
    "assembly of no file",
    "fault in a part",
    "fault in an included file",
    "key of a file",
]


@pytest.mark.parametrize("name", FOLLOW_FROM)
def test_one_mistake_gives_one_fault(name, tmp_path):
    assert len(faults_of_full(tmp_path, *FAULTS[name][:3])[0]) == 1


def test_python_code_runs_only_for_those_who_allow_it(tmp_path):
    file = write_files(tmp_path)
    with pytest.raises(ModelError) as caught:
        read_machine(file)
    (fault,) = caught.value.faults
    assert fault.path == "forces.brake.effort.python"
    assert fault.message == "this law runs Python code from laws.py; say --allow-code if you trust it"
    assert fault.line
    assert fault.column


def test_python_code_in_the_file_itself_is_refused_likewise(tmp_path):
    new = '{source: "def brake(t, w, s): return 0.0", function: brake, arguments: [time, time, 1]}'
    old = "{python: laws.py, function: brake, arguments: [time, axle.angle_rate, 2 kN]}"
    (fault,), line = faults_of_full(tmp_path, M, old, new, allow_code=False)
    assert (fault.line, fault.path) == (line, "forces.brake.effort.source")
    assert "--allow-code" in fault.message
