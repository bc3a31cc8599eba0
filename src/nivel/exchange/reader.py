"""Readers of models, chosen by the content of a file, its translation, and solids of a STEP file as bodies."""

import re
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Any, Final, Literal

from nivel.errors import Fault, ModelError, retold
from nivel.exchange.freecad import KIND as FREECAD
from nivel.exchange.freecad import read_freecad
from nivel.exchange.looks import Drawing
from nivel.exchange.machine import machine_of
from nivel.exchange.mechanism import Mechanism
from nivel.exchange.mjcf import read_mjcf
from nivel.exchange.sdf import read_sdf
from nivel.exchange.translation import Names, Notes, Translation, triple
from nivel.exchange.urdf import read_urdf
from nivel.exchange.urdf_loops import close_loops
from nivel.files.outline import FORMAT
from nivel.files.reader import parse_machine
from nivel.files.sources import read_bytes
from nivel.files.step_file import KINDS as STEP_KINDS
from nivel.files.step_file import STEEL, step_solids
from nivel.files.writer import write_data
from nivel.files.xml_source import Document, Element
from nivel.machine.bodies.surface import surface_text
from nivel.machine.machine_record import MachineRecord

Base = Literal["fixed", "free"]
Contacts = Literal["all", "floor", "none"]

_XACRO: Final = re.compile(r"\$\{.*?\}|\$\((arg|find|eval) ")
_OTHERS: Final = (
    (
        re.compile(rb"\A\W*adams[/_ ]view|^\s*(part|marker|joint)\s+create\b|^\s*(PART|MARKER|JOINT)/\d+", re.I | re.M),
        "this is a dataset of Adams, which nivel does not read; save the parts as STEP in Adams/View, translate them by "
        "`nivel import parts.step --out machine.yaml`, and write each JOINT as `hinge: {type: revolute, bodies: [ground, arm], "
        "point: [0, 0, 0], axis: [0, 0, 1]}`",
    ),
    (
        re.compile(
            rb"^\s*(partial\s+|encapsulated\s+)?(model|package|class|block)\s+\w+.*?^\s*end\s+\w+\s*;", re.M | re.S
        ),
        "this is Modelica, which nivel does not read; write each Modelica.Mechanics.MultiBody.Parts.Body as `arm: {mass: 2, inertia: "
        "[0.01, 0.2, 0.2], centre_of_mass: [0.5, 0, 0]}` and each Joints.Revolute as `hinge: {type: revolute, bodies: [ground, arm], "
        "point: [0, 0, 0], axis: [0, 0, 1]}`; `nivel new machine` starts a file",
    ),
)


def read_model(
    file: str | Path,
    *,
    base: Base | None = None,
    package_paths: Sequence[str | Path] = (),
    target: str | Path | None = None,
    contacts: Contacts = "all",
    density: float | None = None,
    keyframe: str | None = None,
    include_paths: Sequence[str | Path] = (),
) -> Translation:
    """The translation of a file of another program. target : the machine file that will be written; default beside the model. density :
    of solids of a STEP file [kg/m³]. contacts : all of the model, those with the ground, or none. keyframe : of an MJCF file, at which
    it starts. include_paths : folders from which an MJCF file may take files, beside its own.

    Raises ModelError with everything that cannot be read, each with file and line.
    """
    path = Path(file)
    beside = Path(target) if target is not None else path
    drawing = Drawing(path, [Path(each) for each in package_paths], beside.parent, f"{beside.stem}-meshes")
    if path.suffix.lower() in STEP_KINDS:
        return read_step(str(file), path.name, f"{beside.stem}-meshes", density)
    if path.suffix.lower() == FREECAD:
        return machine_of(read_freecad(path, density), path.name, drawing)
    if density is not None:
        raise ModelError(f"{file}: the masses are in the model; `density` belongs to STEP files and those of FreeCAD")
    content = read_bytes(path)
    mechanism = _mechanism(content, str(file), base, contacts, keyframe, [Path(each) for each in include_paths])
    return machine_of(mechanism, path.name, drawing)


def translated_machine(file: str | Path, **given: Any) -> MachineRecord:
    """The machine that a file of another program describes; meshes are in it. given : as of `read_model`. Raises ModelError."""
    translation = read_model(file, **given)
    shapes = [each["shape"] for each in translation.data.get("markers", {}).values() if "shape" in each]
    for shape in [*_meshes(translation.data), *(each for each in shapes if each["type"] == "mesh")]:
        made = translation.meshes.get(shape["file"])
        if made is not None:
            shape["surface"] = surface_text(*made)
    text = write_data({"format": FORMAT, **translation.data})
    return as_machine(text, str(Path(file).parent / f"{Path(file).stem}.yaml"), translation, str(file))


def as_machine(text: str, target: str, translation: Translation, source: str) -> MachineRecord:
    """The machine of a translation, as the file `target` with this text would give it.

    Raises ModelError whose faults point to the element of the source from which they come.
    """
    with retold(partial(_in_source, translation, source)):
        return parse_machine(text, target)


def _in_source(translation: Translation, source: str, fault: Fault) -> Fault:
    """The fault of a machine that was never written, at what its element was translated from."""
    name = fault.path.split(".")[1] if "." in fault.path else fault.path
    line, element = translation.lines.get(name, (1, ""))
    said = f"the translation has no such machine: {fault.path}: {fault.message}" if fault.path else fault.message
    return Fault(source, line, 1, element, said)


def _meshes(data: dict[str, Any]) -> list[dict[str, Any]]:
    looks = [shape for body in data["bodies"].values() for shape in body.get("looks", [])]
    return [shape for shape in [*looks, *data.get("surroundings", [])] if shape["type"] == "mesh"]


def _mechanism(
    content: bytes,
    file: str,
    base: Base | None,
    contacts: Contacts,
    keyframe: str | None,
    include_paths: Sequence[Path],
) -> Mechanism:
    start = content[:100_000]
    for pattern, answer in _OTHERS:
        if not start.lstrip(b"\xef\xbb\xbf \r\n\t").startswith(b"<") and pattern.search(start):
            raise ModelError(Fault(file, 1, 1, "", answer))
    if not start.lstrip(b"\xef\xbb\xbf \r\n\t").startswith(b"<"):
        message = "this is no model that is read; there are URDF, SDF, MJCF (.xml), STEP files and assemblies of FreeCAD (.FCStd)"
        raise ModelError(Fault(file, 1, 1, "", message))
    document = Document(content, file)
    root = document.root
    if macro := _macro(root):
        made = "robot.sdf" if root.tag == "sdf" else "robot.urdf"
        message = (
            f"this is xacro, macros that make a model; write `xacro {Path(file).name} > {made}` and translate {made}"
        )
        raise ModelError(Fault(file, macro.line, macro.column, macro.shown, message))
    match root.tag:
        case "mujoco":
            return read_mjcf(Path(file), document, base, contacts, keyframe, include_paths)
        case _ if keyframe is not None:
            raise ModelError(f"{file}: `keyframe` belongs to MJCF files")
        case _ if include_paths:
            raise ModelError(f"{file}: `include_paths` belong to MJCF files; meshes of others are in `package_paths`")
        case "robot":
            mechanism = read_urdf(document, base, contacts)
            close_loops(mechanism, Path(file))
            return mechanism
        case "sdf":
            return read_sdf(document, base, contacts)
    message = f"<{root.tag}> is no model that is read; there are <robot> (URDF), <sdf> and <mujoco> (MJCF)"
    raise ModelError(Fault(file, root.line, root.column, "", message))


def _macro(root: Element) -> Element | None:
    """The first element that is a macro of xacro, or uses one."""
    made = (
        each
        for each in root.every()
        if each.tag.startswith("xacro:") or any(map(_XACRO.search, each.attributes.values()))
    )
    return next(made, None)


def read_step(file: str, name: str, folder: str, density: float | None) -> Translation:
    """Bodies with the exact mass, centre and inertia of each solid; meshes to draw them. folder : of the meshes. Raises ModelError."""
    notes, names = Notes(), Names()
    rho = STEEL if density is None else density
    bodies: dict[str, Any] = {}
    meshes = {}
    for solid in step_solids(file):
        body = names.name("body", solid.name)
        meshes[f"{folder}/{body}.stl"] = (solid.surface[0] - solid.centre, solid.surface[1])
        i = rho * solid.moments
        tensor = {"xx": i[0, 0], "yy": i[1, 1], "zz": i[2, 2], "xy": i[0, 1], "xz": i[0, 2], "yz": i[1, 2]}
        look = {"type": "mesh", "file": f"{folder}/{body}.stl"} | ({"colour": solid.colour} if solid.colour else {})
        bodies[body] = {
            "position": triple(solid.centre),
            "mass": rho * solid.volume,
            "inertia": {key: float(value) for key, value in tensor.items()},
            "looks": [look],
        }
    changed = names.changed(("body",))
    if changed:
        notes.change("names that nivel does not take were changed", "; ".join(changed))
    if density is None:
        notes.change("a STEP file has no densities: 7850 kg/m³ is used; `--density` gives another one")
    notes.change(f"all {len(bodies)} solids are bodies of their own, with the origin in the centre of mass")
    notes.leave("joints: a STEP file has none; write them under `joints:`")
    notes.leave("gravity: write `gravity: [0, 0, -9.81]`")
    description = {"description": f"Names in STEP: {'; '.join(changed)}."} if changed else {}
    title = name.rpartition(".")[0] or name
    return Translation(name, "STEP", {"name": title, **description, "bodies": bodies}, notes, meshes)
