"""Records in Python: each is an attribute of `nivel` or of one of its rooms, and together they make the machine that a file says."""

import inspect
import re
import sys
from importlib import import_module
from pathlib import Path

import pytest

import nivel
from nivel.lazy import homes
from nivel.machine.machine_record import MachineRecord

ROOT = Path(__file__).parents[2]
sys.path.append(str(ROOT / "packaging"))
from record_stubs import ROOMS, records_of, stub, stub_of_joints, stub_of_lazy  # noqa: E402

SECTIONS = set(MachineRecord.model_fields) - {"name"}
ROOM_OF = {"forces": nivel.forces, "hydraulics": nivel.hydraulics, "fluids": nivel.hydraulics, "control": nivel.control}
MACHINES = [path for path in sorted((ROOT / "examples").rglob("*.yaml")) if "\nbodies:" in path.read_text("utf-8")]


def test_every_section_of_a_machine_file_is_a_keyword():
    assert set(inspect.signature(nivel.Machine.__init__).parameters) >= SECTIONS


@pytest.mark.parametrize("room", sorted(ROOMS))
def test_type_checkers_know_every_record(room):
    module = sys.modules[f"nivel.elements.{room}"]
    written = Path(str(module.__file__)).with_suffix(".pyi").read_text(encoding="utf-8")
    assert written == stub(room), "python packaging/write_settings.py"
    assert set(records_of(room)) <= {getattr(module, name) for name in dir(module)}


@pytest.mark.parametrize("path", MACHINES, ids=lambda path: path.stem)
def test_an_example_is_made_from_its_records(path):
    try:
        record = nivel.load(path, allow_code=True).record
    except nivel.ModelError as error:
        pytest.skip(str(error.faults[0].message)) if "there is no file" in str(error) else pytest.fail(str(error))
    sections = {name: getattr(record, name) for name in SECTIONS}
    for name, room in ROOM_OF.items():
        sections[name] = tuple(
            getattr(room, type(one).__name__)(**{key: getattr(one, key) for key in one.model_fields_set})
            for one in sections[name]
        )
    assert nivel.Machine(record.name, **sections).record == record


def test_names_that_stubs_list_are_there():
    assert all(hasattr(nivel, name) for name in nivel.__all__)
    for module, name in homes(import_module("nivel.known").__file__).values():
        assert re.search(rf"\b(class {name}\b|{name}\b.*=)", inspect.getsource(import_module(module))), (module, name)


def test_type_checkers_know_what_is_imported_late():
    written = (Path(str(nivel.__file__)).parent / "lazy.pyi").read_text(encoding="utf-8")
    assert written == stub_of_lazy(), "python packaging/write_settings.py"


def test_type_checkers_know_the_types_of_joints():
    module = sys.modules["nivel.elements.joints"]
    written = Path(str(module.__file__)).with_suffix(".pyi").read_text(encoding="utf-8")
    assert written == stub_of_joints(), "python packaging/write_settings.py"


def test_a_record_that_stands_elsewhere_is_told():
    with pytest.raises(AttributeError, match=r"write `nivel\.hydraulics\.Pump`"):
        _ = nivel.Pump
    with pytest.raises(AttributeError, match=r"in `nivel\.forces`, .*SpringDamper"):
        _ = nivel.Force
    with pytest.raises(AttributeError, match=r"no component `Pmup`; there are Accumulator, "):
        _ = nivel.hydraulics.Pmup
