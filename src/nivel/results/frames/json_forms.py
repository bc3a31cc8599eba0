"""Forms of the JSON texts of a result file, so that whatever reads them finds what it asks for.

A form is a type (`float` is any number), `[form]` a list, `(form, form)` a list of just these, `{"key": form}` a mapping, where `key?`
may be missing, `*` is every key and other keys may be there; a set is one of its words, `Either` one of several forms. The scene is
described in `nivel.system.scene`.
"""

from typing import Any, Final

from nivel.lazy import Struct


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
