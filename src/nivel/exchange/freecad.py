"""Assemblies of FreeCAD, read from their file without FreeCAD: parts as links, with the masses of their solids, and the joints of the
Assembly workbench.

A file is a ZIP archive: `Document.xml` has the objects and their properties, lengths in millimetres, and each shape is a BREP file, placed
as its object is. A joint has two connectors, each a frame in a part, whose z axes and origins it brings together (FreeCAD 1.0,
Mod/Assembly/JointObject.py). Parts stand where FreeCAD's solver left them.
"""

import tempfile
import zipfile
from functools import cached_property
from pathlib import Path
from typing import Final

import numpy as np

from nivel.errors import Fault, ModelError
from nivel.exchange.bodies import together
from nivel.exchange.mechanism import WORLD, Connection, Frame, Inertial, Link, Look, Mechanism
from nivel.files.step_file import STEEL, step_solids
from nivel.files.xml_source import Document, Element
from nivel.machine.core.orientation import Orientation, rotation_matrix

KIND: Final = ".fcstd"
MILLIMETRE: Final = 1e-3
CLOSED: Final = 1e-6  # [m, 1] by which connectors of a joint may be apart as the parts stand
GRAVITY: Final = (0.0, 0.0, -9.81)
KINDS: Final = {
    "Fixed": "fixed",
    "Revolute": "revolute",
    "Cylindrical": "cylindrical",
    "Slider": "translational",
    "Ball": "spherical",
}
LIMITS: Final = ("EnableLengthMin", "EnableLengthMax", "EnableAngleMin", "EnableAngleMax")


class Archive:
    """Objects of a file by name: their types and properties."""

    def __init__(self, path: Path) -> None:
        """Raises ModelError where this is no file of FreeCAD."""
        try:
            self._zip = zipfile.ZipFile(path)
            content = self._zip.read("Document.xml")
        except (OSError, KeyError, zipfile.BadZipFile) as error:
            raise ModelError(Fault(str(path), 1, 1, "", f"this is no file of FreeCAD: {error}")) from None
        self.document = Document(content, f"{path}/Document.xml")
        objects, data = self.document.root.first("Objects"), self.document.root.first("ObjectData")
        self.types = {each.get("name"): each.get("type") for each in (objects.all("Object") if objects else ())}
        self._data = {each.get("name"): each for each in (data.all("Object") if data else ())}

    @cached_property
    def properties(self) -> dict[str, dict[str, Element]]:
        """Of each object by name its properties."""
        given = {name: each.first("Properties") for name, each in self._data.items()}
        return {
            name: {of.get("name"): of for of in (each.all("Property") if each else ()) if of.children}
            for name, each in given.items()
        }

    def value(self, name: str, key: str) -> Element | None:
        """The element in which a property has its value."""
        found = self.properties.get(name, {}).get(key)
        return found.children[0] if found is not None else None

    def frame(self, name: str, key: str = "Placement") -> Frame:
        """A placement, in metres."""
        element, number = self.value(name, key), self.document.number
        if element is None:
            return Frame()
        x, y, z, w = (number(element, f"Q{k}", float(k == 3)) for k in range(4))
        turned = rotation_matrix(Orientation(euler_parameters=(w, x, y, z)))
        return Frame(turned, MILLIMETRE * np.array([number(element, f"P{a}", 0.0) for a in "xyz"]))

    def text(self, name: str, key: str, attribute: str = "value") -> str:
        """A property, or an empty text."""
        element = self.value(name, key)
        return element.get(attribute) if element is not None else ""

    def members(self, name: str) -> list[str]:
        """What is in a group."""
        group = self.value(name, "Group")
        return [each.get("value") for each in group.all("Link")] if group is not None else []

    def place(self, name: str) -> Frame:
        """The frame of a part in what it is in; that of a link to a part is its own, or with `LinkTransform` behind it that of the part."""
        if self.text(name, "LinkTransform") != "true":
            return self.frame(name)
        return self.frame(name) @ self.frame(self.text(name, "LinkedObject", "name"))

    def shapes(self, name: str, at: Frame) -> list[tuple[str, Frame]]:
        """BREP files of a part whose own frame is `at`, each with the frame in which it is placed."""
        if self.types.get(name) == "App::Link":
            if self.text(name, "LinkedObject", "file"):
                message = f"the part is in {self.text(name, 'LinkedObject', 'file')}; save the assembly with its parts in one file"
                self.document.fault(self.properties[name]["LinkedObject"], message)
                return []
            return self.shapes(self.text(name, "LinkedObject", "name"), at)
        if file := self.text(name, "Shape", "file"):
            return [(file, at @ self.frame(name).inverse)]
        return [found for each in self.members(name) for found in self.shapes(each, at @ self.place(each))]

    def unpacked(self, file: str, folder: Path) -> str:
        """Path of a BREP file that is written to a folder. Raises ModelError where the archive does not have it."""
        out = folder / f"{Path(file).stem}.brep"
        try:
            out.write_bytes(self._zip.read(file))
        except (KeyError, zipfile.BadZipFile) as error:
            message = f"the shape `{file}` cannot be read: {error}"
            raise ModelError(Fault(self.document.file, 1, 1, "", message)) from None
        return str(out)


def read_freecad(path: Path, density: float | None) -> Mechanism:
    """The mechanism of the assembly in a file. density [kg/m³] : of all solids, default steel's. Raises ModelError with all faults."""
    archive = Archive(path)
    tops = [name for name, kind in archive.types.items() if kind == "Assembly::AssemblyObject"]
    if len(tops) != 1:
        message = f"{len(tops)} assemblies; one, of the Assembly workbench of FreeCAD 1.0 or later, was expected"
        raise ModelError(Fault(str(path), 1, 1, "", message))
    mechanism = Mechanism(path.stem, "FreeCAD", GRAVITY)
    mechanism.notes.change("gravity is no part of FreeCAD: 9.81 m/s² against the z axis is written")
    if density is None:
        mechanism.notes.change("densities are not read: 7850 kg/m³ is used; `--density` gives another one")
    with tempfile.TemporaryDirectory() as folder:
        for name in archive.members(tops[0]):
            if files := archive.shapes(name, Frame()):
                place = archive.place(name)
                mechanism.links[name] = _link(name, place, files, archive, Path(folder), density or STEEL)
    archive.document.raise_faults()
    for name in archive.types:
        if ground := archive.text(name, "ObjectToGround") or archive.text(name, "ObjectToGround", "name"):
            mechanism.connections.append(Connection(name, "fixed", (WORLD, ground), np.zeros(3)))
        elif "JointType" in archive.properties.get(name, {}) and archive.text(name, "Activated") != "false":
            _join(name, tops[0], archive, mechanism)
    archive.document.raise_faults()
    return mechanism


def _link(name: str, place: Frame, files: list[tuple[str, Frame]], archive: Archive, folder: Path, rho: float) -> Link:
    parts, looks = [], []
    for file, at in files:
        for solid in step_solids(archive.unpacked(file, folder)):
            centre = at.axes @ (MILLIMETRE * solid.centre) + at.origin
            moments = rho * MILLIMETRE**5 * at.axes @ solid.moments @ at.axes.T
            parts.append(Inertial(rho * MILLIMETRE**3 * solid.volume, centre, moments))
            surface = MILLIMETRE * solid.surface[0], solid.surface[1]
            looks.append(Look("surface", at, surface=surface, colour=solid.colour))
    return Link(name, place, together(parts), looks)


def _join(name: str, top: str, archive: Archive, mechanism: Mechanism) -> None:
    """Add a joint, at its connectors."""
    element = archive.properties[name]["JointType"]
    count, words = int(archive.document.number(element.children[0], "value", 0.0)), element.first("CustomEnumList")
    listed = [each.get("value") for each in words.all("Enum")] if words is not None else []
    given = listed[count] if count < len(listed) else str(count)
    if given not in KINDS:
        mechanism.notes.leave(f"joints of type {given}", name, element.line, acts=True)
        return
    ends, frames = [], []
    for k in (1, 2):
        reference = archive.value(name, f"Reference{k}")
        sub = reference.first("Sub") if reference is not None else None
        way = [reference.get("name") if reference else "", *(sub.get("value") if sub else "").split(".")[:-1]]
        way = [each for each in way if each != top]
        if not way or way[0] not in mechanism.links:
            archive.document.fault(element, f"`Reference{k}` of the joint `{name}` names no part of the assembly")
            return
        inside = Frame()
        for each in way[1:]:
            inside = inside @ archive.place(each)
        ends.append(way[0])
        frames.append(inside @ archive.frame(name, f"Placement{k}"))
    first, second = (mechanism.links[end].place @ frame for end, frame in zip(ends, frames, strict=True))
    kind, axis = KINDS[given], first.axes[:, 2]
    away = first.origin - second.origin
    off = away - (axis @ away) * axis if kind in ("cylindrical", "translational") else away
    turned = first.axes[:, :2] - second.axes[:, :2]
    tilt = turned if kind in ("fixed", "translational") else np.cross(axis, second.axes[:, 2])
    is_open = max(float(np.abs(off).max()), 0.0 if kind == "spherical" else float(np.abs(tilt).max())) > CLOSED
    axes = () if kind in ("fixed", "spherical") else (axis,)
    joint = Connection(name, kind, (ends[0], ends[1]), first.origin, axes, line=element.line)
    joint.frames = (frames[0], frames[1]) if is_open else None
    mechanism.connections.append(joint)
    if any(archive.text(name, each) == "true" for each in LIMITS):
        mechanism.notes.leave("limits of joints", name, element.line, acts=True)
