"""One file with all that it includes, and the parts that it places: from YAML to a record.

Every part that `assemblies:` names is a file read by itself, with parameters and names of its own. Its records are
placed and get their prefix (assembly.py), and join those of the file that uses it.

Parameters of a file decide whose size chooses between pieces of an expression, as p of `max(p, 30)` or `if(p > 2, a, b)`: numbers follow
them by several formulas, of which a few values may show one (`nivel.analysis.preparation.parameters`). What decides while the machine
runs, as `if(time > p, a, b)`, is none of these.
"""

from collections.abc import Iterator, Mapping
from pathlib import Path as FilePath
from typing import Any, Final

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from nivel.errors import Fault, ModelError, refuse
from nivel.files.code import read_python_laws, read_unit_blocks
from nivel.files.csv_tables import read_csv_tables
from nivel.files.include import include, place_body_files, read_mass_properties
from nivel.files.joint_parts import add_joint_parts
from nivel.files.mesh_file import read_meshes
from nivel.files.outline import NAMING, SETS, SHARING, VALUES, Known, as_part, check_sections, check_start, section_of
from nivel.files.overrides import in_order, override, prefix_of, with_units
from nivel.files.sources import Sources
from nivel.files.tree import Path, Tree, read_tree
from nivel.known import Assembly
from nivel.lazy import Struct, nivel, replace
from nivel.machine.control.order import can_be_named
from nivel.machine.core.record import Record
from nivel.machine.laws.named_function import resolve_functions
from nivel.machine.machine_record import MachineRecord
from nivel.machine.parameters import resolve
from nivel.machine.units.functions import FUNCTIONS
from nivel.machine.units.grammar import parse
from nivel.machine.units.measure import name_notes
from nivel.machine.units.plain_factors import with_bodies
from nivel.machine.units.quantity import FunctionFault
from nivel.machine.units.tree import (
    COMPARISONS,
    Call,
    ExpressionError,
    Node,
    Number,
    Operation,
    Parameters,
    Signal,
    names,
    parts,
    varies,
)
from nivel.machine.uses.references import SECTIONS


def deciding(tree: Tree) -> frozenset[str]:
    """Names of parameters that decide in the expressions of a file, or may do so in the parts that it gives them to."""
    given = section_of(tree, "parameters")
    found = {name for node in _trees(tree.data) for name in _decided(node)}
    found |= {name for node in _trees(section_of(tree, "assemblies")) for name in names(node)}
    while (
        more := {name for each in found & given.keys() for node in _trees(given[each]) for name in names(node)} - found
    ):
        found |= more
    return frozenset(found & given.keys())


def _trees(data: Any) -> Iterator[Node]:
    """Of all texts that are expressions."""
    if isinstance(data, dict | list):
        for each in data.values() if isinstance(data, dict) else data:
            yield from _trees(each)
    elif isinstance(data, str):
        try:
            yield parse(data)
        except ExpressionError:
            return


def _decided(node: Node) -> Iterator[str]:
    """Names in the parts of an expression that decide before the machine runs. Functions of the file, and curves, decide by all that they
    are given."""
    for part in parts(node):
        yield from _decided(part)
    match node:
        case Operation(symbol) if symbol in COMPARISONS and not varies(node):
            yield from names(node)
        case Call(function, arguments):
            kind = FUNCTIONS.get(function)
            if kind is None:
                for part in arguments:
                    yield from () if varies(part) else names(part)
            elif kind.sides is not None:
                for pair in kind.sides(lambda *each: not any(map(varies, each)), *arguments):
                    yield from (name for each in pair if each is not None for name in names(each))
            elif kind.jumps and not any(map(varies, arguments)):
                yield from names(node)


MOST_ROUNDS: Final = 5  # of functions that call for other units in the expressions that use them
Elements = dict[str, dict[str, Record]]


class FileNames(Struct):
    """What a machine file names beside the elements: values of its parameters, and its assemblies with all their values. deciding : the
    parameters of `nivel.files.scope`."""

    parameters: Mapping[str, float]
    assemblies: Mapping[str, Assembly]
    deciding: frozenset[str] = frozenset()


class Scope(Struct):
    """A file with all that it includes. overrides : set from outside. user : the file, and the assembly in it, that this is a part of."""

    text: str
    file: str
    sources: Sources
    overrides: Mapping[str, object]
    user: tuple[Tree, str, Assembly] | None = None

    def record(self, known: Known | None = None) -> MachineRecord:
        """The machine. known : of another reading of the file. Raises ModelError."""
        tree, parameters = self._tree()
        return _record(tree, parameters, _expanded(tree, parameters, self.sources), known)

    def known(self, record: MachineRecord) -> Known:
        """The elements of the machine that was read as `record`."""
        return Known.of(*self._tree(), record)

    def names(self) -> FileNames:
        """The names that can be read without fault. Values in SI units."""
        tree, values = self._tree()
        entries = section_of(tree, "assemblies").items()
        assemblies = {name: nivel.files.assembly.read_assembly(tree, name, given, values) for name, given in entries}
        return FileNames(
            {name: each.value for name, each in values.items() if isinstance(each, Number)},
            {name: assembly for name, assembly in assemblies.items() if assembly is not None},
            deciding(tree),
        )

    def name_notes(self) -> tuple[str, ...]:
        """What a reader has to know of parameters with the name of a unit or of a constant, in a file that was read without fault."""
        tree = read_tree(self.text, self.file)
        about_files, _, others = in_order(self.overrides)
        override(tree, about_files)
        include(tree, self.sources)
        override(
            tree, {path: value for path, value in others.items() if path.partition(".")[0].strip() == "parameters"}
        )
        return name_notes(resolve(section_of(tree, "parameters"))[0])

    def _tree(self) -> tuple[Tree, Parameters]:
        """The file with all that it includes and what was set from outside, and the values of its parameters."""
        tree = read_tree(self.text, self.file)
        about_files, of_masses, others = in_order(self.overrides)
        override(tree, about_files)
        check_start(tree)
        include(tree, self.sources)
        override(tree, of_masses)
        check_sections(tree)
        read_mass_properties(tree, self.sources)
        place_body_files(tree)
        override(tree, with_units(tree, others))
        check_sections(tree)
        if self.user is not None:
            _, name, assembly = self.user
            as_part(tree, assembly.only, f"`assemblies.{name}: {{file: {assembly.file}, only: [bodies, joints]}}`")
            nivel.files.assembly.given_parameters(tree, *self.user)
        touching = _has_contacts(tree)
        if touching or any("part" in each for of in SHARING["catalogue"] for each in section_of(tree, of).values()):
            nivel.files.height_file.spread_sets(tree)
        add_joint_parts(tree)
        read_meshes(tree, self.sources)
        if touching:
            nivel.files.convex_parts.divide_meshes(tree)
            nivel.files.convex_parts.divide_heaps(tree)
            nivel.files.height_file.read_heights(tree, self.sources)
            nivel.files.tyre_file.read_tyres(tree, self.sources)
        read_python_laws(tree, self.sources)
        read_unit_blocks(tree, self.sources)
        read_csv_tables(tree, self.sources)
        parameters, faults = resolve(section_of(tree, "parameters"))
        tree.faults += [tree.fault(("parameters", name), message) for name, message in faults.items()]
        functions, wrong = resolve_functions(section_of(tree, "functions"), parameters)
        tree.faults += [tree.fault(("functions", *place), message) for place, message in wrong.items()]
        return tree, {**parameters, **functions}


def _has_contacts(tree: Tree) -> bool:
    """Whether there are contacts or tyres, sets of their keys, or meshes in parts."""
    forces, bodies, markers = (section_of(tree, section).values() for section in ("forces", "bodies", "markers"))
    shapes = [each.get("shape") for each in (*bodies, *markers) if isinstance(each, dict)]
    return (
        not tree.data.keys().isdisjoint(SETS)
        or any(isinstance(each, dict) and each.get("type") in ("contacts", *NAMING) for each in forces)
        or any(isinstance(each, dict) and "convex_parts" in each for each in shapes)
    )


def _expanded(tree: Tree, parameters: Parameters, sources: Sources) -> Elements:
    """The elements that the assemblies of `tree` make. Faults go to `tree.faults`."""
    made: Elements = {section: {} for section in SECTIONS}
    for name, given in (tree.data.pop("assemblies", None) or {}).items():
        assembly = nivel.files.assembly.read_assembly(tree, name, given, parameters)
        part = None if assembly is None else _part(tree, name, assembly, sources)
        elements = (
            None if assembly is None or part is None else nivel.files.assembly.made_by(tree, name, assembly, part)
        )
        if elements is None:
            tree.unread.add(prefix_of(name, given))
            continue
        for section, records in elements.items():
            for its_name, record in records.items():
                _join(tree, made[section], (section, its_name), record, ("assemblies", name))
    return made


def _part(tree: Tree, name: str, assembly: Assembly, sources: Sources) -> MachineRecord | None:
    """The part of an assembly, in its own names and axes; None where it has faults, which are collected."""
    found = sources.text(tree, ("assemblies", name, "file"), assembly.file)
    if found is None:
        return None
    text, file = found
    scope = Scope(text, file, sources.inside(file), tree.for_parts.get(name, {}), (tree, name, assembly))
    try:
        return scope.record()
    except ModelError as error:
        faults = error.faults
    own = faults
    if assembly.parameters and not sources.again:
        try:
            bare = (tree, name, assembly.replace(parameters={}))
            replace(scope, sources=replace(sources, again=True).inside(file), user=bare).record()
            own = ()
        except ModelError as error:
            own = error.faults
    hint = f" (in assemblies.{name}, with the parameters given there)"
    places = [(each.file, each.line, each.column, each.path) for each in own]
    for fault in faults:
        of_parameters = fault.line and (fault.file, fault.line, fault.column, fault.path) not in places
        tree.faults.append(_seen_from_user(fault, assembly, hint if of_parameters else ""))
    return None


def _seen_from_user(fault: Fault, assembly: Assembly, hint: str) -> Fault:
    """A fault in a part: with the whole name of the element where it was set from outside, else with the `hint`."""
    steps = fault.path.split(".")
    if not fault.line and len(steps) > 1 and steps[0] in SECTIONS:
        return replace(fault, path=".".join([steps[0], f"{assembly.prefix}{steps[1]}", *steps[2:]]))
    return fault if "the parameters given there" in fault.message else replace(fault, message=fault.message + hint)


def _join(tree: Tree, records: dict[str, Record], path: Path, record: Record, maker: Path) -> None:
    """Add an element that the assembly `maker` makes, unless its name is taken. Its place is that of the assembly."""
    section, name = map(str, path)
    if name in section_of(tree, section) or name in records:
        if not tree.is_broken(maker):  # the first name is enough
            tree.report(maker, f"its `{name}` stands in {tree.place_of(path)} already; give another `prefix`")
        return
    records[name] = record
    tree.files[path] = tree.file_of(maker)
    if maker in tree.places:
        tree.places[path] = tree.places[maker]


def _record(tree: Tree, parameters: Parameters, made: Elements, known: Known | None) -> MachineRecord:
    """The record of the whole tree.

    Raises ModelError.
    """
    alike = known.alike(tree, parameters) if known is not None else {}
    data: dict[str, Any] = {"name": FilePath(tree.file).stem or "machine", **tree.data}
    for section in VALUES:
        data.pop(section, None)
    if data.get("simulation", ...) is None:
        del data["simulation"]
    names: dict[str, list[str]] = {}
    for section in SECTIONS:
        own = section_of(tree, section)
        names[section] = [*own, *made[section]]
        if names[section]:
            written = (alike.get((section, name)) or {"name": name, **element} for name, element in own.items())
            data[section] = [*written, *made[section].values()]
        else:
            data.pop(section, None)
    data.setdefault("bodies", [])
    signals = {
        name: Signal(f"{name}.value")
        for name in (*names["control"], *names["inputs"], *names["states"])
        if can_be_named(name, parameters)
    }
    known_names: Parameters = {**parameters, **signals}
    try:
        record = MachineRecord.model_validate(data, context={"parameters": known_names})
    except ValidationError as error:
        if alike:  # faults are told in the words of the file
            return _record(tree, parameters, made, None)
        problems = _beside_functions(tree, data, known_names, names, error)
        read = (each for each in problems if not _is_about_unread(tree, each["msg"]))
        tree.take(read, lambda path: _path_in_file(path, names))
        if not tree.faults:  # nothing is refused without a word
            lines = error.errors(include_url=False)
            tree.faults += [tree.fault(_path_in_file(line["loc"], names), line["msg"]) for line in lines]
        raise ModelError(tree.faults) from None
    refuse(tree.faults)
    return record


def _beside_functions(
    tree: Tree, data: Any, parameters: Parameters, names: Mapping[str, list[str]], error: ValidationError
) -> list[ErrorDetails]:
    """What is still wrong when the functions whose plain numbers lack units are right; the faults of these go to `tree.faults`.

    A function is called in several places: each round puts in what the calls have asked for, and looks at all of them again.
    """
    bodies: dict[str, str] = {}
    first: dict[str, tuple[FunctionFault, Path]] = {}
    lines = error.errors(include_url=False)
    for _ in range(MOST_ROUNDS):
        asked: dict[str, str] = {}
        for line in lines:
            lacking = line.get("ctx", {}).get("lacking")
            for name, each in lacking.functions.items() if lacking is not None else ():
                asked.setdefault(name, each.body)
                first.setdefault(name, (each, _path_in_file(line["loc"], names)))
        if not asked:
            break
        bodies |= asked
        try:
            MachineRecord.model_validate(data, context={"parameters": with_bodies(parameters, bodies)})
        except ValidationError as other:
            lines = other.errors(include_url=False)
        else:
            lines = []
    for name, (each, caller) in first.items():
        message = f"{each.message}; write `{each.head}: {bodies[name]}` (called by {'.'.join(map(str, caller))})"
        tree.faults.append(tree.fault(("functions", each.head), message))
    return lines


def _is_about_unread(tree: Tree, message: str) -> bool:
    """Whether something is missing that may stand in a file which could not be read."""
    if message == "a machine needs at least one body, beam or circuit":
        return bool(tree.unread)
    return message.startswith("there is no ") and any(f" `{prefix}" in message for prefix in tree.unread)


def _path_in_file(location: tuple[int | str, ...], names: Mapping[str, list[str]]) -> Path:
    """A place in the record as a place in the file: names instead of numbers in the sections."""
    if len(location) < 2 or location[0] not in names or not isinstance(location[1], int):
        return location
    rest = () if location[2:] == ("name",) else location[2:]
    return (location[0], names[str(location[0])][location[1]], *rest)
