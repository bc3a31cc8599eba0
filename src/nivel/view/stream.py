"""One page that is connected: its frames, newest only and one on its way at a time, and what it asks for, within bounds."""

import asyncio
import json
import math
import struct
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import asdict, fields
from typing import Any, Final, get_args, get_origin, get_type_hints

from nivel.errors import ModelError
from nivel.view.package import message, samples_message
from nivel.view.records import (
    COLUMN,
    FROM_PAGE,
    FROM_SERVER,
    PACKAGE,
    Command,
    Drive,
    Hold,
    Move,
    Refused,
    Reset,
    Shown,
    Take,
    Want,
)
from nivel.view.sources import Source

RATE: Final = 200.0  # messages a second that a page may send for long
BURST: Final = 400.0  # and at once
PATIENCE: Final = 2.0  # seconds after which a frame that nobody acknowledged counts as lost
TELLING: Final = 0.2  # seconds between two words on how a live machine is
REFUSED: Final = 1008  # closing code: policy violation


class Allowance:
    """How much a sender may still say: refilled with time. What is refused costs nothing, so a flood is forgotten when it ends."""

    def __init__(self, rate: float = RATE, burst: float = BURST, clock: Callable[[], float] = time.monotonic) -> None:
        """rate : messages a second, burst : at once. clock : [s]"""
        self._rate, self._burst, self._clock = rate, burst, clock
        self._left, self._at = burst, clock()

    def spend(self) -> bool:
        """Whether one more message is allowed."""
        now = self._clock()
        self._left = min(self._burst, self._left + self._rate * (now - self._at))
        self._at = now
        if self._left < 1.0:
            return False
        self._left -= 1.0
        return True


def within(allowance: Allowance, content: str | bytes) -> Shown | Want | Move | Reset | Drive | Hold | Take | Command:
    """The record in a message, as long as there are not too many.

    Raises NotUnderstoodError.
    """
    if not allowance.spend():
        raise NotUnderstoodError("too many messages")
    return read_message(content)


class Stream:
    """The conversation with one page over its connection (a websocket)."""

    def __init__(self, connection: Any, source: Source) -> None:
        self._connection = connection
        self._source = source
        self._fresh = asyncio.Event()  # there is a frame that was not sent
        self._seen = asyncio.Event()  # no frame is on its way
        self._seen.set()
        self._moves = source.moves()
        self._number = 0
        self._sampled = 0  # number of the last sample that was sent
        # the newest only: a slider that is dragged says more than can be computed
        self._wish: Move | Reset | None = None
        self._wished = asyncio.Event()
        self.frame_count = 0
        self.dropped_count = 0  # messages that were not understood, or too many

    def has_news(self) -> None:
        """The source has a new frame."""
        self._fresh.set()

    async def run(self) -> None:
        """Talk until the page goes."""
        await self._connection.send(struct.pack("<I", PACKAGE) + self._source.package())
        if self._source.frame() is not None:
            self._fresh.set()
        async with asyncio.TaskGroup() as group:
            tasks = [group.create_task(each) for each in (self._send_frames(), self._fulfil(), self._tell())]
            try:
                await self._listen()
            finally:
                self._source.leave(self)
                for task in tasks:
                    task.cancel()

    async def _send_frames(self) -> None:
        while True:
            await self._fresh.wait()
            with suppress(TimeoutError):  # a page in the background shows nothing and says nothing
                await asyncio.wait_for(self._seen.wait(), PATIENCE)
            self._fresh.clear()
            self._sampled, samples = self._source.samples(self._sampled)
            if len(samples):
                await self._connection.send(samples_message(samples))
            newest = self._source.frame()
            if newest is None:
                continue
            for each in self._moves():
                await self._connection.send(each)
            self._number += 1
            content = message(self._number, *newest)
            self._seen.clear()
            self.frame_count += 1
            await self._connection.send(content)

    async def _listen(self) -> None:
        allowance = Allowance()
        async for content in self._connection:
            try:
                wanted = within(allowance, content)
            except NotUnderstoodError as problem:
                self.dropped_count += 1
                if self._source.forgiving:
                    continue
                await self._connection.close(REFUSED, str(problem))
                return
            match wanted:
                case Shown(frame=number):
                    if number == self._number:
                        self._seen.set()
                case Want():
                    await self._answer(wanted)
                case Move() | Reset():
                    self._wish = wanted
                    self._wished.set()
                case Drive() | Hold():
                    self._source.hear(self, wanted)
                case Take() | Command():
                    note = await asyncio.to_thread(self._source.hear, self, wanted)
                    if note is not None:
                        await self._connection.send(said(note))

    async def _answer(self, wanted: Want) -> None:
        try:
            column = await asyncio.to_thread(self._source.column, wanted.stage, wanted.name)
        except ModelError as error:
            await self._connection.send(said(Refused("refused", wanted.request, str(error))))
            return
        await self._connection.send(struct.pack("<III", COLUMN, wanted.request, 0) + column.astype("<f4").tobytes())

    async def _tell(self) -> None:
        """Say how a live machine is, as long as the page is there."""
        while (status := self._source.status(self, self.dropped_count)) is not None:
            await self._connection.send(said(status))
            await asyncio.sleep(TELLING)

    async def _fulfil(self) -> None:
        """Move the machine as the page wishes, one wish after the other, those in between left out."""
        while True:
            await self._wished.wait()
            self._wished.clear()
            wish, self._wish = self._wish, None
            match wish:
                case Move(coordinate=name, value=value):
                    moved = await asyncio.to_thread(self._source.move, name, value)
                case Reset():
                    moved = await asyncio.to_thread(self._source.reset)
                case _:
                    moved = None
            if moved is not None:
                await self._connection.send(said(moved))


LARGEST: Final = 2048  # bytes of a message
LARGEST_NUMBER: Final = 2**32 - 1
LONGEST_NAME: Final = 512
MOST_NUMBERS: Final = 64  # of a list
_RECORDS: Final = {get_type_hints(record)["type"].__args__[0]: record for record in FROM_PAGE}


class NotUnderstoodError(Exception):
    """The message is none that a page sends."""


def read_message(content: str | bytes) -> Shown | Want | Move | Reset | Drive | Hold | Take | Command:
    """The record in a message.

    Raises NotUnderstoodError.
    """
    if not isinstance(content, str) or len(content) > LARGEST:
        raise NotUnderstoodError("a short text was expected")
    try:
        data = json.loads(content)
    except (ValueError, RecursionError):
        raise NotUnderstoodError("this is not JSON") from None
    kind = data.get("type") if isinstance(data, dict) else None
    record = _RECORDS.get(kind) if isinstance(kind, str) else None
    if record is None or set(data) != {field.name for field in fields(record)}:
        raise NotUnderstoodError("there is no such message")
    hints = get_type_hints(record)
    return record(**{name: _value(hints[name], value) for name, value in data.items()})


def _value(hint: Any, value: Any) -> Any:
    if hint is int:
        if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value <= LARGEST_NUMBER:
            raise NotUnderstoodError("a number from zero on was expected")
    elif hint is float:
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise NotUnderstoodError("a number was expected")
        value = _float(value)
    elif get_origin(hint) is list:
        if not isinstance(value, list) or len(value) > MOST_NUMBERS:
            raise NotUnderstoodError("a short list was expected")
        value = [_value(get_args(hint)[0], each) for each in value]
    elif not isinstance(value, str) or len(value) > LONGEST_NAME:
        raise NotUnderstoodError("a name was expected")
    return value


def _float(value: float) -> float:
    try:
        value = float(value)
    except OverflowError:
        value = math.inf
    if not math.isfinite(value):
        raise NotUnderstoodError("a finite number was expected")
    return value


def said(record: Any) -> str:
    """A record of the server as the text of a message."""
    if not isinstance(record, FROM_SERVER):
        raise TypeError(f"{type(record).__name__} is not a message of the server")
    return json.dumps(asdict(record), allow_nan=False)
