"""Sources of a server: something with a package, and perhaps with frames that come while it is looked at."""

from collections.abc import Callable, Sequence
from threading import Lock
from typing import Any, Protocol

import numpy as np

from nivel.errors import ModelError
from nivel.machine.core.vectors import Array
from nivel.results.result import Result
from nivel.view import package, records
from nivel.view.couplings import couplings
from nivel.view.extent import extent
from nivel.view.package import Block, to_bytes
from nivel.view.playback import SERVED, Budget, playback, played_frames
from nivel.view.stage import cast, flexible


class Source:
    """What is shown; without frames of its own, unless it says otherwise.

    on_change : called, from any thread, when there is a new frame.
    forgiving : messages that are not understood, or come too often, are dropped and counted; else their page is sent away.
    """

    def __init__(self) -> None:
        self.on_change: Callable[[], None] = lambda: None
        self.forgiving = False

    def package(self) -> bytes:
        """Everything that the page needs at first."""
        raise NotImplementedError

    def frame(self) -> tuple[float, Array] | None:
        """The newest frame with its time; None where the package has the whole motion."""
        return None

    def samples(self, after: int) -> tuple[int, Array]:
        """Of a live machine the samples (n, width) that follow number `after`, and the number of the last: see `Package.traced`."""
        return after, np.empty((0, 0))

    def moves(self) -> Callable[[], list[bytes]]:
        """For a page: messages on how terrains have moved since it asked last, or since the package."""
        return list

    def column(self, stage: int, name: str) -> Array:
        """A column of a stage, one number a frame. Raises ModelError."""
        raise ModelError(f"there is no variable `{name}`")

    def move(self, coordinate: str, value: float) -> records.Moved | None:
        """Move a joint coordinate by hand; None where nothing can be moved."""
        return None

    def reset(self) -> records.Moved | None:
        """Put the machine back."""
        return None

    def hear(
        self, page: object, said: records.Drive | records.Hold | records.Take | records.Command
    ) -> records.Note | None:
        """What a page that operates a live machine says."""
        return None

    def status(self, page: object, dropped: int) -> records.Status | None:
        """How a live machine is; None of others. dropped : messages of this page."""
        return None

    def leave(self, page: object) -> None:
        """A page is gone."""


class Playback(Source):
    """A result, and results laid over it as ghosts."""

    def __init__(self, results: Sequence[Result], budget: Budget = SERVED) -> None:
        super().__init__()
        self._results = list(results)
        self._budget = budget
        self._package = playback(self._results, budget)

    def package(self) -> bytes:
        return self._package

    def column(self, stage: int, name: str) -> Array:
        if stage >= len(self._results):
            raise ModelError("there is no such result")
        result = self._results[stage]
        values = result.array(name, played_frames(result, self._budget))
        if values.ndim != 1:
            raise ModelError(f"`{name}` is not one number a frame")
        return values


class Movable(Protocol):
    """A machine that can be moved by hand. `movements` have name, unit, value, low, high and free, as `records.Coordinate`."""

    @property
    def scene(self) -> dict[str, Any]:
        """As in a result."""
        ...

    @property
    def movements(self) -> Sequence[Any]:
        """What can be moved."""
        ...

    def pose(self) -> tuple[Array, Array]:
        """Position (B, 3) and Euler parameters (B, 4) of all bodies."""
        ...

    def values(self) -> list[float]:
        """Of all movements now."""
        ...

    def move(self, name: str, value: float) -> str:
        """Why it could not be moved there, or an empty text."""
        ...

    def reset(self) -> None:
        """Back to the start."""
        ...


class PosedMachine(Source):
    """A machine moved by hand: every move gives a frame."""

    def __init__(self, name: str, movable: Movable, record: dict[str, Any]) -> None:
        super().__init__()
        self._movable = movable
        self._lock = Lock()
        block = Block()
        self._stage = machine_stage(name, movable.scene, record, block, movable.pose(), movable.movements)
        self._package = to_bytes(records.Package(records.PROTOCOL, "machine", [self._stage]), block)

    def package(self) -> bytes:
        return self._package

    def frame(self) -> tuple[float, Array] | None:
        with self._lock:
            position, orientation = self._movable.pose()
        undeformed = np.zeros((1, self._stage.layout.modes))
        return 0.0, package.rows(position[None] - np.array(self._stage.origin), orientation[None], undeformed)[0]

    def move(self, coordinate: str, value: float) -> records.Moved | None:
        return self._moved(lambda: self._movable.move(coordinate, value))

    def reset(self) -> records.Moved | None:
        return self._moved(self._movable.reset)

    def _moved(self, move: Callable[[], str | None]) -> records.Moved:
        """What the page hears after a move, which says why it could not be made."""
        with self._lock:
            problem = move()
            values = self._movable.values()
        self.on_change()
        return records.Moved("moved", values, problem or "")


def machine_stage(
    name: str,
    scene: dict[str, Any],
    record: dict[str, Any],
    block: Block,
    pose: tuple[Array, Array],
    movements: Sequence[Any] = (),
) -> records.Stage:
    """What is drawn of a machine in a pose. movements : as of `Movable`."""
    players = cast(scene, record, block)
    position, orientation = pose
    where = extent(players, position[None], orientation[None])
    bending = flexible(scene, block, None)
    modes = max((each.first + each.modes.shape[0] for each in bending), default=0)
    row = package.rows(position[None] - np.array(where.origin), orientation[None], np.zeros((1, modes)))
    motion = records.Motion(block.add(np.zeros(1), "f8"), block.add(row.T), 1, 1)
    return records.Stage(
        **vars(where),
        **players.lists,
        name=name,
        title=name,
        layout=package.layout(len(players.bodies), modes),
        flexible=bending,
        arrows=[],
        couplings=couplings(players, position[None], orientation[None]),
        coordinates=[
            records.Coordinate(m.name, m.name.partition(".")[0], m.unit, m.value, m.low, m.high, m.free)
            for m in movements
        ],
        motion=motion,
    )
