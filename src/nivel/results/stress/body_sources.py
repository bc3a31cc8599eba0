"""Sources of the flexible bodies of a run, kept in its result so that they are found again."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from difflib import get_close_matches
from pathlib import Path

import numpy as np

from nivel.errors import ModelError
from nivel.flexible.body.body import ReducedBody
from nivel.flexible.body.body_file import read_body
from nivel.flexible.body.identity import fingerprint

ATTRIBUTE = "flexible_bodies"


@dataclass(frozen=True)
class BodySource:
    """A flexible body of a run: its `file`, the places of the `modes` that were used among all of it, `fingerprint` of it with these."""

    name: str
    file: str
    modes: tuple[int, ...]
    fingerprint: str

    def read(self, path: Path) -> ReducedBody:
        """The body with the modes of the run from the file where it is now. Raises ModelError where its modes are not those of the run."""
        whole = read_body(path)
        if max(self.modes, default=-1) < len(whole.eigenvalues):
            body = whole.keeping(np.array(self.modes, dtype=np.int64))
            if fingerprint(body) == self.fingerprint:
                return body
        raise ModelError(
            f"{path} was changed since the run, or is another body: its modes are not those that `{self.name}` had, so the "
            f"modal coordinates of this result mean nothing to it; run the machine again, or give the file of the run with --body-file "
            f"(in Python: file=…)"
        )

    def path(self, beside: Path | None = None) -> Path:
        """Where the file was in the run, or else a file of that name in the folder `beside`. Raises ModelError where both are gone."""
        places = [Path(self.file), *([beside / Path(self.file).name] if beside is not None else [])]
        for place in places:
            if place.is_file():
                return place
        raise ModelError(
            f"the file of the flexible body `{self.name}` is gone: {self.file}; say where it is with --body-file (in Python: "
            f"file=…), or reduce its model again and run the machine again"
        )


def as_attribute(sources: list[BodySource]) -> str:
    """The attribute of a result, JSON."""
    return json.dumps([asdict(each) for each in sources])


def source_of(attributes: Mapping[str, str | float | int], name: str | None) -> BodySource:
    """The flexible body called `name`, default the only one. Raises ModelError where there is none, or more than one to choose from."""
    known = {
        each["name"]: BodySource(each["name"], each["file"], tuple(each["modes"]), each["fingerprint"])
        for each in json.loads(str(attributes.get(ATTRIBUTE, "[]")))
    }
    if not known:
        raise ModelError("no body of this machine is flexible: stress is known of bodies made by `nivel reduce` only")
    if name is None:
        if len(known) > 1:
            raise ModelError(f"the machine has several flexible bodies, {', '.join(known)}: say which one")
        return next(iter(known.values()))
    if name not in known:
        near = get_close_matches(name, known, n=1)
        hint = f"did you mean `{near[0]}`?" if near else f"the flexible bodies are {', '.join(known)}"
        bodies = [each["name"] for each in json.loads(str(attributes.get("scene", "{}"))).get("bodies", [])]
        what = f"the body `{name}` is not flexible" if name in bodies else f"there is no body `{name}`"
        raise ModelError(f"{what}; {hint}")
    return known[name]
