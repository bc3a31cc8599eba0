"""Values of a machine by path, such as ``bodies.crank.mass``: read, and set in a copy."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from nivel.errors import Fault, ModelError, retold
from nivel.files.outline import TOP_WORDS, Known
from nivel.files.reader import OUTSIDE, Origin, parse_machine
from nivel.files.writer import write_machine
from nivel.machine.bodies.inertia import Inertia
from nivel.machine.core.record import Record, field_words
from nivel.machine.laws.varying_value import Table
from nivel.machine.machine_record import MachineRecord
from nivel.machine.uses.references import SECTIONS
from nivel.words.wording import shown, unknown_word

# places of principal moments of inertia in a list
PRINCIPAL = {"0": "xx", "1": "yy", "2": "zz"}
PARAMETERS = (
    "the machine has no parameters: they belong to machine files, and are worked out when elements are replaced in Python; "
    "set them first, with `with_values` of the machine that was loaded"
)


def elements_named(record: MachineRecord, name: str) -> dict[str, Record]:
    """The elements of this name, by section."""
    found = ((section, each) for section in SECTIONS for each in getattr(record, section))
    return {section: each for section, each in found if getattr(each, "name", None) == name}


def whole_path(record: MachineRecord, path: str) -> str:
    """`path` with its section, where it begins with the name of an element. Raises ModelError where several have this name."""
    first = path.partition(".")[0].strip()
    if first in (*TOP_WORDS, "assemblies", "include"):
        return path
    sections = list(elements_named(record, first))
    if len(sections) > 1:
        listed = " or ".join(f"`{section}.{path}`" for section in sections)
        raise ModelError(Fault.at(path, f"several elements are called `{first}`: write {listed}"))
    return f"{sections[0]}.{path}" if sections else path


def value_at(record: MachineRecord, path: str) -> Any:
    """The value at `path`, whose steps are keys as in machine files, names of elements, and places in lists from 0.

    Raises ModelError where nothing can stand there.
    """
    value: Any = record
    steps = [step.strip() for step in path.split(".")]
    for at, step in enumerate(steps):
        try:
            value = _entered(value, step, steps[at - 1] if at else "")
        except ModelError as error:
            raise ModelError(Fault.at(".".join(steps[: at + 1]), error.faults[0].message)) from None
    return value


def _entered(value: Any, step: str, key: str) -> Any:
    """What `value` has under `step`. key : the step before, empty for the machine itself. Raises ModelError."""
    match value:
        case Record():
            names = {field.alias or name: name for name, field in type(value).model_fields.items()}
            if isinstance(value, Inertia) and step in PRINCIPAL:
                step = PRINCIPAL[step]
            if step not in names:
                raise ModelError(unknown_word(step, field_words(type(value)), "key" if key else "section"))
            return getattr(value, names[step])
        case Mapping():
            if step not in value:
                raise ModelError(unknown_word(step, [str(key) for key in value], "key"))
            return value[step]
        case Table() if step in ("times", "values"):
            return getattr(value, step)
        case None if step.isdecimal():
            raise ModelError(f"`{key}` is not written, so it has no entries: write `{key}: [0, 0, 0]` with its values")
        case tuple() if step.isdecimal() and int(step) < len(value):
            return value[int(step)]
        case tuple():
            names = [str(getattr(each, "name", "")) for each in value]
            if step in names:
                return value[names.index(step)]
            if any(names) or not value:
                raise ModelError(unknown_word(step, names, "name"))
            raise ModelError(
                f"this is a list of {len(value)}; its entries are 0 to {len(value) - 1}, not {shown(step)}"
            )
    raise ModelError(f"this is a single value, {shown(value)}, and has nothing inside")


def with_values(
    record: MachineRecord, origin: Origin, values: Mapping[str, Any], known: Known | None = None
) -> tuple[MachineRecord, Origin]:
    """The machine with other values by path, and where it comes from. What depends on a parameter follows it. known : of the record.

    Raises ModelError with everything that is wrong.
    """
    if not origin.source:
        return _of_record(record, values), origin.edited()
    values = {**origin.values, **values}
    read = parse_machine(origin.source, origin.file, overrides=values, allow_code=origin.allow_code, known=known)
    return read, replace(origin, values=values, outside=origin.outside | outside_paths(values), given={})


def outside_paths(values: Iterable[str]) -> frozenset[str]:
    """The paths as `Origin.outside` has them."""
    return frozenset(".".join(step.strip() for step in path.split(".")) for path in values)


def _of_record(record: MachineRecord, values: Mapping[str, Any]) -> MachineRecord:
    if any(path.split(".")[0].strip() in ("parameters", "assemblies", "include") for path in values):
        raise ModelError(PARAMETERS)
    # where there is no file, no value is said to be from outside of it
    with retold(lambda each: replace(each, file="", line=0, column=0, message=each.message.removesuffix(OUTSIDE))):
        return parse_machine(write_machine(record), overrides=values, allow_code=True)


def replaced(record: MachineRecord, elements: Sequence[Record]) -> dict[str, tuple[Record, ...]]:
    """The sections in which `elements` stand in place of those that have their names. Raises ModelError where none has."""
    sections: dict[str, list[Record]] = {}
    for element in elements:
        section, name = section_of_element(element), str(getattr(element, "name", ""))
        records = sections.setdefault(section, list(getattr(record, section)))
        names = [str(getattr(each, "name", "")) for each in records]
        if name not in names:
            raise ModelError(Fault.at(section, f"nothing to replace: {unknown_word(name, names, 'name')}"))
        records[names.index(name)] = element
    return {section: tuple(records) for section, records in sections.items()}


def section_of_element(element: Any) -> str:
    """The section of a machine in which such a record stands. Raises ModelError for anything else."""
    section = element.collection if isinstance(element, Record) else ""
    if not section:
        raise ModelError(f"an element of a machine, such as a Body or a Joint, was expected, got {shown(element)}")
    return section
