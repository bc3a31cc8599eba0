"""Read a result file: finished, still being written, or left behind by a killed run.

Its JSON texts have forms, so that whatever reads them finds what it asks for. A form is a type (`float` is any number), `[form]` a list,
`(form, form)` a list of just these, `{"key": form}` a mapping, where `key?` may be missing, `*` is every key and other keys may be there;
a set is one of its words, `Either` one of several forms. The scene is described in `nivel.system.scene`.
"""

import json
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from nivel.errors import ModelError
from nivel.lazy import Struct, h5py, replace
from nivel.results.frames.contents import MemoryContents, check_format, name_in_file, name_of, written_by_newer
from nivel.system.layout import Variable


class Either(Struct):
    """One of these forms; None is a form too."""

    forms: tuple[Any, ...]


VECTOR: Final = (float, float, float)
DRAWN: Final = {"centre": VECTOR, "colour?": str}
LONG: Final = {**DRAWN, "length": float, "along": frozenset("xyz")}
SHAPE: Final = Either(
    (
        {"type": frozenset(["box"]), **DRAWN, "size": VECTOR},
        {"type": frozenset(["sphere"]), **DRAWN, "radius": float},
        {"type": frozenset(["ellipsoid"]), **DRAWN, "semi_axes": VECTOR},
        {"type": frozenset(["cylinder", "capsule"]), **LONG, "radius": float},
        {"type": frozenset(["tube"]), **LONG, "outer_radius": float, "inner_radius": float},
        {"type": frozenset(["extrusion"]), **LONG, "outline": [(float, float)]},
        {"type": frozenset(["mesh"]), **DRAWN, "surface": str},
    )
)
BETWEEN: Final = {"name": str, "type": str, "bodies": [str], "points": [VECTOR]}
WHEELS: Final = {"axis": VECTOR, "carrier": int, "radii": [float], "arcs": [float], "fixed": (VECTOR, VECTOR)}
SCENE: Final = {
    "bodies": [
        {
            "name": str,
            "shape": Either((None, SHAPE)),
            "looks?": [SHAPE],
            "centre_of_mass": VECTOR,
            "points": [VECTOR],
            "mass?": float,
            "radius_of_gyration?": float,
            "flexible?": {"surface": str, "modes": str, "first": int},
        }
    ],
    "ground_points": [VECTOR],
    "joints": [
        {
            **BETWEEN,
            "bodies": (str, str),
            "points": (VECTOR, VECTOR),
            "axes": (VECTOR, VECTOR),
            "x_axes?": (VECTOR, VECTOR),
            "slot?": VECTOR,
        }
    ],
    "markers?": [{"name": str, "body": str, "position": VECTOR, "x_axis": VECTOR, "axis": VECTOR}],
    "forces?": [{**BETWEEN, "axis?": VECTOR, "sizes?": (float, float, float), "wheels?": WHEELS}],
    "sweeps?": [{"name": str, "bodies": [str], "section": [(float, float)]}],
}
NAMED: Final = [{"name": str}]
RECORD: Final = {
    "gravity?": VECTOR,
    "simulation?": {},
    **dict.fromkeys(("bodies?", "beams?", "joints?", "couplings?", "drivers?", "forces?", "hydraulics?"), NAMED),
    **dict.fromkeys(("inputs?", "states?", "control?", "sensors?", "events?"), NAMED),
}
SETTINGS: Final = {
    **dict.fromkeys(("duration?", "step?", "output_interval?", "tolerance?", "largest_step?"), Either((None, float))),
    **dict.fromkeys(("integrator?", "formulation?", "coordinates?", "stabilisation?"), Either((None, str))),
}
CHANGE: Final = (str, float, float)
FORMS: Final[dict[str, Any]] = {
    "scene": SCENE,
    "machine_record": RECORD,
    "settings": SETTINGS,
    "timing": {"*": float},
    "iterations": {"length": float, "part": [int], "steps": [int], "total": [int], "most": [int]},
    "buckling": [{"time": float, "moves": str}],
    "flexible_bodies": [{"name": str, "file": str, "modes": [int], "fingerprint": str}],
    "assembly": {"gap?": float, "gap_row?": str, "followed?": [str], "moved?": [CHANGE], "velocity_change?": [CHANGE]},
    "constraint_units": {"*": str},
    "coordinate_units": {"*": str},
}


def misshapen(form: Any, value: Any, place: str = "") -> str:
    """Where a value is not of the form, and how; empty where it is."""
    match form:
        case Either(forms):
            return "" if any(not misshapen(each, value) for each in forms) else _wrong(place, value)
        case frozenset():
            return "" if isinstance(value, str) and value in form else _wrong(place, value)
        case None:
            return "" if value is None else _wrong(place, value)
        case dict():
            return _of_mapping(form, value, place)
        case list() | tuple():
            if not isinstance(value, list) or (isinstance(form, tuple) and len(value) != len(form)):
                return _wrong(place, value)
            forms = form if isinstance(form, tuple) else form * len(value)
            return next(
                (told for k, each in enumerate(value) if (told := misshapen(forms[k], each, f"{place}.{k}"))), ""
            )
    kinds = (int, float) if form is float else form
    return "" if isinstance(value, kinds) and not isinstance(value, bool) else _wrong(place, value)


def strangers(scene: dict[str, Any]) -> str:
    """Which body of a scene of the right form is none of its bodies; empty where all are."""
    known = {"ground", *(body["name"] for body in scene["bodies"])}
    used = [name for part in ("joints", "forces", "sweeps") for each in scene.get(part, ()) for name in each["bodies"]]
    used += [marker["body"] for marker in scene.get("markers", ())]
    few = [each["name"] for each in scene.get("forces", ()) if not 2 <= len(each["bodies"]) == len(each["points"])]
    if few:
        return f"the force {few[0]} has not as many points as bodies"
    if other := [each["name"] for each in scene.get("forces", ()) if "wheels" in each and not _fit(each)]:
        return f"the wheels of the rope {other[0]} are not those of its points"
    return next((f"there is no body {name!r}" for name in used if name not in known), "")


def _fit(rope: dict[str, Any]) -> bool:
    """Whether every point of a rope around wheels has its radius and arc."""
    wheels, count = rope["wheels"], len(rope["points"])
    return len(wheels["radii"]) == len(wheels["arcs"]) == count and 0 <= wheels["carrier"] < count


def _of_mapping(form: dict[str, Any], value: Any, place: str) -> str:
    if not isinstance(value, dict):
        return _wrong(place, value)
    if "*" in form:
        return next((told for key, each in value.items() if (told := misshapen(form["*"], each, f"{place}.{key}"))), "")
    for key, inner in form.items():
        name = key.removesuffix("?")
        if name in value:
            if told := misshapen(inner, value[name], f"{place}.{name}"):
                return told
        elif name == key:
            return f"{place.lstrip('.') or 'it'} lacks `{name}`"
    return ""


def _wrong(place: str, value: Any) -> str:
    return f"{place.lstrip('.') or 'it'} is {type(value).__name__} where something else belongs"


# what reading a file raises whose parts are not what they should be
DAMAGE = (AttributeError, IndexError, KeyError, TypeError, ValueError, MemoryError)
# attributes that are JSON text
JSON_TEXTS: Final = (
    *("trust", "settings", "timing", "scene", "machine_record", "events", "assembly", "constraint_units"),
    *("coordinate_units", "critical_points", "buckling", "estimated_errors", "flexible_bodies", "iterations"),
)
# A file holds at least this share of the bytes that its frames take: no compression of times gets below.
LEAST_SHARE = 1e-4
SMALL = 100_000_000  # bytes that are read without a question


@contextmanager
def opened(path: Path) -> Iterator[h5py.File]:
    """The file, open for reading, also while another process writes it or after that process was killed."""
    try:
        file = h5py.File(path, "r", locking="best-effort")
    except (OSError, RuntimeError):
        file = _opened_while_running(path)
    with file:
        try:
            yield file
        except (RuntimeError, OSError) as error:  # of the HDF5 library
            raise ModelError(f"{path} is damaged and cannot be read: {error}") from None


def _opened_while_running(path: Path) -> h5py.File:
    """The file in SWMR mode (single writer, multiple readers): such a file refuses to be opened otherwise."""
    if not os.path.exists(path):  # Path.exists raises where the name is too long
        raise ModelError(f"there is no result file {path}") from None
    if os.path.isdir(path):
        raise ModelError(f"{path} is a folder; a result file of nivel was expected") from None
    try:
        return h5py.File(path, "r", swmr=True, locking="best-effort")
    except PermissionError:
        raise ModelError(f"{path} may not be read: permission denied") from None
    except (OSError, RuntimeError):
        made_by = f"; `nivel run {path}` makes the result of a machine" if path.suffix in (".yaml", ".yml") else ""
        raise ModelError(f"{path} is not a result of nivel (NetCDF-4){made_by}") from None


class StoredContents:
    """Contents of a result file. The file is open only while something is read, so results can be kept and pickled.

    The number of frames is that of the moment of opening: all variables have at least these frames, whatever a writer
    was doing. What this process has just written need not be read: see `of`.
    """

    attributes: dict[str, str | float | int]
    variables: dict[str, Variable]
    coordinates: dict[str, tuple[str, ...]]
    frame_count: int
    _memory: MemoryContents | None = None

    def __init__(self, path: Path) -> None:
        self.path = path
        with opened(path) as file:
            written: Mapping[str, Any] = {}
            try:
                written = file.attrs
                if "nivel_version" in written:
                    check_format(path, written)
                if "nivel_version" not in written or "time" not in file:
                    raise ModelError(
                        f"{path} is not a result file of nivel: "
                        "it lacks the attribute `nivel_version` or the variable `time`"
                    )
                self._understand(file)
            except DAMAGE as error:
                raise ModelError(f"{path} is damaged and cannot be read: {error}{written_by_newer(written)}") from None

    @classmethod
    def of(cls, path: Path, memory: MemoryContents) -> "StoredContents":
        """Those of a file that holds what is in memory."""
        made = cls.__new__(cls)
        made.path, made.frame_count, made._memory = path, memory.frame_count, memory
        made.attributes, made.coordinates = memory.attributes, memory.coordinates
        made.variables = {
            name: replace(each, columns=slice(0, each.columns.stop - each.columns.start))
            for name, each in memory.variables.items()
        }
        return made

    def __getstate__(self) -> dict[str, Any]:
        return {**vars(self), "_memory": None}

    def _understand(self, file: h5py.File) -> None:
        self.attributes = {key: _plain(file.attrs[key]) for key in file.attrs if not key.startswith("_")}
        for key in JSON_TEXTS:
            _refuse_broken(key, self.attributes.get(key))
        self.variables, self.coordinates = {}, {}
        times = _dataset(file, "time")
        self.frame_count = times.shape[0]
        if times.id.get_storage_size() < LEAST_SHARE * 8 * self.frame_count:
            raise ValueError(f"it claims {self.frame_count} frames, which it does not hold")
        datasets = {name: _dataset(file, name) for name in map(str, file)}
        # HDF5 searches the whole file for the name of what a reference leads to
        scales = {each.id: name for name, each in datasets.items() if each.is_scale}
        for name, dataset in datasets.items():
            if name == "time":
                continue
            name.encode()
            claimed = 8 * int(dataset.size or 0)
            if claimed > SMALL and dataset.id.get_storage_size() < LEAST_SHARE * claimed:
                raise ValueError(f"`{name}` claims {dataset.size} numbers, which it does not hold")
            if dataset.is_scale:
                self.coordinates[name] = tuple(dataset.asstr()[()])
                continue
            own = [dimension[0] for dimension in dataset.dims]
            dims = tuple(scales[each.id] for each in own)
            if dataset.shape[1:] != tuple(each.shape[0] for each in own[1:]):
                raise ValueError(f"`{name}` has {dataset.shape[1:]} numbers a frame, and other names of them")
            columns = slice(0, int(np.prod(dataset.shape[1:])))
            units, long_name = str(_plain(dataset.attrs["units"])), str(_plain(dataset.attrs["long_name"]))
            self.variables[name_of(name)] = Variable(name_of(name), dims, units, long_name, columns)
            self.frame_count = min(self.frame_count, dataset.shape[0])
        if "position" in self.variables and "scene" not in self.attributes:
            raise ValueError("it has positions and lacks the attribute `scene`, which says of what")

    def read(self, name: str, where: tuple[slice | int, ...] = ()) -> NDArray[np.float64]:
        if self._memory is not None:
            return self._memory.read(name, where)
        frames, rest = (where[0], where[1:]) if where else (slice(None), ())
        frames = range(self.frame_count)[frames]
        index = slice(frames.start, frames.stop, frames.step) if isinstance(frames, range) else frames
        with opened(self.path) as file:
            try:
                return np.asarray(_dataset(file, name_in_file(name))[(index, *rest)], dtype=np.float64)
            except DAMAGE as error:
                raise ModelError(f"{self.path} is damaged, `{name}` cannot be read: {error}") from None


def _refuse_broken(key: str, text: object) -> None:
    """Raises ValueError where the attribute is there and is no JSON, or not of its form."""
    if text is None:
        return
    try:
        value = json.loads(str(text))
    except (ValueError, RecursionError) as error:
        raise ValueError(f"the attribute `{key}`: {error}") from None
    if key in FORMS and (told := misshapen(FORMS[key], value)):
        raise ValueError(f"the attribute `{key}`: {told}")
    if key == "scene" and (told := strangers(value)):
        raise ValueError(f"the attribute `{key}`: {told}")


def _dataset(file: h5py.File, name: str) -> Any:
    """What is stored under a name in this file itself: another file that it may point to is nobody's result."""
    dataset: Any = file[name] if isinstance(file.get(name, getlink=True), h5py.HardLink) else None
    if not isinstance(dataset, h5py.Dataset) or dataset.is_virtual or dataset.external:
        raise ValueError(f"`{name}` is no variable, or one of another file")
    return dataset


@contextmanager
def understood(contents: object, attribute: str) -> Iterator[None]:
    """Inside, what an attribute lacks or has wrongly is told as damage of the file. Raises ModelError."""
    try:
        yield
    except DAMAGE as error:
        file = getattr(contents, "path", None) or "the result"
        newer = written_by_newer(getattr(contents, "attributes", {}))
        said = f"{type(error).__name__}: {(str(error).splitlines() or [''])[0]}"
        raise ModelError(f"{file} is damaged, `{attribute}` cannot be read: {said}{newer}") from None


def _plain(value: Any) -> str | float | int:
    """An attribute as a Python str, float or int."""
    if isinstance(value, bytes):
        return value.decode()
    if isinstance(value, str):
        value.encode()  # raises where it has bytes that are no characters
        return value
    return value.item() if isinstance(value, np.generic | np.ndarray) else value
