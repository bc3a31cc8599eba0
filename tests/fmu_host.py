"""A host of FMUs by ctypes, for tests: unpacks a unit, reads its description, and calls it by FMI 3.0 or 2.0."""

import ctypes
import xml.etree.ElementTree as ET
import zipfile
from ctypes import byref, c_bool, c_char_p, c_double, c_int, c_size_t, c_uint32, c_void_p
from pathlib import Path

OK, DISCARD, ERROR = 0, 2, 3
LOG_3 = ctypes.CFUNCTYPE(None, c_void_p, c_int, c_char_p, c_char_p)
LOG_2 = ctypes.CFUNCTYPE(None, c_void_p, c_char_p, c_int, c_char_p, c_char_p, c_char_p)


class Callbacks2(ctypes.Structure):
    _fields_ = (("logger", LOG_2), ("rest", c_void_p * 3), ("environment", c_void_p))


class Unit:
    """An unpacked unit: names → value references, and what makes instances."""

    def __init__(self, file, folder):
        self.folder = Path(folder)
        with zipfile.ZipFile(file) as packed:
            packed.extractall(self.folder)
        root = ET.parse(self.folder / "modelDescription.xml").getroot()
        self.version = int(root.get("fmiVersion")[0])
        self.token = (root.get("instantiationToken") or root.get("guid")).encode()
        self.variables = {each.get("name"): each for each in root.find("ModelVariables")}
        self.reference = {name: int(each.get("valueReference")) for name, each in self.variables.items()}
        (binary,) = (self.folder / "binaries").rglob("*.so")
        self.library = ctypes.CDLL(str(binary))

    def of(self, causality):
        return [name for name, each in self.variables.items() if each.get("causality") == causality]

    def instance(self, token=None, early=True):
        return {3: Instance3, 2: Instance2}[self.version](self, token or self.token, early)


class Instance:
    """One instance. messages : what it has logged. ended, early, last : of the last step."""

    prefix, ended, early, last = "", False, False, 0.0

    def call(self, name, *arguments):
        return getattr(self.unit.library, self.prefix + name)(c_void_p(self.pointer), *arguments)

    def checked(self, name, *arguments):
        status = self.call(name, *arguments)
        assert status == OK, (name, status, self.messages)

    def references(self, names):
        return (c_uint32 * len(names))(*(self.unit.reference[name] for name in names))

    def start(self, values=None, at=0.0):
        self.enter(at)
        self.set(values or {})
        self.checked("ExitInitializationMode")
        return self

    def set(self, values):
        status = self.try_set(values)
        assert status == OK, self.messages

    def get(self, names):
        values = (c_double * len(names))()
        self.checked(self.getter, self.references(names), c_size_t(len(names)), values, *self.sizes(names))
        return dict(zip(names, values, strict=True))

    def try_set(self, values):
        numbers = (c_double * len(values))(*values.values())
        return self.call(self.setter, self.references([*values]), c_size_t(len(values)), numbers, *self.sizes(values))

    def state(self):
        state = c_void_p()
        self.checked(f"Get{self.state_word}", byref(state))
        return state

    def restore(self, state):
        return self.call(f"Set{self.state_word}", state)

    def serialised(self, state):
        size = c_size_t()
        self.checked(f"Serialized{self.state_word}Size", state, byref(size))
        content = ctypes.create_string_buffer(size.value)
        self.checked(f"Serialize{self.state_word}", state, content, size)
        return content.raw

    def deserialised(self, content):
        state = c_void_p()
        status = self.call(self.deserialise, content, c_size_t(len(content)), byref(state))
        return state if status == OK else None

    def free_state(self, state):
        self.checked(f"Free{self.state_word}", byref(state))

    def close(self):
        self.unit.library[self.prefix + "FreeInstance"](c_void_p(self.pointer))


class Instance3(Instance):
    prefix, getter, setter, state_word, deserialise = (
        "fmi3",
        "GetFloat64",
        "SetFloat64",
        "FMUState",
        "DeserializeFMUState",
    )

    def __init__(self, unit, token, early):
        self.unit, self.messages = unit, []
        self.log = LOG_3(lambda _, status, category, text: self.messages.append(text.decode()))
        make = unit.library.fmi3InstantiateCoSimulation
        make.restype = c_void_p
        folder = f"{unit.folder / 'resources'}/".encode()
        self.pointer = make(b"unit", token, folder, False, False, False, early, None, c_size_t(0), None, self.log, None)

    def sizes(self, names):
        return (c_size_t(len(names)),)

    def enter(self, at):
        self.checked("EnterInitializationMode", False, c_double(0.0), c_double(at), False, c_double(0.0))

    def step(self, now, length):
        event, ended, early, last = c_bool(), c_bool(), c_bool(), c_double()
        flags = byref(event), byref(ended), byref(early), byref(last)
        status = self.call("DoStep", c_double(now), c_double(length), True, *flags)
        self.ended, self.early, self.last = ended.value, early.value, last.value
        return status


class Instance2(Instance):
    prefix, getter, setter, state_word, deserialise = "fmi2", "GetReal", "SetReal", "FMUstate", "DeSerializeFMUstate"

    def __init__(self, unit, token, early):
        self.unit, self.messages = unit, []
        log = LOG_2(lambda _, name, status, category, form, text: self.messages.append(text.decode()))
        self.callbacks = Callbacks2(log, (c_void_p * 3)(), None)
        make = unit.library.fmi2Instantiate
        make.restype = c_void_p
        where = (unit.folder / "resources").as_uri().encode()
        self.pointer = make(b"unit", 1, token, where, byref(self.callbacks), 0, 0)

    def sizes(self, names):
        return ()

    def enter(self, at):
        self.checked("SetupExperiment", 0, c_double(0.0), c_double(at), 0, c_double(0.0))
        self.checked("EnterInitializationMode")

    def step(self, now, length):
        status = self.call("DoStep", c_double(now), c_double(length), 1)
        time, over = c_double(), c_int()
        self.checked("GetRealStatus", 2, byref(time))
        self.checked("GetBooleanStatus", 3, byref(over))
        self.ended, self.last = bool(over.value), time.value
        return status
