"""Inputs and outputs over UDP, for hardware and other programs.

All numbers are little-endian. A datagram is a head of 24 bytes and float64 values:

======  ======  ==============================================================
bytes   type    content
======  ======  ==============================================================
0–3     text    ``NVLI`` inputs to nivel, ``NVLO`` outputs of nivel
4–5     uint16  version, 1
6–7     uint16  number of values
8–11    uint32  sequence number; of outputs that of the last inputs taken
12–15   uint32  unused
16–23   int64   time stamp [ns] of the sender's clock; of outputs that of the last inputs taken
24–     float64 inputs: wanted values, in the order of the machine file; outputs: simulated time [s], then the gauges of the page
======  ======  ==============================================================

One sender at a time drives: an address and port. While it is heard, others are dropped, and of its own datagrams all that are not newer
than the last one. After the silence of the watchdog whoever comes first drives, from whatever sequence number on.
"""

import socket
import struct
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from typing import Final

import numpy as np

from nivel.errors import Fault, ModelError
from nivel.lazy import Struct
from nivel.live.picture import gauges
from nivel.live.preparation import SILENCE
from nivel.live.session import Session
from nivel.view.stream import Allowance

HEAD: Final = struct.Struct("<4sHHIIq")
INPUTS, OUTPUTS, VERSION = b"NVLI", b"NVLO", 1
MOST: Final = 4096  # datagrams a second that are taken of a sender
WAIT: Final = 0.1  # s
ROOM: Final = 1 << 20  # bytes that may wait to be read

Place = tuple[str, int]  # address and port


class Counts(Struct, frozen=False):
    """Datagrams that were taken, and those that were dropped: malformed, older than one before, too many, of a sender that does not
    drive."""

    taken: int = 0
    malformed: int = 0
    stale: int = 0
    excessive: int = 0
    others: int = 0

    def __str__(self) -> str:
        return (
            f"{self.taken} taken; dropped: {self.malformed} malformed, {self.others} of other senders, {self.stale} stale, "
            f"{self.excessive} excessive"
        )


def place_of(text: str, option: str) -> tuple[str, int]:
    """Address and port of HOST:PORT, or a port of this machine. Raises ModelError where it is neither, or the host is not known."""
    host, _, port = text.rpartition(":")
    if not port.isdecimal() or not 0 <= int(port) <= 65535:
        raise ModelError(Fault.at(option, f"HOST:PORT was expected, for instance 127.0.0.1:9000, got `{text}`"))
    try:
        return socket.gethostbyname(host or "127.0.0.1"), int(port)
    except (OSError, UnicodeError):
        raise ModelError(Fault.at(option, f"`{host}` is no host that is known here")) from None


class _Driver(Struct, frozen=False):
    """The sender whose inputs the machine follows. sequence, stamp : of its last datagram that was taken, at the time `heard` [s]."""

    place: Place
    allowance: Allowance
    sequence: int
    stamp: int
    heard: float


class Datagrams:
    """Takes inputs for a session, and sends its outputs with every frame.

    listen : where inputs come in; None: an operator at the page has them. send : where outputs go, or None. clock : [s]
    Raises ModelError where the address cannot be used.
    """

    def __init__(
        self, session: Session, listen: Place | None, send: Place | None, *, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self.counts = Counts()
        self._session, self._to, self._clock = session, send, clock
        self._driver: _Driver | None = None
        self._columns = [0, *(variable.columns.start for _, variable in gauges(session.facts["layout"]))]
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._closing = False
        self._thread: threading.Thread | None = None
        if listen is not None:
            try:
                self._socket.bind(listen)
            except OSError as error:
                where = f"{listen[0]}:{listen[1]}"
                raise ModelError(Fault.at("udp", f"{where} cannot be listened at: {error.strerror or error}")) from None
            self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, ROOM)
            self._socket.settimeout(WAIT)
            self._thread = threading.Thread(target=self._listen, daemon=True)
            self._thread.start()

    @property
    def address(self) -> tuple[str, int]:
        """Where inputs come in."""
        return self._socket.getsockname()[:2]

    @property
    def is_driving(self) -> bool:
        """Whether a sender was heard within the time of the watchdog."""
        driver = self._driver
        return driver is not None and self._clock() - driver.heard < SILENCE

    def _listen(self) -> None:
        while not self._closing:
            try:
                content, place = self._socket.recvfrom(2048)
            except TimeoutError:
                continue
            except OSError:
                return
            self.take(content, place)

    def take(self, content: bytes, place: Place = ("", 0)) -> None:
        """Let the machine follow the inputs of a datagram from `place`, or drop and count it. What is dropped changes nothing else."""
        counts, size, now = self.counts, len(self._session.inputs), self._clock()
        read = _read(content, size)
        if read is None:
            counts.malformed += 1
            return
        sequence, stamp, values = read
        driver = self._driver
        if driver is None or now - driver.heard >= SILENCE:
            known = driver is not None and driver.place == place
            allowance = driver.allowance if driver is not None and known else Allowance(MOST, MOST, self._clock)
            driver = _Driver(place, allowance, (sequence - 1) % 2**32, stamp, now)
        elif driver.place != place:
            counts.others += 1
            return
        # a sequence may pass through zero: newer is what lies less than half of the numbers ahead
        if not 0 < (sequence - driver.sequence) % 2**32 < 2**31:
            counts.stale += 1
            return
        if not driver.allowance.spend():
            counts.excessive += 1
            return
        driver.sequence, driver.stamp, driver.heard = sequence, stamp, now
        self._driver = driver
        self._session.operate(values)
        counts.taken += 1

    def send(self) -> None:
        """Send the outputs of the newest frame."""
        frame = self._session.newest
        if self._to is None or frame is None or self._closing:
            return
        values = frame[self._columns]
        driver = self._driver
        sequence, stamp = (0, 0) if driver is None else (driver.sequence, driver.stamp)
        head = HEAD.pack(OUTPUTS, VERSION, len(values), sequence, 0, stamp)
        with suppress(OSError):  # nobody listens there, now
            self._socket.sendto(head + values.astype("<f8").tobytes(), self._to)

    def close(self) -> None:
        """Neither take nor send any more."""
        self._closing = True
        if self._thread is not None:
            self._thread.join(2 * WAIT + 1.0)
        self._socket.close()


def _read(content: bytes, size: int) -> tuple[int, int, list[float]] | None:
    """Sequence number, time stamp and `size` values of a datagram of inputs; None where it is malformed."""
    if len(content) != HEAD.size + 8 * size:
        return None
    kind, version, number, sequence, _, stamp = HEAD.unpack_from(content)
    values = np.frombuffer(content, "<f8", size, HEAD.size)
    if (kind, version, number) != (INPUTS, VERSION, size) or not np.isfinite(values).all():
        return None
    return sequence, stamp, values.tolist()
