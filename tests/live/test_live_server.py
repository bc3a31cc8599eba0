"""The server of a live machine: one page operates it, nonsense is dropped and counted, datagrams have their format."""

import asyncio
import json
import random
import socket
import struct
import time
from contextlib import AsyncExitStack

import numpy as np
import pytest

import cart
from browsing import served
from nivel.errors import ModelError
from nivel.integrate.loop.paced import BIN_WIDTH, BINS, COMPUTING, DONE
from nivel.live.datagrams import Counts, Datagrams, packed_inputs, place_of
from nivel.live.source import LiveSource
from nivel.view.records import FRAME

websockets = pytest.importorskip("websockets")


@pytest.fixture(scope="module")
def live():
    """A running session and the viewing of its page."""
    with cart.running() as session, served(LiveSource(session)) as viewing:
        session.command("run")
        yield session, viewing


def connected(viewing):
    port = viewing.address.port
    return websockets.connect(
        f"ws://127.0.0.1:{port}/stream", origin=f"http://127.0.0.1:{port}", max_size=None, proxy=None, close_timeout=0.5
    )


async def statuses(page, wanted):
    """Messages of the server until one of them fulfils a condition."""
    while True:
        content = await asyncio.wait_for(page.recv(), 30.0)
        if isinstance(content, str):
            message = json.loads(content)
            if wanted(message):
                return message


def test_inputs_come_back_in_frames_many_times_a_second(live):
    """A page that acknowledges every frame gets 60 a second, and soon one that has what it wanted."""
    _, viewing = live

    async def talk():
        frames, delay, begin, asked = 0, None, time.monotonic(), 0.0
        async with connected(viewing) as page:
            await page.send('{"type": "take", "on": 1}')
            while time.monotonic() < begin + 2.0:
                content = await asyncio.wait_for(page.recv(), 30.0)
                if not isinstance(content, bytes) or struct.unpack_from("<I", content)[0] != FRAME:
                    continue
                frames += 1
                await page.send(json.dumps({"type": "shown", "frame": struct.unpack_from("<I", content, 4)[0]}))
                asked = asked or time.monotonic()
                await page.send('{"type": "drive", "values": [0, 1.5]}')
                if delay is None and struct.unpack_from("<f", content, len(content) - 4)[0] == 1.5:
                    delay = time.monotonic() - asked
        return frames, delay

    frames, delay = asyncio.run(talk())
    assert frames > 30
    assert delay is not None
    assert delay < 1.0


def test_one_page_operates_and_another_may_not(live):
    session, viewing = live

    async def talk():
        async with connected(viewing) as first, connected(viewing) as second:
            await statuses(first, lambda m: m["type"] == "status" and m["driver"] == "nobody")
            await first.send('{"type": "take", "on": 1}')
            await statuses(first, lambda m: m["type"] == "status" and m["driver"] == "you")
            await second.send('{"type": "take", "on": 1}')
            note = await statuses(second, lambda m: m["type"] == "note")
            await second.send('{"type": "command", "word": "pause", "number": 0}')
            refused = await statuses(second, lambda m: m["type"] == "note")
            await second.send('{"type": "drive", "values": [1, 1]}')
            await first.send('{"type": "drive", "values": [0, 2]}')
            while session.live.target[:2].tolist() != [0.0, 2.0]:
                await asyncio.wait_for(first.recv(), 30.0)
            targets = session.live.target[:2].tolist()
            await first.send('{"type": "take", "on": 0}')
            await second.send('{"type": "take", "on": 1}')
            await statuses(second, lambda m: m["type"] == "status" and m["driver"] == "you")
            return note["text"], refused["text"], targets

    note, refused, targets = asyncio.run(talk())
    assert note == "another person operates the machine"
    assert refused == "take the controls first"
    assert targets == [0.0, 2.0]
    assert session.mode == "running"


def ticks_by_computing_time(session):
    return session.live.histogram[COMPUTING * BINS : (COMPUTING + 1) * BINS].copy()


def median_bin(counts):
    return int(np.searchsorted(np.cumsum(counts), counts.sum() / 2))


@pytest.mark.parametrize("seconds", [0.5, pytest.param(10.0, marks=pytest.mark.full)])
def test_twenty_watchers_of_whom_four_stop_reading_change_nothing_for_the_operator(live, seconds):
    """Who reads nothing holds nobody up: the operator's wish comes back, no tick is late by the loop's own computing, and half of the
    ticks take no longer than twice what they took before."""
    session, viewing = live
    session.command("run")
    before = ticks_by_computing_time(session)
    time.sleep(seconds)
    alone, own = ticks_by_computing_time(session) - before, session.timing.own

    async def reads(page, end):
        while time.monotonic() < end:
            content = await asyncio.wait_for(page.recv(), 30.0)
            if isinstance(content, bytes) and struct.unpack_from("<I", content)[0] == FRAME:
                await page.send(json.dumps({"type": "shown", "frame": struct.unpack_from("<I", content, 4)[0]}))

    async def talk():
        async with AsyncExitStack() as stack:
            pages = [await stack.enter_async_context(connected(viewing)) for _ in range(20)]
            stuck = pages[:4]
            for page in stuck:
                page.transport.pause_reading()
            operator = await stack.enter_async_context(connected(viewing))
            await operator.send('{"type": "take", "on": 1}')
            end = time.monotonic() + seconds
            watching = [asyncio.create_task(reads(page, end)) for page in pages[4:]]
            back = 0
            while time.monotonic() < end or not back:
                await operator.send('{"type": "drive", "values": [0, 0.75]}')
                content = await asyncio.wait_for(operator.recv(), 30.0)
                if isinstance(content, bytes) and struct.unpack_from("<I", content)[0] == FRAME:
                    await operator.send(json.dumps({"type": "shown", "frame": struct.unpack_from("<I", content, 4)[0]}))
                    back += struct.unpack_from("<f", content, len(content) - 4)[0] == 0.75
            await asyncio.gather(*watching)
            for page in stuck:
                page.transport.resume_reading()
            return len(viewing.streams), back

    begin = ticks_by_computing_time(session)
    pages, back = asyncio.run(talk())
    assert pages == 21
    assert back > 0
    assert session.timing.own == own
    assert median_bin(ticks_by_computing_time(session) - begin) - median_bin(alone) < np.log(2.0) / BIN_WIDTH


def nonsense(random_numbers):
    """A message: bytes, broken JSON, records with wrong parts, names that look like paths."""
    pick = random_numbers.randrange(6)
    if pick == 0:
        return random_numbers.randbytes(random_numbers.randrange(60))
    if pick == 1:
        return "".join(chr(random_numbers.randrange(32, 1000)) for _ in range(random_numbers.randrange(60)))
    kind = random_numbers.choice(["drive", "take", "command", "want", "move", "reset", "shown", "x", None, 7])
    values = [None, True, -1, 1e999, "../../etc/passwd", "__import__('os')", [1] * 70, ["a"], {"a": []}, [[[]]]]
    keys = random_numbers.sample(["values", "on", "word", "number", "coordinate", "value", "request"], 2)
    return json.dumps({"type": kind, **{key: random_numbers.choice(values) for key in keys}})


@pytest.mark.parametrize("count", [5_000, pytest.param(100_000, marks=pytest.mark.full)])
def test_random_messages_are_dropped_and_counted(live, count):
    session, viewing = live
    numbers = random.Random(count)

    async def talk():
        async with connected(viewing) as page:
            for _ in range(count):
                await page.send(nonsense(numbers))
            return (await statuses(page, lambda m: m["type"] == "status" and m["dropped"] >= count))["dropped"]

    ticks = int(session.live.control[DONE])
    assert asyncio.run(talk()) == count
    cart.until(lambda: int(session.live.control[DONE]) > ticks)
    assert session.mode == "running"
    cart.until(lambda: session.values() == {"lever": 0.0, "brake": 1.0}, "inputs at rest")


def test_places_of_datagrams_are_looked_up_at_once():
    assert place_of("localhost:9000", "udp") == ("127.0.0.1", 9000)
    assert place_of("9001", "udp") == ("127.0.0.1", 9001)
    with pytest.raises(ModelError, match="HOST:PORT was expected"):
        place_of("127.0.0.1:x", "udp")
    with pytest.raises(ModelError, match="is no host that is known here"):
        place_of("no host:9000", "udp-to")


def test_datagrams_operate_the_machine_and_bad_ones_are_counted(live):
    session, _ = live
    outside = Datagrams(session, ("127.0.0.1", 0), None)
    try:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            for k in range(40):
                sender.sendto(packed_inputs([-0.5, 0.5], k + 1, time.monotonic_ns()), outside.address)
                time.sleep(0.01)
            cart.until(lambda: session.live.target[:2].tolist() == [-0.5, 0.5])
            for bad in (b"", b"NVLI", packed_inputs([1.0], 99, 0), packed_inputs([np.nan, 0.0], 99, 0), b"X" * 40):
                sender.sendto(bad, outside.address)
            sender.sendto(packed_inputs([1.0, 1.0], 3, 0), outside.address)
            cart.until(lambda: outside.counts.stale == 1)
    finally:
        outside.close()
    assert outside.counts == Counts(taken=40, malformed=5, stale=1)
    assert session.live.target[:2].tolist() == [-0.5, 0.5]
